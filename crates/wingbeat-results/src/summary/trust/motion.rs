//! Motions that are impossible or implausible, whatever the air.

use wingbeat_flight::{AirModel, Doubt, DoubtKind, FlightSetup};
use wingbeat_model::Crossing;

use super::doubts::{self, NO_MEANING, NOT_FELT, Place};
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

/// Wings that passed through each other as they were flown, where their prescribed motion alone does not: in a lattice
/// the numbers mean nothing, other air does not feel it.
pub(crate) fn flown_crossings(
    setup: &FlightSetup,
    doubts: &[Doubt],
    found: &[Crossing],
    list: &mut Warnings,
) {
    let is_crossing = |d: &Doubt| matches!(d.kind, DoubtKind::Crossing | DoubtKind::Graze);
    if doubts.iter().any(is_crossing) {
        return;
    }
    for crossing in found {
        let said = setup.say_flown_crossing(crossing);
        let found = format!("The motion that was flown is impossible: {said}.");
        match &setup.air {
            AirModel::VortexLattice(_) => list.fault(found + NO_MEANING),
            _ => list.limit_first(found + NOT_FELT),
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
