//! The stages of a flight: tethered all along, free all along, or held first and then released.

use std::sync::Arc;

use wingbeat_dynamics::{
    Baumgarte, ConfigurationTable, Cycle, EulerForm, Formulation, Mechanism, MirrorSymmetry,
    MomentumForm, QuaternionForm, Stabilization, System,
};

use crate::air::dynamic_pressure::DynamicPressure;
use crate::air::{Air, wing_pairs};
use crate::bodies::{self, WingLaw};
use crate::carried::CarriedAir;
use crate::carried::light::is_light;
use crate::elastic::ElasticWings;
use crate::equations::Equations;
use crate::equations::mirrored::Mirrored;
use crate::equations::tethered::TetheredForm;
use crate::error::FlightError;
use crate::setup::{
    AirModel, BaumgarteChoice, FlightSetup, FormulationChoice, IntegratorChoice, MotionMode,
    PrescribedMotion, StabilizationChoice,
};

/// Passes of a step that are plain where nothing speaks for more.
const PLAIN_PASSES: usize = 12;

/// A part of the flight with the same equations.
#[derive(Debug)]
pub struct Stage {
    /// Step at which it begins.
    pub from_step: usize,
    /// Its equations.
    pub equations: Equations,
}

/// The stages of a setup.
///
/// # Errors
/// Bodies that the dynamics refuse, air that its model refuses.
pub fn stages(setup: &FlightSetup, law: &WingLaw<'_>) -> Result<Vec<Stage>, FlightError> {
    let system = bodies::system_with(setup, law)?;
    let air = AirModel::build(setup, &system)?;
    let elastic = ElasticWings::new(&setup.animal, setup.gravity)?;
    let on_joints = !CarriedAir::new(&system, setup.animal.wings.len()).is_empty();
    let is_light = is_light_as_a_whole(setup, (&system, air.as_ref()))?;
    let beat = setup.animal.wings.iter().any(|w| w.motion.frequency > 0.0);
    let is_driven = beat || setup.joints.iter().any(|j| j.law.is_some());
    let elastic = elastic.carried_by(on_joints, is_light).driven(is_driven);
    let elastic = elastic.in_air(setup.air.jumps());
    let elastic = Arc::new(match setup.air.is_mirrored() {
        true => elastic.mirrored(&wing_pairs(&setup.animal)),
        false => elastic,
    });
    check_integrator(setup, &elastic)?;
    let pressure = Arc::new(DynamicPressure::of(setup));
    let mechanism = Mechanism::of(&system);
    let carried = carried(setup, (&system, is_light), &elastic);
    let moves_by_air = on_joints || is_light;
    let is_carried = !carried.is_empty() || (moves_by_air && !elastic.is_empty());
    let mirror = (moves_by_air && setup.air.is_mirrored()).then(|| mirror(setup, &system));
    let moves_joints = system.speeds() > 0 && !setup.air.keeps_wake();
    let is_light_in_fluid = setup.mass_over_carried_fluid().is_some();
    let at_once = is_carried || moves_joints || is_light_in_fluid;
    let accelerated_from = accelerated_from(setup, at_once);
    let stage = |from_step: usize, core: Box<dyn Formulation>| {
        let is_tethered = core.is_supported();
        let step = setup.time.step;
        let mirror = mirror
            .clone()
            .map(|m| Mirrored::new(m, core.as_ref(), step));
        Stage {
            from_step,
            equations: Equations {
                core,
                air: air.clone(),
                pressure: pressure.clone(),
                elastic: elastic.clone(),
                carried: carried.clone(),
                mechanism: mechanism.clone(),
                applied: setup.loads.clone(),
                springs: setup.springs.clone(),
                mirror,
                step: setup.time.step,
                accelerated_from,
                is_tethered,
            },
        }
    };
    Ok(match &setup.mode {
        MotionMode::Tethered(motion) => vec![stage(0, tethered(setup, system, motion))],
        MotionMode::Free(start) => {
            let free = formulation(setup, system.clone())?;
            if start.held_steps == 0 {
                vec![stage(0, free)]
            } else {
                let held = tethered(setup, system, &start.hold());
                vec![stage(0, held), stage(start.held_steps, free)]
            }
        }
    })
}

/// Pass from which those before speed the next ones up: `at_once` where air is carried along, by light bodies as a
/// difference over steps, too, or springs and
/// dampers of joints may act faster than the steps; else in a wake where plain passes lead nowhere, as where
/// one half of the air is computed and the form does not keep to the mirror: least squares raise what parts the
/// halves by rounding.
fn accelerated_from(setup: &FlightSetup, at_once: bool) -> Option<usize> {
    let parts_halves =
        setup.air.is_mirrored() && matches!(setup.formulation, FormulationChoice::Euler(_));
    match at_once && !parts_halves {
        true => Some(1),
        false => setup.air.keeps_wake().then_some(PLAIN_PASSES + 1),
    }
}

/// The mirror in which the wings are images of each other.
fn mirror(setup: &FlightSetup, system: &System) -> MirrorSymmetry {
    let pairs = wing_pairs(&setup.animal).into_iter();
    let bodies = pairs.map(|pair| pair.map(|wing| wing + 1)).collect();
    MirrorSymmetry::new(system, setup.root_at_start().r.y_axis, bodies)
}

