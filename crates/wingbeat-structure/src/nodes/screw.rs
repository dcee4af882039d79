//! Screw motions: the exponential of SE(3), its logarithm and the derivative of that.
//!
//! A displacement is a place p and a rotation; its logarithm is the screw (u, theta) with `p = J(theta) u`.
//! With `A(theta) = 1 + tilde(theta) / 2 + c(theta^2) tilde(theta)^2`, the inverse of the right Jacobian of
//! rotations, that of screws is `[[A, dA[u]], [0, A]]`, `dA[u]` the derivative of A along u (Sonneville,
//! Cardona & Bruls 2014, appendix A; Barfoot, State Estimation for Robotics, 2017, eq. 7.95).

use wingbeat_math::rotation_jacobian::{Curve, inverse_right_jacobian as a};
use wingbeat_math::{DMat3, DQuat, DVec3, rotation_vector, six, tilde};

use crate::nodes::block::pair;

/// A screw: translation u \[m\] and rotation theta \[rad\], both in the axes of its first frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Screw {
    /// Translation along the screw \[m\], or the force that works on it \[N\].
    pub u: DVec3,
    /// Rotation \[rad\], or the moment that works on it \[N m\].
    pub theta: DVec3,
}

impl std::ops::Neg for Screw {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            u: -self.u,
            theta: -self.theta,
        }
    }
}

impl Screw {
    /// The screw to the frame at `place` with the attitude `rotation`, of at most half a turn.
    pub fn to(place: DVec3, rotation: DQuat) -> Self {
        let theta = rotation_vector(rotation);
        let u = transposed(&Curve::at(theta), theta, place);
        Self { u, theta }
    }

    /// Place and attitude at the part `along` of the screw (0 its beginning, 1 its end).
    pub fn frame(&self, along: f64) -> (DVec3, DQuat) {
        let theta = along * self.theta;
        let place = a(&Curve::at(theta), theta).transpose().inverse() * (along * self.u);
        (place, DQuat::from_scaled_axis(theta))
    }

    /// The six numbers, translation first.
    pub fn numbers(&self) -> [f64; 6] {
        six(self.u, self.theta)
    }

    /// From six numbers, translation first.
    pub fn from_numbers(n: &[f64; 6]) -> Self {
        let [u, theta] = pair(n, 0);
        Self { u, theta }
    }
}

/// Derivative of A(theta) along u.
fn a_along(curve: &Curve, theta: DVec3, u: DVec3) -> DMat3 {
    let (t, d) = (tilde(theta), tilde(u));
    d * 0.5 + (t * d + d * t) * curve.c + t * t * (2.0 * curve.first * theta.dot(u))
}

/// `A^T n`.
fn transposed(curve: &Curve, t: DVec3, n: DVec3) -> DVec3 {
    n - 0.5 * t.cross(n) + curve.c * t.cross(t.cross(n))
}

/// Derivative of `A^T n` by theta along d.
fn transposed_along(curve: &Curve, t: DVec3, n: DVec3, d: DVec3) -> DVec3 {
    let tn = t.cross(n);
    2.0 * curve.first * t.dot(d) * t.cross(tn) - 0.5 * d.cross(n)
        + curve.c * (d.cross(tn) + t.cross(d.cross(n)))
}

/// Second derivative of `A^T n` by theta along u and d.
fn transposed_twice(curve: &Curve, t: DVec3, n: DVec3, [u, d]: [DVec3; 2]) -> DVec3 {
    let tn = t.cross(n);
    let mixed = |a: DVec3, b: DVec3| a.cross(b.cross(n));
    (4.0 * curve.second * t.dot(u) * t.dot(d) + 2.0 * curve.first * u.dot(d)) * t.cross(tn)
        + 2.0 * curve.first * t.dot(u) * (mixed(d, t) + mixed(t, d))
        + 2.0 * curve.first * t.dot(d) * (mixed(u, t) + mixed(t, u))
        + curve.c * (mixed(u, d) + mixed(d, u))
}

/// Blocks `[A, B]` of the inverse right Jacobian `[[A, B], [0, A]]` at a screw.
pub(crate) fn inverse_jacobian(d: &Screw) -> [DMat3; 2] {
    let curve = Curve::at(d.theta);
    [a(&curve, d.theta), a_along(&curve, d.theta, d.u)]
}

/// The transpose of the inverse right Jacobian at `d` times `s`.
pub(crate) fn pulled(d: &Screw, s: &Screw) -> Screw {
    let (curve, t) = (Curve::at(d.theta), d.theta);
    Screw {
        u: transposed(&curve, t, s.u),
        theta: transposed_along(&curve, t, s.u, d.u) + transposed(&curve, t, s.theta),
    }
}

/// Derivative of [`pulled`] by d: blocks `[N, M]` of `[[0, N], [N, M]]`.
pub(crate) fn pulled_gradient(d: &Screw, s: &Screw) -> [DMat3; 2] {
    let (curve, t) = (Curve::at(d.theta), d.theta);
    let along = |f: &dyn Fn(DVec3) -> DVec3| {
        let [x, y, z] = DVec3::AXES.map(f);
        DMat3::from_cols(x, y, z)
    };
    let n = along(&|e| transposed_along(&curve, t, s.u, e));
    let m = along(&|e| {
        transposed_twice(&curve, t, s.u, [d.u, e]) + transposed_along(&curve, t, s.theta, e)
    });
    [n, m]
}

/// Right Jacobian of rotations: `exp(theta + d) = exp(theta) exp(T d)`, |theta| up to half a turn.
pub(crate) fn right_jacobian(theta: DVec3) -> DMat3 {
    a(&Curve::at(theta), theta).inverse()
}
