//! The case file as it is written: every key with its unit in its name, its default, its range and
//! when to change it, all in one place.
//!
//! These types are the reference of the case language: `crate::keys` makes the JSON schema, the
//! checks of single keys and the page of all keys from them. What stands where:
//!
//! | of a key | where |
//! |---|---|
//! | meaning, when to change it | the comment; its last paragraph begins with "Change it" |
//! | default | `default`; `Option`: none; [`Open`]: follows from other keys |
//! | range | `range`, `exclusiveMinimum`, `exclusiveMaximum`, `length` |
//! | when it has an effect | `with`: another key that has one of these values, is given, or is not given (`no`) |
//! | what it is an alternative to | `or`: of these only one may be given |
//!
//! They hold what the user wrote; [`crate::LoadedCase`] holds the validated setup.

mod air;
mod blade;
mod body;
mod control;
mod cores;
mod deformation;
mod derivatives;
mod flight;
mod joint;
mod load;
mod motion;
mod open;
mod structure;
mod wake;
mod wind;
mod wing;

pub use air::{AirCase, AirModel, LeadingEdgeCase, SchemeCase};
pub use blade::{
    BladeCase, BodyDragCase, OwnCoefficients, RotationCase, UnsteadyCase, ViscousCase,
};
pub use body::{BodyCase, OriginCase, PartCase, ProfileCase};
pub use control::{
    ControlCase, ControllerCase, ObserverCase, SensorsCase, StiffnessCase, TargetCase,
    WaypointCase, WeightsCase,
};
pub use cores::{CoreCase, CutOffCase, LambOseenCase, RadiusCase};
pub use deformation::{
    BendingCase, CamberCase, CourseCase, DeformationCase, SurfaceCase, TwistCase,
};
pub use derivatives::{DerivativesCase, DimensionlessCase, ExternalCase};
pub use flight::{
    AngleOscillation, BaumgarteCase, DynamicsCase, FlightCase, Formulation, IntegratorCase, Mode,
    PathOscillation, StabilisationCase, TetherCase, WingInertia,
};
pub use joint::{
    ElementCase, FollowCase, JointCase, JointKind, SegmentCase, SeriesCase, StopCase, TravelCase,
    TurnCase,
};
pub use load::{LoadCase, SpringCase};
pub(crate) use motion::ANGLES;
pub use motion::{
    AdjustCase, AngleCase, FourierCase, MotionCase, OvalCase, ShapedCase, SplitCycleCase,
    StartCase, TableCase, WingMotionCase,
};
pub use open::Open;
pub use structure::{
    BeamCase, BeamMassCase, RegionCase, ShellCase, ShellRule, StructureCase, VeinCase,
};
pub use wake::{FrictionCase, ParticlesCase, SectionDragCase};
pub use wind::{GroundCase, GustCase, TurbulenceCase, VortexStreetCase};
pub use wing::{BetaCase, OutlineCase, PlanformCase, RectangleCase, WingCase, WingMeshCase};

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use wingbeat_flight::CorrectorSettings;

/// A wingbeat case: an animal or vehicle, its wing motion, the air, the numerics, the output.
///
/// Units are part of the key (`_m`, `_kg`, `_s`, `_deg`, `_hz`, ...). Axes: inertial n3 down;
/// body b1 forward, b2 right, b3 down; wing axis 1 towards the leading edge, axis 2 to the right
/// (span of a right wing), axis 3 the normal.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Version of the case language.
    ///
    /// Change it never: this version of wingbeat reads 1.
    #[default = 1]
    #[schemars(range(min = 1, max = 1))]
    pub format: u32,
    /// Name of the case, used for the result directory. Default: name of the file.
    ///
    /// Change it to tell runs apart.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// One line about the case.
    ///
    /// Change it to say what the case is for.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Acceleration of gravity, inertial axes (n3 down).
    ///
    /// Change it to zeros to see the forces of the air alone.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    #[default(gravity())]
    #[serde(default = "gravity")]
    pub gravity_m_s2: [f64; 3],
    /// Size of the whole animal.
    #[serde(default)]
    pub animal: AnimalCase,
    /// Time steps.
    #[serde(default)]
    pub time: TimeCase,
    /// What all wings share in their motion.
    #[serde(default)]
    pub motion: MotionCase,
    /// Free or tethered, and the start.
    #[serde(default)]
    pub flight: FlightCase,
    /// Equations of motion.
    #[serde(default)]
    pub dynamics: DynamicsCase,
    /// Corrector iteration of a step.
    #[serde(default)]
    pub corrector: CorrectorCase,
    /// The air.
    #[serde(default)]
    pub air: AirCase,
    /// Feedback in the loop of the flight; left out: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlCase>,
    /// What is written.
    #[serde(default)]
    pub output: OutputCase,
    /// The central body.
    pub body: BodyCase,
    /// Wings by name, e.g. `[wing.right]`; a right wing brings its mirror image along.
    #[serde(default)]
    pub wing: BTreeMap<String, WingCase>,
    /// Further rigid bodies by name, e.g. `[segment.abdomen]`; each needs a joint.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub segment: BTreeMap<String, SegmentCase>,
    /// Joints by name, e.g. `[joint.waist]`. The first joint (by name) that has a body as its child
    /// carries it, others close loops. Wings without a joint hang on the body, their motion
    /// prescribed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joint: BTreeMap<String, JointCase>,
    /// Springs and dampers between points of two bodies, by name, e.g. `[spring.tendon]`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub spring: BTreeMap<String, SpringCase>,
    /// Extra forces and couples, one `[[load]]` each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub load: Vec<LoadCase>,
}

