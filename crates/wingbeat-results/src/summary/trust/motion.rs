//! Motions that are impossible or implausible, whatever the air.

use wingbeat_flight::{AirModel, FlightSetup};
use wingbeat_model::Crossing;

use crate::summary::beats::BeatMeans;
use crate::summary::numbers::Summary;
use crate::summary::verdict::Warnings;

/// No animal carries this many of its weights over a whole wingbeat.
const IMPLAUSIBLE_LIFT: f64 = 10.0;

/// Mean lift over weight below which wings push the body down.
const PUSHES_DOWN: f64 = -0.1;

/// Of surfaces of a lattice that are in one place.
pub(super) const NO_MEANING: &str = "The forces of those instants have no meaning, nor have the means and motions that they are part of.";

/// Of wings in a lattice that pass through each other by little.
/// Plane wings of aspect ratio 7 that flap in a stream with the hinges 0 to 8 mm aside, by 3 to 0 % of a chord through
/// each other and apart: their mean lift goes on smoothly from one to the other, 2 % in all.
const GRAZES: &str = "Loads of the panels that graze are wrong at those instants; mean forces of whole wings went on smoothly in trials from wings that graze so to wings just apart.";

/// Wings that pass through each other, angles that scatter, and a lift that no animal has.
pub(super) fn warnings(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    // They are why balances do not close.
    for scatter in setup.scattered_angles().iter().rev() {
        list.limit_first(format!("Angles that scatter: {scatter}."));
    }
    for crossing in setup.crossing_wings() {
        match (&setup.air, crossing.is_graze) {
            (AirModel::VortexLattice(_), true) => list.limit(format!(
                "Wings graze each other: {}. {GRAZES}",
                crossing.said
            )),
            _ => impossible(setup, "The prescribed motion", &crossing.said, list),
        }
    }
    for backwards in setup.trailing_edges_ahead() {
        list.limit(format!("Wings that fly backwards: {backwards}."));
    }
    for reynolds in wingbeat_analysis::doubtful_reynolds_numbers(setup) {
        list.limit(format!("Outside of what the air was made for: {reynolds}."));
    }
    if let Some(apart) = setup.starts_apart() {
        list.limit(format!("Tether and strokes out of step: {apart}."));
    }
    lift(setup, summary, list);
}

/// Wings that pass through each other: in a lattice the numbers mean nothing, other air does not feel it.
fn impossible(setup: &FlightSetup, motion: &str, crossing: &str, list: &mut Warnings) {
    let found = format!("{motion} is impossible: {crossing}.");
    match &setup.air {
        AirModel::VortexLattice(_) => list.fault(format!("{found} {NO_MEANING}")),
        _ => list.limit_first(format!(
            "{found} No animal beats so, and the air of this case does not feel it."
        )),
    }
}

/// Wings that passed through each other as they were flown, where their prescribed motion alone does not.
pub(crate) fn flown_crossings(setup: &FlightSetup, found: &[Crossing], list: &mut Warnings) {
    if !setup.crossing_wings().is_empty() {
        return;
    }
    for crossing in found {
        let crossing = setup.say_flown_crossing(crossing);
        impossible(setup, "The motion that was flown", &crossing, list);
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
