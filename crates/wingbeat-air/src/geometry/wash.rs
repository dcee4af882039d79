//! Place and motion of the surfaces as the vorticity on the rings meets them.
//!
//! A lattice whose rings begin at the leading edge is that of a wing a quarter panel ahead, as far as the edge
//! holds its circulation: it is the lattice of rings a quarter panel aft, which is exact for a flat plate, but
//! for its place. What leaves the edge as it leaves the trailing edge is in its place, for such a lattice looks
//! the same from either edge. Therefore rings move, and are inclined, as the surface does behind them: by a
//! quarter panel where the edge of the strip holds all, by less as more leaves.

use crate::geometry::aft::Aft;
use crate::geometry::control::Controls;
use crate::geometry::node_motion::NodeMotion;
use crate::geometry::panels::Panels;
use crate::geometry::strips::Strip;
use crate::geometry::topology::Topology;
use wingbeat_math::DVec3;

/// The surfaces where the rings meet them, in the inertial frame N.
#[derive(Debug, Default)]
pub(crate) struct Wash {
    /// Nodes of the rings, moved aft.
    pub nodes: NodeMotion,
    /// Velocity between them [m/s], panel by panel.
    pub velocity: Vec<DVec3>,
    /// Unit normals between them \[1\].
    pub normal: Vec<DVec3>,
    /// Sum over the strips of each node of the parts of a panel by which they are moved, and their number.
    parts: Vec<(f64, u32)>,
}

impl Wash {
    /// The rings themselves.
    pub fn none(&mut self, rings: &NodeMotion, panels: &Panels) {
        self.nodes.position.clone_from(&rings.position);
        self.nodes.velocity.clone_from(&rings.velocity);
        self.velocity.clone_from(&panels.velocity);
        self.normal.clone_from(&panels.normal);
        self.parts.clear();
        self.parts.resize(rings.position.len(), (0.0, 0));
    }

    /// The rings of the strips moved aft, each by `part` of its panels; the nodes of strips are those of `aft`.
    pub fn move_aft(
        &mut self,
        (topology, controls): (&Topology, &Controls),
        (strips, aft): (&[Strip], &[Aft]),
        part: impl Fn(usize) -> f64,
        rings: &NodeMotion,
    ) {
        for (k, strip) in strips.iter().enumerate() {
            let part = part(k);
            let corners = strip.panels.iter().flat_map(|&p| topology.panels[p]);
            for n in corners {
                self.parts[n].0 += part;
                self.parts[n].1 += 1;
            }
        }
        self.pool(&topology.joined_nodes);
        for node in aft {
            let (n, part) = (node.node, self.part(node.node));
            let way = |of| part * node.way(&rings.position, of);
            self.nodes.position[n] += way(&rings.position);
            self.nodes.velocity[n] += way(&rings.velocity);
        }
        for &p in strips.iter().flat_map(|s| &s.panels) {
            let corners = &topology.panels[p];
            let velocity = corners.map(|n| self.nodes.velocity[n]);
            self.velocity[p] = controls.point(p, corners, &velocity);
            if let Some(normal) = controls.normal(p, corners, &self.nodes.position) {
                self.normal[p] = normal;
            }
        }
    }

    /// Joined nodes are one, with the panels on both sides.
    fn pool(&mut self, joined: &[[usize; 2]]) {
        for &[a, b] in joined {
            let [one, other] = [a, b].map(|n| self.parts[n]);
            let both = (one.0 + other.0, one.1 + other.1);
            (self.parts[a], self.parts[b]) = (both, both);
        }
    }

    /// Part of a panel by which node `n` is moved, the mean over its panels.
    fn part(&self, n: usize) -> f64 {
        let (sum, panels) = self.parts[n];
        sum / f64::from(panels.max(1))
    }

    /// What a force on moved node `n` does to the nodes of the rings: [`Self::move_aft`], transposed.
    pub fn spread(
        &self,
        (n, aft): (usize, &[Aft]),
        rings: &NodeMotion,
        force: DVec3,
        mut add: impl FnMut(usize, DVec3),
    ) {
        add(n, force);
        let part = self.part(n);
        if part != 0.0
            && let Ok(k) = aft.binary_search_by_key(&n, |a| a.node)
        {
            aft[k].spread(&rings.position, part * force, add);
        }
    }
}
