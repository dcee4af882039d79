//! Elementary rotations (active, right-handed) and rotations that move in time.

use glam::{DMat3, DQuat, DVec3};

/// Active rotation about axis 1 by `a` [rad]: `[[1,0,0],[0,c,-s],[0,s,c]]`.
pub fn r1(a: f64) -> DMat3 {
    let (s, c) = a.sin_cos();
    DMat3::from_cols_array(&[1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c])
}

/// Active rotation about axis 2 by `a` [rad]: `[[c,0,s],[0,1,0],[-s,0,c]]`.
pub fn r2(a: f64) -> DMat3 {
    let (s, c) = a.sin_cos();
    DMat3::from_cols_array(&[c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c])
}

/// Active rotation about axis 3 by `a` [rad]: `[[c,-s,0],[s,c,0],[0,0,1]]`.
pub fn r3(a: f64) -> DMat3 {
    let (s, c) = a.sin_cos();
    DMat3::from_cols_array(&[c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0])
}

/// Active rotation about coordinate axis `axis` (0, 1 or 2) by `a` [rad].
///
/// # Panics
/// If `axis` is not 0, 1 or 2.
pub fn rotation_about(axis: usize, a: f64) -> DMat3 {
    match axis {
        0 => r1(a),
        1 => r2(a),
        2 => r3(a),
        _ => panic!("axis {axis} is not 0, 1 or 2"),
    }
}

/// The skew matrix of a vector: `tilde(a) b = a x b` (seed eq. 14).
///
/// ```
/// use wingbeat_math::{DVec3, tilde};
/// let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0));
/// assert_eq!(tilde(a) * b, a.cross(b)); // (-3, 6, -3)
/// ```
pub fn tilde(a: DVec3) -> DMat3 {
    DMat3::from_cols_array(&[0.0, a.z, -a.y, -a.z, 0.0, a.x, a.y, -a.x, 0.0])
}

/// The vector of the skew part of a matrix: `untilde(tilde(a)) = a`.
pub fn untilde(m: DMat3) -> DVec3 {
    0.5 * DVec3::new(
        m.y_axis.z - m.z_axis.y,
        m.z_axis.x - m.x_axis.z,
        m.x_axis.y - m.y_axis.x,
    )
}

/// Rotation vector \[rad\] of a quaternion, at most half a turn; right for small turns, too (glam's has no
/// turns below 2e-8).
pub fn rotation_vector(q: DQuat) -> DVec3 {
    let q = if q.w < 0.0 { -q } else { q };
    let v = q.xyz();
    let sine = v.length();
    if sine > 0.0 {
        v * (2.0 * sine.atan2(q.w) / sine)
    } else {
        v * 2.0
    }
}

/// Rotation vector \[rad\] of a rotation matrix, at most half a turn.
///
/// Of small turns it is that of the antisymmetric part of the matrix, which is not rounded as a quaternion is.
pub fn rotation_vector_of_matrix(r: DMat3) -> DVec3 {
    let sine = untilde(r);
    if sine.length_squared() < 1e-6 && r.x_axis.x + r.y_axis.y > 0.0 && r.z_axis.z > 0.0 {
        // asin x = x (1 + x2/6 + 3 x4/40 + ...): exact to round-off below a thousandth.
        let s2 = sine.length_squared();
        return sine * (1.0 + s2 / 6.0 + 3.0 * s2 * s2 / 40.0);
    }
    // Not small here: as [`rotation_vector`], up to rounding.
    let q = DQuat::from_mat3(&r).normalize();
    let short = if q.w < 0.0 { -q } else { q };
    short.to_scaled_axis()
}

/// A rotation matrix with its angular velocity and acceleration at one instant.
///
/// `c` maps components in the moving frame W to components in the reference frame B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingRotation {
    /// Rotation C_BW: W components to B components \[1\].
    pub c: DMat3,
    /// Angular velocity of W relative to B, W components [rad/s]: `tilde(w) = C^T C'`.
    pub w: DVec3,
    /// Angular acceleration, the time derivative of `w`, W components [rad/s2].
    pub w_dot: DVec3,
}

impl MovingRotation {
    /// A rotation that stands still.
    pub fn fixed(c: DMat3) -> Self {
        Self {
            c,
            w: DVec3::ZERO,
            w_dot: DVec3::ZERO,
        }
    }

