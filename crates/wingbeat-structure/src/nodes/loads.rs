//! Loads on nodes, dead and following.

use wingbeat_math::six_by_six::{ZERO, from_quarters};
use wingbeat_math::{DMat3, DVec3, SixBySix, tilde};

use crate::nodes::block::add_pair;
use crate::nodes::configuration::{Configuration, NODE};

/// Loads that depend on the configuration alone.
pub trait Loading {
    /// Adds the loads on all nodes, six numbers each: force in W components \[N\], moment in node components [N m].
    fn add(&self, at: &Configuration, loads: &mut [f64]);

    /// Derivative of the loads on a node by the increments of that node (dx in W, dtheta in node components), by rows;
    /// none if it is zero or not known: Newton's iteration then needs more passes.
    fn tangent(&self, _at: &Configuration, _node: usize) -> Option<[[f64; NODE]; NODE]> {
        None
    }
}

impl<F: Fn(&Configuration, &mut [f64])> Loading for F {
    fn add(&self, at: &Configuration, loads: &mut [f64]) {
        self(at, loads);
    }
}

/// A load on one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeLoad {
    /// The node.
    pub node: usize,
    /// Force \[N\], W components, or those of the node if it follows.
    pub force: DVec3,
    /// Moment [N m], W components, or those of the node if it follows.
    pub moment: DVec3,
    /// Whether force and moment turn with the node (components are the node's) or keep their direction in W.
    pub follows: bool,
}

impl NodeLoad {
    /// Force in W components and moment in node components, with the derivative.
    fn now(&self, at: &Configuration) -> ([DVec3; 2], SixBySix) {
        let r = DMat3::from_quat(at.rotation[self.node]);
        let zero = DMat3::ZERO;
        if self.follows {
            let turn = r * tilde(-self.force);
            (
                [r * self.force, self.moment],
                from_quarters([[zero, turn], [zero, zero]]),
            )
        } else {
            let moment = r.transpose() * self.moment;
            (
                [self.force, moment],
                from_quarters([[zero, zero], [zero, tilde(moment)]]),
            )
        }
    }
}

/// Any number of loads on nodes.
impl Loading for [NodeLoad] {
    fn add(&self, at: &Configuration, loads: &mut [f64]) {
        for load in self {
            add_pair(loads, load.node, load.now(at).0);
        }
    }

    fn tangent(&self, at: &Configuration, node: usize) -> Option<SixBySix> {
        let mut here = self.iter().filter(|l| l.node == node).peekable();
        here.peek()?;
        let parts = here.map(|l| l.now(at).1);
        Some(parts.fold(ZERO, |a, b| wingbeat_math::six_by_six::sum(&a, &b)))
    }
}

/// No load.
impl Loading for () {
    fn add(&self, _at: &Configuration, _loads: &mut [f64]) {}
}
