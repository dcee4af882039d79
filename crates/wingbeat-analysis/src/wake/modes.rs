//! Floquet's modes by disturbed flights.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{AirModel, FlightSetup, MotionMode, Record};

use super::differences::{departures, map_between};
use super::free_beat::{
    before_release, disturbance, free_beat, level, released, scales, seen, steps_per_beat,
};
use super::trim::WakeTrim;
use crate::AnalysisError;
use crate::beat::level::Perturbation;
use crate::stability::eigen::eigen;
use crate::stability::modes::ModeSet;

/// What is held fixed when the state of the body is disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WakeMemory {
    /// The wake of the trimmed flight.
    Given,
    /// The disturbed motion during the hold: the wake goes with it.
    Carried,
}

/// The derivative of the free beat by the nine components of [`Perturbation`] at the release, 9 x 9
/// by rows, about the trimmed flight. Velocities in it are those through the air: in a stream it is that of still air.
///
/// # Errors
/// A flight that fails; disturbances that do not reach all nine components.
pub fn wake_monodromy(trim: &WakeTrim, memory: WakeMemory) -> Result<Vec<f64>, AnalysisError> {
    if trim.is_orbit() {
        return Err(AnalysisError::not_covered(
            "this flight is periodic with its elastic wings or wakes of strips, and no wake is given or carried",
            "ask for the modes of body, wings and wakes together: elastic_floquet",
        ));
    }
    let (level, sizes) = (level(&trim.setup), scales(&trim.setup).array());
    let steps = steps_per_beat(&trim.setup)?;
    let setup = both_sides(&trim.setup);
    let held = match memory {
        WakeMemory::Given => Some(before_release(&setup)?),
        WakeMemory::Carried => None,
    };
    let fly = |k: usize, size: f64| {
        let by = disturbance(&trim.setup, &level, &Perturbation::component(k, size));
        let ends = match &held {
            Some(held) => {
                let change = |root: BodyMotion, record: &Record| by.root(&root, record.mass_centre);
                released(held.branch()?, steps, Some(&change))?
            }
            None => {
                let mode = MotionMode::Free(by.start(trim.start()));
                free_beat(
                    &FlightSetup {
                        mode,
                        ..setup.clone()
                    },
                    steps,
                    None,
                )?
            }
        };
        Ok(ends.map(|r| seen(&trim.setup, &level, &r).to_array()))
    };
    map_between(&departures(9, |k| 1e-3 * sizes[k], fly)?, 9)
}

/// The same with both sides computed: lateral disturbances need them.
fn both_sides(setup: &FlightSetup) -> FlightSetup {
    let mut setup = setup.clone();
    if let AirModel::VortexLattice(air) = &mut setup.air {
        air.mirror = false;
    }
    setup
}

/// Floquet's modes of the free beat about the trimmed flight.
///
/// # Errors
/// As [`wake_monodromy`].
pub fn wake_floquet(trim: &WakeTrim, memory: WakeMemory) -> Result<ModeSet, AnalysisError> {
    wake_modes(trim, &wake_monodromy(trim, memory)?)
}

/// The same of a derivative that is known, [`wake_monodromy`].
///
/// # Errors
/// Numbers that are not finite.
pub fn wake_modes(trim: &WakeTrim, monodromy: &[f64]) -> Result<ModeSet, AnalysisError> {
    let pairs = eigen(monodromy, 9)?;
    Ok(ModeSet::of_multipliers(pairs, &scales(&trim.setup), &[]))
}
