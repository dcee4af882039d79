//! `wingbeat trim --sweep`: trimmed flights over a range of speeds.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use serde_json::{Value, json};
use wingbeat::analysis::{Lost, Sweep, Swept, TrimProblem, Unknown, glides, sweep_watched};
use wingbeat::case::LoadedCase;
use wingbeat::draw::figures::swept::{SpeedRow, swept};
use wingbeat::math::DVec3;
use wingbeat::results::fixed::{fixed, signed};

use super::found::{sideslip_and_turn, values, why};
use super::trimming::{Trimming, unused};
use crate::command::output::failure::{FAILED, Failure, INTERRUPTED};
use crate::command::output::report::{Report, line};
use crate::command::output::target::Target;
use crate::command::output::terminal::tell as announce;
use crate::command::progress::watch::Watch;
use crate::command::signals::stop_flag_after;

/// Trims from speed to speed, reports, and draws; Ctrl-C ends it after a speed, with what is done.
pub(super) fn run(
    args: &Trimming,
    [from, to]: [f64; 2],
    points: usize,
    report: &mut Report,
    figure: Option<Target>,
) -> Result<(), Failure> {
    let case = args.load()?;
    args.without_memory(&case)?;
    let is_glide = glides(&case.setup);
    if is_glide && figure.is_some() {
        let why =
            "it shows power and strokes, of which a glide has none; the table has its sink rates";
        return Err(unused("figure", why));
    }
    let problem = args.problem_at(&case, if from.abs() > to.abs() { from } else { to })?;
    let share = |k: usize| k as f64 / (points - 1) as f64;
    let velocity = |k: usize| DVec3 {
        x: from + (to - from) * share(k),
        ..problem.velocity
    };
    let velocities: Vec<DVec3> = (0..points).map(velocity).collect();
    let found = watched(&case, &problem, &velocities)?;
    tell(report, (&case.name, is_glide), &problem, &found);
    if let Some(file) = figure.filter(|_| !found.flights.is_empty()) {
        let rows: Vec<SpeedRow> = found.flights.iter().map(row).collect();
        let lost = found.lost.as_ref().map(|(velocity, _)| velocity.x);
        file.write(&swept(&case.name, &rows, lost))?;
        report.drew(&file);
    }
    if !found.untried.is_empty() {
        announce!(
            "interrupted: {} of {points} speeds were not tried",
            found.untried.len()
        );
        return Err(Failure::Told(INTERRUPTED));
    }
    match found.lost.is_none() && found.missed.is_empty() {
        true => Ok(()),
        false => Err(Failure::Told(FAILED)),
    }
}

