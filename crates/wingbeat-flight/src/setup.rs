//! What a flight is made of: the validated setup, before anything moves.

use std::fmt;
use std::sync::Arc;

use wingbeat_air::{AirSettings, CoreModel, LeadingEdge, LoadMethod, SheddingKinds, Wind};
use wingbeat_blade::DerivativeTable;
use wingbeat_blade::{BladeSettings, BodyDrag, Unsteady};
use wingbeat_dynamics::Joint;
use wingbeat_math::{DMat3, DVec3, EulerSequence};
use wingbeat_model::{Animal, Start};

pub use crate::applied::{AppliedLoad, LoadFrame, PointSpring};
use crate::controller::Controller;
use crate::error::FlightError;
use crate::interface::{Air, ExternalAir};
pub use crate::prescribed::{PrescribedMotion, PrescribedRoot};
pub use wingbeat_math::DriftingFourier;

/// Everything that defines one flight. Constant once built; the state is elsewhere.
#[derive(Clone, Debug)]
pub struct FlightSetup {
    /// Name of the case.
    pub name: String,
    /// The animal or vehicle: masses, meshes, wing motion.
    pub animal: Animal,
    /// Acceleration of gravity in N components [m/s2], default (0, 0, 9.81): n3 points down.
    pub gravity: DVec3,
    /// The air and its model.
    pub air: AirModel,
    /// How the root body moves.
    pub mode: MotionMode,
    /// Joints of segments, and of wings that are not simply driven; mostly empty. Bodies are counted as in the
    /// system: 0 the central body, then the wings, then the segments. The first joint that has a body as its child
    /// carries it, with a wing's motion where the joint of a wing has no law of its own; others close loops. A
    /// wing without a joint hangs on the central body.
    pub joints: Vec<Joint>,
    /// Which equations are integrated.
    pub formulation: FormulationChoice,
    /// By which method.
    pub integrator: IntegratorChoice,
    /// Time grid.
    pub time: TimeGrid,
    /// When the corrector of one step has converged.
    pub corrector: CorrectorSettings,
    /// Extra forces and couples.
    pub loads: Vec<AppliedLoad>,
    /// Springs and dampers between points of two bodies.
    pub springs: Vec<PointSpring>,
    /// Feedback on the wings; none flies the motion as it is.
    pub feedback: Option<Feedback>,
}

impl FlightSetup {
    /// A free flight of `animal` in `air` from rest at the origin, five wingbeats of 40 steps under
    /// the gravity of the earth, momentum form, Hamming's method. What differs is set
    /// afterwards: all fields are public.
    pub fn new(name: &str, animal: Animal, air: AirModel) -> Self {
        let frequency = animal.wings.first().map_or(0.0, |w| w.motion.frequency);
        let period = (frequency > 0.0).then(|| 1.0 / frequency);
        Self {
            name: name.into(),
            animal,
            gravity: DVec3::new(0.0, 0.0, 9.81),
            air,
            mode: MotionMode::Free(StartState::default()),
            joints: vec![],
            formulation: FormulationChoice::Momentum,
            integrator: IntegratorChoice::Hamming,
            time: TimeGrid {
                step: period.unwrap_or(1.0) / 40.0,
                steps: 200,
                period,
            },
            corrector: CorrectorSettings::default(),
            loads: vec![],
            springs: vec![],
            feedback: None,
        }
    }
}

/// Feedback of a flight.
#[derive(Clone, Debug)]
pub struct Feedback {
    /// The controller.
    pub controller: Arc<dyn ControlModel>,
    /// Time steps from one look to the next, at least [`crate::control::MIN_INTERVAL`].
    pub interval: usize,
    /// Looks from sensing to the beginning of the passage to the command.
    pub latency: usize,
    /// Time constant of the actuators, a first-order lag: what acts goes over to the command by the share
    /// `1 - exp(-interval / lag)` from one look to the next; 0: wholly [s].
    pub lag: f64,
}

/// What makes the controller of a flight.
pub trait ControlModel: fmt::Debug + Send + Sync {
    /// The controller at the start of a flight of `setup`.
    ///
    /// # Errors
    /// A flight that it cannot control.
    fn open(&self, setup: &FlightSetup) -> Result<Box<dyn Controller>, FlightError>;

