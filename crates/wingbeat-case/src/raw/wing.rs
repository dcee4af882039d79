//! `[wing.NAME]`: shape, mesh, mass and hinge of a wing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use wingbeat_model::Side;
use wingbeat_model::planform::Spacing;

use super::{DeformationCase, StructureCase, WingMotionCase};

/// One wing. What a left wing leaves out it takes from the mirror image of its right counterpart, and
/// the other way round (`left` and `right` in the names make pairs). A table such as `planform` or `mesh` that
/// it gives takes the place of the whole of the other's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WingCase {
    /// Side of the body. Left out: by the word `left` or `right` in the name.
    ///
    /// Change it for wings whose name does not tell the side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<Side>,
    /// Whether the mirror image on the other side comes along when it is not given, and has the joint of this
    /// wing if it has none. Left out: true.
    ///
    /// Change it to false for a single wing, or for a joint on one side alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mirror: Option<bool>,
    /// Hinge in body axes. Left out of a wing that another wing carries (`joint.NAME.parent`): its place is `at_m` of the
    /// joint, and another one is refused.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hinge_m: Option<[f64; 3]>,
    /// Outline.
    ///
    /// Change it to the wing that was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub planform: Option<PlanformCase>,
    /// Panels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<WingMeshCase>,
    /// Mass of this wing, spread evenly over its area if nothing else is said; 0 is allowed.
    ///
    /// Change it to the mass that was measured: an insect's wing has 0.5 to 1 % of the body's.
    #[schemars(range(min = 0, max = 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Mass per area, instead of `mass_kg`.
    ///
    /// Change it where the membrane was weighed and not the wing.
    #[schemars(range(min = 0, max = 1e9), extend("or" = "mass_kg"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub areal_density_kg_m2: Option<f64>,
    /// Mass per area over the span, instead of `mass_kg`: rows [distance from the hinge in m,
    /// areal density in kg/m2].
    ///
    /// Change it where wings were cut into strips and weighed.
    #[schemars(extend("or" = ["mass_kg", "areal_density_kg_m2"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub areal_density_table_m_kg_m2: Option<Vec<[f64; 2]>>,
    /// Mass centre in wing axes from the hinge. Left out: the hinge.
    ///
    /// Change it to what was measured.
    #[schemars(extend("with" = "inertia_about_centre_kg_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Inertia matrix about the mass centre in wing axes: xx, yy, zz, xy, xz, yz (elements of
    /// the matrix: a product carries its minus sign). Left out: that of the even mass.
    /// Moments rounded to three digits are accepted: a largest one that exceeds the sum of the two
    /// others by up to 0.5 % is lowered to it.
    ///
    /// Change it to what was measured.
    #[schemars(extend("with" = "mass_kg"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_about_centre_kg_m2: Option<[f64; 6]>,
    /// Motion of this wing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<WingMotionCase>,
    /// Twist, camber and bending of this wing, or its measured surface.
    #[schemars(extend("with" = "air.model = vortex_lattice | blade_element"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deformation: Option<DeformationCase>,
    /// What this wing is made of; left out: it is rigid but for a prescribed deformation.
    #[schemars(extend("with" = "air.model = vortex_lattice | blade_element | none", "or" = "deformation"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub structure: Option<StructureCase>,
    /// Whether the wing shares the edge at its root with its counterpart on the other side: one lifting
    /// surface without a vortex in the middle. The roots must meet. Of a wing that another one carries: with the tip
    /// of that wing, which has to be its root where all angles are zero. Left out: false.
    ///
    /// Change it to true for wings without a body between them, and for hand wings on arm wings.
    #[schemars(extend("with" = "air.model = vortex_lattice"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joined: Option<bool>,
}

/// Panels of a wing.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WingMeshCase {
    /// Panels along the chord.
    ///
    /// Change it to see what depends on the mesh; the step goes with it.
    #[default = 4]
    #[schemars(range(min = 1))]
    pub chordwise: usize,
    /// Panels along the span.
    ///
    /// Change it to see what depends on the mesh.
    #[default = 10]
    #[schemars(range(min = 1))]
    pub spanwise: usize,
    /// Spacing along the chord. `cosine` only with `air.ring_inset` = 0.25, as `air.scheme` = `accurate` has it.
    ///
    /// Change it to resolve leading and trailing edge.
    #[default(Spacing::Uniform)]
    pub chordwise_spacing: Spacing,
    /// Spacing along the span. `cosine` only with `air.ring_inset` = 0.25; rings reach to the tips then.
    ///
    /// Change it to resolve root and tip.
    #[default(Spacing::Uniform)]
    pub spanwise_spacing: Spacing,
}

/// Outline of a wing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlanformCase {
    /// An insect's wing from length, chord and r2_hat.
    Beta(BetaCase),
    /// Constant chord.
    Rectangle(RectangleCase),
    /// Measured edges.
    Outline(OutlineCase),
    /// The mesh itself, flat or not, in wing axes from the hinge: rows of nodes from the leading edge to the
    /// trailing edge, each from the root to the tip; without `mesh`.
    NodesM(Vec<Vec<[f64; 3]>>),
}

