//! The interface of the air: what the equations of motion ask of it, and what is asked of another
//! program that stands behind it.

pub(crate) mod air_probe;
pub(crate) mod controller;
pub(crate) mod memory;
pub mod record;

use std::fmt;

use wingbeat_air::{AirLoads, AirWorkspace, NodeMotion, Points};
use wingbeat_blade::{SectionAnswer, SectionMotion, SectionState, StripTrial};
use wingbeat_dynamics::{AddedMass, BodyAcceleration, BodyMotion, Wrench};
use wingbeat_math::{DVec3, Six};

use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::interface::record::{Snapshot, SurfaceSnapshot};

/// What is said of models of the air in which no wing can bend.
pub(crate) const NO_BENDING: &str = "it gives no loads along the wings, so no wing can bend in it: take vortex_lattice, blade_element or none, or leave out [wing.NAME.structure]";

/// The bodies at one instant, as the air sees them.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// Time [s].
    pub time: f64,
    /// Time step of the flight [s].
    pub step: f64,
    /// Motions of all bodies: root, wings, segments.
    pub motions: &'a [BodyMotion],
    /// Their accelerations as far as they are known; empty where no wing bends.
    pub accelerations: &'a [BodyAcceleration],
    /// Shapes of the wings that loads bend, wing by wing; none for the others, empty where no wing bends.
    pub shapes: &'a [Option<BentShape>],
}

impl<'a> Instant<'a> {
    /// Bodies that move like `motions` at `time` \[s\], in steps of `step` \[s\]; no wing bends.
    pub fn rigid(time: f64, step: f64, motions: &'a [BodyMotion]) -> Self {
        Self {
            time,
            step,
            motions,
            accelerations: &[],
            shapes: &[],
        }
    }
}

/// A wing as loads bend it: the nodes of its mesh relative to the frame of the wing, wing components.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BentShape {
    /// Places [m].
    pub position: Vec<DVec3>,
    /// Velocities [m/s].
    pub velocity: Vec<DVec3>,
    /// Accelerations [m/s2].
    pub acceleration: Vec<DVec3>,
}

/// How the normal forces of the panels of a wing answer to the motion of the nodes of its mesh, in frozen
/// wakes; of blade elements, how the forces of each section along three ways to move it do
/// ([`wingbeat_blade::SectionAnswer`]).
#[derive(Clone, Debug, Default)]
pub struct WingResponse {
    /// Derivative of the normal forces by the normal velocities of the panels \[N s/m\] or by their
    /// accelerations \[kg\], row by row.
    pub matrix: Vec<f64>,
    /// Derivative of the forces by accelerations \[kg\] where the air answers to them at once; else empty.
    pub inertia: Vec<f64>,
    /// Panel by panel: how a node of the mesh (its number among the wing's) shares in the panel's normal force
    /// \[1\], and how the panel's normal velocity changes with the node's velocity \[1\] and place \[1/s\]; N
    /// components.
    pub panels: Vec<Vec<(usize, [DVec3; 2])>>,
}

/// The air that a rigid wing carries along, as loads hold it in which rates are differences over steps: of them
/// `-A (w0 q + w1 q1 + w2 q2)`, with q, q1 and q2 the velocity of the wing's origin and its angular velocity
/// \[m/s, rad/s\] now and in the last two accepted steps, wing components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WingInertia {
    /// A: rows force and moment about the origin, columns acceleration of the origin and angular acceleration, wing
    /// components \[kg, kg m, kg m2\].
    pub mass: [[f64; 6]; 6],
    /// w0, w1, w2 \[1/s\].
    pub rate_weights: [f64; 3],
}

/// Room for intermediate results of the air; what it holds belongs to the instant last asked for.
#[derive(Default)]
pub struct AirScratch {
    /// Nodes of the lattice.
    pub nodes: NodeMotion,
    /// Circulations, pressure jumps, panel forces.
    pub loads: AirLoads,
    pub(crate) rings: NodeMotion,
    pub(crate) workspace: AirWorkspace,
    pub(crate) nodes_done: NodeMotion,
    pub(crate) is_current: bool,
    /// Forces on the nodes of a wing \[N\], N components.
    pub(crate) nodal: Vec<DVec3>,
    pub(crate) bent: BentScratch,
    pub(crate) strips: StripScratch,
    pub(crate) answer: AnswerScratch,
}