/// The sweep, telling of each speed, until a signal stops it.
fn watched(
    case: &LoadedCase,
    problem: &TrimProblem,
    velocities: &[DVec3],
) -> Result<Sweep, Failure> {
    let stop = stop_flag_after("this speed is finished");
    let watch = Watch::new("trimming");
    let mut done = 0;
    let each = |velocity: DVec3, lost: Option<Lost>| {
        done += 1;
        let what = lost.map_or_else(
            || "trimmed".to_owned(),
            |l| format!("NOT trimmed ({})", why(&l)),
        );
        watch.told(&format!(
            "{}: {:.3} m/s {what}, {done} of {} speeds",
            case.name,
            velocity.x,
            velocities.len()
        ));
        match stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    Ok(sweep_watched(&case.setup, problem, velocities, each)?)
}

fn row(flight: &Swept) -> SpeedRow {
    let p = &flight.power;
    SpeedRow {
        forward: flight.velocity.x,
        power: [p.aerodynamic, p.perfect_storage, p.no_storage].map(|x| p.body_specific(x)),
        stroke_amplitude: flight.stroke_amplitude,
        drive: drive(flight),
        frequency: match flight.glide {
            None => 1.0 / flight.trim.beat.period(),
            Some(_) => 0.0, // nothing beats
        },
        body_pitch: flight.trim.solution.body_pitch,
        wings_cross: crossing(flight).is_some(),
    }
}

/// Relative change of what drives joints, where no wing flaps by itself \[1\].
fn drive(flight: &Swept) -> Option<f64> {
    let is_driven = flight.glide.is_none() && flight.stroke_amplitude == 0.0;
    let solution = &flight.trim.solution;
    is_driven.then(|| solution.value(Unknown::DriveAmplitude).unwrap_or(0.0))
}

fn tell(report: &mut Report, (name, is_glide): (&str, bool), problem: &TrimProblem, found: &Sweep) {
    let is_unknown = problem.unknowns.contains(&Unknown::Climb);
    let up = match 0.0 - problem.velocity.z {
        0.0 => String::new(),
        _ if is_unknown => String::new(),
        up => format!(", {up:.3} m/s up"),
    };
    let aside = sideslip_and_turn(problem);
    line!(report, "{name}: trimmed flights against speed{up}{aside}");
    let climb = (!is_unknown).then_some(0.0 - problem.velocity.z);
    report.value("climb_m_s", climb);
    report.value("sideslip_m_s", problem.velocity.y);
    report.value("turn_rate_deg_s", problem.turn_rate.to_degrees());
    match is_glide {
        true => polar(report, found),
        false => {
            table(report, found);
            cheapest(report, found);
        }
    }
    crossings(report, &found.flights);
    end(report, found);
    untried(report, found);
    let flights: Vec<Value> = found.flights.iter().map(value).collect();
    report.value("case", name);
    report.value("flights", flights);
}

/// The speeds before the first flight, and why there is none.
fn missed(report: &mut Report, found: &Sweep) {
    for (velocity, lost) in &found.missed {
        line!(
            report,
            "  {:>11.3}  NOT trimmed ({})",
            velocity.x,
            why(lost)
        );
    }
    let missed = found.missed.iter();
    let missed: Vec<Value> = missed
        .map(|(v, lost)| json!({ "forward_m_s": v.x, "reason": why(lost) }))
        .collect();
    report.value("not_trimmed_before", missed);
}

/// Glides against speed.
fn polar(report: &mut Report, found: &Sweep) {
    line!(
        report,
        "  {:>11}{:>12}{:>13}{:>11}  unknowns",
        "forward m/s",
        "climb m/s",
        "glide ratio",
        "pitch deg"
    );
    missed(report, found);
    for f in &found.flights {
        let solution = &f.trim.solution;
        let others = solution.unknowns.iter().copied();
        let others: Vec<Unknown> = others
            .filter(|u| ![Unknown::BodyPitch, Unknown::Climb].contains(u))
            .collect();
        let named = values(&others, solution).into_iter();
        let named: Vec<String> = named
            .map(|(name, x)| format!("{name} {}", signed(x.as_f64().unwrap_or(0.0), 4)))
            .collect();
        line!(
            report,
            "  {:>11.3}{:>12.4}{:>13.4}{:>11.2}  {}",
            f.velocity.x,
            0.0 - f.velocity.z,
            f.glide.map_or(0.0, |g| g.ratio),
            solution.body_pitch.to_degrees(),
            named.join(", ")
        );
    }
    let ends = [found.flights.first(), found.flights.last()];
    let ends = ends.map(|f| f.map(|f| f.velocity.x));
    for (what, key, flight) in [
        ("least sink", "least_sink", found.least_sink()),
        ("flattest glide", "flattest_glide", found.flattest()),
    ] {
        let Some(v) = flight.map(|f| f.velocity.x) else {
            continue;
        };
        let note = match ends.contains(&Some(v)) {
            true => ", the end of what was swept: look beyond it",
            false => " of these",
        };
        line!(report, "  {what} at {v:.3} m/s{note}");
        report.value(&format!("{key}_forward_m_s"), v);
    }
}

fn table(report: &mut Report, found: &Sweep) {
    let is_driven = found.flights.iter().any(|f| drive(f).is_some());
    line!(
        report,
        "  {:>11}{:>12}{:>14}{:>17}{:>12}{:>14}{:>11}",
        "forward m/s",
        "air W/kg",
        "storage W/kg",
        "no storage W/kg",
        if is_driven { "drive" } else { "stroke deg" },
        "frequency Hz",
        "pitch deg"
    );
    missed(report, found);
    for r in found.flights.iter().map(row) {
        let [air, perfect, none] = r.power;
        let stroke = || fixed(r.stroke_amplitude.to_degrees(), 2);
        line!(
            report,
            "  {:>11.3}{air:>12.2}{perfect:>14.2}{none:>17.2}{:>12}{:>14.2}{:>11.2}",
            r.forward,
            r.drive.map_or_else(stroke, |x| signed(x, 4)),
            r.frequency,
            r.body_pitch.to_degrees()
        );
    }
    line!(
        report,
        "  air: power against the air; storage: of actuators (muscles, motors) with perfect elastic storage, no storage: with none"
    );
    if is_driven {
        line!(
            report,
            "  drive: relative change of what drives the joints (drive_amplitude), from that of the case"
        );
    }
}

/// The speeds of least power and of least work per distance.
fn cheapest(report: &mut Report, found: &Sweep) {
    if found.flights.len() < 3 {
        return;
    }
    let forward = |f: &Swept| f.velocity.x;
    let ends = [found.flights.first(), found.flights.last()].map(|f| f.map(forward));
    let least = [
        (
            "power (storage)",
            "least_power",
            found.least_power(),
            found.least_power_forward(),
        ),
        (
            "work per distance (storage)",
            "least_work_per_distance",
            found.least_work(),
            found.least_work_forward(),
        ),
    ];
    for (what, key, flight, between) in least {
        let Some(v) = flight.map(forward) else {
            continue;
        };
        let note = match (ends.contains(&Some(v)), between) {
            (true, _) => ", the end of what was swept: look beyond it".to_owned(),
            (false, Some(at)) => {
                format!(
                    " of these; between them, by the parabola through the nearest three, at {at:.3} m/s"
                )
            }
            (false, None) => " of these".to_owned(),
        };
        line!(report, "  least {what} at {v:.3} m/s{note}");
        report.value(&format!("{key}_forward_m_s"), v);
        report.value(&format!("{key}_interpolated_forward_m_s"), between);
    }
}

/// The speeds at which wings pass through each other.
fn crossings(report: &mut Report, flights: &[Swept]) {
    let crossing: Vec<(f64, f64)> = flights.iter().filter_map(crossing).collect();
    if let (Some((from, _)), Some((to, _))) = (crossing.first(), crossing.last()) {
        let most = crossing.iter().fold(0.0_f64, |m, (_, part)| m.max(*part));
        line!(
            report,
            "  warning: wings pass through each other from {from:.3} to {to:.3} m/s, in up to {:.0} % of the beat: no animal flies so",
            (100.0 * most).max(1.0)
        );
    }
}

/// Where the range begins late or ends early, and why.
fn end(report: &mut Report, found: &Sweep) {
    // The missed speed next to the flights; where there are none, the first.
    let next = match found.flights.is_empty() {
        true => found.missed.first(),
        false => found.missed.last(),
    };
    let before = match found.flights.is_empty() {
        true if !found.untried.is_empty() => "no flight was found before the interruption",
        true => "no flight is found in this range",
        false => "the range begins after it",
    };
    let ends = [
        (next, before),
        (found.lost.as_ref(), "the range ends before it"),
    ];
    for (velocity, lost, what) in ends
        .into_iter()
        .filter_map(|(e, what)| e.map(|e| (e.0, e.1, what)))
    {
        line!(
            report,
            "NOT trimmed at {:.3} m/s ({}): {what}; choose other --unknowns, or a narrower range",
            velocity.x,
            why(&lost)
        );
    }
    if let Some((velocity, lost)) = found.lost.as_ref().or(next) {
        report.value("not_trimmed_forward_m_s", velocity.x);
        report.value("not_trimmed_reason", why(lost));
    }
}

/// Speeds that were left when it was interrupted.
fn untried(report: &mut Report, found: &Sweep) {
    let speeds: Vec<f64> = found.untried.iter().map(|v| v.x).collect();
    if let (Some(first), Some(last)) = (speeds.first(), speeds.last()) {
        line!(
            report,
            "NOT tried, as the sweep was interrupted: {} speeds from {first:.3} to {last:.3} m/s",
            speeds.len()
        );
    }
    report.value("complete", speeds.is_empty());
    report.value("not_tried_forward_m_s", speeds);
}

/// Speed of a flight whose wings pass through each other, and the part of the beat in which they do.
fn crossing(flight: &Swept) -> Option<(f64, f64)> {
    let found = flight.trim.setup.prescribed_crossings();
    let part = found.iter().map(|c| c.part).reduce(f64::max)?;
    Some((flight.velocity.x, part))
}

fn value(flight: &Swept) -> Value {
    let r = row(flight);
    let [air, perfect, none] = r.power;
    json!({
        "forward_m_s": r.forward,
        "climb_m_s": 0.0 - flight.velocity.z,
        "aerodynamic_watt_per_kg_body": air,
        "perfect_storage_watt_per_kg_body": perfect,
        "no_storage_watt_per_kg_body": none,
        "stroke_deg": r.drive.is_none().then(|| r.stroke_amplitude.to_degrees()),
        "frequency_hz": r.frequency,
        "body_pitch_deg": r.body_pitch.to_degrees(),
        "crossing_wings_part_of_beat": crossing(flight).map_or(0.0, |(_, part)| part),
        "glide_ratio": flight.glide.map(|g| g.ratio),
        "unknowns": values(&flight.trim.solution.unknowns, &flight.trim.solution),
    })
}
