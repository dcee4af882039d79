//! `[control]`.

use std::sync::Arc;

use wingbeat_air::Wind;
use wingbeat_analysis::control::{
    Channels, Design, LawDesign, Limits, ProcessNoise, Sensors, Stiffness, Target, Timing, Weights,
};
use wingbeat_flight::control::MIN_INTERVAL;
use wingbeat_flight::{AppliedLoad, BladeOptions, ControlModel, Feedback};
use wingbeat_math::DVec3;

use crate::build::air::blade;
use crate::build::fault::Built;
use crate::build::flight::route;
use crate::build::numbers::vector;
use crate::build::program::program;
use crate::error::Fault;
use crate::external::controller::ProcessController;
use crate::raw::{
    AirModel, Case, ControlCase, ControllerCase, Mode, SensorsCase, StiffnessCase, TargetCase,
    WeightsCase,
};

/// Where the controller is chosen.
const KEY: &str = "control.controller";

/// Feedback of the case, laid out with this buoyancy; none without, or with `controller = "none"`.
pub(crate) fn feedback(case: &Case, buoyancy: &[AppliedLoad]) -> Built<Option<Feedback>> {
    let Some(control) = &case.control else {
        return Ok(None);
    };
    let controller: Arc<dyn ControlModel> = match control.controller {
        ControllerCase::None => return Ok(None),
        ControllerCase::External => {
            check(case)?;
            Arc::new(external(case, control)?)
        }
        ControllerCase::Regulator => {
            check(case)?;
            let law = LawDesign::Regulator(weights(&control.weights));
            let buoyancy = buoyancy.to_vec();
            Arc::new(Design {
                buoyancy,
                ..design(case, control, law)?
            })
        }
        ControllerCase::Stabiliser => {
            check(case)?;
            let law = LawDesign::Stabiliser(stiffness(&control.stiffness));
            let buoyancy = buoyancy.to_vec();
            Arc::new(Design {
                buoyancy,
                ..design(case, control, law)?
            })
        }
    };
    Ok(Some(Feedback {
        controller,
        interval: interval(case)? / control.looks_per_beat,
        latency: timing(case, control)?.latency,
        lag: lag(case, control),
    }))
}

/// A law about the trimmed flight.
fn design(case: &Case, control: &ControlCase, law: LawDesign) -> Built<Design> {
    Ok(Design {
        law,
        target: match control.hold {
            TargetCase::Trim => Target::Trimmed,
            TargetCase::Start => Target::Begun,
        },
        air: BladeOptions {
            wind: Wind::default(),
            ..blade::options(&case.air, case.animal.scale)?
        },
        buoyancy: vec![],
        velocity: DVec3::new(control.forward_m_s, 0.0, -control.climb_m_s),
        timing: timing(case, control)?,
        every: control.every_beats,
        limits: limits(control),
        sensors: control.sensors.as_ref().map(sensors),
        observer: control.observer.as_ref().map(|o| ProcessNoise {
            velocity: o.velocity,
            rate: o.rate,
        }),
        route: route::build(case, control)?,
    })
}

/// A law in another program.
fn external(case: &Case, control: &ControlCase) -> Built<ProcessController> {
    Ok(ProcessController {
        program: program(
            control.external.as_ref(),
            "control.external",
            "control.controller = \"external\"",
            "docs/control.md",
        )?,
        limits: limits(control),
        every: control.every_beats,
        latency: timing(case, control)?.latency,
        lag: lag(case, control),
        interval: 1.0 / case.motion.frequency_hz.value() / control.looks_per_beat as f64,
        sensors: control.sensors.as_ref().map(sensors),
        route: route::build(case, control)?,
    })
}

fn limits(control: &ControlCase) -> Limits {
    Limits {
        amplitude: control.amplitude_limit,
        angle: control.angle_limit_deg.to_radians(),
    }
}

