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
    /// Body length; all parts are scaled together to extend this much along b1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Mass of the body without wings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Mass centre in body axes, from the body origin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Inertia matrix about the mass centre in body axes: xx, yy, zz, xy, xz, yz (elements of
    /// the matrix: a product carries its minus sign).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_about_centre_kg_m2: Option<[f64; 6]>,
    /// Origin of the body frame, from which hinges are measured.
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

/// One closed part of the body: a surface of revolution, or a mesh from a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PartCase {
    /// Middle of the part's axis, body axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Direction of the axis towards the front; default forward.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// Length along the axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Largest diameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diameter_m: Option<f64>,
    /// Shape of the outline; default ellipsoid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileCase>,
    /// Panels from front to rear; default 6.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stations: Option<usize>,
    /// Panels around, even; default 8.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meridians: Option<usize>,
    /// Mesh file (.obj or .stl) in body axes instead of a surface of revolution; the path is
    /// relative to the case file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Length of one unit of the mesh file; default 1 (metres).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_unit_m: Option<f64>,
    /// Nodes of a mesh given in the case itself (resolved cases carry imported meshes so).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nodes_m: Option<Vec<[f64; 3]>>,
    /// Corner nodes of each panel of a mesh given in the case itself, counted from 0, normals
    /// outward by the right-hand rule.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quads: Option<Vec<[usize; 4]>>,
    /// Mass of the part, spread evenly.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Density of the part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<f64>,
}

/// Outline of a surface of revolution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ProfileCase {
    /// `profile = "ellipsoid"`.
    Ellipsoid,
    /// `profile.superellipse = n`: 2 is the ellipsoid, larger is fuller.
    Superellipse(f64),
    /// `profile.table = [[station, radius], ...]`, both from 0 to 1, front to rear.
    Table(Vec<[f64; 2]>),
}
