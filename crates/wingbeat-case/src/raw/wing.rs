//! `[wing.NAME]`: shape, mesh, mass and hinge of a wing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{DeformationCase, WingMotionCase};

/// One wing. What a left wing leaves out it takes from the mirror image of its right twin, and
/// the other way round (`left` and `right` in the names make twins).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WingCase {
    /// Side of the body; default from the name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<SideCase>,
    /// Whether the mirror image on the other side comes along when it is not given; default true.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mirror: Option<bool>,
    /// Hinge in body axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hinge_m: Option<[f64; 3]>,
    /// Outline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub planform: Option<PlanformCase>,
    /// Panels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<WingMeshCase>,
    /// Mass of this wing, spread evenly over its area if nothing else is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Mass per area, instead of `mass_kg`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub areal_density_kg_m2: Option<f64>,
    /// Mass per area over the span, instead of `mass_kg`: rows [distance from the hinge in m,
    /// areal density in kg/m2].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub areal_density_table_m_kg_m2: Option<Vec<[f64; 2]>>,
    /// Mass centre in wing axes from the hinge, with `mass_kg` and the inertia.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Inertia matrix about the mass centre in wing axes: xx, yy, zz, xy, xz, yz (elements of
    /// the matrix: a product carries its minus sign).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_about_centre_kg_m2: Option<[f64; 6]>,
    /// Motion of this wing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<WingMotionCase>,
    /// Twist, camber and bending of this wing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deformation: Option<DeformationCase>,
    /// Whether the wing shares the edge at its root with its twin on the other side: one lifting
    /// surface without a vortex in the middle. The roots must meet. Default false.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joined: Option<bool>,
}

/// Side of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SideCase {
    /// Spans along -axis 2.
    Left,
    /// Spans along +axis 2.
    Right,
}

/// Panels of a wing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WingMeshCase {
    /// Panels along the chord.
    pub chordwise: usize,
    /// Panels along the span.
    pub spanwise: usize,
    /// Spacing along the chord.
    pub chordwise_spacing: SpacingCase,
    /// Spacing along the span.
    pub spanwise_spacing: SpacingCase,
}

impl Default for WingMeshCase {
    fn default() -> Self {
        Self {
            chordwise: 4,
            spanwise: 10,
            chordwise_spacing: SpacingCase::Uniform,
            spanwise_spacing: SpacingCase::Uniform,
        }
    }
}

/// Spacing of panel lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SpacingCase {
    /// Equal.
    Uniform,
    /// Dense at both ends.
    Cosine,
}

/// Outline of a wing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlanformCase {
    /// `[wing.right.planform.beta]`: an insect's wing from length, chord and r2_hat.
    Beta(BetaCase),
    /// `[wing.right.planform.rectangle]`: constant chord.
    Rectangle(RectangleCase),
    /// `[wing.right.planform.outline]`: measured edges.
    Outline(OutlineCase),
}

/// Ellington's beta distribution of the chord. One of `mean_chord_m`, `area_m2`, `max_chord_m`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BetaCase {
    /// Wing length R, hinge to tip.
    pub length_m: f64,
    /// Mean chord S/R.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_chord_m: Option<f64>,
    /// Area of this wing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area_m2: Option<f64>,
    /// Largest chord.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_chord_m: Option<f64>,
    /// Radius of the second moment of area about the hinge over R.
    pub r2_hat: f64,
    /// Distance from the hinge to the root of the surface.
    #[serde(default)]
    pub root_offset_m: f64,
    /// Part of the chord ahead of the hinge axis, 0 to 1.
    #[serde(default = "quarter")]
    pub axis_fraction: f64,
    /// Least chord at root and tip relative to the largest.
    #[serde(default = "least_chord")]
    pub least_chord: f64,
}

/// Constant chord.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleCase {
    /// Chord.
    pub chord_m: f64,
    /// Span from root to tip.
    pub span_m: f64,
    /// Distance from the hinge to the root.
    #[serde(default)]
    pub root_offset_m: f64,
    /// Part of the chord ahead of the hinge axis, 0 to 1.
    #[serde(default = "quarter")]
    pub axis_fraction: f64,
}

/// Edges as points [distance from the hinge along the span, position towards the leading edge].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutlineCase {
    /// Leading edge from root to tip.
    pub leading_m: Vec<[f64; 2]>,
    /// Trailing edge from root to tip.
    pub trailing_m: Vec<[f64; 2]>,
    /// Least chord relative to the largest: narrower places are widened to it.
    #[serde(default = "least_chord")]
    pub least_chord: f64,
}

fn quarter() -> f64 {
    0.25
}

fn least_chord() -> f64 {
    0.2
}
