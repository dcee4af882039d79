//! Motions that are impossible or implausible, whatever the air.

use wingbeat_flight::{AirModel, Doubt, FlightSetup};
use wingbeat_model::Crossing;

use super::doubts::{self, GRAZE_EACH_OTHER, GRAZES, NO_MEANING, NOT_FELT, Place};
use crate::summary::beats::BeatMeans;
use crate::summary::numbers::Summary;
use crate::summary::verdict::Warnings;

/// No animal carries this many of its weights over a whole wingbeat.
const IMPLAUSIBLE_LIFT: f64 = 10.0;

/// Mean lift over weight below which wings push the body down.
const PUSHES_DOWN: f64 = -0.1;

/// Motions that are implausible, Reynolds numbers that the air was not made for, and a lift that no animal has.
pub(super) fn warnings(
    setup: &FlightSetup,
    doubts: &[Doubt],
    summary: &Summary,
    list: &mut Warnings,
) {
    doubts::say(setup, doubts, Place::Motion, list);
    for reynolds in wingbeat_analysis::doubtful_reynolds_numbers(setup) {
        list.limit(format!("Outside of what the air was made for: {reynolds}."));
    }
    lift(setup, summary, list);
}

/// Wings that passed through each other as they were flown, by how much \[m\], where their prescribed motion alone does
/// not, or only grazes: in a lattice the numbers mean nothing, if they did more than graze, other air does not feel it.
pub(crate) fn flown_crossings(setup: &FlightSetup, found: &[(Crossing, f64)], list: &mut Warnings) {
    if found.is_empty() {
        return;
    }
    let doubted = setup.doubted_pairs();
    for (crossing, depth) in found {
        let flown = setup.say_flown_crossing(crossing, *depth);
        let is_said = |&(wings, is_graze): &([usize; 2], bool)| {
            wings == flown.wings && (flown.is_graze || !is_graze)
        };
        if doubted.iter().any(is_said) {
            continue;
        }
        let said = flown.said;
        let impossible = format!("The motion that was flown is impossible: {said}.");
        match (&setup.air, flown.is_graze) {
            (AirModel::VortexLattice(_), true) => {
                list.limit(format!("{GRAZE_EACH_OTHER}{said}.{GRAZES}"));
            }
            (AirModel::VortexLattice(_), false) => list.fault(impossible + NO_MEANING),
            _ => list.limit_first(impossible + NOT_FELT),
        }
    }
}

/// A mean lift of a beat beyond all animals, or wings that push down.
fn lift(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    let weights = |b: &BeatMeans| b.mean.lift_over_weight.unwrap_or(0.0).abs();
    let pushes_down = |b: &BeatMeans| b.mean.lift_over_weight.is_some_and(|l| l < PUSHES_DOWN);
    if !summary.beats.is_empty() && summary.beats.iter().all(pushes_down) {
        list.limit("The wings push the body down in every wingbeat: look at the signs and phases of their angles, the feathering (psi) first (`wingbeat check` helps).");
    }
    let Some(b) = summary.beats.iter().find(|b| weights(b) > IMPLAUSIBLE_LIFT) else {
        return;
    };
    let found = format!(
        "a mean lift of {:.0} weights in beat {}",
        weights(b),
        b.beat
    );
    match &setup.air {
        AirModel::VortexLattice(_) => list.fault(format!(
            "The air diverged: {found} is not physical. Enlarge the wake core, take smaller steps, keep fewer wake rows, or do not shed from leading edges."
        )),
        _ => list.limit(format!(
            "Implausible: {found} is more than any animal carries. Look at mass and lengths, wingbeat frequency and angles (`wingbeat check` helps), then at the steps."
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Outcome;
    use crate::summary::verdict::Verdict;
    use std::path::Path;
    use wingbeat_case::LoadedCase;

    /// What is made of wings that passed through each other by a part of the chord in flight, where those at rest stand
    /// off the plane of symmetry by `hinge` \[m\]: verdict, and whether anything is said.
    fn heard(hinge: f64, depth: f64) -> (Verdict, bool) {
        let text = format!(
            r#"
            format = 1
            gravity_m_s2 = [0, 0, 0]
            time = {{ steps_per_beat = 40, beats = 0.25 }}
            flight = {{ mode = "tethered" }}
            air = {{ density_kg_m3 = 1.2, stream_m_s = [-5, 0, 0], shed = ["trailing"], body = false }}
            body = {{ mass_kg = 1, inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0] }}
            motion.frequency_hz = 10
            [wing.right]
            hinge_m = [0, {hinge}, 0]
            mass_kg = 0.005
            motion = {{ phi.fourier.sine_deg = [15], psi.constant_deg = 3 }}
            planform.rectangle = {{ chord_m = 0.06, span_m = 0.2, axis_fraction = 0.25 }}
            mesh = {{ chordwise = 3, spanwise = 6 }}
        "#
        );
        let case = LoadedCase::from_text("pair", &text, Path::new(""), &[]).unwrap();
        let found = Crossing {
            wings: [0, 1],
            part: 0.2,
        };
        let mut list = Warnings::default();
        flown_crossings(&case.setup, &[(found, 0.06 * depth)], &mut list);
        (
            list.verdict(&Outcome::Finished).0,
            !list.into_texts().is_empty(),
        )
    }

    /// Wings whose prescribed motion grazes are said to once, and again where loads bend them deep through each other;
    /// those that are apart without loads are judged by how deep they were.
    #[test]
    fn behaves_deep_crossings_in_flight_are_red_though_the_prescribed_motion_grazes() {
        assert_eq!(heard(0.0, 0.01), (Verdict::Green, false));
        assert_eq!(heard(0.0, 0.3), (Verdict::Red, true));
        assert_eq!(heard(0.01, 0.01), (Verdict::Amber, true));
        assert_eq!(heard(0.01, 0.3), (Verdict::Red, true));
    }
}
