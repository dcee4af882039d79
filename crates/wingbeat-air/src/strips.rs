//! Strips of panels behind the leading edge, and whether the flow leaves the edge there.

use crate::lattice::Lattice;
use crate::loads::AirLoads;
use crate::settings::LeadingEdge;
use crate::state::AirState;
use crate::surface::{EdgeKind, Surface};
use crate::topology::Topology;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use wingbeat_math::DVec3;

/// A chordwise row of panels from a segment of the leading edge backward.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// The leading-edge segment (global edge).
    pub edge: usize,
    /// Panels from the leading edge on (global).
    pub panels: Vec<usize>,
    /// Nodes of the segment (global).
    pub nodes: [usize; 2],
    /// Nodes of the last panel's rear edge (global).
    pub rear: [usize; 2],
}

/// All strips, surface by surface in the order of their leading-edge segments.
pub(crate) fn strips(topology: &Topology, surfaces: &[Surface]) -> Vec<Strip> {
    let pair = |a: usize, b: usize| [a.min(b), a.max(b)];
    let by_nodes: BTreeMap<[usize; 2], usize> = (topology.edges.iter().enumerate())
        .map(|(e, edge)| (pair(edge.from, edge.to), e))
        .collect();
    let mut strips = Vec::new();
    for (s, surface) in surfaces.iter().enumerate() {
        let (node, panel) = (topology.first_node[s], topology.first_panel[s]);
        let leading = surface.shedding.iter().flatten();
        for g in leading.filter(|g| g.kind == EdgeKind::Leading) {
            let front = pair(g.from + node, g.to + node);
            let Some(&edge) = by_nodes.get(&front) else {
                continue;
            };
            let (panels, rear) = walk(topology, &by_nodes, g.panel + panel, front);
            strips.push(Strip {
                edge,
                panels,
                nodes: front,
                rear,
            });
        }
    }
    strips
}

/// From panel to panel over opposite edges, until the surface ends.
fn walk(
    topology: &Topology,
    by_nodes: &BTreeMap<[usize; 2], usize>,
    first: usize,
    front: [usize; 2],
) -> (Vec<usize>, [usize; 2]) {
    let (mut panels, mut side) = (vec![first], front);
    loop {
        let here = panels[panels.len() - 1];
        let c = topology.panels[here];
        let i = (0..4).find(|&i| {
            let (a, b) = (c[i], c[(i + 1) % 4]);
            [a.min(b), a.max(b)] == side
        });
        let Some(i) = i else {
            return (panels, side);
        };
        let (a, b) = (c[(i + 2) % 4], c[(i + 3) % 4]);
        side = [a.min(b), a.max(b)];
        let next = by_nodes.get(&side).and_then(|&e| {
            let edge = &topology.edges[e];
            [Some(edge.plus), edge.minus]
                .into_iter()
                .flatten()
                .find(|&p| p != here)
        });
        match next {
            Some(p) if !panels.contains(&p) => panels.push(p),
            _ => return (panels, side),
        }
    }
}

/// Unit vector from the leading edge backward and the length of the chord [m], N.
pub(crate) fn chord(strip: &Strip, position: &[DVec3]) -> (DVec3, f64) {
    let middle = |n: [usize; 2]| 0.5 * (position[n[0]] + position[n[1]]);
    let chord = middle(strip.rear) - middle(strip.nodes);
    (chord.normalize_or_zero(), chord.length())
}

/// The number that the criterion compares with its threshold, strip by strip.
///
/// - Effective angle of attack [rad], 0 to pi: between chord and the wind that stream and motion
///   make at the leading panel, in the plane of the section; what the wake induces is left out.
/// - Leading-edge suction parameter: A0, the coefficient of the suction singularity in thin-airfoil
///   theory [Ramesh et al. 2014, J. Fluid Mech. 751:500], from the circulation G of the leading
///   panel of length h on a chord c: `A0 = 2 / sqrt(pi) G / (U c (a + sin a))`,
///   `cos a = 1 - 2 h / c`. `2 / sqrt(pi) = 1.13` is what a lattice's first vortex falls short of
///   the exact circulation of its panel [Hirato et al. 2019, AIAA J. 57:4034].
pub(crate) fn leading_values(lattice: &Lattice, position: &[DVec3], out: &mut AirLoads) {
    out.leading.clear();
    for strip in lattice.strips() {
        let p = strip.panels[0];
        let (aft, c) = chord(strip, position);
        let normal = out.panels.normal[p];
        let wind = lattice.stream(out.panels.point[p], out.time) - out.panels.velocity[p];
        let (along, across) = (wind.dot(aft), wind.dot(normal));
        let value = match lattice.settings().leading {
            LeadingEdge::Always | LeadingEdge::Never => 0.0,
            LeadingEdge::AngleOfAttack { .. } => across.abs().atan2(along),
            LeadingEdge::Suction { .. } => {
                let middle = 0.5 * (position[strip.nodes[0]] + position[strip.nodes[1]]);
                let h = 2.0 * (out.panels.point[p] - middle).dot(aft);
                let a = (1.0 - 2.0 * h / c).clamp(-1.0, 1.0).acos();
                let scale = along.hypot(across) * c * (a + a.sin());
                2.0 / PI.sqrt() * out.gamma[p].abs() / scale.max(f64::MIN_POSITIVE)
            }
        };
        out.leading.push(value);
    }
}

impl Lattice {
    /// Whether the flow leaves the leading edge of a strip, by the value kept in the state.
    pub fn is_separated(&self, strip: usize, state: &AirState) -> bool {
        let value = state.leading.get(strip).copied().unwrap_or(0.0);
        match self.settings().leading {
            LeadingEdge::Always => true,
            LeadingEdge::Never => false,
            LeadingEdge::AngleOfAttack { threshold } | LeadingEdge::Suction { threshold } => {
                value > threshold
            }
        }
    }
}
