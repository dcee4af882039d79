//! What a flight refuses when it is built or flown, at the key of the case it is about.

use wingbeat_air::AirError;
use wingbeat_dynamics::DynamicsError;
use wingbeat_flight::{FlightError, FlightSetup};

use crate::build::air::lattice;
use crate::build::fault::extreme_key;
use crate::build::joints::joint;
use crate::error::Fault;
use crate::raw::{Case, ControlCase, ControllerCase, WingCase};

/// The error of a flight of `setup`, which `case` made, as a fault of the case.
pub(crate) fn refused(case: &Case, setup: &FlightSetup, error: &FlightError) -> Fault {
    if is_not_finite(error)
        && let Some(key) = extreme_key(case)
    {
        let problem = format!("with it numbers of the flight go beyond all bounds: {error}");
        let allowed = "sizes, speeds, loads and rates that some flyer has";
        return Fault::new(key, problem, allowed, "check its unit and its power of ten");
    }
    if let FlightError::Dynamics(e) = error {
        return joint::fault_of(case, setup, e);
    }
    let (key, remedy) = key_and_remedy(case, setup, error);
    // Key and value stand before the message already.
    let problem = match error {
        FlightError::Setup { problem, .. } => problem.to_string(),
        FlightError::Air(AirError::Singular { .. }) => {
            let mut wings = setup.coincident_wings();
            wings.extend(setup.coincident_at_start());
            match wings.first() {
                Some(said) => format!("{error}; {said}"),
                None => error.to_string(),
            }
        }
        other => other.to_string(),
    };
    Fault::new(key, problem, "", remedy)
}

/// The key that an error is about, and what to do there.
fn key_and_remedy(case: &Case, setup: &FlightSetup, error: &FlightError) -> (String, &'static str) {
    match error {
        FlightError::Air(AirError::Singular { .. }) if has_wide_cores(setup) => {
            ("air.bound_core".to_owned(), WIDE_CORES)
        }
        FlightError::Air(e) => of_lattice(e),
        FlightError::Asymmetric { .. } => (
            "air.mirror".to_owned(),
            "set it to false: both sides are computed",
        ),
        FlightError::Diverged { .. } => (
            "time.steps_per_beat".to_owned(),
            "the message says what to take",
        ),
        FlightError::JointGrows { joint, .. } => {
            (joint::key_of(case, joint), "the message says what to take")
        }
        FlightError::Blade(_) => ("air.blade".to_owned(), "change this number"),
        FlightError::External(_) => (
            "air.external.command".to_owned(),
            "run the program by itself; docs/external-air.md says what it is asked",
        ),
        FlightError::Control { .. } => of_control(case),
        FlightError::Folded { wing, elastic, .. } => (
            of_wing(
                case,
                wing,
                if *elastic { "structure" } else { "deformation" },
            ),
            match elastic {
                true => "change the structure, or time.steps_per_beat",
                false => "give a shape whose panels keep their sides apart, lengths in metres",
            },
        ),
        FlightError::RootsApart { wings, .. } => (
            format!("wing.{}.joined", wings[1]),
            "bring the roots together, or do not join them",
        ),
        FlightError::OffPlane { wing, .. } => (
            of_wing(case, wing, "structure"),
            "the message says what to take",
        ),
        FlightError::Setup { key: "control", .. } => (
            "control.controller".to_owned(),
            "change what the message names, or fly without: control.controller = \"none\"",
        ),
        FlightError::Setup {
            key: key @ "air.mirror",
            ..
        } => (
            (*key).to_owned(),
            "set it to false: both sides are computed",
        ),
        FlightError::Setup { key, .. } => (of_setup(key).to_owned(), "change this key"),
        _ => (String::new(), ""),
    }
}

/// What to do about cores that are wider than panels.
const WIDE_CORES: &str = "give it a tenth of the foremost panels or less, in chords (radius_chords), or take fewer panels; animal.scale makes the animal smaller and leaves all lengths of [air] as they are";

/// Whether cores of the wings' own filaments are wider than their foremost panels.
fn has_wide_cores(setup: &FlightSetup) -> bool {
    setup.bound_core_width().is_some_and(|width| width > 1.0)
}

/// The key of a wing, or that of the wing of which it is the mirror image.
fn of_wing(case: &Case, wing: &str, key: &str) -> String {
    let has = |w: &WingCase| match key {
        "structure" => w.structure.as_ref().is_some_and(|s| !s.rigid),
        _ => w.deformation.is_some(),
    };
    let own = case.wing.get(wing).filter(|w| has(w)).map(|_| wing);
    let other = || case.wing.iter().find(|(_, w)| has(w));
    let name = own.or_else(|| other().map(|(name, _)| &name[..]));
    format!("wing.{}.{key}", name.unwrap_or(wing))
}

fn of_control(case: &Case) -> (String, &'static str) {
    let external = |control: &ControlCase| control.controller == ControllerCase::External;
    match case.control.as_ref().is_some_and(external) {
        true => (
            "control.external.command".to_owned(),
            "correct the program, or name another",
        ),
        false => ("control.controller".to_owned(), ""),
    }
}

/// Whether the flight ended at a number that is none.
fn is_not_finite(error: &FlightError) -> bool {
    matches!(
        error,
        FlightError::Dynamics(DynamicsError::NotFinite { .. })
            | FlightError::Air(
                AirError::SurfaceNotFinite { .. }
                    | AirError::PanelNotFinite { .. }
                    | AirError::WakeNotFinite { .. }
                    | AirError::ParticleNotFinite { .. }
            )
    )
}

fn of_lattice(error: &AirError) -> (String, &'static str) {
    match error {
        AirError::Setting { key, .. } => (lattice::key_of(key).to_owned(), "change this key"),
        AirError::Asymmetric { .. } => (
            "air.mirror".to_owned(),
            "set it to false: both sides are computed; wings on joints that begin alike come apart by rounding where springs are stiffer than steps resolve (joint.NAME.element)",
        ),
        AirError::MirrorPairs { .. } | AirError::AsymmetricAir { .. } => (
            "air.mirror".to_owned(),
            "set it to false: both sides are computed",
        ),
        AirError::ThroughPlane { .. } => (
            "air.ground".to_owned(),
            "lower the ground, start higher, or leave the key out",
        ),
        AirError::WindThroughPlane { .. } => (
            "air.ground".to_owned(),
            "turn the plane or the wind, or leave the key out",
        ),
        AirError::Empty => (
            "air.model".to_owned(),
            "add a wing, set air.body = true, or fly without air",
        ),
        _ => ("air".to_owned(), ""),
    }
}

/// The key of a case for a key of the setup.
fn of_setup(key: &str) -> &str {
    match key {
        "time.step" => "time.step_s",
        "time.period" => "motion.frequency_hz",
        "flight.start" => "flight",
        "flight.held_motion" => "flight.tether",
        "load.body" => "load",
        "spring.between" | "spring.stiffness" | "spring.rest" | "spring.damping" => "spring",
        key => key,
    }
}
