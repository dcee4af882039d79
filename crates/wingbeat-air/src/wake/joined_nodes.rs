//! Wake nodes that left joined edges: two columns in one place.

use crate::geometry::{JoinedColumns, Topology};
use crate::state::WakeSheet;
use wingbeat_math::DVec3;

/// Puts joined wake nodes midway between them: roundings and what a tree leaves out would part them.
pub(crate) fn merge_joined_nodes(topology: &Topology, sheets: &mut [WakeSheet]) {
    for JoinedColumns(ends) in &topology.joined_columns {
        let rows = ends.map(|(s, _)| sheets[s].rows());
        for back in 1..=rows[0].min(rows[1]) {
            let at = [0, 1].map(|k| {
                let (s, column) = ends[k];
                (s, (rows[k] - back) * (sheets[s].columns + 1) + column)
            });
            let middle = |of: fn(&WakeSheet, usize) -> DVec3| {
                let [x, y] = at.map(|(s, n)| of(&sheets[s], n));
                0.5 * (x + y)
            };
            let position = middle(|sheet, n| sheet.nodes.get(n));
            let looks_back = at.iter().all(|&(s, n)| n < sheets[s].velocity.len());
            let velocity = looks_back.then(|| middle(|sheet, n| sheet.velocity.get(n)));
            for (s, n) in at {
                sheets[s].nodes.set(n, position);
                if let Some(v) = velocity {
                    sheets[s].velocity.set(n, v);
                }
            }
        }
    }
}
