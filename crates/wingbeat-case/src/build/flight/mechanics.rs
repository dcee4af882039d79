//! `[flight]`, `[dynamics]`, `[[load]]` and `[spring.NAME]`.

use wingbeat_flight::{
    AppliedLoad, BaumgarteChoice, DriftingFourier, FlightSetup, FormulationChoice,
    IntegratorChoice, MotionMode, PointSpring, PrescribedMotion, StabilizationChoice, StartState,
    TimeGrid,
};
use wingbeat_math::{DVec3, EulerSequence, RotationLaw};
use wingbeat_model::{Animal, Start};

use crate::build::fault::Built;
use crate::build::names::body_names;
use crate::build::numbers::vector;
use crate::error::Fault;
use crate::raw::{
    AirModel, AngleOscillation, BaumgarteCase, Case, DynamicsCase, FlightCase, Formulation,
    IntegratorCase, LoadCase, Mode, PathOscillation, StabilisationCase, TetherCase,
};

/// Least |cos theta| with which the Euler form starts (design: it gives up below this).
const MIN_REGULARITY: f64 = 0.05;

/// Free or tethered.
pub(crate) fn mode(case: &Case, time: &TimeGrid) -> MotionMode {
    let flight = &case.flight;
    match flight.mode {
        Mode::Tethered => MotionMode::Tethered(tethered(flight)),
        Mode::Free => MotionMode::Free(free(flight, time)),
    }
}

fn degrees(v: [f64; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::to_radians))
}

fn start_angles(flight: &FlightCase) -> DVec3 {
    degrees([flight.pitch_deg, flight.yaw_deg, flight.roll_deg])
}

fn free(flight: &FlightCase, time: &TimeGrid) -> StartState {
    let held_time = match flight.held_s {
        Some(seconds) => seconds,
        None => flight.held_beats * time.period.unwrap_or(0.0),
    };
    StartState {
        position: vector(flight.position_m),
        angles: start_angles(flight),
        velocity: vector(flight.velocity_m_s),
        angular_velocity: degrees(flight.angular_velocity_deg_s),
        held_steps: (held_time / time.step).round() as usize,
        held_motion: (flight.tether.as_ref()).map(|t| Box::new(on_tether(t, [[0.0; 3]; 3]))),
    }
}

fn tethered(flight: &FlightCase) -> PrescribedMotion {
    let none = TetherCase::default();
    let tether = flight.tether.as_ref().unwrap_or(&none);
    let angles = start_angles(flight).to_array();
    on_tether(tether, [flight.position_m, flight.velocity_m_s, angles])
}

/// Oscillations about a constant velocity from a place \[m\] on, at an attitude \[rad\], from rest on if it is
/// to start smoothly.
fn on_tether(tether: &TetherCase, [p, v, angles]: [[f64; 3]; 3]) -> PrescribedMotion {
    let paths = [&tether.x, &tether.y, &tether.z];
    let turns = [&tether.pitch, &tether.yaw, &tether.roll];
    PrescribedMotion {
        position: std::array::from_fn(|i| path(paths[i].as_ref(), p[i], v[i])),
        angles: std::array::from_fn(|i| turn(turns[i].as_ref(), angles[i])),
        start: (tether.start_s).map_or(Start::Impulsive, |duration| Start::Smooth { duration }),
    }
}

fn path(case: Option<&PathOscillation>, constant: f64, rate: f64) -> DriftingFourier {
    let still = DriftingFourier {
        rate,
        ..DriftingFourier::constant(constant)
    };
    case.map_or(still.clone(), |c| DriftingFourier {
        frequency: c.frequency_hz,
        cosine: c.cosine_m.clone(),
        sine: c.sine_m.clone(),
        ..still
    })
}

fn turn(case: Option<&AngleOscillation>, constant: f64) -> DriftingFourier {
    let radians = |list: &[f64]| list.iter().map(|a| a.to_radians()).collect();
    case.map_or(DriftingFourier::constant(constant), |c| DriftingFourier {
        constant,
        rate: c.rate_deg_s.to_radians(),
        frequency: c.frequency_hz,
        cosine: radians(&c.cosine_deg),
        sine: radians(&c.sine_deg),
    })
}

/// Which equations are integrated.
pub(crate) fn formulation(case: &DynamicsCase) -> FormulationChoice {
    let choice = match case.baumgarte {
        BaumgarteCase::StepFactor(a) => BaumgarteChoice::StepTied(a),
        BaumgarteCase::Fixed {
            alpha_per_s: alpha,
            beta_per_s: beta,
        } => BaumgarteChoice::Fixed { alpha, beta },
    };
    let kept = match case.stabilisation {
        StabilisationCase::Baumgarte => StabilizationChoice::Baumgarte(choice),
        StabilisationCase::Projection => StabilizationChoice::Projection,
        StabilisationCase::None => StabilizationChoice::None,
    };
    match case.formulation.value() {
        Formulation::Momentum => FormulationChoice::Momentum,
        Formulation::Euler => FormulationChoice::Euler(choice),
        Formulation::Quaternion => FormulationChoice::Quaternion(kept),
    }
}

