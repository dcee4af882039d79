//! Strips of panels behind the leading edge.

use crate::edges::EdgeKind;
use crate::geometry::surface::Surface;
use crate::geometry::topology::Topology;
use std::collections::{BTreeMap, BTreeSet};
use wingbeat_math::DVec3;

/// A chordwise row of panels from a segment of the leading edge backward.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Strip {
    /// The leading-edge segment (global edge).
    pub edge: usize,
    /// Panels from the leading edge on (global).
    pub panels: Vec<usize>,
    /// Nodes of the segment, of the edges between the panels and of the last panel's rear edge (global): one
    /// more than panels.
    pub sides: Vec<[usize; 2]>,
}

impl Strip {
    /// Nodes of the leading-edge segment (global).
    pub fn front(&self) -> [usize; 2] {
        self.sides[0]
    }

    /// Nodes of the last panel's rear edge (global).
    pub fn rear(&self) -> [usize; 2] {
        self.sides[self.panels.len()]
    }
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
            strips.push(walk(topology, &by_nodes, (edge, g.panel + panel), front));
        }
    }
    strips
}

/// Whether each edge is a side of a panel of a strip that runs along the span.
pub(crate) fn spanwise(topology: &Topology, strips: &[Strip]) -> Vec<bool> {
    let pair = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let sides: BTreeSet<[usize; 2]> = (strips.iter().flat_map(|s| &s.sides))
        .map(|&side| pair(side))
        .collect();
    let edges = topology.edges.iter();
    edges
        .map(|e| sides.contains(&pair([e.from, e.to])))
        .collect()
}

/// From the leading-edge segment `edge` and its panel `first` on, panel to panel over opposite edges, until the
/// surface ends.
fn walk(
    topology: &Topology,
    by_nodes: &BTreeMap<[usize; 2], usize>,
    (edge, first): (usize, usize),
    front: [usize; 2],
) -> Strip {
    let (mut panels, mut sides) = (vec![first], vec![front]);
    loop {
        let (here, side) = (panels[panels.len() - 1], sides[panels.len() - 1]);
        let rear = opposite(topology.panels[here], side);
        sides.push(rear);
        let shared = by_nodes.get(&[rear[0].min(rear[1]), rear[0].max(rear[1])]);
        let next = shared.and_then(|&e| {
            let edge = &topology.edges[e];
            [Some(edge.plus), edge.minus]
                .into_iter()
                .flatten()
                .find(|&p| p != here)
        });
        match next {
            Some(p) if !panels.contains(&p) => panels.push(p),
            _ => {
                return Strip {
                    edge,
                    panels,
                    sides,
                };
            }
        }
    }
}

/// The nodes across the panel from those of an edge, in their order.
pub(crate) fn opposite(corners: [usize; 4], edge: [usize; 2]) -> [usize; 2] {
    edge.map(|n| {
        let k = corners.iter().position(|&c| c == n).expect("a corner");
        let sides = [corners[(k + 1) % 4], corners[(k + 3) % 4]];
        if corners.iter().filter(|&&c| c == n).count() > 1 {
            n // a triangle: the side between its repeated corners has no length
        } else if edge.contains(&sides[0]) {
            sides[1]
        } else {
            sides[0]
        }
    })
}

/// From the middle of the leading edge of a strip to that of its rear edge [m], N components: columns of a mesh
/// need not be normal to either.
pub(crate) fn column(strip: &Strip, position: &[DVec3]) -> DVec3 {
    let middle = |n: [usize; 2]| 0.5 * (position[n[0]] + position[n[1]]);
    middle(strip.rear()) - middle(strip.front())
}

/// The section of a strip normal to its leading edge: unit vector backward and length of the chord [m], N
/// components. What flows along an edge, or how its mesh is sheared, makes no suction there.
pub(crate) fn section(strip: &Strip, position: &[DVec3]) -> (DVec3, f64) {
    let [from, to] = strip.front();
    let edge = position[to] - position[from];
    let column = column(strip, position);
    let across = column - edge.dot(column) / edge.length_squared().max(f64::MIN_POSITIVE) * edge;
    // Where the column lies along the edge there is no such section.
    let chord = match across.length() > 1e-9 * column.length() {
        true => across,
        false => column,
    };
    (chord.normalize_or_zero(), chord.length())
}