fn gravity() -> [f64; 3] {
    [0.0, 0.0, 9.81]
}

/// Size of the whole animal.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AnimalCase {
    /// Every length times this, masses times its cube, inertias times its fifth power: the same
    /// animal in another size. Lengths of `[air]` stay as they are given: cores and clearance in metres are to be
    /// scaled, too, or given in chords (`radius_chords`, `clearance_chords`).
    ///
    /// Change it to study the influence of size.
    #[default = 1.0]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub scale: f64,
}

/// Time steps: `steps_per_beat` and `beats`, or `step_s` and `steps`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TimeCase {
    /// Steps per wingbeat. Default: 40, if `step_s` is left out.
    ///
    /// Change it to 60 or 80 to see what depends on the step.
    #[schemars(range(min = 4))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_per_beat: Option<usize>,
    /// Wingbeats to fly. Default: 5, if `steps` is left out.
    ///
    /// Change it for longer flights; in the lattice the cost of a beat grows nearly with the square of its number.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beats: Option<f64>,
    /// Length of a step.
    ///
    /// Change it for wings that do not beat.
    #[schemars(extend("exclusiveMinimum" = 0, "or" = "steps_per_beat"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step_s: Option<f64>,
    /// Number of steps.
    ///
    /// Change it for wings that do not beat.
    #[schemars(range(min = 1), extend("or" = "beats"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
}

/// Integrators whose steps are solved by iteration.
const ITERATED: &str = "dynamics.integrator = hamming | bdf";

/// Corrector iteration: bodies and air are brought to agreement in every step.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CorrectorCase {
    /// Largest change between two passes, relative to natural sizes, that counts as converged.
    ///
    /// Change it for studies of convergence: where it is large, passes are left out.
    #[default(CorrectorSettings::default().tolerance)]
    #[schemars(range(max = 1e-3), extend("exclusiveMinimum" = 0, "with" = ITERATED))]
    pub tolerance: f64,
    /// Most passes; more is an error. What has not converged after a hundred passes will not.
    ///
    /// Change it together with `relaxation`.
    #[default(CorrectorSettings::default().max_passes)]
    #[schemars(range(min = 1, max = 10_000), extend("with" = ITERATED))]
    pub max_passes: usize,
    /// Relaxation: 1 takes each pass whole.
    ///
    /// Change it to less than 1 where passes do not converge.
    #[default(CorrectorSettings::default().relaxation)]
    #[schemars(range(max = 1), extend("exclusiveMinimum" = 0, "with" = ITERATED))]
    pub relaxation: f64,
}

/// What is written beside the history.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputCase {
    /// Write a row of history.csv every so many steps, and at every wingbeat, frame and end; sums and extremes
    /// in a row are those of all steps since the row before.
    ///
    /// Change it to keep the history of a long flight small; means of wingbeats stay the same.
    #[default = 1]
    #[schemars(range(min = 1))]
    pub history_every: usize,
    /// Write surfaces and wakes (.vtp) of the vortex lattice every so many steps; 0 writes none, nor does other air.
    ///
    /// Change it to 0 for long flights whose wakes nobody looks at.
    #[default = 2]
    pub frames_every: usize,
    /// Draw figures (.svg) at the end.
    ///
    /// Change it to false in studies of many flights.
    #[default = true]
    pub figures: bool,
    /// Write the flight page (flight.html) at the end.
    ///
    /// Change it to false in studies of many flights.
    #[default = true]
    pub page: bool,
    /// Save the state for `wingbeat resume` every so many steps; 0: not by steps. Flights in the air of another program
    /// (`air.model` = `external`) have no states, whatever this and the two that follow say.
    ///
    /// Change it to have states at known steps.
    pub checkpoint_every: usize,
    /// Save the state after so much wall time; 0: not by time.
    ///
    /// Change it to lose less, or write less, of a long flight.
    #[default = 20.0]
    #[schemars(range(min = 0, max = 1e15))]
    pub checkpoint_interval_s: f64,
    /// Keep the state after the last step.
    ///
    /// Change it to true for `wingbeat velocity`.
    pub keep_checkpoint: bool,
}