/// How panels of a rigid wing answer to accelerations \[kg\], row by row, and what they do in its six motions.
#[derive(Debug, Default)]
pub(crate) struct AnswerScratch {
    pub response: Vec<f64>,
    pub moved: Vec<Six>,
}

/// Room for blade elements on a wing that loads bend: its nodes, wing components, its sections, and the forces
/// on the nodes wing by wing \[N\].
#[derive(Debug, Default)]
pub(crate) struct BentScratch {
    pub position: Vec<DVec3>,
    pub velocity: Vec<DVec3>,
    pub acceleration: Vec<DVec3>,
    pub states: Vec<SectionState>,
    pub answers: Vec<SectionAnswer>,
    pub forces: Vec<Vec<DVec3>>,
}

/// Room for blade elements: the strips at the time last asked for \[s\], wing by wing where their wakes are remembered.
#[derive(Debug, Default)]
pub(crate) struct StripScratch {
    pub time: f64,
    pub trials: Vec<Vec<StripTrial>>,
    /// How the strips of the wing last looked at lie and move.
    pub sections: Vec<SectionMotion>,
    /// Those of a wing that is asked how it answers.
    pub asked: Vec<StripTrial>,
}

/// Air around bodies that move.
///
/// An air answers with two things: loads that follow from positions, velocities and its own memory
/// (a wake), and masses that bodies carry along ([`AddedMass`]), which join the inertia of the
/// bodies. Within a step the memory is frozen; it moves on once per step and is accepted with the
/// motion that the corrector found.
pub trait Air: fmt::Debug + Send + Sync {
    /// Loads about the origins of all bodies, N components, but for those of the added mass.
    ///
    /// # Errors
    /// What the model reports.
    fn loads(
        &self,
        at: &Instant<'_>,
        memory: Option<&AirMemory>,
        scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError>;

    /// Masses that the bodies carry along at time `t` [s], into `out`, which is empty: a function of time alone, asked
    /// once for all states at that time.
    fn added_mass(&self, _t: f64, _scratch: &mut AirScratch, _out: &mut Vec<AddedMass>) {}

    /// Whether loads depend on the past.
    fn has_memory(&self) -> bool {
        false
    }

    /// Whether the loads depend on the motion of the bodies alone, not on time or place besides, as in gusts, shear or
    /// over a ground. A wingbeat may then be like the next.
    fn is_steady_and_uniform(&self) -> bool {
        true
    }

    /// Room for intermediate results.
    fn scratch(&self) -> AirScratch {
        AirScratch::default()
    }

    /// Puts the surfaces where the bodies are.
    ///
    /// # Errors
    /// Surfaces that do not fit together.
    fn place(&self, _at: &Instant<'_>, _scratch: &mut AirScratch) -> Result<(), FlightError> {
        Ok(())
    }

    /// The memory before the first step, the surfaces placed.
    fn initial(&self, _scratch: &AirScratch) -> Option<AirMemory> {
        None
    }

    /// Moves the memory on by one `step` [s].
    ///
    /// # Errors
    /// Velocities that are not finite.
    fn advance(
        &self,
        _memory: &mut Option<AirMemory>,
        _step: f64,
        _scratch: &mut AirScratch,
    ) -> Result<(), FlightError> {
        Ok(())
    }

    /// Accepts the instant last asked for.
    ///
    /// # Errors
    /// The memory has not been moved on.
    fn accept(
        &self,
        _memory: &mut Option<AirMemory>,
        _scratch: &AirScratch,
    ) -> Result<(), FlightError> {
        Ok(())
    }

    /// Checks that a saved memory is one of this air.
    ///
    /// # Errors
    /// What does not fit.
    fn check(&self, memory: Option<&AirMemory>) -> Result<(), FlightError> {
        match memory {
            None => Ok(()),
            Some(_) => Err(misfit("the case has no air with a memory")),
        }
    }

    /// Forces on the nodes of the mesh of wing number `wing` \[N\], N components, into `out`: what the loads
    /// last asked for do to it, the same force, moment and power.
    ///
    /// # Errors
    /// A model that knows no wings that bend.
    fn nodal_forces(
        &self,
        _wing: usize,
        _at: &Instant<'_>,
        _scratch: &mut AirScratch,
        _out: &mut Vec<DVec3>,
    ) -> Result<(), FlightError> {
        let model = "this model";
        Err(FlightError::setup("air.model", model, NO_BENDING))
    }

    /// How the loads on a wing that bends answer to the motion of its nodes, at the instant last asked for,
    /// into `out`: for the left-hand side of a step. False if they hardly do.
    ///
    /// # Errors
    /// What the model reports.
    fn wing_response(
        &self,
        _wing: usize,
        _at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        _out: &mut WingResponse,
    ) -> Result<bool, FlightError> {
        Ok(false)
    }

    /// The added mass of the rigid wing number `wing` that the loads last asked for hold as a difference over
    /// steps; none if they hold none.
    ///
    /// # Errors
    /// What the model reports.
    fn wing_inertia(
        &self,
        _wing: usize,
        _at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
    ) -> Result<Option<WingInertia>, FlightError> {
        Ok(None)
    }

    /// At the first instant, whose loads hold no rates of circulations: what these rates are to these rigid `wings`,
    /// added to `out`, N components, where velocities change from those of `at` to those of `pushed` within a step and
    /// nothing moves. False where loads hold such rates or never do.
    ///
    /// # Errors
    /// What the model reports.
    fn rate_loads_at_start(
        &self,
        _wings: &[usize],
        _at: &Instant<'_>,
        _pushed: &[BodyMotion],
        _memory: Option<&AirMemory>,
        _scratch: &AirScratch,
        _out: &mut [Wrench],
    ) -> Result<bool, FlightError> {
        Ok(false)
    }

    /// Whether loads on wings that bend follow their accelerations within a step ([`WingResponse::inertia`]).
    fn follows_accelerations(&self) -> bool {
        false
    }

    /// Whether any wing moves otherwise than its body.
    fn deforms(&self) -> bool {
        false
    }

    /// Power that is needed to deform the wings against the air [W], body by body.
    fn deformation_power(
        &self,
        _at: &Instant<'_>,
        _accelerations: &[BodyAcceleration],
        _scratch: &mut AirScratch,
        _out: &mut [f64],
    ) {
    }

    /// Wings, then body parts, as surfaces at the instant last asked for; none where the model has none.
    fn surfaces(&self, _scratch: &AirScratch) -> Vec<SurfaceSnapshot> {
        Vec::new()
    }

    /// Surfaces and wakes at the instant last asked for; none where there are none.
    fn snapshot(&self, _memory: Option<&AirMemory>, _scratch: &AirScratch) -> Snapshot {
        Snapshot::default()
    }

    /// Velocity of the air [m/s] at `points` [m], N components; none where the model has none.
    ///
    /// # Errors
    /// What the model reports.
    fn velocity(
        &self,
        _memory: Option<&AirMemory>,
        _points: &Points,
    ) -> Result<Option<Points>, FlightError> {
        Ok(None)
    }
}

/// A memory that belongs to another case.
pub(crate) fn misfit(problem: &str) -> FlightError {
    FlightError::misfit("air", problem)
}

/// What a partner gets before the flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Announcement {
    /// Names of all bodies, in the order of their motions: root, wings, segments.
    pub bodies: Vec<String>,
    /// All joints: name, parent and child as indices of bodies.
    pub joints: Vec<(String, usize, usize)>,
    /// Time step [s].
    pub step: f64,
}

/// Air computed by someone else.
pub trait ExternalAir: fmt::Debug + Send + Sync {
    /// Begins a flight.
    ///
    /// # Errors
    /// What keeps the partner from answering.
    fn open(&self, flyer: &Announcement) -> Result<Box<dyn ExternalSession>, String>;
}

/// A flight in such air.
pub trait ExternalSession: Send {
    /// Loads about the origins of the bodies, N components, if they move like `motions` at step
    /// number `step`, time `time` [s].
    ///
    /// # Errors
    /// What the partner says.
    fn loads(
        &mut self,
        step: usize,
        time: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String>;

    /// The motion asked for last is that of step number `step`.
    ///
    /// # Errors
    /// What the partner says.
    fn accept(&mut self, step: usize) -> Result<(), String>;
}
