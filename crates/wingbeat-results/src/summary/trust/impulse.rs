//! Whether the wakes of a lattice keep the impulse that its surfaces give them: what they do not keep, forces lack or
//! have too much.

use wingbeat_air::{AirSettings, CirculationRate, CoreModel, LoadMethod};
use wingbeat_analysis::way_in_a_step;
use wingbeat_flight::FlightSetup;
use wingbeat_math::RotationLaw;
use wingbeat_model::{Wing, are_joined, nearest_nodes, pairs};

use super::lattice::differences;
use super::wakes::{cut_wake, held_off};
use crate::summary::beats::BeatMeans;
use crate::summary::numbers::Summary;
use crate::summary::per_beat::force;
use crate::summary::verdict::{Verdict, Warnings};

/// Two ways to the mean lift of a beat that differ by more, over the mean force, are apart: six times what they do in
/// attached hover with algebraic cores, and what they do with leading-edge sheets. So is the residual of the impulse of a
/// flight, 0.002 to 0.09 of what is in play in presets with algebraic or narrow cores, 0.23 with Lamb-Oseen's.
const APART: f64 = 0.1;

/// Part of the mean magnitude of the force that the mean force counts as at least \[1\]. Forces that cancel over a beat
/// leave as a mean what both ways are exact to, 0.4 and 1.6 % of that magnitude for a wing that flaps up and down alike
/// in still air, its edges shedding both: of a mean that is a tenth of it they say nothing.
const IN_PLAY: f64 = 0.2;

/// Residual of the impulse over what is in play from which on forces have little to do with the vorticity.
const MEANINGLESS: f64 = 0.5;

/// The same that wakes which are cut may leave, as rows at their ends are drawn out by what is no longer there.
/// The residual of membrane-wing, 0.012 with its whole wake, is 0.15 with three and a half chords of it, its lift
/// 0.6 % lower; at an incidence of 40 deg it is 0.52 and the lift within 1 %.
/// More than all that is in play no cut leaves.
const OF_A_CUT: f64 = 1.0;

/// Way of the tip in a step, in mean chords, that rolled-up parts of a wake feel. Presets have 0.05 to 0.4.
const LONG_STEP: f64 = 0.5;

/// What the impulse of the vorticity says of the forces.
pub(super) fn warnings(
    setup: &FlightSetup,
    lattice: &AirSettings,
    summary: &Summary,
    list: &mut Warnings,
) {
    let is_comparable = lattice.wind.is_none() && lattice.rate != CirculationRate::Omitted;
    if !is_comparable {
        return;
    }
    let is_cut = cut_wake(setup, summary).is_some();
    let why = || causes(setup, lattice, summary);
    // What a sudden start gives in no time is no part of the mean force of the first beat.
    let later = &summary.beats[usize::from(summary.beats.len() > 1)..];
    let budget = summary.impulse_budget.as_ref();
    let exchanged = budget.and_then(|b| Some(b.exchanged_newton_s? / summary.time_s));
    let scale = IN_PLAY * exchanged.filter(|force| force.is_finite()).unwrap_or(0.0);
    let is_said =
        lattice.images.is_empty() && two_ways_to_the_lift(lattice, (later, scale), why, list);
    let Some(residual) = budget.and_then(|b| b.largest_relative) else {
        return;
    };
    let said = format!(
        "the impulse of the vorticity and that of the force part {}",
        part(residual)
    );
    match judged(residual, is_cut) {
        Verdict::Green if residual > APART => list.note(format!(
            "Of a wake that is cut {said}, of which the cut may be the cause: rows at its end are drawn out by what is no longer there."
        )),
        Verdict::Green => {}
        Verdict::Amber if is_cut => list.limit(format!(
            "Of a wake that is cut {said}, of which the cut may be the cause. Keep more of the wake and see what changes. {}",
            why()
        )),
        Verdict::Amber if is_said => {}
        Verdict::Amber => list.limit(format!(
            "Wakes do not keep the impulse that surfaces give them: {said}, and forces are not known better. {}",
            why()
        )),
        Verdict::Red => list.fault(format!(
            "The forces of the air mean nothing: {said}. {}",
            why()
        )),
    }
}

/// What a residual of the impulse over what is in play \[1\] means, of wakes that are cut or whole; what is not a number is
/// red.
fn judged(residual: f64, is_cut: bool) -> Verdict {
    let [green, amber] = match is_cut {
        true => [MEANINGLESS, OF_A_CUT],
        false => [APART, MEANINGLESS],
    };
    match residual {
        r if r <= green => Verdict::Green,
        r if r <= amber => Verdict::Amber,
        _ => Verdict::Red,
    }
}

