//! The free wingbeat after a hold: the map of the state.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{FlightSetup, MotionMode, Record, Simulation, StartState};
use wingbeat_math::{DMat3, DQuat};

use crate::AnalysisError;

/// How a flight that was trimmed starts.
pub(super) fn start(setup: &FlightSetup) -> &StartState {
    match &setup.mode {
        MotionMode::Free(start) => start,
        MotionMode::Tethered(_) => unreachable!("trimmed flights are free"),
    }
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

/// Attitude of the root, root to N.
pub(super) fn rotation(r: &Record) -> DMat3 {
    let [w, x, y, z] = r.root_quaternion;
    DMat3::from_quat(DQuat::from_xyzw(x, y, z, w))
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
