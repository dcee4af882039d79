//! `[segment.NAME]` and `[joint.NAME]`: further bodies and how bodies are joined.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rigid body beside the central body and the wings. Its frame is parallel to the body's in the
/// reference configuration (all joint coordinates and prescribed rotations zero), its origin is the
/// point of its joint.
///
/// Mass: from its `parts`, which then leave the central body; or `mass_kg`, `centre_m` and
/// `inertia_about_centre_kg_m2` as measured numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SegmentCase {
    /// Names of the parts (`[body.part.NAME]`) that move with this segment.
    ///
    /// Change it to let parts of the body move.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
    /// Mass. Left out: that of its parts.
    ///
    /// Change it to what was measured.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Mass centre in body axes in the reference configuration, from the point the hinges of wings are measured
    /// from; of a segment that a wing carries, itself or by other segments, in wing axes from the point of the
    /// joint at the wing. Left out: that point.
    ///
    /// Change it to what was measured.
    #[schemars(extend("with" = "inertia_about_centre_kg_m2"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Inertia matrix about the mass centre: xx, yy, zz, xy, xz, yz (elements of the matrix: a
    /// product carries its minus sign).
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_about_centre_kg_m2: Option<[f64; 6]>,
}

/// A joint between two bodies (`body`, wings and segments by their names).
///
/// The joint's frame sits on the parent at `at_m` and is turned by `turn` and moved by `travel`; for a wing it
/// is turned by the wing's motion instead. Axes are given in this frame: body axes for segments, wing axes for
/// wings. A joint of a right wing is mirrored to a left wing that has none, and the other way round: points,
/// displacements, axes, and angles of spherical joints. With `mirror = false` at the wing it is not.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct JointCase {
    /// The body it hangs on. Left out: `body`.
    ///
    /// Change it for chains of bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parent: Option<String>,
    /// The body it carries.
    ///
    /// Change it to name the body that moves.
    pub child: String,
    /// Joint point in body axes in the reference configuration; where the parent is a wing, in wing axes from
    /// its hinge, and where a wing carries the parent, in wing axes from the joint at the wing. Left out for a wing on the body: its hinge, which is no other place than `wing.NAME.hinge_m`. A wing on a wing hinges here and needs no `hinge_m`.
    ///
    /// Change it to what was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<[f64; 3]>,
    /// Joint point on the child, likewise. Left out: `at_m`. At a joint that closes a loop another point is a gap
    /// that the loop closes; at one that carries its child it moves the child. Not where the child is a wing, which
    /// closes loops by its hinge, or is carried by one. A segment that a wing carries closes loops by its own joint's
    /// point if this is left out; it is needed where the parent moves with a wing and the child does not.
    ///
    /// Change it for links of a loop.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_child_m: Option<[f64; 3]>,
    /// What is free there.
    ///
    /// Change it to let the joint move.
    pub kind: JointKind,
    /// Axis of `revolute`, `prismatic` and `point_on_line`.
    ///
    /// Change it to the axis of the joint.
    #[schemars(extend("with" = "kind = revolute | prismatic | point_on_line"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// The two axes of `universal`: the first fixed in the parent, the second in the child.
    ///
    /// Change it to the axes of the joint.
    #[schemars(extend("with" = "kind = universal"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axes: Option<[[f64; 3]; 2]>,
    /// Prescribed rotation of a segment's joint about an axis, of the time since the start: a smooth start of the wings
    /// (`motion.start_beats`) does not delay it. Left out: none.
    ///
    /// Change it to move the segment as prescribed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<TurnCase>,
    /// Prescribed displacement of the joint along body axes of the parent; left out:
    /// none.
    ///
    /// Change it to move the joint as prescribed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub travel: Option<TravelCase>,
    /// Springs, dampers, stops and actuators, one `[[joint.NAME.element]]` each.
    ///
    /// Change it for joints with springs, dampers, stops or motors.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub element: Vec<ElementCase>,
    /// Angles at the start along the free directions. Left out: zeros.
    ///
    /// Change it to start displaced.
    #[schemars(extend("with" = "kind = revolute | universal | spherical"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg: Option<Vec<f64>>,
    /// Angular rates at the start; of a spherical joint the components of the angular velocity of the child
    /// against the parent in the axes of the child. Left out: zeros.
    ///
    /// Change it to start moving.
    #[schemars(extend("with" = "kind = revolute | universal | spherical"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg_s: Option<Vec<f64>>,
    /// Displacement of a `prismatic` joint at the start. Left out: 0.
    ///
    /// Change it to start displaced.
    #[schemars(extend("with" = "kind = prismatic"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_m: Option<f64>,
    /// Its rate at the start. Left out: 0.
    ///
    /// Change it to start moving.
    #[schemars(extend("with" = "kind = prismatic"))]
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
    /// Any rotation; its three angles are the components of the rotation vector, at most half a turn.
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
    ///
    /// Change it to the axis of the rotation.
    pub axis: [f64; 3],
    /// Frequency f. Left out: the wingbeat's.
    ///
    /// Change it for motions slower or faster than the beat.
    #[schemars(range(min = 0, max = 1_000_000), extend("with" = "cosine_deg | sine_deg"))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Mean angle.
    ///
    /// Change it for a constant angle.
    #[serde(default)]
    pub mean_deg: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub cosine_deg: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub sine_deg: Vec<f64>,
}

