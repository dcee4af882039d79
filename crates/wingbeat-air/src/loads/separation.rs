//! What the separation criteria compare with their thresholds.

use crate::geometry::{Strip, chord};
use crate::lattice::Lattice;
use crate::loads::values::AirLoads;
use crate::settings::LeadingEdge;
use crate::wake::Filaments;
use std::f64::consts::PI;
use wingbeat_math::DVec3;

/// The number that the criterion compares with its threshold, and the circulation that the leading edge holds, strip by
/// strip.
///
/// - Effective angle of attack [rad], 0 to pi: between chord and the wind that stream and motion
///   make at the leading panel, in the plane of the section; what the wake induces is left out. Beyond the threshold all
///   leaves, below it none.
/// - Leading-edge suction parameter: A0, the coefficient of the suction singularity in thin-airfoil
///   theory [Ramesh et al. 2014, J. Fluid Mech. 751:500], from the net circulation G of the leading
///   edge, a leading panel of length h and a chord c: `A0 = 2 / sqrt(pi) G / (U c (a + sin a))`,
///   `cos a = 1 - 2 h / c`; U is the speed of stream and motion at the quarter chord, in the plane of the section.
///   `2 / sqrt(pi) = 1.13` is what a lattice's first vortex falls short of
///   the exact circulation of its panel [Hirato et al. 2019, AIAA J. 57:4034]. The edge holds what gives it the threshold.
pub(crate) fn leading_values(
    lattice: &Lattice,
    filaments: &Filaments,
    position: &[DVec3],
    out: &mut AirLoads,
) {
    out.leading.clear();
    out.hold.clear();
    let all_or_none = |leaves: bool| if leaves { 0.0 } else { f64::MAX };
    for strip in lattice.strips() {
        let p = strip.panels[0];
        let (aft, c) = chord(strip, position);
        let [value, hold] = match lattice.settings().leading {
            LeadingEdge::Always => [0.0, 0.0],
            LeadingEdge::Never => [0.0, f64::MAX],
            LeadingEdge::AngleOfAttack { threshold } => {
                let wind = lattice.stream(out.panels.point[p], out.time) - out.panels.velocity[p];
                let (along, across) = (wind.dot(aft), wind.dot(out.panels.normal[p]));
                let angle = across.abs().atan2(along);
                [angle, all_or_none(angle > threshold)]
            }
            LeadingEdge::Suction { threshold } => {
                let middle = 0.5 * (position[strip.nodes[0]] + position[strip.nodes[1]]);
                let h = 2.0 * (out.panels.point[p] - middle).dot(aft);
                let a = (1.0 - 2.0 * h / c).clamp(-1.0, 1.0).acos();
                let wind = quarter_chord_wind(lattice, strip, (middle, aft, c), out);
                let speed = wind.dot(aft).hypot(wind.dot(out.panels.normal[p]));
                // The net circulation of a suction parameter of one.
                let unit = 0.5 * PI.sqrt() * speed * c * (a + a.sin());
                let net = filaments.bound.gamma[strip.edge].abs();
                [net / unit.max(f64::MIN_POSITIVE), threshold * unit]
            }
        };
        out.leading.push(value);
        out.hold.push(hold);
    }
}

/// The wind that stream and motion make at the quarter chord of a strip, whose leading edge is at `middle` [m, m/s]: that of
/// its control points, which is linear along a rigid section.
fn quarter_chord_wind(
    lattice: &Lattice,
    strip: &Strip,
    (middle, aft, c): (DVec3, DVec3, f64),
    out: &AirLoads,
) -> DVec3 {
    let ends = [strip.panels[0], strip.panels[strip.panels.len() - 1]];
    let place = ends.map(|p| (out.panels.point[p] - middle).dot(aft));
    let wind = ends.map(|p| lattice.stream(out.panels.point[p], out.time) - out.panels.velocity[p]);
    let way = place[1] - place[0];
    match way > 0.0 {
        true => wind[0].lerp(wind[1], (0.25 * c - place[0]) / way),
        false => wind[0],
    }
}
