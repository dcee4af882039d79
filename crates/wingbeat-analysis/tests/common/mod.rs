//! The fruit fly in blade-element air.
#![allow(dead_code)] // every test binary uses its own part

use wingbeat_air::Wind;
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
    let air = AirModel::BladeElement(BladeOptions {
        blade: BladeSettings::insect(RHO),
        body_drag: None,
        induced: DVec3::ZERO,
        wind: Wind::default(),
    });
    FlightSetup {
        mode: MotionMode::Free(StartState {
            angles: DVec3::new(HOVER_BODY_PITCH, 0.0, 0.0),
            ..StartState::default()
        }),
        time: TimeGrid {
            step: period / 100.0,
            steps: 100,
            period: Some(period),
        },
        ..FlightSetup::new("fly", animal, air)
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
