//! `[time]`, `[flight]` and `[dynamics]`.

use wingbeat_flight::{
    BaumgarteChoice, DriftingFourier, FormulationChoice, IntegratorChoice, MotionMode,
    PrescribedMotion, StabilizationChoice, StartState, TimeGrid,
};
use wingbeat_math::DVec3;
use wingbeat_model::{Animal, Start};

use super::refusal::{Written, no_keys};
use crate::raw::{
    AngleOscillation, BaumgarteCase, DynamicsCase, FlightCase, Formulation, IntegratorCase, Mode,
    MotionCase, PathOscillation, StabilisationCase, TetherCase, TimeCase, WingInertia,
};

/// The time grid in seconds; its period is that of the wings.
pub(super) fn time(time: &TimeGrid, motion: &mut MotionCase, animal: &Animal) -> Written<TimeCase> {
    let TimeGrid {
        step,
        steps,
        period,
    } = *time;
    if animal.wings.is_empty() {
        motion.frequency_hz = period.map_or(0.0, f64::recip).into();
    }
    let frequency = motion.frequency_hz.value();
    if period != (frequency > 0.0).then(|| 1.0 / frequency) {
        let problem = format!("the period {period:?} s is not that of wings at {frequency} Hz");
        let remedy = "set both, as `Flight::frequency_hz` does";
        return Err(no_keys("time grid", problem, remedy));
    }
    Ok(TimeCase {
        step_s: Some(step),
        steps: Some(steps),
        ..TimeCase::default()
    })
}

/// Free or tethered.
pub(super) fn mode(mode: &MotionMode, time: &TimeGrid) -> Written<FlightCase> {
    match mode {
        MotionMode::Free(start) => free(start, time),
        MotionMode::Tethered(motion) => Ok(tethered(motion)),
    }
}

fn free(start: &StartState, time: &TimeGrid) -> Written<FlightCase> {
    let StartState {
        position,
        angles,
        velocity,
        angular_velocity,
        held_steps,
        held_motion,
    } = start;
    let held = *held_steps as f64 * time.step;
    let (held_beats, held_s) = match time.period {
        Some(period) => (held / period, None),
        None => (0.0, Some(held).filter(|s| *s > 0.0)),
    };
    let hold = held_motion.as_ref().map(|_| tethered(&start.hold()));
    Ok(FlightCase {
        mode: Mode::Free,
        angular_velocity_deg_s: angular_velocity.to_array().map(f64::to_degrees),
        held_beats,
        held_s,
        ..hold.unwrap_or_else(|| FlightCase {
            position_m: position.to_array(),
            velocity_m_s: velocity.to_array(),
            ..pitched(*angles)
        })
    })
}

fn pitched(angles: DVec3) -> FlightCase {
    let [pitch_deg, yaw_deg, roll_deg] = angles.to_array().map(f64::to_degrees);
    FlightCase {
        pitch_deg,
        yaw_deg,
        roll_deg,
        ..FlightCase::default()
    }
}

/// A body that follows a motion.
pub(crate) fn tethered(motion: &PrescribedMotion) -> FlightCase {
    let PrescribedMotion {
        position,
        angles,
        start,
    } = motion;
    let start_s = match *start {
        Start::Impulsive => None,
        Start::Smooth { duration } => Some(duration),
    };
    let [x, y, z] = position.each_ref().map(path);
    let [pitch, yaw, roll] = angles.each_ref().map(turn);
    let constant = DVec3::from_array(angles.each_ref().map(|a| a.constant));
    FlightCase {
        mode: Mode::Tethered,
        position_m: position.each_ref().map(|p| p.constant),
        velocity_m_s: position.each_ref().map(|p| p.rate),
        tether: Some(TetherCase {
            x,
            y,
            z,
            pitch,
            yaw,
            roll,
            start_s,
        }),
        ..pitched(constant)
    }
}

fn oscillates(law: &DriftingFourier) -> bool {
    !(law.cosine.is_empty() && law.sine.is_empty())
}

fn path(law: &DriftingFourier) -> Option<PathOscillation> {
    oscillates(law).then(|| PathOscillation {
        frequency_hz: law.frequency,
        cosine_m: law.cosine.clone(),
        sine_m: law.sine.clone(),
    })
}

fn turn(law: &DriftingFourier) -> Option<AngleOscillation> {
    let degrees = |list: &[f64]| list.iter().map(|a| a.to_degrees()).collect();
    (oscillates(law) || law.rate != 0.0).then(|| AngleOscillation {
        rate_deg_s: law.rate.to_degrees(),
        frequency_hz: if oscillates(law) { law.frequency } else { 0.0 },
        cosine_deg: degrees(&law.cosine),
        sine_deg: degrees(&law.sine),
    })
}

/// Whether the method solves its steps by iteration.
pub(super) fn iterates(integrator: IntegratorChoice) -> bool {
    integrator.carries_wake()
}

/// Equations and method.
pub(super) fn dynamics(
    formulation: FormulationChoice,
    integrator: IntegratorChoice,
    wings: WingInertia,
) -> DynamicsCase {
    let plain = DynamicsCase {
        wings,
        ..DynamicsCase::default()
    };
    let dynamics = match formulation {
        FormulationChoice::Momentum => DynamicsCase {
            formulation: Formulation::Momentum.into(),
            ..plain
        },
        FormulationChoice::Euler(choice) => DynamicsCase {
            formulation: Formulation::Euler.into(),
            baumgarte: baumgarte(choice),
            ..plain
        },
        FormulationChoice::Quaternion(kept) => {
            let (stabilisation, choice) = match kept {
                StabilizationChoice::None => (StabilisationCase::None, None),
                StabilizationChoice::Projection => (StabilisationCase::Projection, None),
                StabilizationChoice::Baumgarte(c) => (StabilisationCase::Baumgarte, Some(c)),
            };
            DynamicsCase {
                formulation: Formulation::Quaternion.into(),
                stabilisation,
                baumgarte: choice.map_or(plain.baumgarte, baumgarte),
                ..plain
            }
        }
    };
    with_integrator(dynamics, integrator)
}

fn with_integrator(mut dynamics: DynamicsCase, integrator: IntegratorChoice) -> DynamicsCase {
    dynamics.integrator = match integrator {
        IntegratorChoice::Hamming => IntegratorCase::Hamming,
        IntegratorChoice::Bdf => IntegratorCase::Bdf,
        IntegratorChoice::Adams => IntegratorCase::Adams,
        IntegratorChoice::RungeKutta => IntegratorCase::RungeKutta,
        IntegratorChoice::OrderEight { tolerance } => {
            dynamics.tolerance = tolerance;
            IntegratorCase::OrderEight
        }
    }
    .into();
    dynamics
}

fn baumgarte(choice: BaumgarteChoice) -> BaumgarteCase {
    match choice {
        BaumgarteChoice::StepTied(a) => BaumgarteCase::StepFactor(a),
        BaumgarteChoice::Fixed { alpha, beta } => BaumgarteCase::Fixed {
            alpha_per_s: alpha,
            beta_per_s: beta,
        },
    }
}
