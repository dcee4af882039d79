//! Whether a problem of steady flight can be posed and is symmetric where it has to be.

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::beat::glide::glides;
use crate::trim::problem::TrimProblem;
use crate::trim::residuals::Residuals;
use crate::trim::unknown::{SPEED_OF_SOUND, check_unknowns};

/// Steps per wingbeat at least and at most: in fewer the loads of a beat are off by more than a trim is, and with the
/// most a method of order four is at the last bits.
pub const TRIM_STEPS: [usize; 2] = [20, 2_000];

/// How many times more than at its end right and left may part by rounding where a search begins, in flight
/// that is not steady.
pub(crate) const AT_START: f64 = 10.0;

/// An error if right and left part by more than `rounding` where only the plane of symmetry was asked.
pub(crate) fn check_symmetric(lateral: f64, rounding: f64) -> Result<(), AnalysisError> {
    match lateral <= rounding {
        true => Ok(()),
        false => Err(AnalysisError::Asymmetric {
            lateral,
            remedy: "name six unknowns, three of them lateral, e.g. body_pitch stroke_amplitude stroke_offset body_roll stroke_amplitude_difference stroke_plane_difference, of a glider body_pitch forward climb body_roll feathering_offset_difference deviation_offset_difference; or make right and left wings alike and let wind and gravity lie in the plane of symmetry, n1 and n3",
        }),
    }
}

/// An error if the problem cannot be posed for `setup`.
pub(crate) fn check(setup: &FlightSetup, problem: &TrimProblem) -> Result<(), AnalysisError> {
    if setup.gravity == DVec3::ZERO {
        return Err(AnalysisError::not_covered(
            "there is no gravity (gravity_m_s2), and a trim balances the weight",
            "leave gravity_m_s2 out, or give the animal a weight to carry",
        ));
    }
    check_upright(setup.gravity)?;
    check_numbers(setup, problem)?;
    let all = problem.with_given(&[]).0;
    check_unknowns(setup, &all)?;
    let (residuals, named) = (Residuals::of(problem), problem.unknowns.len());
    let needed = residuals.controls();
    if named < needed {
        let which = match residuals {
            Residuals::Symmetric => "straight flight",
            Residuals::All => "flight with a turn, a sideslip or lateral unknowns",
        };
        return Err(AnalysisError::not_covered(
            format!("{which} determines {needed} unknowns, and {named} are named"),
            match glides(setup) {
                true => {
                    "name as many: three of them lateral (body_roll, feathering_offset_difference, deviation_offset_difference) where there are six"
                }
                false => {
                    "name as many: three of them lateral (body_roll, stroke_amplitude_difference, ...) where there are six"
                }
            },
        ));
    }
    if let Some(k) = (1..all.len()).find(|&k| all[..k].contains(&all[k])) {
        return Err(AnalysisError::not_covered(
            format!("the unknown {} is named twice", all[k].name()),
            "name unknowns that differ",
        ));
    }
    match problem.turn_rate {
        0.0 => Ok(()),
        _ => check_turn(setup),
    }
}

/// An error if gravity points more than 45 degrees off n3: forward, right and up are those of n1, n2 and -n3.
fn check_upright(gravity: DVec3) -> Result<(), AnalysisError> {
    if gravity.z > gravity.truncate().length() {
        return Ok(());
    }
    let [x, y, z] = gravity.to_array();
    let off = gravity.angle_between(DVec3::Z).to_degrees();
    Err(AnalysisError::not_covered(
        format!(
            "gravity points {off:.0} degrees off n3 (gravity_m_s2 = [{x}, {y}, {z}]), and of a trim forward is n1, right n2 and up -n3"
        ),
        "take inertial axes of which n3 points down: gravity_m_s2 = [0, 0, 9.81]; at most 45 degrees off are allowed",
    ))
}

/// An error if speeds, turn or steps are out of range.
fn check_numbers(setup: &FlightSetup, problem: &TrimProblem) -> Result<(), AnalysisError> {
    let speeds = problem.velocity.to_array();
    if let Some(speed) = speeds
        .iter()
        .find(|v| v.is_nan() || v.abs() >= SPEED_OF_SOUND)
    {
        return Err(AnalysisError::not_covered(
            format!("{speed:?} m/s is no speed below that of sound ({SPEED_OF_SOUND} m/s)"),
            "the air is incompressible: choose a lower speed",
        ));
    }
    if !problem.turn_rate.is_finite() {
        return Err(AnalysisError::not_covered(
            format!("a turn by {:?} rad/s", problem.turn_rate),
            "give a finite number",
        ));
    }
    // Of more than half a turn in a wingbeat nobody can tell which way it went round.
    let rate = problem.turn_rate;
    let turned = rate * setup.time.period.unwrap_or(0.0);
    if turned.abs() > std::f64::consts::PI {
        return Err(AnalysisError::not_covered(
            format!(
                "a turn by {:.3} deg/s is {:.3} whole turns in a wingbeat",
                rate.to_degrees(),
                turned.abs() / std::f64::consts::TAU
            ),
            "a steady turn has at most half a turn in a wingbeat: choose a lower turn rate",
        ));
    }
    let ([least, most], steps) = (TRIM_STEPS, problem.settings.steps);
    match (least..=most).contains(&steps) {
        true => Ok(()),
        false => Err(AnalysisError::not_covered(
            format!("a trim in {steps} steps per wingbeat"),
            "take 20 to 2000; 100 is the default",
        )),
    }
}

/// The same where no more may be named than is determined.
pub(crate) fn check_determined(
    setup: &FlightSetup,
    problem: &TrimProblem,
) -> Result<(), AnalysisError> {
    check(setup, problem)?;
    let (named, needed) = (problem.unknowns.len(), Residuals::of(problem).controls());
    match named > needed {
        false => Ok(()),
        true => Err(AnalysisError::not_covered(
            format!("{named} unknowns are named, and only {needed} are determined here"),
            "name as many; the others can be chosen for least power in one trim in air without memory",
        )),
    }
}

/// An error if what surrounds the flight does not look the same from all headings.
fn check_turn(setup: &FlightSetup) -> Result<(), AnalysisError> {
    let horizontal = |v: DVec3| v.x != 0.0 || v.y != 0.0;
    let refused = |key: &str, v: DVec3, what: &str, remedy: &'static str| {
        let [x, y, z] = v.to_array();
        let why = format!(
            "a steady turn is about the vertical along n3, and {what} ({key} = [{x}, {y}, {z}])"
        );
        Err(AnalysisError::not_covered(why, remedy))
    };
    let gravity = setup.gravity;
    if horizontal(gravity) {
        let remedy = "take inertial axes of which n3 is along gravity: gravity_m_s2 = [0, 0, 9.81]";
        return refused("gravity_m_s2", gravity, "gravity is not along it", remedy);
    }
    match setup.air.stream().filter(|s| horizontal(*s)) {
        None => Ok(()),
        Some(stream) => refused(
            "air.stream_m_s",
            stream,
            "the air streams across it",
            "leave air.stream_m_s out: velocities are relative to the air then",
        ),
    }
}
