//! Sides of panels that no other panel shares.

use crate::geometry::{Surface, Topology};

/// Of each panel which of its sides, from a corner to the next one, no other panel shares that is in the way: what
/// leads through bodies is in nobody's. Shape (panels, 4).
pub(crate) fn borders(topology: &Topology, surfaces: &[Surface]) -> Vec<[bool; 4]> {
    let is_within = |p: usize| surfaces[topology.panel_surface[p]].carry_through;
    let of_panel = |p: usize| {
        let nodes = topology.panels[p];
        std::array::from_fn(|k| {
            let side = [nodes[k], nodes[(k + 1) % 4]];
            topology.panel_edges[p].iter().any(|e| {
                let edge = &topology.edges[e.edge];
                let ends = [edge.from, edge.to];
                let others = [Some(edge.plus), edge.minus].into_iter().flatten();
                !edge.is_on_plane()
                    && others.filter(|&q| q != p).all(is_within)
                    && (ends == side || ends == [side[1], side[0]])
            })
        })
    };
    (0..topology.panels.len()).map(of_panel).collect()
}
