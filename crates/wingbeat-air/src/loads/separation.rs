//! What the separation criteria compare with their thresholds.

use crate::geometry::section;
use crate::lattice::Lattice;
use crate::loads::values::AirLoads;
use crate::loads::vortex_lift::{foremost, suction_parameter};
use crate::settings::LeadingEdge;
use crate::solve::LeadingSection;
use crate::state::AirState;
use crate::wake::Filaments;
use wingbeat_math::DVec3;

/// The number that the criterion compares with its threshold, and the circulation that the leading edge holds, strip by
/// strip.
///
/// - Effective angle of attack [rad], 0 to pi: between the chord of the section normal to the edge and the wind
///   that stream and motion make at the leading panel, in the plane of the section; what the wake induces is
///   left out. Beyond the threshold all leaves, below it none.
/// - Leading-edge suction parameter, from the net circulation of the leading edge ([`LeadingSection`]): the
///   edge holds what gives it the threshold. Where what leaves is part of the solution, `suction` is what that
///   found.
pub(crate) fn leading_values(
    (lattice, state): (&Lattice, &AirState),
    filaments: &Filaments,
    (suction, position): (&[f64], &[DVec3]),
    out: &mut AirLoads,
) {
    out.leading.clear();
    out.hold.clear();
    let all_or_none = |leaves: bool| if leaves { 0.0 } else { f64::MAX };
    for (k, strip) in lattice.strips().iter().enumerate() {
        let p = strip.panels[0];
        let [value, hold] = match lattice.settings().leading {
            LeadingEdge::Always => [0.0, 0.0],
            LeadingEdge::Never => [0.0, f64::MAX],
            LeadingEdge::VortexLift(_) => {
                let [parameter, _] = suction_parameter(lattice, strip, position, out);
                [parameter.abs(), f64::MAX]
            }
            LeadingEdge::AngleOfAttack { threshold } => {
                let (aft, _) = section(strip, position);
                let wind = lattice.stream(out.panels.point[p], out.time) - out.panels.velocity[p];
                let (along, across) = (wind.dot(aft), wind.dot(out.panels.normal[p]));
                let angle = across.abs().atan2(along);
                [angle, all_or_none(angle > threshold)]
            }
            LeadingEdge::Suction { threshold, .. } => {
                let section = LeadingSection::of((lattice, &out.panels, out.time), strip, position);
                let net = filaments.bound.gamma[strip.edge];
                let [_, beside] = lattice.held_and_beside(state, k, &filaments.newest);
                let [_, second] = foremost(strip, &out.gamma).map(|g| (g - beside) * net.signum());
                // Flow that leaves the edge smoothly has no next mode there.
                let even = threshold * section.unit();
                let all = section.counted([net.abs(), second], 1.0).abs();
                let leaves = beside.abs().max(all - even);
                let share = match leaves < even {
                    true => 1.0 - leaves.max(0.0) / even,
                    false => 0.0,
                };
                let counted = section.counted([net.abs(), second], share);
                [
                    section.parameter(counted).abs(),
                    section.limit(threshold, second, share),
                ]
            }
            LeadingEdge::SuctionImplicit { .. } => [suction[k], f64::MAX],
        };
        out.leading.push(value);
        out.hold.push(hold);
    }
}
