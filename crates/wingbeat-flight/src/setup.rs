//! What a flight is made of: the validated setup, before anything moves.

mod air;
pub(crate) mod applied;
pub mod carriers;
mod integration;
pub(crate) mod prescribed;
mod start;
pub(crate) mod validate;

use std::fmt;
use std::sync::Arc;

use wingbeat_dynamics::{BodyMotion, Joint};
use wingbeat_math::{DVec3, EulerSequence};
use wingbeat_model::Animal;

pub use self::air::{AirModel, AirOptions, BladeOptions};
pub use self::carriers::is_driven;
pub use self::integration::{
    BaumgarteChoice, CorrectorSettings, FormulationChoice, IntegratorChoice, LOOKS,
    StabilizationChoice, TimeGrid,
};
pub use self::start::{MotionMode, StartState};
use crate::error::FlightError;
use crate::interface::controller::Controller;
pub use crate::setup::applied::{AppliedLoad, LoadFrame, PointSpring};
pub use crate::setup::prescribed::PrescribedMotion;
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

    /// Whether forces move anything: a free body, joints, elastic wings. Else all motion is prescribed.
    pub fn is_moved_by_forces(&self) -> bool {
        matches!(self.mode, MotionMode::Free(_))
            || self.joints.iter().any(|j| j.model.kind.directions() > 0)
            || self.animal.is_elastic()
    }

    /// Panels of the lattice, all surfaces on both sides together \[1\]; 0 where the air is no lattice.
    pub fn panels(&self) -> usize {
        let Some(air) = self.air.lattice() else {
            return 0;
        };
        let animal = &self.animal;
        let wings = animal.wings.iter().map(|w| w.panels().len());
        let own = animal.parts.iter();
        let others = animal.segments.iter().flat_map(|s| &s.parts);
        let body = own.chain(others).map(|p| p.mesh.quads.len());
        wings.sum::<usize>() + if air.body_surfaces { body.sum() } else { 0 }
    }

    /// Motion of the root at time zero.
    pub fn root_at_start(&self) -> BodyMotion {
        match &self.mode {
            MotionMode::Tethered(motion) => motion.at(0.0).motion,
            MotionMode::Free(start) if start.held_steps > 0 => start.hold().at(0.0).motion,
            MotionMode::Free(start) if start.held_motion.is_some() => start.released(0.0),
            MotionMode::Free(start) => BodyMotion {
                p: start.position,
                r: start.rotation(),
                v: start.velocity,
                w: start.angular_velocity,
            },
        }
    }

    /// Velocity of the steady undisturbed air where the root starts, N components [m/s]: the stream and what a shear adds
    /// to it there, without gusts and vortex streets; zero of air that has no stream.
    pub fn air_at_start(&self) -> DVec3 {
        let stream = self.air.stream().unwrap_or_default();
        let shear = self.air.wind().and_then(|wind| wind.shear);
        shear.map_or(stream, |s| stream + s * self.root_at_start().p)
    }

    /// Pitch, yaw and roll of the root where its free flight begins, be it released then or not; tethered all
    /// along, the means over its motion \[rad\].
    pub fn angles_at_release(&self) -> DVec3 {
        match &self.mode {
            MotionMode::Tethered(motion) => {
                DVec3::from_array(motion.angles.each_ref().map(|a| a.constant))
            }
            MotionMode::Free(start) if start.held_motion.is_some() => {
                let root = start.released(start.held_steps as f64 * self.time.step);
                EulerSequence::BODY_231.angles(root.r)
            }
            MotionMode::Free(start) => start.angles,
        }
    }
}

/// Feedback of a flight.
#[derive(Clone, Debug)]
pub struct Feedback {
    /// The controller.
    pub controller: Arc<dyn ControlModel>,
    /// Time steps from one look to the next, at least [`crate::simulation::control::MIN_INTERVAL`].
    pub interval: usize,
    /// Looks from sensing to the beginning of the transition to the command.
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

    /// Looks from one of its commands to the next; between them the command is kept.
    fn every(&self) -> usize {
        1
    }

    /// When it is to reach each of its waypoints, after the release [s].
    fn arrivals(&self) -> Vec<f64> {
        vec![]
    }

    /// Whether it holds an attitude that does not follow from that at the release; the departure from it is
    /// recorded ([`crate::Record::attitude_departure`]).
    fn holds_attitude(&self) -> bool {
        false
    }

    /// Mean velocity of the straight flight that it holds from the release of a flight of `setup` on, N components [m/s];
    /// none if it holds no place, or one that it does not tell.
    fn velocity(&self, _setup: &FlightSetup) -> Option<DVec3> {
        None
    }

    /// Whether of the place it holds the altitude alone.
    fn holds_only_altitude(&self) -> bool {
        false
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

    fn holds_attitude(&self) -> bool {
        self.attitude(0, 0.0).is_some()
    }
}
