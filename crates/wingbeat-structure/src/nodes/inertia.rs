//! Inertial force and moment of a node, a small rigid body in a frame that moves.
//!
//! Place u, velocity v and acceleration v' relative to W in W components, attitude R (node to W), relative
//! angular velocity Omega in node components. Absolute angular velocity `w = R^T w_W + Omega`, its derivative
//! `w' = R^T w_W' - Omega x R^T w_W + Omega'`; with mass m, first moment S and inertia J about the node, `F = m
//! a + R (w' x S + w x (w x S))`, `M = S x R^T a + J w' + w x J w`.

use wingbeat_math::six_by_six::from_quarters;
use wingbeat_math::{DMat3, DVec3, MassProperties, SixBySix, tilde};

use crate::nodes::block::pair;
use crate::nodes::configuration::Configuration;
use crate::nodes::frame::FrameMotion;

/// Motion of a node relative to W.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeMotion {
    /// Place \[m\].
    pub u: DVec3,
    /// Node components to W components.
    pub r: DMat3,
    /// Velocity [m/s], W components.
    pub v: DVec3,
    /// Relative angular velocity [rad/s], node components.
    pub omega: DVec3,
    /// Acceleration [m/s2], W components.
    pub v_dot: DVec3,
    /// Derivative of `omega` [rad/s2].
    pub omega_dot: DVec3,
}

impl NodeMotion {
    /// Node n at rest in W.
    pub fn still(at: &Configuration, n: usize) -> Self {
        Self {
            u: at.position[n],
            r: DMat3::from_quat(at.rotation[n]),
            v: DVec3::ZERO,
            omega: DVec3::ZERO,
            v_dot: DVec3::ZERO,
            omega_dot: DVec3::ZERO,
        }
    }
}

/// A configuration with velocities and accelerations, six numbers a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<'a> {
    pub at: &'a Configuration,
    pub velocity: &'a [f64],
    pub acceleration: &'a [f64],
}

impl Motion<'_> {
    /// Motion of node n.
    pub fn node(&self, n: usize) -> NodeMotion {
        let [v, omega] = pair(self.velocity, n);
        let [v_dot, omega_dot] = pair(self.acceleration, n);
        NodeMotion {
            u: self.at.position[n],
            r: DMat3::from_quat(self.at.rotation[n]),
            v,
            omega,
            v_dot,
            omega_dot,
        }
    }

    /// Motion of the point midway between two nodes.
    pub fn middle(&self, [a, b]: [usize; 2]) -> NodeMotion {
        NodeMotion::between(&self.node(a), &self.node(b))
    }
}

impl NodeMotion {
    /// Midway between two nodes: a point, which does not turn.
    pub fn between(a: &Self, b: &Self) -> Self {
        Self {
            u: a.u.midpoint(b.u),
            r: DMat3::IDENTITY,
            v: a.v.midpoint(b.v),
            omega: DVec3::ZERO,
            v_dot: a.v_dot.midpoint(b.v_dot),
            omega_dot: DVec3::ZERO,
        }
    }
}

/// Derivatives of the inertial force (W components) and moment (node components) of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangents {
    /// By (dx in W components, dtheta in node components).
    pub position: SixBySix,
    /// By (v, Omega).
    pub velocity: SixBySix,
    /// By (v', Omega'): the mass matrix.
    pub acceleration: SixBySix,
}

/// What forces and tangents share.
struct NodeKinematics {
    /// Absolute acceleration less gravity, W components.
    a: DVec3,
    /// Angular velocity of W in node components.
    carried: DVec3,
    /// Absolute angular velocity, node components.
    w: DVec3,
    /// Its derivative.
    w_dot: DVec3,
}

fn parts(frame: &FrameMotion, n: &NodeMotion) -> NodeKinematics {
    let back = n.r.transpose();
    let carried = back * frame.w;
    NodeKinematics {
        a: frame.point(n.u, n.v, n.v_dot),
        carried,
        w: carried + n.omega,
        w_dot: back * frame.w_dot - n.omega.cross(carried) + n.omega_dot,
    }
}

/// Inertial force \[N\] (W components) and moment \[N m\] about the node (node components).
pub(crate) fn force(m: &MassProperties, frame: &FrameMotion, n: &NodeMotion) -> [DVec3; 2] {
    let p = parts(frame, n);
    let s = m.first_moment;
    let turning = p.w_dot.cross(s) + p.w.cross(p.w.cross(s));
    [
        m.mass * p.a + n.r * turning,
        s.cross(n.r.transpose() * p.a) + m.inertia * p.w_dot + p.w.cross(m.inertia * p.w),
    ]
}

/// Derivative of `w x (w x S)` and of `w x J w` by w.
fn gyroscopic(m: &MassProperties, w: DVec3) -> [DMat3; 2] {
    let (s, j) = (m.first_moment, m.inertia);
    [
        -(tilde(w.cross(s)) + tilde(w) * tilde(s)),
        tilde(w) * j - tilde(j * w),
    ]
}

/// Derivatives of [`force`].
pub(crate) fn tangents(m: &MassProperties, frame: &FrameMotion, n: &NodeMotion) -> Tangents {
    let p = parts(frame, n);
    let (r, back, s, j) = (n.r, n.r.transpose(), tilde(m.first_moment), m.inertia);
    let [spin_force, spin_moment] = gyroscopic(m, p.w);
    let carried = tilde(p.carried);

    let coriolis = tilde(frame.w) * 2.0;
    let velocity = from_quarters([
        [coriolis * m.mass, r * (spin_force - s * carried)],
        [s * back * coriolis, j * carried + spin_moment],
    ]);

    let place = tilde(frame.w_dot) + tilde(frame.w) * tilde(frame.w);
    // Derivative of w' by dtheta; that of w is `carried`.
    let w_dot = tilde(back * frame.w_dot) - tilde(n.omega) * carried;
    let turning = p.w_dot.cross(m.first_moment) + p.w.cross(p.w.cross(m.first_moment));
    let position = from_quarters([
        [
            place * m.mass,
            r * (spin_force * carried - s * w_dot - tilde(turning)),
        ],
        [
            s * back * place,
            s * tilde(back * p.a) + j * w_dot + spin_moment * carried,
        ],
    ]);
    Tangents {
        position,
        velocity,
        acceleration: m.matrix(n.r),
    }
}

/// Derivative of the inertial force and moment by the acceleration and angular acceleration of W.
pub(crate) fn by_frame_acceleration(m: &MassProperties, n: &NodeMotion) -> SixBySix {
    let back = n.r.transpose();
    let (s, u) = (tilde(m.first_moment), tilde(n.u));
    let unit = DMat3::from_diagonal(DVec3::splat(m.mass));
    from_quarters([
        [unit, -(u * m.mass + n.r * s * back)],
        [s * back, m.inertia * back - s * back * u],
    ])
}

/// Momentum relative to W \[kg m/s\] (W components) and angular momentum about the node (node components).
pub(crate) fn momentum(m: &MassProperties, n: &NodeMotion) -> [DVec3; 2] {
    let s = m.first_moment;
    [
        m.mass * n.v + n.r * n.omega.cross(s),
        s.cross(n.r.transpose() * n.v) + m.inertia * n.omega,
    ]
}