/// By how much impulses part, as the end of a sentence: in per cent, or in powers of ten where it is many times the whole.
fn part(x: f64) -> String {
    let by = match x {
        x if x < 1.0 => format!("{:.0} % of", 100.0 * x),
        x if x < 100.0 => format!("{x:.1} times"),
        x if x.is_finite() => format!("{x:.1e} times"),
        _ => return "by more than a number can hold: the flight diverged".to_owned(),
    };
    format!("by {by} the impulse in play")
}

/// What of this flight may keep its wakes from keeping their impulse, in a sentence.
fn causes(setup: &FlightSetup, lattice: &AirSettings, summary: &Summary) -> String {
    let wide = setup.bound_core_width().filter(|width| *width > 1.0);
    let wide = wide.map(|width| {
        format!(
            "cores of the wings that are {width:.1} of their foremost panels wide (air.bound_core)"
        )
    });
    let is_algebraic = |core: &CoreModel| matches!(core, CoreModel::Algebraic { .. });
    let other = (!is_algebraic(&lattice.wake_core) || !is_algebraic(&lattice.bound_core))
        .then(|| "cores that are not algebraic (air.wake_core, air.bound_core)".to_owned());
    let narrow = (lattice.wake_overlap == 0.0)
        .then(|| "wake cores that do not overlap (air.wake_overlap = 0)".to_owned());
    let cut = cut_wake(setup, summary).map(|kept| kept.said);
    let held = held_off(summary);
    let held = (held > 0).then(|| format!("nodes held off surfaces ({held} times)"));
    let limited = (summary.limited > 0 && lattice.max_displacement.is_some()).then(|| {
        let times = summary.limited;
        match lattice.solves_suction() || lattice.particles.is_some() {
            false => format!("ways of nodes that air.max_displacement_m limits ({times} times)"),
            true => format!(
                "limited events ({times}), ways of nodes (air.max_displacement_m) or others"
            ),
        }
    });
    let step = way_in_a_step(setup);
    let step = (step > LONG_STEP)
        .then(|| format!("steps in which tips go {step:.2} mean chords (time.steps_per_beat)"));
    let rolls_up = summary.leading_rings.is_some_and(|rings| rings > 0.0);
    let rolls_up = rolls_up
        .then(|| "sheets of leading edges, which roll up faster than steps follow".to_owned());
    let all = [
        wide,
        near_wings(setup),
        cut,
        limited,
        other,
        narrow,
        held,
        step,
        rolls_up,
    ];
    let all: Vec<String> = all.into_iter().flatten().collect();
    match all.is_empty() {
        true => "Take smaller steps or wider wake cores and see what changes.".to_owned(),
        false => format!("What may be why in this flight: {}.", all.join("; ")),
    }
}

/// Wings that are not joined and come nearer to each other than half their panels are long.
fn near_wings(setup: &FlightSetup) -> Option<String> {
    let wings = &setup.animal.wings;
    let joined = setup.joined_pairs();
    let apart = pairs(0..wings.len()).filter(|pair| !are_joined(&joined, *pair));
    // The nearest nodes of wings that share their root line are those of the root.
    let apart = apart.filter(|pair| !share_root(pair.map(|w| &wings[w])));
    let found = apart.map(|pair| (pair, nearest_nodes(&setup.animal, pair)));
    let ([a, b], gap) = found.min_by(|x, y| x.1.total_cmp(&y.1))?;
    let panel = |w: &Wing| w.report().mean_chord / w.mesh.rows as f64;
    let part = gap / panel(&wings[a]).max(panel(&wings[b]));
    (part < 0.5).then(|| {
        let [a, b] = [a, b].map(|w| &wings[w].name);
        format!("wings `{a}` and `{b}`, which come as near to each other as {part:.2} panels")
    })
}

/// Whether the roots of two wings are one line as the flight starts.
fn share_root(wings: [&Wing; 2]) -> bool {
    let ends = wings.map(|w| {
        let attitude = w.motion.at(0.0).c;
        [0, w.mesh.rows].map(|i| w.hinge_b + attitude * w.mesh.nodes[w.mesh.node(i, 0)])
    });
    let touch = 1e-6 * wings[0].report().mean_chord;
    (0..2).all(|k| ends[0][k].distance(ends[1][k]) <= touch)
}

/// Difference between the lift by the impulse of the vortices and that by the loads over the mean inviscid force of a
/// beat \[1\], or over `least` \[N\] if that is more; none of results that lack one of the two.
fn apart(beat: &BeatMeans, least: f64) -> Option<f64> {
    let mean = &beat.mean;
    let inviscid = mean.inviscid_lift_newton?;
    // Of the whole mean force: of a tail fin that drives a fish ahead nothing is left as lift.
    let force = force([inviscid, mean.thrust_newton, mean.side_force_newton]).max(least);
    Some((mean.lift_by_impulse_newton? - inviscid).abs() / force.max(f64::MIN_POSITIVE))
}

