//! What users ask of a trim, as every program takes it: in words and numbers, with defaults for the rest.

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::steady::{Residuals, TrimProblem, TrimSettings};
use crate::unknown::{Bound, Unknown};

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
    pub fn problem(self, setup: &FlightSetup) -> TrimProblem {
        let start = setup.angles_at_release();
        let mut problem = TrimProblem::straight(self.velocity, start.x);
        problem.turn_rate = self.turn_rate;
        let lateral = Residuals::of(&problem) == Residuals::All;
        match self.unknowns {
            Some(named) => problem.unknowns = named,
            None if lateral => problem.unknowns.extend(LATERAL),
            None => {}
        }
        if problem.unknowns.contains(&Unknown::BodyRoll) {
            problem.body_roll = start.z;
        }
        problem.bounds = self.bounds;
        let default = TrimSettings::default();
        problem.settings.steps = self.steps.unwrap_or(default.steps);
        problem
    }
}
