//! What was cut, limited or left over in the wakes of a lattice.

use wingbeat_air::AirSettings;
use wingbeat_analysis::{KeptWake, kept_wake};
use wingbeat_flight::FlightSetup;

use crate::summary::numbers::Summary;
use crate::summary::statistics::limits_edges_alone;
use crate::summary::verdict::Warnings;

/// Part of the ways of wake nodes from which on their limits are felt. Of a fruit fly in hover 31, 7, 2 and 0.7 % were
/// limited where a residual of 15, 9, 6 and 2.4 % of the impulse was left (1.6 % without), and lift was 6, 3 and 1 % lower
/// with the last three.
const LIMITED: f64 = 0.01;

/// What was cut, limited or left over in the wakes.
pub(super) fn warnings(
    setup: &FlightSetup,
    lattice: &AirSettings,
    summary: &Summary,
    list: &mut Warnings,
) {
    if summary.wake_particles > 0 {
        list.note(format!(
            "Part of the wake is vortex particles ({} at the end); their radius is an input, not a result.",
            summary.wake_particles
        ));
    }
    cut(setup, summary, list);
    limited(setup, lattice, summary, list);
    let held = held_off(summary);
    if held > 0 {
        list.note(format!(
            "{held} times a wake node ran close to a surface and was held off it."
        ));
    }
    if summary.net_flux_residual_m_s > 0.0 {
        list.note(format!(
            "Net flux through closed body surfaces: a normal velocity of at most {:.1e} m/s is left (their influence matrix has a null space of one dimension).",
            summary.net_flux_residual_m_s
        ));
    }
}

/// How often wake nodes were held off surfaces.
pub(super) fn held_off(summary: &Summary) -> usize {
    summary.regularised.saturating_sub(summary.limited)
}

/// What is kept of wakes of which part was dropped; none of whole ones.
pub(super) fn cut_wake(setup: &FlightSetup, summary: &Summary) -> Option<KeptWake> {
    kept_wake(setup).filter(|kept| summary.time_s > kept.time)
}

/// Wakes that were cut.
fn cut(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    let Some(kept) = cut_wake(setup, summary) else {
        return;
    };
    let dropped = summary.impulse_budget.as_ref().map(|b| {
        let all = b.created_newton_s + b.moved_newton_s;
        (b.cut_newton_s / all).abs()
    });
    let dropped = dropped.filter(|part| part.is_finite());
    let dropped = dropped.map_or(String::new(), |part| {
        let share = match part {
            p if p < 1.0 => format!("{:.0} % of", 100.0 * p),
            p => format!("{p:.1} times"),
        };
        format!(
            "; what was dropped had {share} the impulse along gravity that the vorticity has gained"
        )
    });
    let text = format!("Not the whole wake was kept: {}{dropped}", kept.said);
    match kept.is_short {
        None => list.note(format!("{text}.")),
        Some(felt) => list.limit(format!("{text}. Here {felt}.")),
    }
}

/// Ways and strengths that were limited, and leading edges that found no solution.
fn limited(setup: &FlightSetup, lattice: &AirSettings, summary: &Summary, list: &mut Warnings) {
    let (count, part) = (summary.limited, summary.limited_part);
    if count == 0 {
        return;
    }
    let nodes = lattice.max_displacement.map(|most| {
        format!("a wake node was to go farther in a step than air.max_displacement_m = {most:.1e} and was not let")
    });
    let particles = (lattice.particles.is_some())
        .then(|| "the strength of a particle was to change by more than half in a step".to_owned());
    let edges = (lattice.solves_suction()).then(|| {
        "a leading edge had more suction than it holds and no solution of all, and shed what it had too much"
            .to_owned()
    });
    let what: Vec<String> = [nodes, particles, edges].into_iter().flatten().collect();
    let of_strips = match limits_edges_alone(setup) {
        true => format!(
            " ({} % of all strips and steps; 10 to 50 % are usual where wings flap, and a finer mesh or smaller steps have fewer: a plunging foil with 60 % had 1.4 % less mean thrust than on a finer mesh with none)",
            part_in_percent(part)
        ),
        false => String::new(),
    };
    let text = format!("{count} times {}{of_strips}.", what.join(", or "));
    match lattice.max_displacement.is_some() && part > LIMITED {
        false => list.note(text),
        true => list.limit(format!(
            "Wakes do not go with the air: {:.0} % of the ways of their nodes were limited. {text} Raise it, or take smaller steps.",
            100.0 * part
        )),
    }
}

/// A part in per cent, of small ones the first digit.
fn part_in_percent(part: f64) -> String {
    let percent = 100.0 * part;
    match percent < 0.95 {
        true => format!("{percent:.1e}")
            .parse::<f64>()
            .map_or(String::new(), |p| p.to_string()),
        false => format!("{percent:.0}"),
    }
}