    /// Whether it follows a reference that moves, which is recorded ([`crate::Record::reference`]).
    fn follows(&self) -> bool {
        false
    }

    /// Mean velocity of the straight flight that it holds from the release on, N components [m/s]; none if it holds no place, or one
    /// that it does not tell.
    fn velocity(&self) -> Option<DVec3> {
        None
    }

    /// The same whose noise of the senses has a seed later by `by`; none without noise that it draws itself.
    fn redrawn(&self, _by: u64) -> Option<Arc<dyn ControlModel>> {
        None
    }
}

/// A controller that can be copied controls any flight.
impl<C: Controller + Clone + fmt::Debug + Sync + 'static> ControlModel for C {
    fn open(&self, _setup: &FlightSetup) -> Result<Box<dyn Controller>, FlightError> {
        Ok(Box::new(self.clone()))
    }
}

/// The air and its model: from none to the unsteady lattice.
#[derive(Clone, Debug, Default)]
pub enum AirModel {
    /// Vacuum.
    #[default]
    None,
    /// Quasi-steady blade elements: no memory, fast.
    BladeElement(BladeOptions),
    /// Non-linear unsteady vortex lattice with free wakes.
    VortexLattice(AirOptions),
    /// Stability derivatives of the whole animal, acting on the root body: linear.
    Derivatives(DerivativeTable),
    /// Loads computed by someone else.
    External(Arc<dyn ExternalAir>),
    /// A model of your own.
    Own(Arc<dyn Air>),
}

impl BladeOptions {
    /// The coefficients of insects in air at rest of this density [kg/m3].
    pub fn insect(density: f64) -> Self {
        Self {
            blade: BladeSettings::insect(density),
            body_drag: None,
            induced: DVec3::ZERO,
            wind: Wind::default(),
        }
    }
}

impl AirOptions {
    /// What the presets of insects fly, for wings of this mean chord [m] in air at rest of this
    /// density [kg/m3] and kinematic viscosity [m2/s]: the accurate scheme, wakes from trailing edges and tips,
    /// forces on segments, algebraic cores: bound ones of 0.01 chords, those of wakes from 0.07 chords and never
    /// narrower than their filaments are long. The
    /// body is left out of the air.
    pub fn insect(density: f64, viscosity: f64, chord: f64) -> Self {
        let core = |chords: f64| CoreModel::Algebraic {
            radius: chords * chord,
            viscosity,
        };
        Self {
            lattice: AirSettings {
                bound_core: core(0.01),
                wake_core: core(0.07),
                wake_overlap: 1.0,
                loads: LoadMethod::Joukowski,
                shedding: SheddingKinds {
                    tip: true,
                    ..SheddingKinds::TRAILING
                },
                leading: LeadingEdge::Suction {
                    threshold: 0.15,
                    efficiency: 0.0,
                },
                ..AirSettings::accurate(density, DVec3::ZERO)
            },
            body_surfaces: false,
            mirror: false,
            joined: vec![],
        }
    }
}

