//! Trim and Floquet's modes in air that remembers: the vortex lattice.
//!
//! A periodic orbit of body **and** wake has thousands of unknowns. What is done instead: the body
//! is held for some wingbeats with constant velocity and attitude while the wake grows, then
//! released; the free wingbeat that follows is the map of the state. Trim asks that this beat
//! changes nothing but the place (the residuals of [`crate::steady`]). For stability the map is
//! differentiated, and two things can be held fixed:
//!
//! - [`WakeMemory::Given`]: the wake of the trimmed hold; the disturbance is put on the body at
//!   its release (its velocities and attitude jump, the wake does not).
//! - [`WakeMemory::Carried`]: the hold is flown in the disturbed motion already, so the wake is that
//!   of a steadily disturbed flight; only angular velocity, which a hold cannot have, jumps.
//!
//! Neither is the full monodromy of body and wake; the two bracket what the memory does within
//! a wingbeat.

mod modes;
mod trim;

pub use modes::{WakeMemory, wake_floquet, wake_modes, wake_monodromy};
pub use trim::{WakeSettings, WakeTrim, trim_with_wake};

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{FlightSetup, MotionMode, Record, Simulation, StartState};
use wingbeat_math::{DMat3, DQuat};

use crate::AnalysisError;

fn start(setup: &FlightSetup) -> &StartState {
    match &setup.mode {
        MotionMode::Free(start) => start,
        MotionMode::Tethered(_) => unreachable!("trimmed flights are free"),
    }
}

/// Wingbeat of a setup in steps.
fn steps_per_beat(setup: &FlightSetup) -> Result<usize, AnalysisError> {
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

fn rotation(r: &Record) -> DMat3 {
    let [w, x, y, z] = r.root_quaternion;
    DMat3::from_quat(DQuat::from_xyzw(x, y, z, w))
}

/// The motion into which the root is released, from that at the end of the hold.
type Release<'a> = dyn Fn(BodyMotion, &Record) -> BodyMotion + 'a;

/// Records at the release and one wingbeat later; `release` sets the root into another motion
/// then.
fn free_beat(
    setup: &FlightSetup,
    steps: usize,
    release: Option<&Release>,
) -> Result<[Record; 2], AnalysisError> {
    let held = start(setup).held_steps;
    let mut flight = Simulation::new(setup.clone())?;
    while flight.state().step < held {
        if flight.state().step + 1 == held
            && let Some(change) = release
        {
            // The hold is prescribed: what it will be at the release is known beforehand.
            let mut probe = Simulation::resume(setup.clone(), flight.state().clone())?;
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
