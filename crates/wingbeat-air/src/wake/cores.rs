//! How wide the filaments of the free wakes are where action is to be reaction.

use crate::geometry::JoinedColumns;
use crate::settings::AirSettings;
use crate::state::WakeSheet;
use wingbeat_math::DVec3;

/// Core radius of a node over its way along the sheet from the edge, at most (or as wide as vorticity of its age is).
///
/// Cores as wide as filaments are long blunt what a sheet does to anything nearer than that. Without this limit
/// a row loses its effect on the panels at its edge the moment it leaves it, later if steps are longer: the
/// lift of a hovering fly went up by a seventh from 40 to 160 steps a beat, and by a seventh with half the
/// overlap. With this share of the way the velocity of a sheet is right to 3 parts in a hundred at any
/// distance, and where filaments stretch, a chord or two from the edge, cores are as wide as they are long.
const SHARE_OF_WAY: f64 = 0.25;

/// Appends the squared core radii \[m2\] of the free nodes of a sheet, whose shedding edge is `edge`: as wide
/// with age as viscosity makes them, and at least as wide as the longest filament there is long, times the
/// overlap, but no wider than [`SHARE_OF_WAY`] for that.
pub(super) fn add_cores(
    cores: &mut Vec<f64>,
    sheet: &WakeSheet,
    settings: &AirSettings,
    t: f64,
    edge: impl Iterator<Item = DVec3>,
) {
    let (rows, width, first) = (sheet.rows(), sheet.columns + 1, cores.len());
    cores.resize(first + rows * width, 0.0);
    for (c, edge) in edge.enumerate() {
        let (mut way, mut newer) = (0.0, edge);
        for r in (0..rows).rev() {
            let x = sheet.node(r, c);
            let step = x.distance(newer);
            way += step;
            let age = t - sheet.shed_time[r];
            let wide = settings.free_core(longest(sheet, [r, c], x).max(step), age);
            let aged = settings.wake_core.core(0.0, age);
            cores[first + r * width + c] = wide.min(aged.max((SHARE_OF_WAY * way).powi(2)));
            newer = x;
        }
    }
}

/// Gives nodes of joined columns, which are one, one core: `cores` of all free nodes, sheet after sheet, see
/// each the filaments of their own column only.
pub(super) fn join_cores(cores: &mut [f64], joined: &[JoinedColumns], sheets: &[WakeSheet]) {
    for JoinedColumns(ends) in joined {
        let first = |s: usize| sheets[..s].iter().map(|k| k.nodes.len()).sum::<usize>();
        let ends = ends.map(|(s, c)| (first(s) + c, sheets[s].rows(), sheets[s].columns + 1));
        let rows = ends[0].1.min(ends[1].1);
        for back in 1..=rows {
            let [a, b] = ends.map(|(first, rows, width)| first + (rows - back) * width);
            let wide = cores[a].max(cores[b]);
            (cores[a], cores[b]) = (wide, wide);
        }
    }
}

/// Length \[m\] of the longest filament from node (row, column), which is at `x`, to its neighbours in the same and the
/// older row.
fn longest(sheet: &WakeSheet, [r, c]: [usize; 2], x: DVec3) -> f64 {
    let older = (r > 0).then(|| [r - 1, c]);
    let left = (c > 0).then(|| [r, c - 1]);
    let right = (c < sheet.columns).then_some([r, c + 1]);
    let others = [older, left, right].into_iter().flatten();
    let lengths = others.map(|[r, c]| x.distance(sheet.node(r, c)));
    lengths.fold(0.0, f64::max)
}
