//! Points that follow the nodes of an elastic body: nodes of a lattice, stations of a wing.

use wingbeat_math::{DMat3, DVec3};

use crate::nodes::block::{add_pair, pair};
use crate::nodes::configuration::Configuration;

/// Part of a point that one node carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeWeight {
    /// The node.
    pub node: usize,
    /// Part of the point that it carries \[1\].
    pub weight: f64,
    /// From the node to the point at rest \[m\], node components.
    pub arm: DVec3,
}

/// A point whose place is the weighted mean of where its nodes carry it as rigid bodies, `sum w (u + R arm)`: exact in
/// any rigid motion. Forces on it go back to the nodes transposed, which keeps force, moment and work.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Follower {
    shares: Vec<NodeWeight>,
}

impl Follower {
    /// A point that lies at `x` \[m\] (W components) in the configuration `rest` and is carried by these nodes
    /// with these weights, which are scaled so that their sum is 1.
    pub fn new(x: DVec3, nodes: &[(usize, f64)], rest: &Configuration) -> Self {
        let total: f64 = nodes.iter().map(|n| n.1).sum();
        let share = |&(node, weight): &(usize, f64)| NodeWeight {
            node,
            weight: weight / total,
            arm: rest.rotation[node].inverse() * (x - rest.position[node]),
        };
        let felt = nodes.iter().filter(|n| n.1 != 0.0);
        Self {
            shares: felt.map(share).collect(),
        }
    }

    /// Who carries it.
    pub fn shares(&self) -> &[NodeWeight] {
        &self.shares
    }

    /// Its place \[m\], W components.
    pub fn position(&self, at: &Configuration) -> DVec3 {
        let part = |s: &NodeWeight| s.weight * (at.position[s.node] + at.rotation[s.node] * s.arm);
        self.shares.iter().map(part).sum()
    }

    /// Its velocity relative to W \[m/s\], W components, from six numbers a node ([`crate::State::velocity`]).
    pub fn velocity(&self, at: &Configuration, velocity: &[f64]) -> DVec3 {
        let part = |s: &NodeWeight| {
            let [v, w] = pair(velocity, s.node);
            s.weight * (v + at.rotation[s.node] * w.cross(s.arm))
        };
        self.shares.iter().map(part).sum()
    }

    /// Its acceleration relative to W \[m/s2\], W components, from six numbers a node each.
    pub fn acceleration(
        &self,
        at: &Configuration,
        velocity: &[f64],
        acceleration: &[f64],
    ) -> DVec3 {
        let part = |s: &NodeWeight| {
            let ([_, w], [a, turn]) = (pair(velocity, s.node), pair(acceleration, s.node));
            let relative = turn.cross(s.arm) + w.cross(w.cross(s.arm));
            s.weight * (a + at.rotation[s.node] * relative)
        };
        self.shares.iter().map(part).sum()
    }

    /// Adds a force on the point \[N\], W components, to the loads of the nodes: force in W components, moment
    /// about the node in node components, six numbers a node.
    pub fn add_force(&self, at: &Configuration, force: DVec3, loads: &mut [f64]) {
        for s in &self.shares {
            let part = s.weight * force;
            let back = DMat3::from_quat(at.rotation[s.node]).transpose();
            add_pair(loads, s.node, [part, s.arm.cross(back * part)]);
        }
    }
}
