//! How wide the filaments of the free wakes are where action is to be reaction.

use crate::geometry::JoinedColumns;
use crate::settings::AirSettings;
use crate::state::WakeSheet;
use wingbeat_math::DVec3;

/// Appends the squared core radii \[m2\] of the free nodes of a sheet, whose shedding edge is `edge`: as wide
/// with age as viscosity makes them, and at least as wide as the longest filament there is long, times the
/// overlap, but no wider than [`AirSettings::overlap_slope`] allows for that.
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
            cores[first + r * width + c] =
                wide.min(aged.max((settings.overlap_slope * way).powi(2)));
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
