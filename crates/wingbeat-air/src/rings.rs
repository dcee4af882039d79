//! Where the rings lie: on the panels' edges, or a little inside edges that do not shed.
//!
//! A lattice represents a sheet a quarter panel larger on every free side than its outermost
//! filaments [Hough 1973, J. Aircraft 10:314]: rings on the true edges overrate lift slope and added
//! mass at first order of the panel size, rings inset by a quarter panel are good to second. Control
//! point, normal and area of a panel are those of its ring.

use crate::lattice::Lattice;
use crate::settings::AirSettings;
use crate::state::NodeMotion;
use crate::surface::{EdgeKind, Surface};
use crate::topology::Topology;
use std::collections::{BTreeMap, BTreeSet};
use wingbeat_math::DVec3;

/// A ring node lies off its surface node, towards `inward`, by the part `AirSettings::inset` of the
/// way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Inset {
    pub node: usize,
    pub inward: usize,
}

/// All insets of the open surfaces.
pub(crate) fn insets(
    topology: &Topology,
    surfaces: &[Surface],
    settings: &AirSettings,
) -> Vec<Inset> {
    if settings.inset == 0.0 {
        return Vec::new();
    }
    let kinds = edge_kinds(topology, surfaces);
    let mut found = BTreeSet::new();
    for edge in &topology.edges {
        let s = topology.panel_surface[edge.plus];
        let pair = [edge.from.min(edge.to), edge.from.max(edge.to)];
        let kept = match kinds.get(&pair) {
            Some(EdgeKind::Leading) => settings.shedding.trailing,
            _ => false,
        };
        if edge.minus.is_some() || edge.wake.is_some() || kept || surfaces[s].closed {
            continue;
        }
        let c = topology.panels[edge.plus];
        for i in 0..4 {
            let side = [c[i], c[(i + 1) % 4]];
            if [side[0].min(side[1]), side[0].max(side[1])] == pair {
                let inward = [c[(i + 3) % 4], c[(i + 2) % 4]];
                if is_free(topology, edge.plus, inward) {
                    continue; // a single panel from edge to edge
                }
                for (node, inward) in side.into_iter().zip(inward) {
                    if !side.contains(&inward) {
                        found.insert(Inset { node, inward });
                    }
                }
            }
        }
    }
    found.into_iter().collect()
}

/// Whether the edge of `panel` between these nodes is its surface's border.
fn is_free(topology: &Topology, panel: usize, [a, b]: [usize; 2]) -> bool {
    topology.panel_edges[panel].iter().any(|e| {
        let edge = &topology.edges[e.edge];
        let same = [edge.from, edge.to] == [a, b] || [edge.to, edge.from] == [a, b];
        same && edge.minus.is_none()
    })
}

/// Nodes of the rings from those of the surfaces.
pub(crate) fn place(lattice: &Lattice, motion: &NodeMotion, rings: &mut NodeMotion) {
    let (insets, part) = (lattice.insets(), lattice.settings().inset);
    rings.position.clone_from(&motion.position);
    rings.velocity.clone_from(&motion.velocity);
    offsets(insets, part, &motion.position, |n, d| rings.position[n] += d);
    offsets(insets, part, &motion.velocity, |n, d| rings.velocity[n] += d);
}

/// What the surfaces call their border edges (global nodes).
fn edge_kinds(topology: &Topology, surfaces: &[Surface]) -> BTreeMap<[usize; 2], EdgeKind> {
    let mut kinds = BTreeMap::new();
    for (s, surface) in surfaces.iter().enumerate() {
        let offset = topology.first_node[s];
        for g in surface.shedding.iter().flatten() {
            let (a, b) = (g.from + offset, g.to + offset);
            kinds.insert([a.min(b), a.max(b)], g.kind);
        }
    }
    kinds
}

/// How far the ring nodes are off the surface nodes: `add(node, offset)` for every inset. Works for
/// velocities as well as for places.
pub(crate) fn offsets(
    insets: &[Inset],
    part: f64,
    of: &[DVec3],
    mut add: impl FnMut(usize, DVec3),
) {
    for i in insets {
        add(i.node, part * (of[i.inward] - of[i.node]));
    }
}