/// What stands against any feedback.
fn check(case: &Case) -> Built<()> {
    let refused = |key: &str, problem: &str, allowed: &str, remedy: &str| {
        Err(Fault::new(key, problem, allowed, remedy))
    };
    if matches!(case.air.model, AirModel::None | AirModel::Derivatives) {
        return refused(
            KEY,
            "no stroke steers without air, or in air that follows from a table of derivatives",
            "none, or another air.model: vortex_lattice, blade_element, external",
            "set it to \"none\", or change air.model",
        );
    }
    if case.flight.mode == Mode::Tethered {
        return refused(
            KEY,
            "a tethered body is not steered",
            "none, or flight.mode = \"free\"",
            "set it to \"none\", or change flight.mode",
        );
    }
    if case.motion.frequency_hz.value() <= 0.0 || case.wing.is_empty() {
        return refused(
            KEY,
            "a controller steers by the strokes, and no wing beats here",
            "none where nothing beats",
            "give wings and motion.frequency_hz, or remove [control]",
        );
    }
    if case.air.mirror && case.air.model == AirModel::VortexLattice {
        return refused(
            "air.mirror",
            "a controller commands each side by itself, the mirror holds both alike",
            "false with [control]",
            "set it to false: both sides are computed",
        );
    }
    if case.flight.held_beats.fract() != 0.0 {
        return refused(
            "flight.held_beats",
            "a controller looks at the start of wingbeats, so the release must be at one",
            "a whole number with [control]",
            "round it",
        );
    }
    Ok(())
}

/// Time steps in a wingbeat.
pub(crate) fn interval(case: &Case) -> Built<usize> {
    let time = &case.time;
    let steps = match (time.steps_per_beat, time.step_s) {
        (Some(steps), _) => steps as f64,
        (None, step) => 1.0 / (case.motion.frequency_hz.value() * step.unwrap_or(1.0)),
    };
    let whole = steps.round();
    if (steps - whole).abs() <= 1e-9 * steps && whole >= MIN_INTERVAL as f64 {
        return Ok(whole as usize);
    }
    Err(Fault::new(
        "time.step_s",
        format!("a controller looks at the start of wingbeats, and a wingbeat has {steps} steps"),
        format!("a whole number of steps per wingbeat, at least {MIN_INTERVAL}, with [control]"),
        "give time.steps_per_beat in its place",
    ))
}

/// Time constant of the actuators [s].
pub(crate) fn lag(case: &Case, control: &ControlCase) -> f64 {
    control.lag_beats / case.motion.frequency_hz.value()
}

/// When the controller looks, and when it acts.
pub(crate) fn timing(case: &Case, control: &ControlCase) -> Built<Timing> {
    let (steps, parts) = (interval(case)?, control.looks_per_beat);
    if !steps.is_multiple_of(parts) || steps / parts < MIN_INTERVAL {
        return Err(Fault::new(
            "control.looks_per_beat",
            format!("a wingbeat has {steps} time steps, and looks divide them into equal parts"),
            format!(
                "a number that divides {steps}, at most {}",
                steps / MIN_INTERVAL
            ),
            "change it, or time.steps_per_beat",
        ));
    }
    if parts > 1 && control.every_beats > 1 {
        return Err(Fault::new(
            "control.every_beats",
            "a controller that looks several times in a wingbeat looks in every one",
            "1 with control.looks_per_beat above 1",
            "remove one of them",
        ));
    }
    let looks = control.latency_beats * parts as f64;
    let latency = looks.round();
    if (looks - latency).abs() > 1e-9 * looks {
        return Err(Fault::new(
            "control.latency_beats",
            format!("a command begins to act at a look, and looks in a wingbeat are {parts}"),
            format!("a multiple of {}", 1.0 / parts as f64),
            "round it, or change control.looks_per_beat",
        ));
    }
    Ok(Timing {
        parts,
        latency: latency as usize,
        lag: control.lag_beats * parts as f64,
    })
}

fn weights(case: &WeightsCase) -> Weights {
    Weights {
        position: case.position,
        velocity: case.velocity,
        tilt: case.tilt,
        rate: case.rate,
        command: case.command,
        sum: case.sum,
    }
}

fn stiffness(case: &StiffnessCase) -> Stiffness {
    Stiffness {
        pitch: case.pitch,
        lateral: case.lateral,
        altitude: case.altitude,
        drift: case.drift,
        damping: case.damping,
        integral: case.integral,
    }
}

pub(crate) fn sensors(case: &SensorsCase) -> Sensors {
    let degrees = |v: [f64; 3]| vector(v.map(f64::to_radians));
    Sensors {
        seed: case.seed,
        noise: Channels {
            position: case.position_noise_m,
            velocity: case.velocity_noise_m_s,
            tilt: case.tilt_noise_deg.to_radians(),
            rate: case.rate_noise_deg_s.to_radians(),
        },
        bias: Channels {
            position: DVec3::ZERO,
            velocity: vector(case.velocity_bias_m_s),
            tilt: degrees(case.tilt_bias_deg),
            rate: degrees(case.rate_bias_deg_s),
        },
    }
}
