//! What is reported of a trim.

use serde_json::{Map, Value, json};
use wingbeat::analysis::wake::WakeTrim;
use wingbeat::analysis::{
    Bound, Glide, Lost, Residuals, TrimProblem, TrimSolution, UNKNOWNS, Unknown, UnknownKind,
    doubtful_reynolds_numbers, stroke_amplitude, turned_inside_out,
};
use wingbeat::case::LoadedCase;
use wingbeat::flight::{FlightSetup, MotionMode};
use wingbeat::math::{DVec3, larger};
use wingbeat::results::fixed::signed;

use crate::command::case::expectation::tell_held;
use crate::command::output::report::{Report, line};
use crate::command::output::terminal::tell;

/// The trim: what was found, and the setup with it.
pub(super) fn tell(
    report: &mut Report,
    case: &LoadedCase,
    problem: &TrimProblem,
    (t, setup): (&TrimSolution, &FlightSetup),
) {
    heading(report, case, problem);
    verdict(report, t);
    unknowns(report, t);
    residuals(report, problem, t);
    warn(report, t, setup);
}

/// What was trimmed, to which flight.
fn heading(report: &mut Report, case: &LoadedCase, problem: &TrimProblem) {
    let (forward, up) = (problem.velocity.x, 0.0 - problem.velocity.z);
    line!(
        report,
        "{}: trim to {forward:.3} m/s forward, {up:.3} m/s up{}",
        case.name,
        sideslip_and_turn(problem)
    );
    let stream = case.setup.air.stream().unwrap_or(DVec3::ZERO);
    let airspeed = (problem.velocity - stream).length();
    if stream != DVec3::ZERO {
        line!(
            report,
            "in a stream (air.stream_m_s), which adds to that: {airspeed:.3} m/s through the air"
        );
    }
    report.value("airspeed_m_s", airspeed);
    let off = case.setup.gravity.angle_between(DVec3::Z).to_degrees();
    if off > TILTED {
        line!(
            report,
            "gravity points {off:.2} deg off n3 (gravity_m_s2): forward is along n1, right along n2, up along -n3, not level and plumb"
        );
    }
    report.value("gravity_off_n3_deg", off);
    tell_held(report, &case.setup);
    let has_control = case.raw.control.is_some();
    if has_control {
        line!(report, "of the open loop: [control] is left out");
    }
    report.value("control_left_out", has_control);
    let start = start_velocity(&case.setup);
    let is_left_out = start != DVec3::ZERO && problem.velocity == DVec3::ZERO;
    if is_left_out {
        let [n1, n2, n3] = start.to_array();
        line!(
            report,
            "flight.velocity_m_s = [{n1}, {n2}, {n3}] of the case is left out: --forward, --sideslip and --climb say the speed"
        );
    }
    report.value("velocity_left_out", is_left_out);
    report.value("case", case.name.as_str());
    report.value("forward_m_s", forward);
    report.value("climb_m_s", up);
    report.value("sideslip_m_s", problem.velocity.y);
    report.value("turn_rate_deg_s", problem.turn_rate.to_degrees());
}

/// Part of the residuals from which on the roughness of the map is said to keep them \[1\].
const ROUGH: f64 = 0.1;

/// Angle off n3 from which on gravity is said to be tilted \[deg\].
const TILTED: f64 = 1e-3;

/// Velocity of the body at the start of a free flight, N components [m/s]; 0 on a tether.
fn start_velocity(setup: &FlightSetup) -> DVec3 {
    match &setup.mode {
        MotionMode::Free(start) => start.velocity,
        MotionMode::Tethered(_) => DVec3::ZERO,
    }
}

