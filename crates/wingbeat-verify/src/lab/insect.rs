//! Insects and their robots: one setting for all, nothing fitted.
//!
//! The setting: 5 x 10 panels a wing, 40 steps a beat, wakes from all edges, the accurate scheme, forces on
//! segments, algebraic cores (Lamb-Oseen ones beside blobs and particles) that begin at 0.01 mean chords on the
//! wings (well below a panel) and at 0.07 in the wakes, spread with the medium's viscosity and are as wide in
//! the wakes as filaments are long, wakes kept 0.1 mean chords off the wings; particles begin with 0.36 mean
//! chords (about the distance of wake rows). It is that of the fruit-fly presets. (With particles and with
//! vortex lift roots hold, and particles take what is beyond the suction of the step before.) Motions start
//! smoothly over the first beat, after which they lag half a beat.

use wingbeat_air::{EdgeKind, LoadMethod};
use wingbeat_case::LoadedCase;
use wingbeat_case::raw::{
    AirCase, AngleCase, BetaCase, BodyCase, Case, CoreCase, FlightCase, FourierCase, LambOseenCase,
    LeadingEdgeCase, Mode, MotionCase, ParticlesCase, PlanformCase, TimeCase, WingCase,
    WingMeshCase, WingMotionCase,
};
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

use super::series::mean;
use crate::row::VerifyError;

/// A pair of wings on a fixed mount.
pub(crate) struct Insect {
    pub length: f64,
    pub area: f64,
    pub r2_hat: f64,
    pub root: f64,
    pub frequency: f64,
    pub density: f64,
    pub viscosity: f64,
    /// Motion of the right wing.
    pub motion: WingMotionCase,
}

/// Numerical choices, relative to the setting of all insects.
#[derive(Clone, Copy)]
pub(crate) struct Choice {
    pub shed: &'static [EdgeKind],
    pub loads: LoadMethod,
    pub leading_edge: LeadingEdgeCase,
    pub core: f64,
    pub overlap: f64,
    /// Length, in chords, from which wake filaments become blobs.
    pub blobs: Option<f64>,
    pub steps: usize,
    pub mesh: [usize; 2],
    pub cut: Cut,
    pub particles: bool,
    pub beats: usize,
}

/// Where wakes end.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Cut {
    /// Nowhere.
    Nowhere,
    /// After so many beats.
    Beats(f64),
}

/// Wakes from all edges but the root.
const HELD_ROOTS: &[EdgeKind] = &[EdgeKind::Trailing, EdgeKind::Tip, EdgeKind::Leading];

pub(crate) const DEFAULT: Choice = Choice {
    shed: &[
        EdgeKind::Trailing,
        EdgeKind::Tip,
        EdgeKind::Leading,
        EdgeKind::Root,
    ],
    loads: LoadMethod::Joukowski,
    leading_edge: LeadingEdgeCase::SuctionImplicit,
    core: 1.0,
    overlap: 1.0,
    blobs: None,
    steps: 40,
    mesh: [5, 10],
    cut: Cut::Nowhere,
    particles: false,
    beats: 3,
};

/// What the air of a case needs to know.
pub(crate) struct Fluid {
    pub density: f64,
    pub viscosity: f64,
    pub stream: [f64; 3],
    pub chord: f64,
    pub frequency: f64,
}

impl Choice {
    /// A case of a tethered body without weight as far as the air.
    pub(crate) fn case(&self, fluid: Fluid) -> Case {
        Case {
            gravity_m_s2: [0.0; 3],
            time: TimeCase {
                steps_per_beat: Some(self.steps),
                beats: Some(self.beats as f64),
                ..TimeCase::default()
            },
            motion: MotionCase {
                frequency_hz: fluid.frequency.into(),
                ..MotionCase::default()
            },
            flight: FlightCase {
                mode: Mode::Tethered,
                ..FlightCase::default()
            },
            air: self.air(fluid),
            body: BodyCase {
                mass_kg: Some(1.0),
                inertia_about_centre_kg_m2: Some([1e-2, 1e-2, 1e-2, 0.0, 0.0, 0.0]),
                ..BodyCase::default()
            },
            ..Case::default()
        }
    }

    fn air(&self, fluid: Fluid) -> AirCase {
        let particles = ParticlesCase {
            leading_edge: true,
            radius_m: Some(0.36 * self.core * fluid.chord),
            ..ParticlesCase::default()
        };
        let air = AirCase {
            density_kg_m3: fluid.density,
            stream_m_s: fluid.stream,
            body: false,
            mirror: true,
            shed: self.shed.to_vec(),
            loads: self.loads,
            leading_edge: self.leading_edge,
            bound_core: self.core(0.01, &fluid),
            wake_core: self.core(0.07, &fluid),
            wake_overlap: self.overlap.into(),
            clearance_m: Some(0.1 * fluid.chord),
            wake_blob_length_m: self.blobs.map(|chords| chords * fluid.chord),
            particles: self.particles.then_some(particles),
            ..AirCase::default()
        };
        match self.cut {
            Cut::Nowhere => air,
            Cut::Beats(n) => AirCase {
                max_wake_age_s: Some(n / fluid.frequency),
                ..air
            },
        }
    }

    /// Cores that begin with this part of the chord; blobs and particles need their own kind.
    fn core(&self, part: f64, fluid: &Fluid) -> CoreCase {
        let core = LambOseenCase {
            radius_m: Some(part * self.core * fluid.chord),
            viscosity_m2_s: Some(fluid.viscosity),
            ..LambOseenCase::default()
        };
        match self.blobs.is_some() || self.particles {
            true => CoreCase::LambOseen(core),
            false => CoreCase::Algebraic(core),
        }
    }