/// Whether the flyer is light as a whole beside the air that its wings carry along.
///
/// # Errors
/// What the air reports at the start.
fn is_light_as_a_whole(
    setup: &FlightSetup,
    (system, air): (&System, &dyn Air),
) -> Result<bool, FlightError> {
    match (&setup.air, &setup.mode) {
        (AirModel::VortexLattice(options), MotionMode::Free(_)) => {
            is_light(setup, system, air, options.mirror)
        }
        _ => Ok(false),
    }
}

/// The wings whose air joins the inertia of the bodies: of a flyer that is light as a whole all, else those on
/// free joints. What bends has its answer to accelerations from the elastic side; where any wing bends, rigid
/// wings on free joints are left to the passes, too.
fn carried(
    setup: &FlightSetup,
    (system, is_light): (&System, bool),
    elastic: &ElasticWings,
) -> CarriedAir {
    let AirModel::VortexLattice(options) = &setup.air else {
        return CarriedAir::default();
    };
    let wings = setup.animal.wings.len();
    let on_joints = CarriedAir::new(system, wings);
    if !elastic.is_empty() {
        return CarriedAir::default();
    }
    let carried = match is_light {
        true => CarriedAir::of_all(wings),
        false => on_joints,
    }
    .in_air(options.lattice.free_stream, options.lattice.wind.clone());
    match options.mirror {
        true => carried.mirrored(&wing_pairs(&setup.animal)),
        false => carried,
    }
}

/// # Errors
/// Elastic wings on free joints, or on a flyer that is light as a whole, by `hamming`.
fn check_integrator(setup: &FlightSetup, elastic: &ElasticWings) -> Result<(), FlightError> {
    let is_hamming = setup.integrator == IntegratorChoice::Hamming;
    match is_hamming && elastic.is_delicate() && !elastic.is_empty() {
        true => Err(FlightError::setup(
            "dynamics.integrator",
            "hamming",
            "elastic wings on free joints, or on a body that weighs little beside the air, vibrate together with what carries them, and by hamming that grows from step to step: take bdf, or leave out [wing.NAME.structure]",
        )),
        false => Ok(()),
    }
}

/// A root that moves like `motion`: inverse dynamics where all joints are prescribed, the
/// quaternion form on a support where some are free.
fn tethered(
    setup: &FlightSetup,
    system: System,
    motion: &PrescribedMotion,
) -> Box<dyn Formulation> {
    let motion = motion.clone();
    if system.speeds() == 0 && system.loops().is_empty() {
        return Box::new(TetheredForm { system, motion });
    }
    let stabilization = match setup.formulation {
        FormulationChoice::Quaternion(choice) => stabilization(choice, setup.time.step),
        _ => Stabilization::Baumgarte(Baumgarte::for_step(setup.time.step)),
    };
    let motion = Arc::new(motion);
    Box::new(QuaternionForm::new(system, stabilization).supported(motion.clone(), motion))
}

fn baumgarte(choice: BaumgarteChoice, step: f64) -> Baumgarte {
    match choice {
        BaumgarteChoice::StepTied(a) => Baumgarte::step_tied(a, step),
        BaumgarteChoice::Fixed { alpha, beta } => Baumgarte { alpha, beta },
    }
}

fn stabilization(choice: StabilizationChoice, step: f64) -> Stabilization {
    match choice {
        StabilizationChoice::None => Stabilization::None,
        StabilizationChoice::Baumgarte(b) => Stabilization::Baumgarte(baumgarte(b, step)),
        StabilizationChoice::Projection => Stabilization::Projection,
    }
}

/// The chosen formulation of `system`.
fn formulation(setup: &FlightSetup, system: System) -> Result<Box<dyn Formulation>, FlightError> {
    Ok(match setup.formulation {
        FormulationChoice::Momentum => Box::new(momentum(setup, system)),
        FormulationChoice::Euler(choice) => {
            Box::new(EulerForm::new(system, baumgarte(choice, setup.time.step)))
        }
        FormulationChoice::Quaternion(choice) => {
            let stabilization = stabilization(choice, setup.time.step);
            Box::new(QuaternionForm::new(system, stabilization))
        }
    })
}

/// How a free flight of `system` repeats itself from step to step, if that is known beforehand: in the momentum
/// form, in air without a wake in space, whose flights are many beats long and cost little else, by a method
/// that keeps to the time grid.
pub fn cycle(setup: &FlightSetup, system: &System) -> Option<Cycle> {
    let known = setup.formulation == FormulationChoice::Momentum
        && matches!(setup.mode, MotionMode::Free(_))
        && !setup.air.keeps_wake()
        && !matches!(setup.integrator, IntegratorChoice::OrderEight { .. });
    known.then(|| system.cycle(setup.time.step)).flatten()
}

/// The momentum form, with configurations from a table where the motion repeats itself in whole steps.
fn momentum(setup: &FlightSetup, system: System) -> MomentumForm {
    let step = setup.time.step;
    let table = cycle(setup, &system).map(|cycle| match setup.integrator {
        IntegratorChoice::RungeKutta => {
            ConfigurationTable::repeating(&system, 0.5 * step, cycle.halved())
        }
        _ => ConfigurationTable::repeating(&system, step, cycle),
    });
    let form = MomentumForm::new(system);
    match table {
        Some(table) => form.tabulated(Arc::new(table)),
        None => form,
    }
}
