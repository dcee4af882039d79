//! Where a frame is and how it moves as seen from the root.

use wingbeat_math::{DMat3, DQuat, DVec3, MovingRotation};

use crate::system::joint_model::JointType;

/// Placement of a body's frame relative to the root's frame, with two time derivatives as seen
/// from the root.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Rotation A: body components to root components.
    pub c: DMat3,
    /// Angular velocity relative to the root [rad/s], body components.
    pub w: DVec3,
    /// Its time derivative [rad/s2], body components.
    pub w_dot: DVec3,
    /// Position d of the body's origin \[m\], root components.
    pub d: DVec3,
    /// First derivative of `d` [m/s].
    pub d_dot: DVec3,
    /// Second derivative of `d` [m/s2].
    pub d_ddot: DVec3,
}

impl Placement {
    /// The root itself.
    pub(crate) const ROOT: Self = Self {
        c: DMat3::IDENTITY,
        w: DVec3::ZERO,
        w_dot: DVec3::ZERO,
        d: DVec3::ZERO,
        d_dot: DVec3::ZERO,
        d_ddot: DVec3::ZERO,
    };

    /// A frame at the same origin, turned by `law`.
    pub(crate) fn turned(&self, law: &MovingRotation) -> Self {
        let own = MovingRotation {
            c: self.c,
            w: self.w,
            w_dot: self.w_dot,
        };
        let MovingRotation { c, w, w_dot } = own.then(law);
        Self {
            c,
            w,
            w_dot,
            ..*self
        }
    }

    /// A frame with the same axes whose origin is a point that moves in this one: position \[m\],
    /// velocity [m/s] and acceleration [m/s2] as seen from this frame.
    pub(crate) fn slid(&self, [r, v, a]: [DVec3; 3]) -> Self {
        let w = self.w;
        let still = self.shifted(r);
        Self {
            d_dot: still.d_dot + self.c * v,
            d_ddot: still.d_ddot + self.c * (2.0 * w.cross(v) + a),
            ..still
        }
    }

    /// A frame with the same axes whose origin is the point `r` \[m\] fixed in this one.
    pub(crate) fn shifted(&self, r: DVec3) -> Self {
        let (spin, w) = (self.w.cross(r), self.w);
        Self {
            d: self.d + self.c * r,
            d_dot: self.d_dot + self.c * spin,
            d_ddot: self.d_ddot + self.c * (self.w_dot.cross(r) + w.cross(spin)),
            ..*self
        }
    }
}

/// The child's frame at the joint point, from the joint's frame `k`, for coordinates `q`, speeds `u` and their
/// rates; none: constant speeds.
pub(crate) fn carry(
    kind: JointType,
    k: Placement,
    q: &[f64],
    u: &[f64],
    u_dot: Option<&[f64]>,
) -> Placement {
    let rate = |a: DVec3, i: usize| u_dot.map_or(DVec3::ZERO, |u_dot| a * u_dot[i]);
    let about = |k: Placement, a: DVec3, i: usize| {
        k.turned(&MovingRotation {
            c: DMat3::from_axis_angle(a, q[i]),
            w: a * u[i],
            w_dot: rate(a, i),
        })
    };
    match kind {
        JointType::Weld | JointType::PointOnLine { .. } => k,
        JointType::Revolute { axis } => about(k, axis, 0),
        JointType::Universal { axes: [a, b] } => about(about(k, a, 0), b, 1),
        JointType::Spherical => k.turned(&MovingRotation {
            c: DMat3::from_quat(DQuat::from_slice(q).normalize()),
            w: DVec3::from_slice(u),
            w_dot: u_dot.map_or(DVec3::ZERO, DVec3::from_slice),
        }),
        JointType::Prismatic { axis } => k.slid([axis * q[0], axis * u[0], rate(axis, 0)]),
    }
}
