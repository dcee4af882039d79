//! `[wing.NAME.deformation]`: how a wing changes its shape over the beat.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use wingbeat_model::Deformation;

/// Prescribed deformation of a wing: the sum of its terms, each a law along the span times a series
/// in time; or its measured surface. The air sees it; for its inertia the wing stays rigid.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DeformationCase {
    /// Position of the twist axis behind the leading edge over the chord.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0, max = 1), extend("with" = "twist"))]
    #[default(Deformation::default().axis_fraction)]
    pub axis_fraction: f64,
    /// Position of the highest camber behind the leading edge over the chord.
    ///
    /// Change it to what was measured.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1, "with" = "camber"))]
    #[default(Deformation::default().camber_peak)]
    pub camber_peak: f64,
    /// Twist of the sections about the axis, positive like feathering: leading edge towards -axis 3.
    ///
    /// Change it to what was measured; terms add up.
    #[schemars(extend("with" = "no surface"))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub twist: Vec<TwistCase>,
    /// Height of the mean line over the local chord, positive towards -axis 3. The vortex lattice takes it; blade
    /// elements leave it out beside twist and bending, and refuse it alone.
    ///
    /// Change it to what was measured; terms add up.
    #[schemars(extend("with" = "no surface"))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub camber: Vec<CamberCase>,
    /// Displacement of the sections towards -axis 3.
    ///
    /// Change it to what was measured; terms add up.
    #[schemars(extend("with" = "no surface"))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bending: Vec<BendingCase>,
    /// The surface as it was measured over the beat, instead of twist, camber and bending.
    #[schemars(extend("with" = "air.model = vortex_lattice"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceCase>,
}

/// A wing's surface at phases of its beat. Each point's course is a Fourier series, fitted by least squares.
/// The planform is the wing at rest: it says where the nodes of the mesh lie, in parts of chord and span, and
/// what its inertia is.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceCase {
    /// Phases of the wing's own beat in wingbeats, rising, all within one beat.
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 3))]
    pub phases: Vec<f64>,
    /// Points of the surface, phase by phase: rows at equal parts of the chord from the leading to the trailing
    /// edge, each with points at equal parts of the span from root to tip. A point is [position along axis 1
    /// from the hinge, distance outboard of the hinge along axis 2 (positive on wings of either side), position
    /// along axis 3 from the hinge].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 3))]
    pub nodes_m: Vec<Vec<Vec<[f64; 3]>>>,
    /// Harmonics of the series: two neighbouring phases must be less than 1 / (2 harmonics) wingbeats apart.
    ///
    /// Change it to see what depends on the fastest part of the motion.
    #[schemars(range(min = 1))]
    #[default = 4]
    #[serde(default = "harmonics")]
    pub harmonics: usize,
}

fn harmonics() -> usize {
    SurfaceCase::default().harmonics
}

/// A term of the twist: `linear_deg` or `table_deg`, times `fourier`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TwistCase {
    /// Values at root and tip of the surface, linear between.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_deg: Option<[f64; 2]>,
    /// Rows [r/R, value] from the root (or the hinge, 0) to the tip (1), straight lines between.
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "linear_deg"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table_deg: Option<Vec<[f64; 2]>>,
    /// Course over the beat; left out: always 1.
    ///
    /// Change it for shapes that change over the beat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fourier: Option<CourseCase>,
}

/// A term of the camber: `linear` or `table`, times `fourier`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CamberCase {
    /// Heights over the chord at root and tip of the surface, linear between.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear: Option<[f64; 2]>,
    /// Rows [r/R, height over the chord] from the root (or the hinge, 0) to the tip (1).
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "linear"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<Vec<[f64; 2]>>,
    /// Course over the beat; left out: always 1.
    ///
    /// Change it for shapes that change over the beat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fourier: Option<CourseCase>,
}

/// A term of the bending: `linear_m` or `table_m`, times `fourier`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BendingCase {
    /// Displacements at root and tip of the surface, linear between.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_m: Option<[f64; 2]>,
    /// Rows [r/R, displacement] from the root (or the hinge, 0) to the tip (1).
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "linear_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table_m: Option<Vec<[f64; 2]>>,
    /// Course over the beat; left out: always 1.
    ///
    /// Change it for shapes that change over the beat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fourier: Option<CourseCase>,
}

/// `mean + sum_k cosine_k cos(2 pi k x) + sine_k sin(2 pi k x)`, x the phase of the wing in
/// wingbeats, k = 1, 2, ...
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CourseCase {
    /// Mean (not halved).
    ///
    /// Change it to what was measured.
    pub mean: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what was measured.
    pub cosine: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what was measured.
    pub sine: Vec<f64>,
}
