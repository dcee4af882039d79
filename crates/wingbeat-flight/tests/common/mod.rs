//! A small fly with smooth, asymmetric strokes, for coupled tests that must run in seconds.
#![allow(dead_code)] // every test binary uses its own part

use wingbeat_air::{AirSettings, CoreModel, Method, SheddingKinds};
use wingbeat_flight::*;
use wingbeat_math::{DMat3, DVec3, MassProperties};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{
    AngleLaw, AngleLaws, Animal, BodyMass, MassInput, Planform, Side, Start, Wing, WingMotion,
    WingShape,
};

/// Wingbeat frequency [Hz].
pub const FREQUENCY: f64 = 200.0;
/// Span of a wing [m].
pub const SPAN: f64 = 2.4e-3;

pub fn sine(mean: f64, cos: f64, sin: f64) -> AngleLaw {
    AngleLaw::Fourier(Fourier {
        mean,
        cos: vec![cos],
        sin: vec![sin],
    })
}

/// Strokes of first harmonics only: as smooth as the integrator could wish.
fn motion(amplitude: f64, start: Start) -> WingMotion {
    WingMotion {
        angles: AngleLaws {
            phi: sine(0.1, amplitude, 0.0),
            theta: sine(0.0, 0.05, 0.1),
            psi: sine(0.0, 0.0, -0.8),
        },
        frequency: FREQUENCY,
        phase: 0.0,
        stroke_plane_pitch: 0.75,
        start,
    }
}

/// How the little fly is made.
#[derive(Clone, Copy)]
pub struct Fly {
    /// Stroke amplitudes, right and left [rad].
    pub amplitudes: [f64; 2],
    /// Mass of a wing [kg].
    pub wing_mass: f64,
    /// Wing panels, chordwise and spanwise.
    pub panels: [usize; 2],
    /// Smooth start over this time [s]; 0 is impulsive.
    pub start: f64,
}

impl Default for Fly {
    fn default() -> Self {
        Self {
            amplitudes: [1.1, 1.1],
            wing_mass: 6e-9,
            panels: [2, 4],
            start: 2.5e-3,
        }
    }
}

impl Fly {
    /// Body without surfaces and two rectangular wings.
    pub fn animal(&self) -> Animal {
        let inertia = DMat3::from_diagonal(DVec3::new(1.0e-13, 4.0e-13, 4.0e-13));
        let body = MassProperties::about_centre(0.95e-6, DVec3::new(-5e-5, 0.0, 3e-5), inertia);
        let planform = Planform::Rectangle {
            chord: 0.7e-3,
            span: SPAN,
            root_offset: 0.2e-3,
            axis_fraction: 0.25,
        };
        let shape = WingShape::uniform(planform, self.panels[0], self.panels[1]);
        let start = match self.start {
            0.0 => Start::Impulsive,
            duration => Start::Smooth { duration },
        };
        let mass = match self.wing_mass {
            0.0 => MassInput::Given(MassProperties::ZERO),
            m => MassInput::Total(m),
        };
        let hinge = DVec3::new(0.4e-3, 0.35e-3, -0.15e-3);
        let wing = |amplitude| {
            Wing::new(
                "right",
                Side::Right,
                hinge,
                &shape,
                &mass,
                motion(amplitude, start),
            )
            .expect("a wing")
        };
        let [right, left] = self.amplitudes.map(wing);
        Animal::new(
            "little fly",
            BodyMass::Given(body),
            vec![],
            vec![left.mirrored("left"), right],
        )
        .expect("an animal")
    }

    /// Free flight for `beats` wingbeats at `steps` steps per beat.
    pub fn setup(&self, steps: usize, beats: f64) -> FlightSetup {
        let core = CoreModel::LambOseen {
            radius: 1e-4,
            viscosity: 1.5e-5,
        };
        let lattice = AirSettings {
            bound_core: core,
            wake_core: core,
            shedding: SheddingKinds {
                tip: true,
                ..SheddingKinds::TRAILING
            },
            summation: Method::Direct, // symmetry to more digits than single precision has
            ..AirSettings::benchmark(1.2, DVec3::ZERO)
        };
        let period = 1.0 / FREQUENCY;
        let air = AirModel::VortexLattice(AirOptions {
            lattice,
            body_surfaces: false,
            mirror: false,
            joined: vec![],
            joined_tips: vec![],
            has_own_viscosity: false,
        });
        FlightSetup {
            mode: MotionMode::Free(StartState {
                position: DVec3::new(0.01, -0.02, 0.03),
                angles: DVec3::new(0.8, 0.0, 0.0),
                ..StartState::default()
            }),
            time: TimeGrid {
                step: period / steps as f64,
                steps: (beats * steps as f64).round() as usize,
                period: Some(period),
            },
            ..FlightSetup::new("little fly", self.animal(), air)
        }
    }

    /// Forward flight with gentle strokes: the wake is left behind, so that what the step does to
    /// the flight can be told apart from what it does to a wake that meets the wings again.
    pub fn forward(&self, steps: usize, beats: f64) -> FlightSetup {
        let gentle = Self {
            amplitudes: [0.4, 0.35],
            ..*self
        };
        let mut setup = gentle.setup(steps, beats);
        for wing in &mut setup.animal.wings {
            wing.motion.stroke_plane_pitch = 0.0;
            wing.motion.angles.psi = sine(0.1, 0.0, -0.2);
        }
        if let MotionMode::Free(start) = &mut setup.mode {
            start.angles = DVec3::ZERO;
            start.velocity = DVec3::new(3.0, 0.0, 0.0);
        }
        let AirModel::VortexLattice(air) = &mut setup.air else {
            unreachable!("the little fly has a lattice")
        };
        air.lattice.shedding = SheddingKinds::TRAILING;
        setup
    }
}

/// Flies to the end; the records of all steps.
pub fn fly(setup: FlightSetup) -> Vec<Record> {
    let mut sim = Simulation::new(setup).expect("a flight");
    let mut records = vec![sim.record().clone()];
    while !sim.finished() {
        records.push(sim.step().expect("a step").clone());
    }
    records
}

/// Position [m] and 2-3-1 angles [rad] of the root.
pub fn pose(r: &Record) -> (DVec3, DVec3) {
    (
        DVec3::from_slice(&r.coordinates[..3]),
        DVec3::from_slice(&r.coordinates[3..6]),
    )
}

/// Largest difference of two poses, position in spans, angles in radians.
pub fn distance(a: &Record, b: &Record) -> f64 {
    let ((p, e), (q, f)) = (pose(a), pose(b));
    ((p - q) / SPAN)
        .abs()
        .max_element()
        .max((e - f).abs().max_element())
}
