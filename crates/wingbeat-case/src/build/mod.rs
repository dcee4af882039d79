//! From the resolved case to the validated setup, in one place.
//!
//! Every step answers with a [`Fault`] that names the key it is about.

mod air;
mod animal;
mod checks;
mod fault;
mod flight;
mod joints;
mod names;
mod numbers;
mod program;
pub(crate) mod resolve;

pub(crate) use animal::motion::radians;
pub(crate) use checks::effects::check as check_effects;
pub(crate) use checks::refused::refused;
pub(crate) use flight::output::output;
pub use flight::output::{OutputSettings, SaveSettings};
pub use flight::own_control::OwnControl;
pub(crate) use flight::own_control::own_control;
pub(crate) use joints::mirrored::images as mirrored_joints;
pub(crate) use names::check_characters as check_names;
pub use names::column_name;

use wingbeat_flight::{CorrectorSettings, FlightSetup};
use wingbeat_math::DMat3;
use wingbeat_model::{Animal, ModelError, Wing};

use air::buoyancy;
use animal::{body, segment, wing};
use checks::size;
use fault::Built;
use flight::{control, mechanics, time};
use joints::joint;

use super::raw::{Case, CorrectorCase, WingInertia};
use crate::error::Fault;
use crate::motion::carrier::is_carried;

/// The setup of a resolved case.
pub(crate) fn setup(case: &Case, name: &str) -> Built<FlightSetup> {
    size::check(case)?;
    let mut animal = animal(case, name)?;
    let time = time::grid(case)?;
    names::check(&animal)?;
    let joints = joint::build_all(case, &animal)?;
    wing::adjust(case, &mut animal, &joints).map_err(|e| fault_of_animal(case, e))?;
    let air = air::model::model(case, &animal)?;
    let mut loads = mechanics::loads(case, &animal)?;
    let buoyancy = buoyancy::loads(case, &air, &animal)?;
    loads.extend(buoyancy.iter().cloned());
    let setup = FlightSetup {
        name: name.to_owned(),
        gravity: case.gravity_m_s2.into(),
        air,
        mode: mechanics::mode(case, &time),
        joints,
        formulation: mechanics::formulation(&case.dynamics),
        integrator: mechanics::integrator(case)?,
        corrector: corrector(&case.corrector),
        loads,
        springs: mechanics::springs(case, &animal)?,
        feedback: control::feedback(case, &buoyancy)?,
        animal,
        time,
    };
    mechanics::check_attitudes(case, &setup)?;
    if !setup.joints.is_empty() {
        let assembled = wingbeat_flight::check_assembly(&setup);
        assembled.map_err(|e| joint::fault_of(case, &setup, &e))?;
    }
    Ok(setup)
}

fn animal(case: &Case, name: &str) -> Built<Animal> {
    let body = body::build(&case.body)?;
    names::check_bodies(case)?;
    let wings = wing::build_all(case)?;
    let mut animal = Animal {
        name: name.to_owned(),
        wings,
        ..body
    };
    segment::split(case, &mut animal)?;
    if let Some(shift) = case.body.centre_shift_m {
        animal.body = animal.body.moved(DMat3::IDENTITY, shift.into());
    }
    let is_carried = |wing: &Wing| is_carried(case, &wing.name);
    (animal.check_with(is_carried)).map_err(|e| fault_of_animal(case, e))?;
    let scale = case.animal.scale;
    let mut animal = scaled(&animal, scale, is_carried)?;
    if case.dynamics.wings == WingInertia::Massless {
        if let Some(wing) = animal.wings.iter().find(|w| w.structure.is_some()) {
            return Err(Fault::new(
                "dynamics.wings",
                format!(
                    "wing `{}` is elastic, and what has no mass cannot vibrate",
                    wing.name
                ),
                "massless beside rigid wings",
                "remove it, or the structure of the wings",
            ));
        }
        for wing in &mut animal.wings {
            wing.mass = wing.mass.scaled(0.0);
        }
    }
    Ok(animal)
}

/// The animal, so many times as large; one that was sound before, and is not any more, has numbers that are too
/// large or small.
fn scaled(animal: &Animal, scale: f64, is_carried: impl Fn(&Wing) -> bool) -> Built<Animal> {
    let fault = |e: ModelError| Fault::new("animal.scale", e.to_string(), "a number > 0", "");
    let scaled = animal.scaled(scale).map_err(fault)?;
    let masses = [animal, &scaled].map(Animal::mass);
    match scaled.check_with(is_carried).is_ok()
        && scaled.mass().is_normal() == animal.mass().is_normal()
    {
        true => Ok(scaled),
        false => Err(Fault::new(
            "animal.scale",
            format!(
                "an animal of {:.3e} kg has {:.3e} kg at this scale",
                masses[0], masses[1]
            ),
            "a scale with which masses and inertias stay numbers",
            "lengths are multiplied by it, masses by its cube: 1 leaves the animal as it is",
        )),
    }
}

/// The key of a fault the finished animal shows.
fn fault_of_animal(case: &Case, error: ModelError) -> Fault {
    match &error {
        ModelError::FarHinge { wing, .. } => Fault::new(
            format!("wing.{}.hinge_m", wing::source_of(case, wing)),
            error.to_string(),
            "a point within half the extent of body and segments of their surfaces, metres in body axes",
            "check sign and unit: b1 forward, b2 right, b3 down, a millimetre is 1e-3; where both are right, give the part that carries it, as a slim [body.part.boom] from the body to the hinge of a tail",
        ),
        ModelError::Mass { of, .. } if case.wing.contains_key(of) => Fault::new(
            format!("wing.{of}.inertia_about_centre_kg_m2"),
            error.to_string(),
            "moments that some distribution of positive mass has",
            "check order (xx, yy, zz, xy, xz, yz), signs and the reference point",
        ),
        _ => Fault::new(
            "body",
            error.to_string(),
            "",
            "correct the body of the animal",
        ),
    }
}

fn corrector(case: &CorrectorCase) -> CorrectorSettings {
    CorrectorSettings {
        tolerance: case.tolerance,
        max_passes: case.max_passes,
        relaxation: case.relaxation,
    }
}
