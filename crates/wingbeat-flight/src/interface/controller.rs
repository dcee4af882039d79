//! A controller in the loop of the flight: what it sees, what it answers, and where it steers to.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::Wing;
use wingbeat_model::motion::Adjustment;

use crate::error::RESUME_AS_SAVED;
use crate::interface::air_probe::AirProbe;

/// What a controller sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Number of this look, from 0.
    pub look: usize,
    /// Time since the release [s].
    pub time: f64,
    /// Motion of the root body.
    pub root: BodyMotion,
    /// Mass centre of the whole, N components [m].
    pub centre: DVec3,
    /// Velocity of the mass centre, N components [m/s].
    pub velocity: DVec3,
}

/// Where the mass centre of a flyer is to be, and where the flyer is to head.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aim {
    /// Place of the mass centre, N components [m].
    pub position: DVec3,
    /// Its velocity, N components [m/s].
    pub velocity: DVec3,
    /// Heading: the angle about n3 from n1 \[rad\].
    pub heading: f64,
    /// Its rate [rad/s].
    pub heading_rate: f64,
}

/// A controller: from what is sensed to one adjustment per wing.
pub trait Controller: Send {
    /// Adjustments of the wings, in the animal's order, on top of the motion of the case. Changes of
    /// frequency are not possible in flight.
    ///
    /// # Errors
    /// Why it has none; the flight ends with it.
    fn command(&mut self, sensed: &Sensed) -> Result<Vec<Adjustment>, String>;

    /// Whether it is given the air before each look.
    fn feels_air(&self) -> bool {
        false
    }

    /// The air at the look that follows; none where it is no vortex lattice.
    fn feel(&mut self, _air: Option<AirProbe>) {}

    /// Where it steers to at `time` [s] since the release; none before its first look, or if it does not know.
    fn aim(&self, _time: f64) -> Option<Aim> {
        None
    }

    /// Attitude R_NB of the root that it holds at its look number `look`, `time` [s] since the release; none where
    /// that follows from the attitude at the release, or if it does not know.
    fn attitude(&self, _look: usize, _time: f64) -> Option<DMat3> {
        None
    }

    /// Whether its newest command stands at a limit, beyond which it would go.
    fn is_limited(&self) -> bool {
        false
    }

    /// Everything it remembers, for a flight that is resumed.
    fn memory(&self) -> Vec<f64> {
        vec![]
    }

    /// Goes on from what it remembered.
    ///
    /// # Errors
    /// Why this cannot be its memory.
    fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        fits(memory, 0)
    }
}

/// Whether a memory has as many numbers as it must have.
///
/// # Errors
/// How many it has.
pub fn fits(memory: &[f64], numbers: usize) -> Result<(), String> {
    match memory.len() == numbers {
        true => Ok(()),
        false => Err(format!(
            "the controller remembers {numbers} numbers, and {} were saved; {RESUME_AS_SAVED}",
            memory.len()
        )),
    }
}

/// Refuses a command of which a part can have no effect on its wing: of an angle that is constant there is neither
/// swing nor lead.
///
/// # Errors
/// The wing, the part and the reason.
pub fn check_heeded(wings: &[Wing], command: &[Adjustment]) -> Result<(), String> {
    let mut wings = wings.iter().zip(command);
    match wings.find_map(|(wing, by)| Some((wing, wing.motion.idle(by).next()?))) {
        None => Ok(()),
        Some((wing, idle)) => Err(unheeded(&wing.name, idle)),
    }
}

/// One command for all wings: each has of it what has an effect there; those that are not `adjusted`
/// ([`FlightSetup::is_adjusted`](crate::FlightSetup::is_adjusted)) have the frequency alone.
///
/// # Errors
/// As [`check_heeded`], for a part that has an effect on no wing.
pub fn for_all(
    wings: &[Wing],
    adjusted: &[bool],
    by: &Adjustment,
) -> Result<Vec<Adjustment>, String> {
    let own = |(wing, is_adjusted): (&Wing, &bool)| match is_adjusted {
        true => wing.motion.heeded(by),
        false => by.on_wing(),
    };
    let heeded: Vec<_> = wings.iter().zip(adjusted).map(own).collect();
    let parts = by.numbers().into_iter().enumerate();
    let mut lost =
        parts.filter(|(k, (_, x))| *x != 0.0 && heeded.iter().all(|a| a.numbers()[*k].1 == 0.0));
    match (lost.next(), wings.first()) {
        (Some((_, idle)), Some(wing)) => Err(unheeded(&wing.name, idle)),
        _ => Ok(heeded),
    }
}

fn unheeded(wing: &str, (part, x): (&str, f64)) -> String {
    let angle = match part.starts_with("stroke") {
        true => "stroke",
        false => "feathering",
    };
    format!(
        "{part} = {x} has no effect on wing `{wing}`: its {angle} angle is constant in the motion of the case; leave it at 0"
    )
}
