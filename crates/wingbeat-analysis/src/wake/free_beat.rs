//! The free wingbeat after a hold: the map of the state.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{FlightSetup, MotionMode, Record, Simulation, StartState};
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::beat::level::{Level, Perturbation};
use crate::stability::disturbance::Disturbance;
use crate::stability::modes::Scales;

/// How a flight that was trimmed starts.
pub(super) fn start(setup: &FlightSetup) -> &StartState {
    match &setup.mode {
        MotionMode::Free(start) => start,
        MotionMode::Tethered(_) => unreachable!("trimmed flights are free"),
    }
}

/// The level frame of its attitude then.
pub(super) fn level(setup: &FlightSetup) -> Level {
    Level::new(start(setup).rotation(), setup.gravity)
}

/// The natural sizes of its perturbations.
pub(super) fn scales(setup: &FlightSetup) -> Scales {
    let period = setup.time.period.unwrap_or(1.0);
    Scales::new(setup.animal.wing_length(), period)
}

/// Wingbeat of a setup in steps.
pub(super) fn steps_per_beat(setup: &FlightSetup) -> Result<usize, AnalysisError> {
    let period = setup.time.period.unwrap_or(0.0);
    let steps = (period / setup.time.step).round();
    let fits = steps >= 4.0 && (steps * setup.time.step / period - 1.0).abs() < 1e-9;
    if fits {
        return Ok(steps as usize);
    }
    Err(AnalysisError::not_covered(
        "a wingbeat is not a whole number of steps",
        "give time.steps_per_beat",
    ))
}

/// What the flyer of `setup` looks like from `level`, its velocity that through the air.
pub(super) fn seen(setup: &FlightSetup, level: &Level, r: &Record) -> Perturbation {
    let velocity = r.momentum / setup.animal.mass() - stream(setup);
    Perturbation::seen(level, r.root_rotation(), velocity, r.root_angular_velocity)
}

/// Velocity of the undisturbed air, N components [m/s].
fn stream(setup: &FlightSetup) -> DVec3 {
    setup.air.stream().unwrap_or_default()
}

/// The trimmed flight of `setup` disturbed by `by`, its velocity that through the air.
pub(super) fn disturbance(setup: &FlightSetup, level: &Level, by: &Perturbation) -> Disturbance {
    Disturbance::new(level, by, stream(setup))
}

/// The motion into which the root is released, from that at the end of the hold.
pub(super) type Release<'a> = dyn Fn(BodyMotion, &Record) -> BodyMotion + 'a;

/// Records at the release and one wingbeat later; `release` sets the root into another motion
/// then.
pub(super) fn free_beat(
    setup: &FlightSetup,
    steps: usize,
    release: Option<&Release>,
) -> Result<[Record; 2], AnalysisError> {
    released(before_release(setup)?, steps, release)
}

/// The flight of `setup` as it is one step before the release; at its start where nothing is held.
pub(super) fn before_release(setup: &FlightSetup) -> Result<Simulation, AnalysisError> {
    let held = start(setup).held_steps;
    let mut flight = Simulation::new(setup.clone())?;
    while flight.state().step + 1 < held {
        flight.step()?;
    }
    Ok(flight)
}

/// As [`free_beat`], from [`before_release`] on.
pub(super) fn released(
    mut flight: Simulation,
    steps: usize,
    release: Option<&Release>,
) -> Result<[Record; 2], AnalysisError> {
    if flight.state().step < start(flight.setup()).held_steps {
        if let Some(change) = release {
            // The hold is prescribed: what it will be at the release is known beforehand.
            let mut probe = flight.branch()?;
            probe.step()?;
            let root = change(probe.root(), probe.record());
            flight.release_into(root);
        }
        flight.step()?;
    }
    let first = flight.record().clone();
    for _ in 0..steps {
        flight.step()?;
    }
    Ok([first, flight.record().clone()])
}