/// Whether it was found.
fn verdict(report: &mut Report, t: &TrimSolution) {
    let is_within = t.outside.is_empty();
    let verdict = match (t.converged, is_within) {
        (true, true) => "trimmed",
        (true, false) => "steady, but NOT within the bounds,",
        (false, _) if !t.at_bound.is_empty() => {
            "NOT trimmed: no steady flight within the bounds; the best point found"
        }
        (false, _) => "NOT trimmed; the best point found",
    };
    line!(
        report,
        "{verdict} after {} Newton steps, largest residual {:.1e}",
        t.iterations,
        t.error()
    );
    if let Some(way) = &t.way {
        line!(
            report,
            "  by way of slower flights it came to {:.3} m/s through the air; beyond: {}",
            way.airspeed,
            why(&way.ended)
        );
        report.value("by_way_to_airspeed_m_s", way.airspeed);
        report.value("by_way_ended", why(&way.ended));
    }
    report.value("converged", t.converged);
    report.value("within_bounds", is_within);
    report.value("newton_steps", t.iterations);
}

/// Why a speed was not reached, in words.
pub(super) fn why(lost: &Lost) -> String {
    match lost {
        Lost::NotTrimmed(Some(residual)) => format!("largest residual {residual:.1e}"),
        Lost::NotTrimmed(None) => "no finite flight".to_owned(),
        Lost::Bound(unknown) => format!("{} outside its bound", unknown.name()),
        Lost::Stroke(angle) => format!(
            "strokes of {:.0} deg, with which wings pass through each other or through the body",
            angle.to_degrees()
        ),
        Lost::Beyond => "not tried, as the range ends at a lower speed".to_owned(),
    }
}

/// The unknowns, a line each.
fn unknowns(report: &mut Report, t: &TrimSolution) {
    let width = t.unknowns.iter().map(|u| u.name().len()).max();
    let width = width.unwrap_or(0).max(16) + 2;
    for &u in &t.unknowns {
        let note = if t.outside.contains(&u) {
            ", OUTSIDE its bound"
        } else if t.at_bound.contains(&u) {
            ", at its bound"
        } else {
            ""
        };
        line!(report, "  {:<width$}{}{note}", u.name(), value(u, t).0);
    }
    report.value("unknowns", values(&t.unknowns, t));
    report.value("at_bound", names_of(&t.at_bound));
    report.value("outside_bounds", names_of(&t.outside));
}

/// Doubts of the motion that was found: told, and for programs `warnings`.
fn warn(report: &mut Report, t: &TrimSolution, setup: &FlightSetup) {
    let strokes = setup.animal.wings.iter().map(stroke_amplitude);
    let stroke = strokes.fold(0.0, f64::max).to_degrees();
    let crossing_wings = setup.crossing_wings().into_iter().map(|c| c.said);
    let crossing_wings: Vec<String> = crossing_wings.collect();
    let mut warnings = match stroke > 180.0 {
        true => vec![format!(
            "strokes of {stroke:.0} deg: wings pass through each other or through the body; choose other --unknowns (frequency, for instance), or a slower flight"
        )],
        false => crossing_wings.clone(),
    };
    let jumps = setup.jumping_rotation();
    warnings.extend(jumps.clone());
    report.value("derivatives_in_doubt", jumps);
    let reynolds = doubtful_reynolds_numbers(setup);
    warnings.extend(reynolds.clone());
    report.value("reynolds_numbers_in_doubt", reynolds);
    report.value("stroke_deg", stroke);
    report.value("crossing_wings", crossing_wings);
    if let Some(unknown) = turned_inside_out(&t.unknowns, &t.values) {
        warnings.push(format!(
            "{} of {}: below -100 % a stroke is turned inside out, back and forth exchanged, which is another motion; choose other --unknowns (frequency or feathering_offset, for instance), or a flight nearer to the motion of the case",
            unknown.name(),
            value(unknown, t).0
        ));
    }
    warnings.iter().for_each(|text| tell!("warning: {text}"));
    report.value("warnings", warnings);
}