/// By which method.
pub(crate) fn integrator(case: &Case) -> Built<IntegratorChoice> {
    let dynamics = &case.dynamics;
    let choice = match dynamics.integrator.value() {
        IntegratorCase::Hamming => IntegratorChoice::Hamming,
        IntegratorCase::Bdf => IntegratorChoice::Bdf,
        IntegratorCase::Adams => IntegratorChoice::Adams,
        IntegratorCase::RungeKutta => IntegratorChoice::RungeKutta,
        IntegratorCase::OrderEight => IntegratorChoice::OrderEight {
            tolerance: dynamics.tolerance,
        },
    };
    if case.air.model == AirModel::VortexLattice && !choice.carries_wake() {
        return Err(Fault::new(
            "dynamics.integrator",
            "a wake is moved once per step: only hamming and bdf carry it along",
            "hamming or bdf with air.model = \"vortex_lattice\"",
            "remove the key, or set it to \"bdf\"",
        ));
    }
    let projects = dynamics.formulation.value() == Formulation::Quaternion
        && dynamics.stabilisation == StabilisationCase::Projection;
    if projects && !choice.is_one_step() {
        return Err(Fault::new(
            "dynamics.stabilisation",
            "projection changes the newest state, multistep methods use older ones too",
            "baumgarte or none with hamming, bdf and adams",
            "integrator = \"order_eight\" or \"runge_kutta\", or stabilisation = \"baumgarte\"",
        ));
    }
    Ok(choice)
}

/// In the Euler form no body may start near the singularity of its angles.
pub(crate) fn check_attitudes(case: &Case, setup: &FlightSetup) -> Built<()> {
    if !matches!(setup.formulation, FormulationChoice::Euler(_)) {
        return Ok(());
    }
    let angles = start_angles(&case.flight);
    if EulerSequence::BODY_231.regularity(angles) < MIN_REGULARITY {
        return Err(singular("flight.yaw_deg", "yaw of the body"));
    }
    let root = EulerSequence::BODY_231.rotation(angles);
    for wing in &setup.animal.wings {
        let attitude = EulerSequence::WING_132.angles(root * wing.motion.at(0.0).c);
        if EulerSequence::WING_132.regularity(attitude) < MIN_REGULARITY {
            let what = format!(
                "deviation angle of wing `{}` seen from the inertial frame",
                wing.name
            );
            return Err(singular("dynamics.formulation", &what));
        }
    }
    Ok(())
}

fn singular(key: &str, what: &str) -> Fault {
    Fault::new(
        key,
        format!(
            "at the start the {what} is within 3 degrees of +-90, where Euler angles are singular"
        ),
        "attitudes away from the singularity, or dynamics.formulation = \"momentum\"",
        "set dynamics.formulation = \"momentum\", which has no singularity",
    )
}

/// Applied loads: their points are places on the animal and scaled with it, their forces are as given.
pub(crate) fn loads(case: &Case, animal: &Animal) -> Built<Vec<AppliedLoad>> {
    let all = case.load.iter().enumerate();
    all.map(|(k, load)| applied(&format!("load[{k}]"), load, animal, case.animal.scale))
        .collect()
}

/// Index of the body that `key` names.
fn body(key: String, name: &str, animal: &Animal) -> Built<usize> {
    let names = body_names(animal);
    let body = names.iter().position(|n| *n == name);
    body.ok_or_else(|| {
        Fault::new(
            key,
            "there is no such body",
            names.join(", "),
            "use one of these names",
        )
    })
}

/// As [`body`], refused where it is a wing that loads bend: `what` acts on one point of a body.
fn rigid_body(key: String, name: &str, animal: &Animal, what: &str) -> Built<usize> {
    let index = body(key.clone(), name, animal)?;
    match index.checked_sub(1).and_then(|k| animal.wings.get(k)) {
        Some(wing) if wing.structure.is_some() => Err(bends(key, name, what)),
        _ => Ok(index),
    }
}

/// What acts on one point of a wing would act on its frame, and not bend it.
pub(crate) fn bends(key: String, name: &str, what: &str) -> Fault {
    Fault::new(
        key,
        format!(
            "wing `{name}` bends under loads, and {what} on it would act on the frame of its root without bending it"
        ),
        "the central body, segments and wings without `structure`",
        "put it on the body or on a segment that carries the wing; give stores as lumped masses (structure.beam.mass); or remove the structure of the wing",
    )
}

/// Springs between points.
pub(crate) fn springs(case: &Case, animal: &Animal) -> Built<Vec<PointSpring>> {
    let built = case.spring.iter().map(|(name, spring)| {
        let path = format!("spring.{name}");
        let [a, b] = &spring.between;
        if a == b {
            return Err(Fault::new(
                format!("{path}.between"),
                "both ends are on one body",
                "two bodies",
                "remove the spring, or name another body",
            ));
        }
        let key = |k: usize| format!("{path}.between[{k}]");
        Ok(PointSpring {
            name: name.clone(),
            bodies: [
                rigid_body(key(0), a, animal, "a spring")?,
                rigid_body(key(1), b, animal, "a spring")?,
            ],
            points: spring.at_m.map(vector),
            stiffness: spring.stiffness_newton_per_m,
            rest: spring.rest_m,
            damping: spring.damping_newton_s_per_m,
        })
    });
    built.collect()
}

fn applied(path: &str, load: &LoadCase, animal: &Animal, scale: f64) -> Built<AppliedLoad> {
    let body = rigid_body(format!("{path}.on"), &load.on, animal, "a load")?;
    let f = load.frequency_hz;
    let series = |constant: &[f64; 3], cosine: &[[f64; 3]], sine: &[[f64; 3]]| {
        std::array::from_fn(|i| {
            let along = |list: &[[f64; 3]]| list.iter().map(|v| v[i]).collect();
            DriftingFourier::periodic(constant[i], f, [cosine, sine].map(along))
        })
    };
    Ok(AppliedLoad {
        body,
        frame: load.frame,
        point: vector(load.point_m) * scale,
        force: series(
            &load.force_newton,
            &load.force_cosine_newton,
            &load.force_sine_newton,
        ),
        couple: series(
            &load.couple_newton_m,
            &load.couple_cosine_newton_m,
            &load.couple_sine_newton_m,
        ),
    })
}
