//! How wide the filaments of the free wakes are.

use crate::settings::AirSettings;
use crate::state::WakeSheet;
use wingbeat_math::DVec3;

/// Core radius with which control points see a node of a wake, at most, over the way along the sheet from its edge.
///
/// Cores as wide as filaments are long blunt what a sheet does to control points that are nearer than that. A row loses
/// its effect on the panels at its edge the moment it leaves it, later if steps are longer: the lift of a hovering fly
/// went up by a seventh from 40 to 160 steps a beat. With this share of the way the velocity of a sheet is right to
/// 3 parts in a hundred at any distance, and what has gone a chord or two and comes back is as wide as it is for others.
const SEEN: f64 = 0.25;

/// Appends the squared core radii \[m2\] of the free nodes of a sheet, whose shedding edge is `edge`: as wide with age as
/// viscosity makes them, and at least as wide as the longest filament there is long, times the overlap.
pub(super) fn add_cores(
    cores: &mut Vec<f64>,
    sheet: &WakeSheet,
    settings: &AirSettings,
    t: f64,
    edge: impl Iterator<Item = DVec3> + Clone,
) {
    let (rows, width) = (sheet.rows(), sheet.columns + 1);
    let at = |r: usize, c: usize| sheet.node(r, c);
    for r in 0..rows {
        for c in 0..width {
            let x = at(r, c);
            let mut longest: f64 = 0.0;
            let mut see = |y: DVec3| longest = longest.max(x.distance_squared(y));
            if r > 0 {
                see(at(r - 1, c));
            }
            if r + 1 < rows {
                see(at(r + 1, c));
            } else if let Some(y) = edge.clone().nth(c) {
                see(y);
            }
            if c > 0 {
                see(at(r, c - 1));
            }
            if c + 1 < width {
                see(at(r, c + 1));
            }
            let age = t - sheet.shed_time[r];
            cores.push(settings.free_core(longest.sqrt(), age));
        }
    }
}

/// Appends the squared core radii [m2] with which control points see the free nodes of a sheet, where those of [`add_cores`]
/// are wider.
pub(super) fn add_seen_cores(
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
            way += x.distance(newer);
            newer = x;
            let least = settings.wake_core.core(0.0, t - sheet.shed_time[r]);
            cores[first + r * width + c] = least.max((SEEN * way).powi(2));
        }
    }
}