/// The glide, where nothing beats.
pub(super) fn tell_glide(report: &mut Report, glide: &Glide) {
    let angle = glide.angle.to_degrees();
    line!(
        report,
        "  glide: {:.4} m/s through the air, {angle:.4} deg below the level, {:.4} of way for one of height",
        glide.airspeed,
        glide.ratio
    );
    report.value("glide_angle_deg", angle);
    report.value("glide_ratio", glide.ratio);
}

/// How much was flown to find a flight in air with memory.
pub(super) fn tell_flown(report: &mut Report, found: &WakeTrim) {
    let (flights, beats) = (found.flights, found.beats);
    report.value("flights", flights);
    report.value("wingbeats", beats);
    let Some(tow) = &found.tow else {
        let unit = match found.glide() {
            Some(_) => "times of sqrt(R / g) / 4",
            None => "wingbeats",
        };
        line!(report, "  {flights} flights of {beats} {unit} in all");
        return;
    };
    line!(
        report,
        "  {flights} tows, the last of {} steps and {:.1} chords; over the second half of that way the loads changed\n  by {:.1e} of the weight; what the start of the wake still makes is about a third of that",
        tow.steps,
        tow.chords,
        tow.change
    );
    report.value("towed_steps", tow.steps);
    report.value("towed_chords", tow.chords);
    report.value("towed_change", tow.change);
}

/// Wings that turn over on passive hinges.
pub(super) fn warn_of_turned(report: &mut Report, turned: Vec<String>) {
    turned.iter().for_each(|text| tell!("warning: {text}"));
    report.value("turned_over", turned);
}

/// That a flight in air with wakes was not found because the map of a wingbeat is rough.
pub(super) fn tell_rough(report: &mut Report, found: &WakeTrim) {
    let Some(rough) = found.roughness else {
        return;
    };
    report.value("roughness", rough);
    if rough < ROUGH * found.solution.error() {
        return;
    }
    let free = found.setup.joints.iter();
    let free = free.filter(|j| j.model.kind.directions() > 0);
    let free: Vec<String> = free.map(|j| format!("`{}`", j.name)).collect();
    let joints = match free.is_empty() {
        true => String::new(),
        false => format!(
            ", as wings on free joints ({}) make it, which swing otherwise in every wake that they meet",
            free.join(", ")
        ),
    };
    tell!(
        "the map of a wingbeat is rough here{joints}: residuals part by {rough:.1e} between flights whose unknowns differ by 0.001, and smaller ones are found by chance alone. Trim in blade elements (--set air.model=blade_element), or take a --tolerance above that"
    );
}

/// What to try where a flight that is not slow is not found in air with memory, whose trims take minutes.
pub(super) fn advise_slower(problem: &TrimProblem) {
    if problem.velocity != DVec3::ZERO {
        tell!(
            "a flight at another speed may be found where this one is not: trim a slower one with --write FILE, and then FILE at this speed"
        );
    }
}

/// The residuals, a line each; those of free joints in one.
fn residuals(report: &mut Report, problem: &TrimProblem, t: &TrimSolution) {
    let mut values = Map::new();
    let mut one = |name: &str, key: &str, r: f64| {
        line!(report, "  residual of {name:<28}{r:>10.1e}");
        values.insert(key.to_owned(), json!(r));
    };
    let names = Residuals::of(problem).names();
    for ([name, key], r) in names.iter().zip(&t.residual) {
        one(name, key, *r);
    }
    if let Some(joints) = t.residual.get(names.len()..).filter(|j| !j.is_empty()) {
        one(
            "free joints, largest",
            "free_joints_largest",
            largest(joints),
        );
    }
    report.value("residuals", values);
}

fn largest(residuals: &[f64]) -> f64 {
    residuals.iter().fold(0.0, |m, r| larger(m, r.abs()))
}

fn names_of(unknowns: &[Unknown]) -> Vec<&'static str> {
    unknowns.iter().map(|u| u.name()).collect()
}

