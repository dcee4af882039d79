//! Wake nodes that left joined edges: two columns in one place, or one on a plane of images.

use crate::geometry::JoinedColumns;
use crate::lattice::Lattice;
use crate::state::WakeSheet;
use wingbeat_math::DVec3;

/// Puts joined wake nodes midway between them: roundings and what a tree leaves out would part them. Those that
/// left the middle of a body lie between the nodes that left the roots: within the body nothing says how they
/// move.
pub(crate) fn merge_joined_nodes(lattice: &Lattice, sheets: &mut [WakeSheet]) {
    let joined = &lattice.topology().joined_columns;
    let is_middle = |j: &&JoinedColumns| {
        let mut ends = j.0.iter();
        ends.all(|&(s, column)| lattice.middle_column(s) == Some(column))
    };
    let others = joined.iter().filter(|j| !is_middle(j));
    // The middle after the roots, which are its ends.
    for JoinedColumns(ends) in others.chain(joined.iter().filter(is_middle)) {
        let from = ends.map(
            |(s, column)| match lattice.middle_column(s) == Some(column) {
                true => 1 - column,
                false => column,
            },
        );
        let rows = ends.map(|(s, _)| sheets[s].rows());
        for back in 1..=rows[0].min(rows[1]) {
            let nodes = |columns: [usize; 2]| {
                [0, 1].map(|k| {
                    let s = ends[k].0;
                    (s, (rows[k] - back) * (sheets[s].columns + 1) + columns[k])
                })
            };
            let at = nodes(ends.map(|(_, column)| column));
            let middle = |of: fn(&WakeSheet, usize) -> DVec3| {
                let [x, y] = nodes(from).map(|(s, n)| of(&sheets[s], n));
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

/// Puts wake nodes that left an edge on a plane of images on that plane, as they are with their images midway between
/// both. Surfaces have their nodes at `position` [m, N].
pub(crate) fn put_on_planes(lattice: &Lattice, position: &[DVec3], sheets: &mut [WakeSheet]) {
    for &(s, column) in &lattice.topology().plane_columns {
        let edge = position[lattice.sheets()[s].nodes[column]];
        let Some(plane) = lattice.nearest_plane(edge) else {
            continue;
        };
        let (width, sheet) = (sheets[s].columns + 1, &mut sheets[s]);
        for n in (column..sheet.nodes.len()).step_by(width) {
            let x = sheet.nodes.get(n);
            sheet.nodes.set(n, plane.foot(x));
            if n < sheet.velocity.len() {
                let v = sheet.velocity.get(n);
                sheet.velocity.set(n, plane.along(v));
            }
        }
    }
}