/// Ellington's beta distribution of the chord. One of `mean_chord_m`, `area_m2`, `max_chord_m`.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BetaCase {
    /// Wing length R, hinge to tip.
    ///
    /// Change it to what was measured.
    #[schemars(extend("minimum" = 1e-9, "maximum" = 1e5))]
    pub length_m: f64,
    /// Mean chord S/R.
    ///
    /// Change it to what was measured.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_chord_m: Option<f64>,
    /// Area of this wing.
    ///
    /// Change it to what was measured.
    #[schemars(extend("exclusiveMinimum" = 0, "or" = "mean_chord_m"))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area_m2: Option<f64>,
    /// Largest chord.
    ///
    /// Change it to what was measured.
    #[schemars(extend("exclusiveMinimum" = 0, "or" = ["mean_chord_m", "area_m2"]))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_chord_m: Option<f64>,
    /// Radius of the second moment of area about the hinge over R.
    ///
    /// Change it to what was measured: 0.5 to 0.6 for insects.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub r2_hat: f64,
    /// Distance from the hinge to the root of the surface.
    ///
    /// Change it for wings on a stalk.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub root_offset_m: f64,
    /// Part of the chord ahead of the hinge axis.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0, max = 1))]
    #[default(quarter())]
    #[serde(default = "quarter")]
    pub axis_fraction: f64,
    /// Least chord at root and tip relative to the largest: no panel degenerates.
    ///
    /// Change it to less for pointed wings of many panels.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 0.9))]
    #[default(least_chord())]
    #[serde(default = "least_chord")]
    pub least_chord: f64,
}

/// Constant chord.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleCase {
    /// Chord.
    ///
    /// Change it to what was measured.
    #[schemars(extend("minimum" = 1e-9, "maximum" = 1e5))]
    pub chord_m: f64,
    /// Span from root to tip.
    ///
    /// Change it to what was measured.
    #[schemars(extend("minimum" = 1e-9, "maximum" = 1e5))]
    pub span_m: f64,
    /// Distance from the hinge to the root.
    ///
    /// Change it for wings on a stalk.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub root_offset_m: f64,
    /// Part of the chord ahead of the hinge axis.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0, max = 1))]
    #[serde(default = "quarter")]
    pub axis_fraction: f64,
}

/// Edges as points [distance from the hinge along the span, position towards the leading edge], or as a file of
/// points around the wing.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutlineCase {
    /// Leading edge from root to tip.
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leading_m: Option<Vec<[f64; 2]>>,
    /// Trailing edge from root to tip.
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 2), extend("or" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trailing_m: Option<Vec<[f64; 2]>>,
    /// CSV file with a header, path relative to the case file: points once around the wing, in either sense, as
    /// they were digitised from a picture. Its unit is that of the names of the columns (`x_mm`), or
    /// `file_unit_m`, or follows from `file_length_m`.
    ///
    /// Change it for outlines digitised from pictures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Column of the first number. Left out: the one called x, or the first.
    ///
    /// Change it where the file has other columns.
    #[schemars(extend("with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_column: Option<String>,
    /// Column of the second number. Left out: the one called y, or the second.
    ///
    /// Change it where the file has other columns.
    #[schemars(extend("with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_column: Option<String>,
    /// Length of one unit of the file.
    ///
    /// Change it for pictures with a scale: metres per pixel.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_unit_m: Option<f64>,
    /// Distance from the hinge to the tip: it gives the file its scale.
    ///
    /// Change it for pictures without a scale: to the wing length that was measured.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "file_tip", "or" = "file_unit_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_length_m: Option<f64>,
    /// Where the hinge lies in the file. Left out: at \[0, 0\].
    ///
    /// Change it to the point of the picture about which the wing strokes.
    #[schemars(extend("with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_hinge: Option<[f64; 2]>,
    /// Where the wing tip lies in the file: from the hinge to it runs the feathering axis. Left out: along x.
    ///
    /// Change it to the tip of the wing in the picture.
    #[schemars(extend("with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_tip: Option<[f64; 2]>,
    /// Any point of the file on the side of the leading edge. Left out: that side is to the left on the way
    /// from hinge to tip where the second number is counted upwards.
    ///
    /// Change it for pictures that count downwards, as most programs do, or show the other side of the wing.
    #[schemars(extend("with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_leading_edge: Option<[f64; 2]>,
    /// Least chord relative to the largest: narrower places are widened to it, which gives pointed tips area (a
    /// triangle gets 4 % by default, and 21 % of second moment).
    ///
    /// Change it to less, 0.02 say, for measured outlines with pointed tips.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    #[default(least_chord())]
    pub least_chord: f64,
}

fn quarter() -> f64 {
    0.25
}

fn least_chord() -> f64 {
    0.2
}
