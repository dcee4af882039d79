//! `[body]`: the central body and its parts.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The central body: shapes of its parts and its mass.
///
/// Mass: from the parts (each with `mass_kg` or `density_kg_m3`); or `mass_kg` here for the
/// total; or `mass_kg`, `centre_m` and `inertia_about_centre_kg_m2` here as measured numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BodyCase {
    /// Body length; all parts are scaled together to extend this much along b1. Left out: parts
    /// keep their sizes.
    ///
    /// Change it to the length that was measured.
    #[schemars(extend("minimum" = 1e-9, "maximum" = 1e5))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Mass of the body without wings. Left out: the sum of its parts.
    ///
    /// Change it to the mass that was measured.
    #[schemars(extend("minimum" = 1e-15, "maximum" = 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Mass centre in body axes, from the body origin. Left out: the origin.
    ///
    /// Change it to what was measured.
    #[schemars(extend("with" = "inertia_about_centre_kg_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// By how much the mass centre is moved, body axes: mass, inertia about it and all places in the file stay what they
    /// are. Left out: not at all.
    ///
    /// Change it for a battery that is moved, or to balance a flyer; trims with the unknown `mass_centre` write it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_shift_m: Option<[f64; 3]>,
    /// Inertia matrix about the mass centre in body axes: xx, yy, zz, xy, xz, yz (elements of
    /// the matrix: a product carries its minus sign). Left out: that of the parts.
    /// Moments rounded to three digits are accepted: a largest one that exceeds the sum of the two
    /// others by up to 0.5 % is lowered to it.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_about_centre_kg_m2: Option<[f64; 6]>,
    /// Origin of the body frame, from which hinges are measured.
    ///
    /// Change it to `mass_centre` where hinges were measured from there.
    pub origin: OriginCase,
    /// Parts by name, e.g. `[body.part.thorax]`.
    pub part: BTreeMap<String, PartCase>,
}

/// Origin of the body frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OriginCase {
    /// The origin of the coordinates in which the parts are given.
    #[default]
    AsGiven,
    /// The mass centre of the body: parts are moved there, hinges are measured from there.
    MassCentre,
}

/// Keys of a surface of revolution.
const REVOLUTION: [&str; 2] = ["no file", "no nodes_m"];

/// One closed part of the body: a surface of revolution, or a mesh from a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PartCase {
    /// Middle of the part's axis, body axes. Left out: the origin.
    ///
    /// Change it to put the part in its place.
    #[schemars(extend("with" = REVOLUTION))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Direction of the axis towards the front. Left out: forward.
    ///
    /// Change it for a part that hangs or stands up.
    #[schemars(extend("with" = REVOLUTION))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// Length along the axis.
    ///
    /// Change it to what was measured.
    #[schemars(extend("minimum" = 1e-9, "maximum" = 1e5, "with" = REVOLUTION))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Largest diameter.
    ///
    /// Change it to what was measured.
    #[schemars(extend("minimum" = 1e-9, "maximum" = 1e5, "with" = REVOLUTION))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diameter_m: Option<f64>,
    /// Shape of the outline. Left out: an ellipsoid.
    ///
    /// Change it for blunt or slender parts.
    #[schemars(extend("with" = REVOLUTION))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileCase>,
    /// Panels from front to rear. Left out: 6.
    ///
    /// Change it for finer pressures on the body; mass and inertia are those of the round body whatever the panels.
    #[schemars(range(min = 2), extend("with" = REVOLUTION))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stations: Option<usize>,
    /// Panels around, even. Left out: 8.
    ///
    /// Change it for finer pressures on the body.
    #[schemars(range(min = 4), extend("multipleOf" = 2, "with" = REVOLUTION))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meridians: Option<usize>,
    /// Mesh file (.obj or .stl) in body axes instead of a surface of revolution; the path is
    /// relative to the case file.
    ///
    /// Change it for bodies of any shape.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Length of one unit of the mesh file. Left out: 1 (metres).
    ///
    /// Change it for files in millimetres: 1e-3.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_unit_m: Option<f64>,
    /// Nodes of a mesh given in the case itself (resolved cases carry imported meshes so).
    ///
    /// Change it for bodies of any shape.
    #[schemars(extend("or" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nodes_m: Option<Vec<[f64; 3]>>,
    /// Corner nodes of each panel of a mesh given in the case itself, counted from 0, normals
    /// outward by the right-hand rule.
    ///
    /// Change it together with `nodes_m`.
    #[schemars(extend("with" = "nodes_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quads: Option<Vec<[usize; 4]>>,
    /// Mass of the part, spread evenly.
    ///
    /// Change it to the mass that was measured.
    #[schemars(range(min = 0, max = 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Density of the part. Surfaces of revolution have the mass of the round solid, meshes that of the solid
    /// within their panels.
    ///
    /// Change it where no mass was measured: insect tissue has about 1000.
    #[schemars(range(min = 0, max = 1e9), extend("or" = "mass_kg"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<f64>,
}

/// Outline of a surface of revolution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ProfileCase {
    /// An ellipsoid.
    Ellipsoid,
    /// A superellipse with this exponent: 2 is the ellipsoid, larger is fuller.
    Superellipse(#[schemars(extend("exclusiveMinimum" = 1))] f64),
    /// Rows [station, radius], both from 0 to 1, front to rear.
    Table(Vec<[f64; 2]>),
}