impl AirModel {
    /// What it is called.
    pub fn name(&self) -> &'static str {
        match self {
            Self::None => "no air",
            Self::BladeElement(_) => "blade elements",
            Self::VortexLattice(_) => "vortex lattice",
            Self::Derivatives(_) => "stability derivatives",
            Self::External(_) => "external program",
            Self::Own(_) => "a model of its own",
        }
    }

    /// Whether there is air.
    pub fn is_some(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// Velocity of the undisturbed air, N components [m/s]; none where the model has no stream.
    pub fn stream(&self) -> Option<DVec3> {
        match self {
            Self::BladeElement(options) => Some(options.blade.free_stream),
            Self::VortexLattice(options) => Some(options.lattice.free_stream),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// The same, to be changed.
    pub fn stream_mut(&mut self) -> Option<&mut DVec3> {
        match self {
            Self::BladeElement(options) => Some(&mut options.blade.free_stream),
            Self::VortexLattice(options) => Some(&mut options.lattice.free_stream),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// Whether half of the air stands for the whole.
    pub fn is_mirrored(&self) -> bool {
        matches!(self, Self::VortexLattice(options) if options.mirror)
    }

    /// Shear and gusts that are added to the stream; none where the model has no wind.
    pub fn wind(&self) -> Option<&Wind> {
        match self {
            Self::BladeElement(options) => Some(&options.wind),
            Self::VortexLattice(options) => Some(&options.lattice.wind),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// The same, to be changed.
    pub fn wind_mut(&mut self) -> Option<&mut Wind> {
        match self {
            Self::BladeElement(options) => Some(&mut options.wind),
            Self::VortexLattice(options) => Some(&mut options.lattice.wind),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// Whether the loads depend on the past.
    pub fn has_memory(&self) -> bool {
        self.has_strip_wakes() || self.keeps_wake()
    }

    /// Whether what is remembered is moved on once a step and known at the ends of steps alone, as a wake in space is.
    pub fn keeps_wake(&self) -> bool {
        match self {
            Self::VortexLattice(_) | Self::External(_) => true,
            Self::None | Self::BladeElement(_) | Self::Derivatives(_) => false,
            Self::Own(air) => air.has_memory(),
        }
    }

    /// Whether strips remember their own wakes, in a few states each.
    pub fn has_strip_wakes(&self) -> bool {
        self.strip_wakes().is_some()
    }

    /// By which theory strips remember their own wakes, if they do.
    pub fn strip_wakes(&self) -> Option<Unsteady> {
        match self {
            Self::BladeElement(options) => options.blade.unsteady,
            _ => None,
        }
    }
}

/// Blade elements and what else the air does to the animal.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeOptions {
    /// Coefficients, rotation, added mass, density and stream.
    pub blade: BladeSettings,
    /// Drag of the body, at [`Animal::body_centre`] where it names no other point; none leaves the body out of the air.
    pub body_drag: Option<BodyDrag>,
    /// Induced flow at the wings, added to the stream, N components [m/s]; zero for coefficients
    /// that hold it already.
    pub induced: DVec3,
    /// Gusts and shear, added to the stream strip by strip.
    pub wind: Wind,
}

/// The vortex lattice and which parts of the animal it sees.
#[derive(Clone, Debug)]
pub struct AirOptions {
    /// Settings of the lattice: density, stream, vortex core, shedding, scheme.
    pub lattice: AirSettings,
    /// Whether head, thorax and abdomen are part of the lattice.
    pub body_surfaces: bool,
    /// Whether animal and motion are mirror-symmetric, so that the air is computed on one half.
    /// A motion that is not so is refused at the step where it shows.
    pub mirror: bool,
    /// Pairs of wings, by their numbers, that share the edge at their roots.
    pub joined: Vec<[usize; 2]>,
}

/// How the root body moves.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there is one per flight")]
pub enum MotionMode {
    /// Free flight from a start state.
    Free(StartState),
    /// Tethered: the root follows a prescribed motion.
    Tethered(PrescribedMotion),
}

/// Position, attitude and velocities of the root body at time zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StartState {
    /// Origin of the root frame, N components [m].
    pub position: DVec3,
    /// 2-3-1 Euler angles phi (pitch), theta (yaw), psi (roll) [rad].
    pub angles: DVec3,
    /// Velocity of the root origin, N components [m/s].
    pub velocity: DVec3,
    /// Angular velocity at the release, beside that of [`Self::held_motion`], root components [rad/s].
    pub angular_velocity: DVec3,
    /// Number of first steps during which the root is held: it keeps this attitude and moves
    /// with this constant velocity (but for [`Self::held_motion`]) while the wings beat and the wake
    /// grows, then it is released. 0 releases at once.
    pub held_steps: usize,
    /// How it moves about that attitude and path while it is held; none is still. It is released with the velocities that it has then,
    /// and with [`Self::angular_velocity`] besides.
    pub held_motion: Option<Box<PrescribedMotion>>,
}

impl StartState {
    /// Rotation R_NB of the start attitude.
    pub fn rotation(&self) -> DMat3 {
        EulerSequence::BODY_231.rotation(self.angles)
    }

    /// The motion of the hold before the release.
    pub fn hold(&self) -> PrescribedMotion {
        let (x, v) = (self.position.to_array(), self.velocity.to_array());
        let (angles, more) = (self.angles.to_array(), self.held_motion.as_deref());
        let about = |constant: f64, rate: f64, more: Option<&DriftingFourier>| {
            let more = more.cloned().unwrap_or_default();
            DriftingFourier {
                constant: constant + more.constant,
                rate: rate + more.rate,
                ..more
            }
        };
        PrescribedMotion {
            position: std::array::from_fn(|i| about(x[i], v[i], more.map(|m| &m.position[i]))),
            angles: std::array::from_fn(|i| about(angles[i], 0.0, more.map(|m| &m.angles[i]))),
            start: more.map_or(Start::Impulsive, |m| m.start),
        }
    }
}

/// Which equations of motion are integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FormulationChoice {
    /// Momentum form: mass centre, quaternion, linear and angular momentum (default).
    Momentum,
    /// The seed's Euler coordinates with multipliers and Baumgarte stabilisation.
    Euler(BaumgarteChoice),
    /// Positions and quaternions of all bodies with multipliers: loops, free joints, singular
    /// nowhere.
    Quaternion(StabilizationChoice),
}

/// How the constraints of the quaternion form are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StabilizationChoice {
    /// Not at all.
    None,
    /// By feedback.
    Baumgarte(BaumgarteChoice),
    /// By projection of positions and velocities after every step; one-step integrators only.
    Projection,
}

/// The time integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IntegratorChoice {
    /// Hamming's modified predictor-corrector, order four: carries a wake along where the air that
    /// moves with the wings weighs less than a third of what carries it.
    Hamming,
    /// Backward differences of order four: carries a wake along whatever the air weighs. Where elastic wings hang on free joints, a
    /// formula of order two that damps the fastest vibrations as their structures do.
    Bdf,
    /// Adams-Bashforth-Moulton, order four.
    Adams,
    /// Runge-Kutta, order four.
    RungeKutta,
    /// Dormand and Prince's method of order eight, steps inside the time grid chosen by its error
    /// estimate.
    OrderEight {
        /// Error allowed per step, relative to the natural size of each component [1].
        tolerance: f64,
    },
}

impl IntegratorChoice {
    /// Whether the method evaluates loads at the ends of steps only, as a wake demands, which is
    /// moved once a step.
    pub fn carries_wake(&self) -> bool {
        matches!(self, Self::Hamming | Self::Bdf)
    }

    /// Whether the method needs nothing but the present state.
    pub fn is_one_step(&self) -> bool {
        matches!(self, Self::RungeKutta | Self::OrderEight { .. })
    }
}

/// Constants of Baumgarte's stabilisation (seed eq. 29).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BaumgarteChoice {
    /// alpha = beta = `a / h` with the step h.
    StepTied(f64),
    /// alpha and beta given [1/s]; zero for both reproduces seed eq. 28.
    Fixed {
        /// Damping constant alpha [1/s].
        alpha: f64,
        /// Stiffness constant beta [1/s].
        beta: f64,
    },
}

/// Equal time steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeGrid {
    /// Step h [s].
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// Period of one wingbeat [s], for cycle means; `None` for motions without one.
    pub period: Option<f64>,
}

impl TimeGrid {
    /// Steps of a wingbeat, the nearest whole number; none of motions without one.
    pub fn steps_per_beat(&self) -> Option<usize> {
        let steps = (self.period? / self.step).round() as usize;
        (steps > 0).then_some(steps)
    }
}

/// When the corrector of one step has converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorrectorSettings {
    /// Largest scaled change between two passes that counts as converged [1].
    pub tolerance: f64,
    /// Most passes before the step is given up with an error.
    pub max_passes: usize,
    /// Relaxation factor of a pass \[1\], above 0 and up to 1; 1 is the plain iteration.
    pub relaxation: f64,
}

impl Default for CorrectorSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_passes: 60,
            relaxation: 1.0,
        }
    }
}