/// The inviscid lift by the loads and by the impulse of the vortices, of the last beat and of that in which they differ
/// most, and what it means if they differ beside the mean force or `least` \[N\].
///
/// Returns whether it said that they do.
fn two_ways_to_the_lift(
    lattice: &AirSettings,
    (beats, least): (&[BeatMeans], f64),
    causes: impl FnOnce() -> String,
    list: &mut Warnings,
) -> bool {
    let difference = |beat: &BeatMeans| apart(beat, least).unwrap_or(0.0);
    let worst = (beats.iter()).max_by(|a, b| difference(a).total_cmp(&difference(b)));
    let (Some(last), Some(worst)) = (beats.last(), worst) else {
        return false;
    };
    if lattice.particles.is_some() {
        list.note(
            "The vorticity of particles does not close: the vortex impulse depends on the origin, and its rate is no second way to the lift.",
        );
        return false;
    }
    let is_apart = difference(worst) > APART;
    let beat = if is_apart { worst } else { last };
    let (Some(other), Some(inviscid)) = (
        beat.mean.lift_by_impulse_newton,
        beat.mean.inviscid_lift_newton,
    ) else {
        return false;
    };
    let lift = beat.mean.lift_newton;
    let loads = match lattice.loads {
        LoadMethod::Joukowski => "Joukowski's forces",
        LoadMethod::Pressure | LoadMethod::Polhamus => {
            "pressures and the suction of edges that do not shed"
        }
    };
    let flown = differences(lattice).map_or(String::new(), |how| {
        format!(" (the flight has {lift:.3e} N, {how})")
    });
    let both = format!(
        "Mean lift of beat {} by the rate of the vortex impulse, another way to the same force: {other:.3e} N; by {loads} {inviscid:.3e} N{flown}.",
        beat.beat
    );
    match is_apart {
        false => list.note(both),
        true => list.limit(format!(
            "Two ways to the mean lift are apart: the wake does not keep its impulse, so its shape is not to be trusted. {} {both}",
            causes()
        )),
    }
    is_apart
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Outcome;
    use wingbeat_math::DVec3;

    /// Residuals of membrane-wing, whose wake is cut and whose lift is within 1 % of that of its whole wake; and of flights
    /// that diverged, which no cut explains.
    #[test]
    fn behaves_residuals_that_a_cut_may_leave_are_no_fault() {
        for (residual, is_cut, verdict) in [
            (0.09, false, Verdict::Green),
            (0.29, true, Verdict::Green),
            (0.29, false, Verdict::Amber),
            (0.515, true, Verdict::Amber),
            (0.515, false, Verdict::Red),
            (2.2e5, true, Verdict::Red),
            (f64::INFINITY, true, Verdict::Red),
            (f64::NAN, true, Verdict::Red),
        ] {
            assert_eq!(judged(residual, is_cut), verdict, "{residual} {is_cut}");
        }
        assert_eq!(part(0.29), "by 29 % of the impulse in play");
        assert!(part(f64::INFINITY).contains("diverged"));
    }

    /// What two ways to the mean lift differ by is an eighth of the lift: much in hover, little beside the thrust of a
    /// fin without mean lift or beside forces that cancel over the beat; and much wherever it was, though the last beat
    /// has no more of it.
    #[test]
    fn behaves_two_ways_to_the_lift_are_apart_beside_the_whole_mean_force_of_any_beat() {
        let settings = AirSettings::accurate(1.0, DVec3::ZERO);
        let beat = |number: usize, thrust: f64, by_impulse: f64| -> BeatMeans {
            let text = format!(
                r#"{{"beat": {number}, "lift_newton": -9.37e3, "lift_over_weight": null, "thrust_newton": {thrust},
                "power_watt": 0, "positive_power_watt": 0, "inviscid_lift_newton": -9.37e3, "lift_by_impulse_newton": {by_impulse}}}"#
            );
            serde_json::from_str(&text).unwrap()
        };
        let first = beat(1, 0.0, -1.054e4);
        for (beats, least, verdict) in [
            (vec![first.clone()], 0.0, Verdict::Amber),
            (vec![first.clone()], 1e4, Verdict::Amber),
            (vec![first.clone()], 1.2e4, Verdict::Green),
            (vec![beat(4, 5.9e5, -1.054e4)], 0.0, Verdict::Green),
            (vec![beat(1, 0.0, -9.4e3)], 0.0, Verdict::Green),
            (vec![first, beat(2, 0.0, -9.4e3)], 0.0, Verdict::Amber),
        ] {
            let mut list = Warnings::default();
            two_ways_to_the_lift(&settings, (&beats, least), String::new, &mut list);
            assert_eq!(list.verdict(&Outcome::Finished).0, verdict);
        }
    }
}