    pub(crate) fn mesh(&self) -> WingMeshCase {
        WingMeshCase {
            chordwise: self.mesh[0],
            spanwise: self.mesh[1],
            ..WingMeshCase::default()
        }
    }
}

/// What a flight leaves step by step, N components: force of the air on the wings [N], impulse of the inviscid
/// force so far [N s], impulse of all vorticity [kg m/s], power [W].
#[derive(Default)]
pub(crate) struct Flown {
    pub force: Vec<DVec3>,
    pub inviscid_impulse: Vec<DVec3>,
    pub vortex_impulse: Vec<DVec3>,
    /// Power of hinges and deformation [W].
    pub power: Vec<f64>,
}

impl Flown {
    /// Flies `case` to its end.
    pub(crate) fn of(case: Case) -> Result<Self, VerifyError> {
        let mut flight = Simulation::new(LoadedCase::new(case)?.setup)?;
        let mut flown = Self::default();
        flown.note(&flight);
        while !flight.finished() {
            flight.step()?;
            flown.note(&flight);
        }
        Ok(flown)
    }

    fn note(&mut self, flight: &Simulation) {
        let record = flight.record();
        self.force
            .push(record.air[1..].iter().map(|a| a.force).sum());
        self.inviscid_impulse.push(record.inviscid_impulse);
        self.vortex_impulse.push(record.vortex_impulse);
        self.power.push(record.driving_power());
    }
}

/// Force of the air on all wings [N], N, step by step, of a case without a body in the air.
pub(crate) fn forces(case: Case) -> Result<Vec<DVec3>, VerifyError> {
    Ok(Flown::of(case)?.force)
}

impl Insect {
    pub fn case(&self, with: Choice) -> Case {
        let mut case = with.case(Fluid {
            density: self.density,
            viscosity: self.viscosity,
            stream: [0.0; 3],
            chord: self.area / (self.length - self.root),
            frequency: self.frequency,
        });
        case.motion.stroke_plane_pitch_deg = 90.0.into();
        let planform = BetaCase {
            length_m: self.length,
            area_m2: Some(self.area),
            r2_hat: self.r2_hat,
            root_offset_m: self.root,
            ..BetaCase::default()
        };
        let wing = WingCase {
            hinge_m: Some([0.0, 0.2 * self.length, 0.0]),
            mass_kg: Some(1e-9),
            planform: Some(PlanformCase::Beta(planform)),
            mesh: Some(with.mesh()),
            motion: Some(self.motion.clone()),
            ..WingCase::default()
        };
        case.wing.insert("right".into(), wing);
        case
    }

    /// Mean upward force of each beat from the second on [N].
    pub fn lifts(&self, with: Choice) -> Result<Vec<f64>, VerifyError> {
        let lift: Vec<f64> = forces(self.case(with))?.iter().map(|f| -f.z).collect();
        let beat = |b: usize| mean(&lift[b * with.steps..=(b + 1) * with.steps]);
        Ok((1..with.beats).map(beat).collect())
    }
}

/// Middle and half-width of what the numbers span.
pub(crate) fn middle(x: &[f64]) -> [f64; 2] {
    let lo = x.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [x.iter().sum::<f64>() / x.len() as f64, 0.5 * (hi - lo)]
}

const ATTACHED: &[EdgeKind] = &[EdgeKind::Trailing, EdgeKind::Tip];

/// The published motion of this name.
pub(crate) fn data(name: &str) -> WingMotionCase {
    WingMotionCase {
        data: Some(name.to_owned()),
        ..WingMotionCase::default()
    }
}

/// Angle by its mean, cosines and sines [deg].
pub(crate) fn fourier(mean_deg: f64, cosine_deg: &[f64], sine_deg: &[f64]) -> Option<AngleCase> {
    Some(AngleCase::Fourier(FourierCase {
        mean_deg,
        cosine_deg: cosine_deg.to_vec(),
        sine_deg: sine_deg.to_vec(),
    }))
}

pub(crate) const MODELS: [(&str, Choice); 6] = [
    ("leading-edge sheets", DEFAULT),
    (
        "leading-edge particles",
        Choice {
            particles: true,
            loads: LoadMethod::Pressure,
            ..STEP_BEFORE.1
        },
    ),
    (
        "attached, pressure",
        Choice {
            shed: ATTACHED,
            loads: LoadMethod::Pressure,
            ..DEFAULT
        },
    ),
    (
        "attached, Polhamus",
        Choice {
            shed: ATTACHED,
            loads: LoadMethod::Polhamus,
            ..DEFAULT
        },
    ),
    (
        "attached, Joukowski",
        Choice {
            shed: ATTACHED,
            loads: LoadMethod::Joukowski,
            ..DEFAULT
        },
    ),
    (
        "vortex lift",
        Choice {
            shed: HELD_ROOTS,
            leading_edge: LeadingEdgeCase::VortexLift,
            ..DEFAULT
        },
    ),
];

/// What leaves leading edges by the suction of the step before, and roots that hold.
pub(crate) const STEP_BEFORE: (&str, Choice) = (
    "suction of the step before, roots hold",
    Choice {
        shed: HELD_ROOTS,
        leading_edge: LeadingEdgeCase::Suction,
        ..DEFAULT
    },
);

/// The wings of the fruit-fly presets and the animal's weight [N].
pub(crate) fn fruit_fly_wings() -> (Insect, f64) {
    let fly = Insect {
        length: 2.5e-3,
        area: 0.699e-3 * 2.5e-3,
        r2_hat: 0.58592,
        root: 0.125e-3,
        frequency: 200.0,
        density: 1.225,
        viscosity: 1.5e-5,
        motion: data("fry-hover"),
    };
    (fly, (0.9315e-6 + 2.0 * 5.35e-9) * 9.81)
}