    /// Rotation about a coordinate axis by an angle with its derivatives
    /// `[angle, rate, acceleration]` [rad, rad/s, rad/s2].
    pub fn about(axis: usize, angle: [f64; 3]) -> Self {
        let e = DVec3::AXES[axis];
        Self {
            c: rotation_about(axis, angle[0]),
            w: e * angle[1],
            w_dot: e * angle[2],
        }
    }

    /// The composition `self * inner` (inner acts first): angular velocities add.
    pub fn then(&self, inner: &Self) -> Self {
        let back = inner.c.transpose();
        let seen = back * self.w;
        Self {
            c: self.c * inner.c,
            w: seen + inner.w,
            w_dot: back * self.w_dot - inner.w.cross(seen) + inner.w_dot,
        }
    }

    /// First time derivative of `c`, seen from B [1/s]: `C' = C tilde(w)`.
    pub fn c_dot(&self) -> DMat3 {
        self.c * tilde(self.w)
    }

    /// Second time derivative of `c`, seen from B [1/s2]: `C'' = C (tilde(w') + tilde(w)^2)`.
    pub fn c_ddot(&self) -> DMat3 {
        let turn = tilde(self.w);
        self.c * (tilde(self.w_dot) + turn * turn)
    }
}

/// A rotation prescribed as a function of time, twice continuously differentiable.
pub trait RotationLaw: Send + Sync + std::fmt::Debug {
    /// The rotation and its first two derivatives at time `t` [s].
    fn at(&self, t: f64) -> MovingRotation;

    /// The time from which on it repeats itself, and its period [s], 0 if it stands still; none if it does not, or
    /// does not say.
    fn cycle(&self) -> Option<[f64; 2]> {
        None
    }
}

/// A constant rotation is a law too.
impl RotationLaw for DMat3 {
    fn at(&self, _t: f64) -> MovingRotation {
        MovingRotation::fixed(*self)
    }

    fn cycle(&self) -> Option<[f64; 2]> {
        Some([0.0; 2])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_elementary_rotations_turn_axes_by_the_right_hand_rule() {
        let q = std::f64::consts::FRAC_PI_2;
        assert!((r1(q) * DVec3::Y - DVec3::Z).length() < 1e-15); // one rounding of cos(pi/2)
        assert!((r2(q) * DVec3::Z - DVec3::X).length() < 1e-15);
        assert!((r3(q) * DVec3::X - DVec3::Y).length() < 1e-15);
    }

    #[test]
    fn exact_rotation_vectors_turn_as_they_were_made() {
        let axis = DVec3::new(0.48, -0.6, 0.64);
        for angle in [0.0, 1e-12, 1e-5, 9e-4, 1.1e-3, 0.5, 3.0] {
            let theta = angle * axis;
            // To the rounding of the entries of the matrix.
            let matrix = rotation_vector_of_matrix(DMat3::from_axis_angle(axis, angle));
            assert!((matrix - theta).length() < 1e-14, "{angle}: {matrix}");
            let q = DQuat::from_axis_angle(axis, angle);
            for q in [q, -q] {
                // Small turns keep their digits.
                let found = rotation_vector(q);
                assert!(
                    (found - theta).length() <= 2e-15 * angle,
                    "{angle}: {found}"
                );
            }
        }
    }

    #[test]
    fn agrees_moving_rotation_with_central_differences() {
        let angle = |t: f64| [t.sin(), t.cos(), -t.sin()];
        let other = |t: f64| [0.3 * t * t, 0.6 * t, 0.6];
        let at =
            |t: f64| MovingRotation::about(0, angle(t)).then(&MovingRotation::about(2, other(t)));
        let (t, h) = (0.7, 1e-5);
        let (m, c, p) = (at(t - h), at(t), at(t + h));
        // Central differences are second order: h^2 = 1e-10, times derivatives of order one.
        let dc = (p.c - m.c) * (0.5 / h) - c.c_dot();
        let ddc = (p.c_dot() - m.c_dot()) * (0.5 / h) - c.c_ddot();
        assert!(dc.to_cols_array().iter().all(|e| e.abs() < 1e-9));
        assert!(ddc.to_cols_array().iter().all(|e| e.abs() < 1e-9));
        let dw = (p.w - m.w) * (0.5 / h);
        assert!((dw - c.w_dot).length() < 1e-9);
    }
}