/// Sideslip and turn in words, where there are any.
pub(super) fn sideslip_and_turn(problem: &TrimProblem) -> String {
    let (right, turn) = (problem.velocity.y, problem.turn_rate.to_degrees());
    let slip = match right {
        0.0 => String::new(),
        _ => format!(", {right:.3} m/s to the right"),
    };
    match turn {
        0.0 => slip,
        _ => format!("{slip}, turning right by {turn:.2} deg/s"),
    }
}

/// What was found of the unknowns, units in the names.
pub(super) fn values(unknowns: &[Unknown], t: &TrimSolution) -> Map<String, Value> {
    let one = |u: &Unknown| {
        let (_, unit, value) = value(*u, t);
        (format!("{}{unit}", u.name()), json!(value))
    };
    let mut values: Map<String, Value> = unknowns.iter().map(one).collect();
    for u in unknowns
        .iter()
        .filter(|u| u.kind() == UnknownKind::WingLengths)
    {
        // As bounds of it are given.
        let key = format!("{}_forward_wing_lengths", u.name());
        values.insert(key, json!(t.value(*u)));
    }
    values
}

/// An unknown in words; the unit its name ends with for programs, and the value in it.
fn value(u: Unknown, t: &TrimSolution) -> (String, &'static str, f64) {
    let x = match u {
        Unknown::MassCentre => t.mass_centre, // [m]
        _ => t.value(u).unwrap_or(0.0),
    };
    let [suffix, unit] = unit(u);
    let (shown, places) = match unit {
        "%" => (100.0 * x, 3),
        "deg" => (x.to_degrees(), 4),
        "mm forward" => (1e3 * x, 4),
        "m/s" => (x, 4),
        _ => (x, 5),
    };
    let told = if unit == "deg" { shown } else { x };
    let also = match u.kind() {
        UnknownKind::WingLengths => {
            format!(" ({} wing lengths)", signed(t.value(u).unwrap_or(0.0), 4))
        }
        _ => String::new(),
    };
    (
        format!("{} {unit}{also}", signed(shown, places)),
        suffix,
        told,
    )
}

/// The unit of an unknown: as the end of its name for programs, and in words.
fn unit(u: Unknown) -> [&'static str; 2] {
    match u.kind() {
        UnknownKind::Relative => ["_change_relative", "%"],
        UnknownKind::Beats => ["_wingbeats", "wingbeats"],
        UnknownKind::WingLengths => ["_forward_m", "mm forward"],
        UnknownKind::Angle => ["_deg", "deg"],
        UnknownKind::Speed => ["_m_s", "m/s"],
    }
}

/// A bound as it is given, `NAME=FROM..TO`: angles in degrees, relative changes as parts of 1, `feathering_lead` in
/// wingbeats, `mass_centre` in wing lengths, speeds in m/s.
pub(super) fn bound(text: &str) -> Result<Bound, String> {
    let parts = text.split_once('=').and_then(|(name, range)| {
        let (from, to) = range.split_once("..")?;
        Some((name, from.trim().parse().ok()?, to.trim().parse().ok()?))
    });
    let known = |name: &str| UNKNOWNS.iter().find(|u| u.1 == name).map(|u| u.0);
    let Some((name, from, to)) = parts.filter(|(_, a, b): &(&str, f64, f64)| a < b) else {
        return Err(
            "give NAME=FROM..TO with FROM below TO, e.g. stroke_amplitude=-0.2..0.2".to_owned(),
        );
    };
    let Some(unknown) = known(name) else {
        let names = UNKNOWNS.map(|u| u.1).join(", ");
        return Err(format!("`{name}` is no unknown; give one of {names}"));
    };
    let scale = match unknown.kind() {
        UnknownKind::Angle => std::f64::consts::PI / 180.0,
        _ => 1.0,
    };
    let (from, to) = (scale * from, scale * to);
    let bound = Bound { unknown, from, to };
    match from.is_finite() && to.is_finite() {
        true => bound.check().map(|()| bound),
        false => Err("give finite numbers".to_owned()),
    }
}
