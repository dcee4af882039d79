//! The fruit fly in blade-element air.
#![allow(dead_code)] // every test binary uses its own part

use wingbeat_analysis::*;
use wingbeat_blade::BladeSettings;
use wingbeat_flight::*;
use wingbeat_math::DVec3;
use wingbeat_model::species::{FlyOptions, HOVER_BODY_PITCH, drosophila_melanogaster};

/// Air density [kg/m3].
pub const RHO: f64 = 1.225;

/// The fruit fly with measured strokes in blade-element air, free, ten strips a wing.
pub fn fly() -> FlightSetup {
    let options = FlyOptions::default();
    let period = 1.0 / options.frequency;
    let mut animal = drosophila_melanogaster(&options).unwrap();
    animal.parts.clear();
    FlightSetup {
        name: "fly".into(),
        animal,
        gravity: DVec3::new(0.0, 0.0, 9.81),
        air: AirModel::BladeElement(BladeOptions {
            blade: BladeSettings::insect(RHO),
            body_drag: None,
            induced: DVec3::ZERO,
        }),
        mode: MotionMode::Free(StartState {
            position: DVec3::ZERO,
            angles: DVec3::new(HOVER_BODY_PITCH, 0.0, 0.0),
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
            held_steps: 0,
        }),
        joints: vec![],
        formulation: FormulationChoice::Momentum,
        integrator: IntegratorChoice::Hamming,
        time: TimeGrid {
            step: period / 100.0,
            steps: 100,
            period: Some(period),
        },
        corrector: CorrectorSettings::default(),
        loads: vec![],
    }
}

/// Hover with body pitch, stroke amplitude and mean stroke angle to choose.
pub fn hover(steps: usize) -> TrimProblem {
    TrimProblem {
        unknowns: [
            Unknown::BodyPitch,
            Unknown::StrokeAmplitude,
            Unknown::StrokeOffset,
        ],
        velocity: DVec3::ZERO,
        body_pitch: HOVER_BODY_PITCH,
        settings: TrimSettings {
            steps,
            ..TrimSettings::default()
        },
    }
}
