//! `[air]`: the air and the settings of the vortex lattice.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{BladeCase, DerivativesCase, ExternalCase};

/// The air and its model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AirCase {
    /// `vortex_lattice`: non-linear, unsteady, with free wakes; `blade_element`: quasi-steady
    /// strips, fast; `derivatives`: a table of stability derivatives acting on the body;
    /// `external`: a program of your own; `none`: vacuum.
    pub model: AirModel,
    /// Density.
    pub density_kg_m3: f64,
    /// Velocity of the undisturbed air, inertial axes.
    pub stream_m_s: [f64; 3],
    /// Whether head, thorax and abdomen are part of the lattice.
    pub body: bool,
    /// The flight is mirror-symmetric: the air is computed on one half. Lateral motion cannot
    /// grow; a motion that is not symmetric is refused.
    pub mirror: bool,
    /// Edges of the wings that shed wakes.
    pub shed: Vec<EdgeCase>,
    /// Core of the vortex filaments on the surfaces; default a cut-off of 0.01 mean panel
    /// lengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound_core: Option<CoreCase>,
    /// Core of the vortex filaments in the wakes: a physical input of hover. Default as
    /// `bound_core`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wake_core: Option<CoreCase>,
    /// Set of numerical choices: what the keys `circulation_rate`, `convection` and `ring_inset`
    /// are where they are left out. `benchmark`: the published benchmark's, first order;
    /// `accurate`: second order, rings at quarter panels, newest wake row matched to the lattice.
    pub scheme: SchemeCase,
    /// How the rate of change of circulation in the pressure is formed; default by `scheme`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub circulation_rate: Option<CirculationRateCase>,
    /// Least core radius of a free wake filament over its length: keeps wakes resolved that the flow
    /// stretches; default 1, or 0 where `wake_core` is a cut-off, which has no radius.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wake_overlap: Option<f64>,
    /// Length from which a wake filament turns into a vortex blob, wholly at 1.25 times this length; left out: never.
    /// Blobs are summed on a mesh: the cost of long flights then grows with the wake and not with its square.
    /// Two mean chords are a good length; needs `wake_overlap` of 0.5 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wake_blob_length_m: Option<f64>,
    /// How wake nodes are moved; default by `scheme`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convection: Option<ConvectionCase>,
    /// Part of a panel by which rings stay inside side edges that do not shed, 0 to below 0.5;
    /// default by `scheme`: 0 or 0.25.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ring_inset: Option<f64>,
    /// How forces follow from circulations.
    pub loads: LoadMethodCase,
    /// Where the flow leaves leading edges, if `shed` names them.
    pub leading_edge: LeadingEdgeCase,
    /// Threshold of `leading_edge = "angle_of_attack"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leading_edge_threshold_deg: Option<f64>,
    /// Threshold of `leading_edge = "suction"`, the leading-edge suction parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leading_edge_threshold: Option<f64>,
    /// Gusts, added to the stream.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gust: Vec<GustCase>,
    /// Gradient of a steady shear in 1/s, three rows: the velocity (gradient x place) is added to
    /// the stream.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_1_s: Option<[[f64; 3]; 3]>,
    /// A plane through which no air goes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundCase>,
    /// Wake rows older than this are dropped; left out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_age_s: Option<f64>,
    /// Wake rows farther than this from their edge are dropped; left out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_distance_m: Option<f64>,
    /// Rows kept in each wake sheet; left out: all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_rows: Option<usize>,
    /// Longest way of a wake node in a step; left out: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_displacement_m: Option<f64>,
    /// Wake nodes keep this distance from surfaces and do not pass through them, which is
    /// counted and reported; 0 lets them pass (the published benchmark's).
    pub clearance_m: f64,
    /// Vortex particles in place of old or leading-edge rows of wake; left out: rings only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub particles: Option<ParticlesCase>,
    /// Friction and profile drag of the wings' sections, added to the forces of the lattice; left
    /// out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section_drag: Option<SectionDragCase>,
    /// How the velocities of the wakes are summed: `direct`, `single`, `tree`, or whichever is fastest.
    pub summation: SummationCase,
    /// Allowed error of tree and single precision, relative to the velocity; it is checked at every sum.
    /// Below 1e-5 all is in double precision.
    pub summation_tolerance: f64,
    /// Settings of `model = "blade_element"`; the lattice's keys do not matter then.
    #[serde(skip_serializing_if = "is_default")]
    pub blade: BladeCase,
    /// Settings of `model = "derivatives"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivatives: Option<DerivativesCase>,
    /// Settings of `model = "external"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub external: Option<ExternalCase>,
}

fn is_default(case: &BladeCase) -> bool {
    *case == BladeCase::default()
}

impl Default for AirCase {
    fn default() -> Self {
        Self {
            model: AirModel::VortexLattice,
            density_kg_m3: 1.225,
            stream_m_s: [0.0; 3],
            body: true,
            mirror: false,
            shed: vec![EdgeCase::Trailing, EdgeCase::Tip, EdgeCase::Leading],
            bound_core: None,
            wake_core: None,
            wake_overlap: None,
            wake_blob_length_m: None,
            scheme: SchemeCase::Benchmark,
            circulation_rate: None,
            convection: None,
            ring_inset: None,
            loads: LoadMethodCase::Pressure,
            leading_edge: LeadingEdgeCase::Always,
            leading_edge_threshold_deg: None,
            leading_edge_threshold: None,
            gust: Vec::new(),
            shear_1_s: None,
            ground: None,
            max_wake_age_s: None,
            max_wake_distance_m: None,
            max_wake_rows: None,
            max_displacement_m: None,
            clearance_m: 0.0,
            particles: None,
            section_drag: None,
            summation: SummationCase::Auto,
            summation_tolerance: 1e-4,
            blade: BladeCase::default(),
            derivatives: None,
            external: None,
        }
    }
}

