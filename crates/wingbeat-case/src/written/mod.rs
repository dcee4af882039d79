//! From a setup made in Rust to the case that gives it: the way of `build`, backwards.
//!
//! Every field is taken apart by its name, so that none is forgotten; what a case has no keys for is refused by
//! its name. Parts that are as in the case the setup began as keep the keys of that case.

mod air;
mod animal;
pub(crate) mod averaged;
pub(crate) mod differences;
pub(crate) mod flight;
mod motion;
mod refusal;
mod structure;
pub(crate) mod trimmed;

use std::fmt::Debug;

use wingbeat_flight::{FlightSetup, TimeGrid};

use crate::error::IoError;
use crate::loaded::LoadedCase;
use crate::raw::{AirCase, Case, CorrectorCase};
use refusal::{Written, no_keys, same};

/// A case whose setup is `setup` to rounding (angles are degrees in cases, moments of inertia those about
/// mass centres): what is flown of it is reproduced by its text to the last bit. `like` is the case that
/// the setup began as.
///
/// # Errors
/// [`IoError::NoKeys`] for what a case cannot say; otherwise as [`LoadedCase::from_text`].
pub fn case_of(setup: &FlightSetup, like: Option<&LoadedCase>) -> Result<LoadedCase, IoError> {
    LoadedCase::new(case(setup, like)?)
}

fn case(setup: &FlightSetup, like: Option<&LoadedCase>) -> Written<Case> {
    let FlightSetup {
        name,
        animal,
        gravity,
        air,
        mode,
        joints: _, // see `lists`
        formulation,
        integrator,
        time,
        corrector,
        loads: _,
        springs: _,
        feedback: _,
    } = setup;
    let old = like.map(|case| &case.setup);
    let mut case = like.map_or_else(Case::default, LoadedCase::effective);
    case.name = Some(name.clone());
    case.gravity_m_s2 = gravity.to_array();

    let same_animal = old.is_some_and(|old| same(&old.animal, animal));
    if !same_animal {
        animal::write(&mut case, animal, old)?;
    }
    if !(same_animal && old.is_some_and(|old| same(&old.air, air))) {
        case.air = AirCase {
            buoyancy: case.air.buoyancy, // of the loads, see `lists`
            ..air::write(air)?
        };
        animal::join(&mut case, animal, air);
        // Parts are written as meshes, whose volumes are not those of round bodies.
        let drag = case.air.blade.body_drag.as_mut();
        if let Some(drag) = drag.filter(|d| d.centre_m.is_none() && !same_animal) {
            drag.centre_m = Some(animal.body_centre().to_array());
        }
    }
    let same_time = old.is_some_and(|old| old.time == *time);
    if !(same_animal && same_time) {
        case.time = flight::time(time, &mut case.motion, animal)?;
    }
    // Holds are counted in wingbeats.
    let beat = |time: &TimeGrid| (time.step, time.period);
    let same_beat = old.is_some_and(|old| beat(&old.time) == beat(time));
    if !(same_beat && old.is_some_and(|old| same(&old.mode, mode))) {
        case.flight = flight::mode(mode, time)?;
    }
    case.dynamics = flight::dynamics(*formulation, *integrator, case.dynamics.wings);
    case.corrector = CorrectorCase {
        tolerance: corrector.tolerance,
        max_passes: corrector.max_passes,
        relaxation: corrector.relaxation,
    };
    if !flight::iterates(*integrator) {
        case.corrector = CorrectorCase::default(); // without effect
    }

    lists(&mut case, setup, old)?;
    Ok(case)
}

/// What keeps the keys of the case or is empty.
fn lists(case: &mut Case, setup: &FlightSetup, old: Option<&FlightSetup>) -> Written<()> {
    if !kept("joints", &setup.joints, old.map(|old| &old.joints[..]))? {
        case.joint.clear();
    }
    if !kept("loads", &setup.loads, old.map(|old| &old.loads[..]))? {
        case.load.clear();
        case.air.buoyancy = false;
    }
    if !kept("springs", &setup.springs, old.map(|old| &old.springs[..]))? {
        case.spring.clear();
    }
    let feedback = setup.feedback.as_slice();
    let before = old.map(|old| old.feedback.as_slice());
    if !kept("feedback", feedback, before)? {
        case.control = None;
    }
    Ok(())
}

/// Whether a part keeps the keys that the case has for it; without them it must be empty.
fn kept<T: Debug>(part: &'static str, new: &[T], old: Option<&[T]>) -> Written<bool> {
    if old.is_some_and(|old| same(old, new)) {
        return Ok(true);
    }
    match new.is_empty() {
        true => Ok(false),
        false => Err(no_keys(
            part,
            "they were made or changed in Rust, and only those of a case are written",
            "give them in the case, or by `Flight::of_case`",
        )),
    }
}