/// Prescribed displacement: one vector per harmonic 1, 2, ...
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TravelCase {
    /// Frequency f. Left out: the wingbeat's.
    ///
    /// Change it for motions slower or faster than the beat.
    #[schemars(range(min = 0, max = 1_000_000), extend("with" = "cosine_m | sine_m"))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Cosine parts.
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub cosine_m: Vec<[f64; 3]>,
    /// Sine parts.
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub sine_m: Vec<[f64; 3]>,
}

/// What acts along a free direction: any of spring, damper, stop, actuator. Rotations take the
/// keys with `newton_m`, displacements those with `newton` and `m`.
///
/// At a `spherical` joint springs, stops and `follow` act along components of the rotation vector, so that
/// springs of any stiffness keep energy; dampers and `moment_newton_m` act about the axes of the child.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ElementCase {
    /// Number of the free direction, from 0.
    ///
    /// Change it for joints with two or three free directions.
    pub direction: usize,
    /// Spring of a rotation; left out: none.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_newton_m_per_rad: Option<f64>,
    /// Angle at which it is slack. Left out: 0.
    ///
    /// Change it to the angle without load.
    #[schemars(extend("with" = "stiffness_newton_m_per_rad"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest_deg: Option<f64>,
    /// Spring of a displacement; left out: none.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_newton_per_m: Option<f64>,
    /// Displacement at which it is slack. Left out: 0.
    ///
    /// Change it to the displacement without load.
    #[schemars(extend("with" = "stiffness_newton_per_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest_m: Option<f64>,
    /// Damper of a rotation; left out: none.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_newton_m_s_per_rad: Option<f64>,
    /// Damper of a displacement; left out: none.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_newton_s_per_m: Option<f64>,
    /// Ends of the free range of a rotation; left out: none.
    ///
    /// Change it for joints that do not turn all the way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<StopCase>,
    /// Moment of an actuator as a function of time; left out: none.
    ///
    /// Change it for muscles and motors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_newton_m: Option<SeriesCase>,
    /// Force of an actuator as a function of time; left out: none.
    ///
    /// Change it for muscles and motors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_newton: Option<SeriesCase>,
    /// Actuator of a rotation that follows an angle; left out: none.
    ///
    /// Change it for servos.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follow: Option<FollowCase>,
}

/// A stop: outside its range it pushes back and dissipates, it never pulls.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopCase {
    /// Lower end.
    ///
    /// Change it to what was measured.
    pub lower_deg: f64,
    /// Upper end.
    ///
    /// Change it to what was measured.
    pub upper_deg: f64,
    /// Stiffness beyond the ends.
    ///
    /// Change it to a value at which it gives way by a degree or two.
    #[schemars(range(min = 0))]
    pub stiffness_newton_m_per_rad: f64,
    /// Damping per rate of depth (Hunt and Crossley); 0 gives all energy back.
    ///
    /// Change it for stops that dissipate.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub damping_s_per_rad: f64,
}

/// `mean + sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t)`, in the unit of the key.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SeriesCase {
    /// Frequency f. Left out: the wingbeat's.
    ///
    /// Change it for actuators slower or faster than the beat.
    #[schemars(range(min = 0, max = 1_000_000), extend("with" = "cosine | sine"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Mean.
    ///
    /// Change it for a constant part.
    pub mean: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what the actuator does.
    pub cosine: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what the actuator does.
    pub sine: Vec<f64>,
}

/// Proportional-derivative actuator towards an angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FollowCase {
    /// The angle aimed at.
    ///
    /// Change it to the angle that is wanted.
    pub angle_deg: SeriesCase,
    /// Gain on the angle.
    ///
    /// Change it for a servo that gives way less.
    #[schemars(range(min = 0))]
    pub stiffness_newton_m_per_rad: f64,
    /// Gain on the rate.
    ///
    /// Change it for a servo that overshoots less.
    #[schemars(range(min = 0))]
    pub damping_newton_m_s_per_rad: f64,
}