/// Vortex particles made of the wakes' rings. A strength may change by half in a step and grow to
/// twice its first size; what would change more is held there, counted and reported.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ParticlesCase {
    /// Newest rows of every sheet that stay rings; left out: all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_rows: Option<usize>,
    /// Whether rows that leave leading edges become particles at once.
    #[serde(default)]
    pub leading_edge: bool,
    /// Radius of new particles; default that of `wake_core` if that has one and
    /// `wake_overlap` is 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Effective kinematic viscosity, with which they spread; default that of `wake_core`, or 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_m2_s: Option<f64>,
    /// How their strengths change.
    #[serde(default)]
    pub stretching: StretchingCase,
}

/// How the strengths of particles change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StretchingCase {
    /// Transpose scheme: keeps the total vorticity.
    #[default]
    Transpose,
    /// Classical scheme.
    Classical,
    /// They stay.
    Omitted,
}

/// How velocities are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SummationCase {
    /// The fastest one.
    Auto,
    /// Every filament at every place, in double precision.
    Direct,
    /// Every filament at every place, in single precision.
    Single,
    /// Far filaments by the expansions of a tree, near ones in single precision.
    Tree,
}

/// Air model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AirModel {
    /// Non-linear unsteady vortex lattice.
    VortexLattice,
    /// Quasi-steady blade elements.
    BladeElement,
    /// Stability derivatives.
    Derivatives,
    /// A program of your own.
    External,
    /// No air.
    None,
}

/// An edge of a wing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EdgeCase {
    /// Trailing edge.
    Trailing,
    /// Wing tip.
    Tip,
    /// Leading edge.
    Leading,
    /// Root.
    Root,
}

/// Regularisation of a vortex filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum CoreCase {
    /// `cut_off = { length_m = ... }`: van Garrel's cut-off (the published benchmark's).
    CutOff {
        /// Cut-off length.
        length_m: f64,
    },
    /// `vatistas = { radius_m = ... }`: Vatistas with n = 2.
    Vatistas {
        /// Core radius.
        radius_m: f64,
    },
    /// `scully = { radius_m = ... }`.
    Scully {
        /// Core radius.
        radius_m: f64,
    },
    /// `lamb_oseen = { radius_m = ..., viscosity_m2_s = ... }`: grows with age.
    LambOseen {
        /// Core radius at age zero.
        radius_m: f64,
        /// Effective kinematic viscosity.
        viscosity_m2_s: f64,
    },
}

/// How the rate of change of circulation is formed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CirculationRateCase {
    /// Backward difference, first order (the published benchmark's).
    Backward,
    /// Backward difference over two steps, second order.
    BackwardSecond,
    /// Left out.
    Omitted,
}

/// Set of numerical choices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SchemeCase {
    /// The published benchmark's: first order.
    Benchmark,
    /// Second order, side edges inset.
    Accurate,
}

/// How wake nodes are moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ConvectionCase {
    /// Explicit Euler, first order (the published benchmark's).
    Euler,
    /// Adams-Bashforth over two steps, second order.
    AdamsBashforth,
}

/// How forces follow from circulations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadMethodCase {
    /// Pressure jump times normal: no leading-edge suction (the published benchmark's).
    Pressure,
    /// Joukowski's force on every segment: with suction.
    Joukowski,
    /// Pressure, and the leading-edge suction turned into normal force (Polhamus's analogy).
    Polhamus,
}

/// Where the flow leaves leading edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LeadingEdgeCase {
    /// Nowhere.
    Never,
    /// Everywhere.
    Always,
    /// Strips whose effective angle of attack exceeds `leading_edge_threshold_deg`.
    AngleOfAttack,
    /// Strips whose leading-edge suction parameter exceeds `leading_edge_threshold`.
    Suction,
}

/// A gust: amplitude times a course in time; give `duration_s` or `table`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GustCase {
    /// Velocity at the height of the gust, inertial axes.
    pub amplitude_m_s: [f64; 3],
    /// When it begins at the origin.
    #[serde(default)]
    pub start_s: f64,
    /// Velocity with which its front travels; left out: it is everywhere at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub front_m_s: Option<[f64; 3]>,
    /// Length of a 1-cosine gust.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Rows of time since the start in s and share of the amplitude, straight lines between.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<Vec<(f64, f64)>>,
}

/// Drag of the sections of wings: `1/2 rho U^2 A C` against the velocity U of the undisturbed air past
/// the strip, `C = friction + cd0 + cd2 alpha^2`, alpha the angle between that velocity and the strip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionDragCase {
    /// Law of the friction.
    #[serde(default)]
    pub friction: FrictionCase,
    /// Kinematic viscosity of the air; needed by the friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity_m2_s: Option<f64>,
    /// Profile drag at zero incidence.
    #[serde(default)]
    pub cd0: f64,
    /// Its growth with the square of the incidence.
    #[serde(default)]
    pub cd2_per_rad2: f64,
}

/// Law of the friction of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FrictionCase {
    /// Laminar flat plate, both sides: `2.656 / sqrt(Re)` (Blasius).
    #[default]
    Blasius,
    /// None.
    None,
}

/// A plane through which no air goes; animal and wake stay on one side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GroundCase {
    /// A point of the plane, inertial axes.
    pub point_m: [f64; 3],
    /// Its normal, of any length, inertial axes.
    pub normal: [f64; 3],
}
