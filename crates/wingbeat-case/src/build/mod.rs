//! From the resolved case to the validated setup, in one place.
//!
//! Every step answers with a [`Fault`] that names the key it is about.

mod air;
mod blade;
mod body;
mod deformation;
mod derivatives;
mod effects;
mod element;
mod flight;
mod joint;
mod lattice;
mod lengths;
mod motion;
mod names;
mod output;
mod refused;
mod segment;
mod size;
mod time;
mod wind;
mod wing;

pub(crate) use effects::check as check_effects;
pub use names::column_name;
pub(crate) use output::output;
pub(crate) use refused::refused;

use serde::Serialize;
use wingbeat_flight::{CorrectorSettings, FlightSetup};
use wingbeat_math::{DMat3, DVec3, MassProperties};
use wingbeat_model::{Animal, ModelError};

use super::raw::{Case, CorrectorCase, WingInertia};
use crate::error::Fault;

type Built<T> = Result<T, Fault>;

/// The setup of a resolved case.
pub(crate) fn setup(case: &Case, name: &str) -> Built<FlightSetup> {
    size::check(case)?;
    let animal = animal(case, name)?;
    let time = time::grid(case)?;
    names::check(&animal)?;
    let joints = joint::build_all(case, &animal)?;
    let setup = FlightSetup {
        name: name.to_owned(),
        gravity: case.gravity_m_s2.into(),
        air: air::model(case, &animal)?,
        mode: flight::mode(case, &time),
        joints,
        formulation: flight::formulation(&case.dynamics),
        integrator: flight::integrator(case)?,
        corrector: corrector(&case.corrector),
        loads: flight::loads(case, &animal)?,
        feedback: None,
        animal,
        time,
    };
    flight::check_attitudes(case, &setup)?;
    if !setup.joints.is_empty() {
        let assembled = wingbeat_flight::check_assembly(&setup);
        assembled.map_err(|e| joint::blame(case, &setup, &e))?;
    }
    Ok(setup)
}

fn animal(case: &Case, name: &str) -> Built<Animal> {
    let body = body::build(&case.body)?;
    let wings = wing::build_all(case)?;
    let mut animal = Animal {
        name: name.to_owned(),
        wings,
        ..body
    };
    segment::split(case, &mut animal)?;
    animal.check().map_err(|e| blame_animal(case, e))?;
    let scale = case.animal.scale;
    let mut animal = animal
        .scaled(scale)
        .map_err(|e| Fault::new("animal.scale", e.to_string(), "a number > 0", ""))?;
    if case.dynamics.wings == WingInertia::Massless {
        for wing in &mut animal.wings {
            wing.mass = wing.mass.scaled(0.0);
        }
    }
    Ok(animal)
}

/// The key of a fault the finished animal shows.
fn blame_animal(case: &Case, error: ModelError) -> Fault {
    match &error {
        ModelError::FarHinge { wing, .. } => Fault::new(
            format!("wing.{}.hinge_m", wing::source_of(case, wing)),
            error.to_string(),
            "a point within half a body length of the body's surface, metres in body axes",
            "check sign and unit: b1 forward, b2 right, b3 down, a millimetre is 1e-3",
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

/// A whole number <= `most` at `key`.
fn at_most(key: &str, value: usize, most: usize, remedy: &str) -> Built<usize> {
    if value <= most {
        return Ok(value);
    }
    Err(Fault::new(
        key,
        "this is too large",
        format!("a whole number <= {most}"),
        remedy,
    ))
}

/// Vector from a list.
fn vector(v: [f64; 3]) -> DVec3 {
    DVec3::from_array(v)
}

/// Published moments of inertia have three digits: the largest of a flat body, which is the sum of the
/// two others, may then exceed it by this part of itself. It is lowered to the sum.
const ROUNDING: f64 = 5e-3;

/// Mass properties given as numbers at `path`: mass, centre, and the inertia about it.
fn given_mass(path: &str, mass: f64, centre: DVec3, inertia: DMat3) -> Built<MassProperties> {
    let given = MassProperties::about_centre(mass, centre, inertia);
    given.within_rounding(ROUNDING).map_err(|e| {
        Fault::new(
            format!("{path}.inertia_about_centre_kg_m2"),
            e.to_string(),
            "moments that some distribution of positive mass has, to three digits",
            "check order (xx, yy, zz, xy, xz, yz), signs and unit",
        )
    })
}

/// Symmetric matrix from xx, yy, zz, xy, xz, yz.
fn symmetric([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> DMat3 {
    DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz])
}

/// A fault of the model traced to the key of the raw table `raw` at `path` it is about.
fn blame(path: &str, raw: &impl Serialize, error: &ModelError) -> Fault {
    let (named, allowed) = match error {
        ModelError::Value { key, allowed, .. } | ModelError::Count { key, allowed, .. } => {
            (key.as_str(), *allowed)
        }
        _ => ("", ""),
    };
    let stem = named.rsplit('.').next().unwrap_or("");
    let stem = stem.split('[').next().unwrap_or("");
    let matching = |key: &&String| {
        let rest = key.strip_prefix(stem);
        !stem.is_empty() && rest.is_some_and(|r| r.is_empty() || r.starts_with('_'))
    };
    let table = toml::Table::try_from(raw).unwrap_or_default();
    let key = match table.keys().find(matching) {
        Some(key) => format!("{path}.{key}"),
        None => path.to_owned(),
    };
    Fault::new(key, error.to_string(), allowed, "change this value")
}
