//! Surfaces whose edges all shed.

use crate::geometry::surface::Surface;
use crate::geometry::topology::{Edge, Topology};

/// An open surface, or several joined ones, that shed from every edge but the ends of a section of plane flow, which
/// move no air: lattice and wakes together have no other edge than that of the oldest rows, so that a circulation common
/// to all rings moves no air except by that edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ShedAround {
    pub panels: Vec<usize>,
    /// Their wake sheets.
    pub sheets: Vec<usize>,
}

/// All of them.
pub(crate) fn shed_around(
    topology: &Topology,
    surfaces: &[Surface],
    group: &[usize],
) -> Vec<ShedAround> {
    let of = |panel: usize| group[topology.panel_surface[panel]];
    let whole = |g: &usize| {
        let open = (0..surfaces.len()).all(|s| group[s] != *g || !surfaces[s].closed);
        let edges = || topology.edges.iter().filter(|e| of(e.plus) == *g);
        let ends_nothing = |e: &Edge| e.is_end || e.minus.is_none() == e.wake.is_some();
        open && edges().next().is_some() && edges().all(ends_nothing)
    };
    let members = |g: usize| ShedAround {
        panels: (0..topology.panels.len()).filter(|&p| of(p) == g).collect(),
        sheets: (0..topology.sheets.len())
            .filter(|&k| group[topology.sheets[k].surface] == g)
            .collect(),
    };
    let first = (0..surfaces.len()).filter(|&s| group[s] == s);
    first.filter(whole).map(members).collect()
}

/// For each surface the first of those that it is joined to.
pub(crate) fn joined_groups(topology: &Topology, count: usize) -> Vec<usize> {
    let mut group: Vec<usize> = (0..count).collect();
    for edge in &topology.edges {
        let Some(minus) = edge.minus else { continue };
        let [a, b] = [edge.plus, minus].map(|p| group[topology.panel_surface[p]]);
        let (low, high) = (a.min(b), a.max(b));
        group
            .iter_mut()
            .filter(|g| **g == high)
            .for_each(|g| *g = low);
    }
    group
}
