//! What users ask of a trim, as every program takes it: in words and numbers, with defaults for the rest.

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::trim::problem::{TrimProblem, TrimSettings};
use crate::trim::residuals::Residuals;
use crate::trim::unknown::{Bound, Unknown};

/// The unknowns of flight that turns or slips sideways, beside those of straight flight.
const LATERAL: [Unknown; 3] = [
    Unknown::BodyRoll,
    Unknown::StrokeAmplitudeDifference,
    Unknown::StrokePlaneDifference,
];

/// What is asked of a trim; by default hover by the usual unknowns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrimRequest {
    /// Mean velocity in the level frame of the heading: along it, to the right of it, down [m/s].
    pub velocity: DVec3,
    /// Turn of the heading, positive to the right [rad/s].
    pub turn_rate: f64,
    /// What may be chosen. None: body pitch, stroke amplitude and mean stroke angle; where the flight turns or slips
    /// sideways body roll and the differences of stroke amplitude and stroke plane besides.
    pub unknowns: Option<Vec<Unknown>>,
    /// Between what unknowns must lie.
    pub bounds: Vec<Bound>,
    /// Steps per wingbeat, within [`TRIM_STEPS`](crate::TRIM_STEPS); none: those of [`TrimSettings`].
    pub steps: Option<usize>,
}

impl TrimRequest {
    /// The problem for a flight: the search begins at the attitude in which it is released.
    ///
    /// # Errors
    /// A flight that is released in a heading or a roll that steady flight is not asked to have.
    pub fn problem(self, setup: &FlightSetup) -> Result<TrimProblem, AnalysisError> {
        let start = setup.angles_at_release();
        let mut problem = TrimProblem::straight(self.velocity, start.x);
        problem.turn_rate = self.turn_rate;
        let lateral = Residuals::of(&problem) == Residuals::All;
        match self.unknowns {
            Some(named) => problem.unknowns = named,
            None if lateral => problem.unknowns.extend(LATERAL),
            None => {}
        }
        check_heading(start.y)?;
        if !problem.unknowns.contains(&Unknown::BodyRoll) {
            check_roll(&problem, start.z)?;
        }
        if start.z.abs() > ROUNDING {
            problem.body_roll = start.z;
        }
        problem.bounds = self.bounds;
        let default = TrimSettings::default();
        problem.settings.steps = self.steps.unwrap_or(default.steps);
        Ok(problem)
    }
}

/// Angles at the release by rounding, of cases that were trimmed \[rad\].
const ROUNDING: f64 = 1e-6;

/// An error if the flight is released with another heading than along n1, `yaw` \[rad\].
fn check_heading(yaw: f64) -> Result<(), AnalysisError> {
    let off = yaw.sin().hypot(yaw.cos() - 1.0);
    match off <= ROUNDING {
        true => Ok(()),
        false => Err(AnalysisError::not_covered(
            format!(
                "the flight is released with a yaw of {} degrees (flight.yaw_deg), and steady flight heads along n1",
                rounded(yaw)
            ),
            "set flight.yaw_deg = 0 and turn what the flight meets (air.stream_m_s, gravity_m_s2) by as much the other way",
        )),
    }
}

/// An error if the flight is released with a `roll` \[rad\] that symmetric flight does not have.
fn check_roll(problem: &TrimProblem, roll: f64) -> Result<(), AnalysisError> {
    match roll.abs() <= ROUNDING || Residuals::of(problem) == Residuals::All {
        true => Ok(()),
        false => Err(AnalysisError::not_covered(
            format!(
                "the flight is released with a roll of {} degrees (flight.roll_deg), which parts right from left, and the unknowns are those of symmetric flight",
                rounded(roll)
            ),
            "set flight.roll_deg = 0, or name six unknowns: body_roll starts from it, and without body_roll it is kept (e.g. body_pitch stroke_amplitude stroke_offset body_roll stroke_amplitude_difference stroke_plane_difference)",
        )),
    }
}

/// An angle [rad] in degrees, to four decimals.
fn rounded(angle: f64) -> f64 {
    (1e4 * angle.to_degrees()).round() / 1e4
}
