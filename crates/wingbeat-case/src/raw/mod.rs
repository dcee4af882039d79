//! The case file as it is written: every key, its unit in its name, its default.
//!
//! These types are the reference of the case language: their comments are the descriptions of
//! the JSON schema. They hold what the user wrote, nothing validated;
//! [`crate::LoadedCase`] holds the validated setup.

mod air;
mod blade;
mod body;
mod deformation;
mod derivatives;
mod flight;
mod joint;
mod motion;
mod wing;

pub use air::{
    AirCase, AirModel, CirculationRateCase, ConvectionCase, CoreCase, EdgeCase, FrictionCase,
    GroundCase, GustCase, LeadingEdgeCase, LoadMethodCase, ParticlesCase, SchemeCase,
    SectionDragCase, StretchingCase, SummationCase,
};
pub use blade::{
    AddedMassCase, BladeCase, BodyDragCase, OwnCoefficients, PressureCase, RotationCase,
    ViscousCase,
};
pub use body::{BodyCase, OriginCase, PartCase, ProfileCase};
pub use deformation::{BendingCase, CamberCase, CourseCase, DeformationCase, TwistCase};
pub use derivatives::{DerivativesCase, DimensionlessCase, ExternalCase};
pub use flight::{
    AngleOscillation, BaumgarteCase, DynamicsCase, FlightCase, Formulation, FrameCase,
    IntegratorCase, LoadCase, Mode, PathOscillation, StabilisationCase, TetherCase, WingInertia,
};
pub use joint::{
    ElementCase, FollowCase, JointCase, JointKind, SegmentCase, SeriesCase, StopCase, TravelCase,
    TurnCase,
};
pub use motion::{
    AngleCase, FourierCase, MotionCase, OvalCase, ShapedCase, StartCase, TableCase, WingMotionCase,
};
pub use wing::{
    BetaCase, OutlineCase, PlanformCase, RectangleCase, SideCase, SpacingCase, WingCase,
    WingMeshCase,
};

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wingbeat case: an animal or vehicle, its wing motion, the air, the numerics, the output.
///
/// Units are part of the key (`_m`, `_kg`, `_s`, `_deg`, `_hz`, ...). Axes: inertial n3 down;
/// body b1 forward, b2 right, b3 down; wing axis 1 towards the leading edge, axis 2 to the right
/// (span of a right wing), axis 3 the normal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Version of the case language: 1.
    pub format: u32,
    /// Name of the case, used for the result directory. Default: name of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// One line about the case.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Acceleration of gravity, inertial axes (n3 down).
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
    /// Extra forces and couples, one `[[load]]` each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub load: Vec<LoadCase>,
}

fn gravity() -> [f64; 3] {
    [0.0, 0.0, 9.81]
}

/// Size of the whole animal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AnimalCase {
    /// Every length times this, masses times its cube, inertias times its fifth power: the same
    /// animal in another size.
    pub scale: f64,
}

impl Default for AnimalCase {
    fn default() -> Self {
        Self { scale: 1.0 }
    }
}

/// Time steps: `steps_per_beat` and `beats`, or `step_s` and `steps`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TimeCase {
    /// Steps per wingbeat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_per_beat: Option<usize>,
    /// Wingbeats to fly.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beats: Option<f64>,
    /// Length of a step.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step_s: Option<f64>,
    /// Number of steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
}

/// Corrector iteration: bodies and air are brought to agreement in every step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CorrectorCase {
    /// Largest change between two passes, relative to natural sizes, that counts as converged.
    pub tolerance: f64,
    /// Most passes; more is an error.
    pub max_passes: usize,
    /// Relaxation in (0, 1]; below 1 for light bodies with large wings.
    pub relaxation: f64,
}

impl Default for CorrectorCase {
    fn default() -> Self {
        let d = wingbeat_flight::CorrectorSettings::default();
        Self {
            tolerance: d.tolerance,
            max_passes: d.max_passes,
            relaxation: d.relaxation,
        }
    }
}

/// What is written beside the history.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputCase {
    /// Write surfaces and wakes (.vtp) every so many steps; 0 writes none.
    pub frames_every: usize,
    /// Draw figures (.svg) at the end.
    pub figures: bool,
    /// Write the flight page (flight.html) at the end.
    pub page: bool,
    /// Save the state for `wingbeat resume` every so many steps; 0: not by steps.
    pub checkpoint_every: usize,
    /// Save the state after so much wall time; 0: not by time.
    pub checkpoint_interval_s: f64,
    /// Keep the state after the last step, for `wingbeat velocity`.
    pub keep_checkpoint: bool,
}

impl Default for OutputCase {
    fn default() -> Self {
        Self {
            frames_every: 2,
            figures: true,
            page: true,
            checkpoint_every: 0,
            checkpoint_interval_s: 20.0,
            keep_checkpoint: false,
        }
    }
}
