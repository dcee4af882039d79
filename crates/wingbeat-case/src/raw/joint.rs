//! `[segment.NAME]` and `[joint.NAME]`: further bodies and how bodies are joined.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rigid body beside the central body and the wings. Its frame is parallel to the body's in the
/// posture of reference (all joint coordinates and prescribed rotations zero), its origin is the
/// point of its joint.
///
/// Mass: from its `parts`, which then leave the central body; or `mass_kg`, `centre_m` and
/// `inertia_about_centre_kg_m2` as measured numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SegmentCase {
    /// Names of the parts (`[body.part.NAME]`) that move with this segment.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
    /// Mass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Mass centre in body axes in the posture of reference, from the point the hinges of wings
    /// are measured from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Inertia matrix about the mass centre: xx, yy, zz, xy, xz, yz (elements of the matrix: a
    /// product carries its minus sign).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_about_centre_kg_m2: Option<[f64; 6]>,
}

/// A joint between two bodies (`body`, wings and segments by their names).
///
/// The joint's frame sits on the parent at `at_m` and is turned by `turn` and moved by `travel`; for
/// a wing it is turned by the wing's motion instead. Axes are given in this frame: body axes for
/// segments, wing axes for wings. A joint of a right wing is mirrored to a left wing that came
/// along by mirror symmetry.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct JointCase {
    /// The body it hangs on; default `body`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parent: Option<String>,
    /// The body it carries.
    pub child: String,
    /// Joint point in body axes in the posture of reference; default for a wing: its hinge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<[f64; 3]>,
    /// Joint point on the child, likewise; default `at_m`. Another point opens a gap that only a
    /// loop can close.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_child_m: Option<[f64; 3]>,
    /// What is free there; default `weld`.
    pub kind: JointKind,
    /// Axis of `revolute`, `prismatic` and `point_on_line`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// The two axes of `universal`: the first fixed in the parent, the second in the child.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axes: Option<[[f64; 3]; 2]>,
    /// Prescribed rotation of a segment's joint about an axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<TurnCase>,
    /// Prescribed displacement of the joint along body axes of the parent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub travel: Option<TravelCase>,
    /// Springs, dampers, stops and actuators, one `[[joint.NAME.element]]` each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub element: Vec<ElementCase>,
    /// Angles at the start along the free directions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg: Option<Vec<f64>>,
    /// Angular rates at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg_s: Option<Vec<f64>>,
    /// Displacement of a `prismatic` joint at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_m: Option<f64>,
    /// Its rate at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_m_s: Option<f64>,
}

/// What a joint leaves free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Nothing beside what is prescribed.
    #[default]
    Weld,
    /// Rotation about `axis`.
    Revolute,
    /// Rotation about two perpendicular `axes`.
    Universal,
    /// Any rotation.
    Spherical,
    /// Displacement along `axis`.
    Prismatic,
    /// Any rotation, and displacement along `axis`: closes planar loops; for loops only.
    PointOnLine,
}

/// Prescribed rotation: `mean + sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t)`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TurnCase {
    /// The axis.
    pub axis: [f64; 3],
    /// Frequency f; default the wingbeat's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Mean angle.
    #[serde(default)]
    pub mean_deg: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    #[serde(default)]
    pub cosine_deg: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    #[serde(default)]
    pub sine_deg: Vec<f64>,
}

/// Prescribed displacement: one vector per harmonic 1, 2, ...
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TravelCase {
    /// Frequency f; default the wingbeat's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Cosine parts.
    #[serde(default)]
    pub cosine_m: Vec<[f64; 3]>,
    /// Sine parts.
    #[serde(default)]
    pub sine_m: Vec<[f64; 3]>,
}

/// What acts along a free direction: any of spring, damper, stop, actuator. Rotations take the
/// keys with `newton_m`, displacements those with `newton` and `m`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ElementCase {
    /// Number of the free direction, from 0.
    pub direction: usize,
    /// Spring of a rotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_newton_m_per_rad: Option<f64>,
    /// Angle at which it is slack.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest_deg: Option<f64>,
    /// Spring of a displacement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_newton_per_m: Option<f64>,
    /// Displacement at which it is slack.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest_m: Option<f64>,
    /// Damper of a rotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_newton_m_s_per_rad: Option<f64>,
    /// Damper of a displacement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_newton_s_per_m: Option<f64>,
    /// Ends of the free range of a rotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<StopCase>,
    /// Moment of an actuator as a function of time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_newton_m: Option<SeriesCase>,
    /// Force of an actuator as a function of time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_newton: Option<SeriesCase>,
    /// Actuator of a rotation that follows an angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follow: Option<FollowCase>,
}

/// A stop: outside its range it pushes back and dissipates, it never pulls.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopCase {
    /// Lower end.
    pub lower_deg: f64,
    /// Upper end.
    pub upper_deg: f64,
    /// Stiffness beyond the ends.
    pub stiffness_newton_m_per_rad: f64,
    /// Damping per rate of depth (Hunt and Crossley); 0 gives all energy back.
    #[serde(default)]
    pub damping_s_per_rad: f64,
}

/// `mean + sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t)`, in the unit of the key.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SeriesCase {
    /// Frequency f; default the wingbeat's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Mean.
    pub mean: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    pub cosine: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    pub sine: Vec<f64>,
}

/// Proportional-derivative actuator towards an angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FollowCase {
    /// The angle aimed at.
    pub angle_deg: SeriesCase,
    /// Gain on the angle.
    pub stiffness_newton_m_per_rad: f64,
    /// Gain on the rate.
    pub damping_newton_m_s_per_rad: f64,
}
