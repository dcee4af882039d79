//! Animals in blade-element air, and a second program to compare with.
#![allow(dead_code)] // every test binary uses its own part

pub mod flight_laws;
pub mod quasi_steady;

use wingbeat_air::Wind;
use wingbeat_analysis::control::STATES;
use wingbeat_analysis::*;
use wingbeat_blade::{BladeSettings, Rotation};
use wingbeat_flight::*;
use wingbeat_math::{DMat3, DVec3, MassProperties};
use wingbeat_model::motion::{AngleLaw, AngleLaws, Fourier, SmoothSquare, Start, WingMotion};
use wingbeat_model::planform::{Beta, ChordSize, Planform, WingShape};
use wingbeat_model::species::{FlyOptions, HOVER_BODY_PITCH, drosophila_melanogaster};
use wingbeat_model::{Animal, MassInput, Side, Wing};

/// Air density [kg/m3].
pub const RHO: f64 = 1.225;

/// Natural sizes of the states of a regulator: wing length, wingbeat, radian.
pub fn sizes(trim: &Trim) -> [f64; STATES] {
    let (length, period) = (trim.beat.wing_length(), trim.beat.period());
    let sizes = [length, length / period, 1.0 / period, 1.0];
    std::array::from_fn(|k| sizes[k / 3])
}

/// The matrix of a linear map of numbers of these natural sizes.
pub fn matrix(sizes: &[f64], map: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let n = sizes.len();
    let mut out = vec![0.0; n * n];
    for j in 0..n {
        let mut z = vec![0.0; n];
        z[j] = sizes[j];
        for (i, y) in map(&z).into_iter().enumerate() {
            out[i * n + j] = y / sizes[i];
        }
    }
    out
}

/// The fruit fly with measured strokes in blade-element air, free, ten strips a wing.
pub fn fly() -> FlightSetup {
    let options = FlyOptions::default();
    let mut animal = drosophila_melanogaster(&options).unwrap();
    animal.parts.clear();
    flying(animal, options.frequency, HOVER_BODY_PITCH)
}

/// The flyer with one coefficient of feathering, about a quarter of the chord that of thin-airfoil theory from ahead. By
/// the default law the air turns to the other edge at once where it comes broadside or a section comes to rest, and
/// methods lose their order there; this one is smooth.
pub fn smooth(mut setup: FlightSetup) -> FlightSetup {
    let AirModel::BladeElement(options) = &mut setup.air else {
        panic!("blade elements");
    };
    options.blade.rotation = Rotation::Coefficient(0.5 * std::f64::consts::PI);
    setup
}

/// The hawkmoth of the preset `hawkmoth-blade` without its body's surface: wings of 5.7 % of the mass.
pub fn moth() -> FlightSetup {
    let planform = Planform::Beta(Beta {
        length: 51.9e-3,
        size: ChordSize::Mean(18.26e-3),
        r2_hat: 0.505,
        root_offset: 2e-3,
        axis_fraction: 0.25,
        least_chord: 0.15,
    });
    let (frequency, pitch) = (26.1, 45_f64.to_radians());
    let right = Wing::new(
        "right",
        Side::Right,
        DVec3::new(8e-3, 5e-3, -8e-3),
        &WingShape::uniform(planform, 4, 10),
        &MassInput::Total(47e-6),
        WingMotion {
            angles: AngleLaws {
                phi: AngleLaw::Fourier(Fourier {
                    sin: vec![60_f64.to_radians()],
                    ..Fourier::default()
                }),
                theta: AngleLaw::Constant(0.0),
                psi: AngleLaw::SmoothSquare(SmoothSquare {
                    amplitude: -55_f64.to_radians(),
                    shape: 2.5,
                    shift: std::f64::consts::FRAC_PI_2,
                    mean: 0.0,
                }),
            },
            frequency,
            phase: 0.0,
            stroke_plane_pitch: pitch,
            start: Start::Impulsive,
        },
    )
    .unwrap();
    let animal = Animal {
        name: "hawkmoth".to_owned(),
        body: MassProperties {
            mass: 1.554e-3,
            first_moment: DVec3::ZERO,
            inertia: DMat3::from_diagonal(DVec3::new(0.3e-7, 2.08e-7, 2.08e-7)),
        },
        parts: vec![],
        wings: vec![right.mirrored("left"), right],
        segments: vec![],
    };
    flying(animal, frequency, pitch)
}

/// An animal in free flight at rest with this body pitch \[rad\], ten strips a wing.
fn flying(animal: Animal, frequency: f64, pitch: f64) -> FlightSetup {
    let period = 1.0 / frequency;
    let air = AirModel::BladeElement(BladeOptions {
        blade: BladeSettings::insect(RHO),
        body_drag: None,
        induced: DVec3::ZERO,
        wind: Wind::default(),
        viscosity: None,
    });
    FlightSetup {
        mode: MotionMode::Free(StartState {
            angles: DVec3::new(pitch, 0.0, 0.0),
            ..StartState::default()
        }),
        time: TimeGrid {
            step: period / 100.0,
            steps: 100,
            period: Some(period),
        },
        ..FlightSetup::new("animal", animal, air)
    }
}

/// Hover with body pitch, stroke amplitude and mean stroke angle to choose.
pub fn hover(steps: usize) -> TrimProblem {
    TrimProblem {
        settings: TrimSettings {
            steps,
            ..TrimSettings::default()
        },
        ..TrimProblem::straight(DVec3::ZERO, HOVER_BODY_PITCH)
    }
}

/// The fruit fly, trimmed for it.
pub fn hovering(steps: usize) -> Trim {
    trim(&fly(), &hover(steps)).expect("the fruit fly")
}

/// Determinant of the n x n matrix `a` given by rows, by elimination with row exchanges.
pub fn determinant(a: &[f64], n: usize) -> f64 {
    let mut a = a.to_vec();
    let mut d = 1.0;
    for k in 0..n {
        let size = |i: &usize| a[i * n + k].abs();
        let p = (k..n)
            .max_by(|i, j| size(i).total_cmp(&size(j)))
            .unwrap_or(k);
        if a[p * n + k] == 0.0 {
            return 0.0;
        }
        if p != k {
            (0..n).for_each(|j| a.swap(p * n + j, k * n + j));
            d = -d;
        }
        d *= a[k * n + k];
        for i in k + 1..n {
            let f = a[i * n + k] / a[k * n + k];
            (k..n).for_each(|j| a[i * n + j] -= f * a[k * n + j]);
        }
    }
    d
}
