//! What users ask of a trim, as every program takes it: in words and numbers, with defaults for the rest.

use wingbeat_flight::{FlightSetup, MotionMode};
use wingbeat_math::DVec3;
use wingbeat_model::Wing;

use crate::AnalysisError;
use crate::beat::glide::glides;
use crate::trim::problem::{TrimProblem, TrimSettings};
use crate::trim::residuals::Residuals;
use crate::trim::tail::tail_wings;
use crate::trim::unknown::{Bound, Unknown, has_drives};

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
    /// What may be chosen. None: body pitch, stroke amplitude and mean stroke angle; where joints drive all wings body
    /// pitch, drive amplitude and mass centre; where the flight turns or slips
    /// sideways body roll and the differences of stroke amplitude and stroke plane besides. Of a flyer in which nothing
    /// beats: body pitch, and speed forward and climb as far as they are not given (0); for those that are, the incidence
    /// of the tail, then the mass centre.
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
            None if glides(setup) => problem.unknowns = of_glide(setup, self.velocity),
            None if are_driven(setup) && !lateral => problem.unknowns = OF_DRIVES.to_vec(),
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
        problem.velocity = first_velocity(setup, &problem)?;
        problem.bounds = self.bounds;
        let default = TrimSettings::default();
        problem.settings.steps = self.steps.unwrap_or(default.steps);
        Ok(problem)
    }
}

/// The unknowns of flyers whose wings are driven through joints.
const OF_DRIVES: [Unknown; 3] = [
    Unknown::BodyPitch,
    Unknown::DriveAmplitude,
    Unknown::MassCentre,
];

/// Whether no wing beats by itself, and actuators of joints do something.
fn are_driven(setup: &FlightSetup) -> bool {
    setup.animal.wings.iter().all(Wing::is_still) && has_drives(setup)
}

/// The unknowns of a glide with the speeds that are `asked` [m/s]; 0 is none.
fn of_glide(setup: &FlightSetup, asked: DVec3) -> Vec<Unknown> {
    let mut all = vec![Unknown::BodyPitch];
    if asked.x == 0.0 {
        all.push(Unknown::Forward);
    }
    if asked.z == 0.0 {
        all.push(Unknown::Climb);
    }
    let spare = [
        tail_wings(setup).ok().map(|_| Unknown::TailIncidence),
        Some(Unknown::MassCentre),
        Some(Unknown::FeatheringOffset),
    ];
    all.extend(spare.into_iter().flatten());
    all.truncate(Residuals::Symmetric.controls());
    all
}

/// Lift coefficient and slope of the glide from which the search for its speed begins where the case has none \[1\].
const FIRST_GLIDE: [f64; 2] = [0.5, 0.1];

/// The velocity from which the search begins, N components [m/s]: what is asked, and of speeds that are unknown, and for
/// which nothing is, that of the release; where that is through no air and nothing beats, a glide by the wings' area.
fn first_velocity(setup: &FlightSetup, problem: &TrimProblem) -> Result<DVec3, AnalysisError> {
    let is_unknown = |u| problem.unknowns.contains(&u);
    let release = match &setup.mode {
        MotionMode::Free(start) => start.velocity,
        MotionMode::Tethered(_) => DVec3::ZERO,
    };
    let mut first = problem.velocity;
    if is_unknown(Unknown::Forward) && first.x == 0.0 {
        first.x = release.x;
    }
    if is_unknown(Unknown::Climb) && first.z == 0.0 {
        first.z = release.z;
    }
    let stream = setup.air.stream().unwrap_or(DVec3::ZERO);
    if !glides(setup) || !is_unknown(Unknown::Forward) || first != stream {
        return Ok(first);
    }
    let reports = setup.animal.wing_reports();
    let area: f64 = reports.iter().map(|r| r.area).sum();
    let [lift, slope] = FIRST_GLIDE;
    let carried = setup.air.density().unwrap_or(0.0) * area * lift;
    if carried <= 0.0 {
        return Err(AnalysisError::not_covered(
            "the search for a glide begins at some speed, and none is known",
            "give about that which is expected: --forward, or flight.velocity_m_s of the case",
        ));
    }
    let weight = setup.animal.mass() * setup.gravity.length();
    let speed = (2.0 * weight / carried).sqrt();
    if is_unknown(Unknown::Climb) {
        first.z += slope * speed;
    }
    first.x += speed;
    Ok(first)
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
            "set flight.roll_deg = 0, or name six unknowns: body_roll starts from it, and without body_roll it is kept (e.g. body_pitch stroke_amplitude stroke_offset body_roll stroke_amplitude_difference stroke_plane_difference, of a glider body_pitch forward climb body_roll feathering_offset_difference deviation_offset_difference)",
        )),
    }
}

/// An angle [rad] in degrees, to four decimals.
fn rounded(angle: f64) -> f64 {
    (1e4 * angle.to_degrees()).round() / 1e4
}
