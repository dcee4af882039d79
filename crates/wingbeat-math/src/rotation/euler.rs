//! Euler-angle sequences: rotation, the matrix G of seed eq. 15 and its derivatives, inverse.

use super::elementary::rotation_about;
use glam::{DMat3, DVec3};

/// Three successive rotations about body axes, `R = R_i(eta_0) R_j(eta_1) R_k(eta_2)`.
///
/// Only sequences of three different axes (Tait-Bryan) occur here: 2-3-1 for the central body
/// and 1-3-2 for wings (seed sec. 3). They are singular where the cosine of the middle angle
/// vanishes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EulerSequence {
    axes: [usize; 3],
}

/// What follows from three Euler angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerMatrices {
    /// Rotation R_NB.
    pub r: DMat3,
    /// G, `w = G eta'`.
    pub g: DMat3,
    /// Partial derivatives of G with respect to the second and third angle.
    pub g_partials: [DMat3; 2],
}

impl EulerSequence {
    /// 2-3-1, the central body of the seed: `R = R2(phi) R3(theta) R1(psi)`.
    pub const BODY_231: Self = Self { axes: [1, 2, 0] };
    /// 1-3-2, the wings of the seed: `R = R1(phi) R3(theta) R2(psi)`.
    pub const WING_132: Self = Self { axes: [0, 2, 1] };

    /// Rotation matrix R_NB of the angles `eta` [rad] (seed eq. 3).
    pub fn rotation(&self, eta: DVec3) -> DMat3 {
        rotation_about(self.axes[0], eta.x)
            * rotation_about(self.axes[1], eta.y)
            * rotation_about(self.axes[2], eta.z)
    }

    /// The matrix G of seed eq. 15: angular velocity in body components `w = G eta'`.
    /// `det G = +-cos(eta_1)`.
    pub fn g(&self, eta: DVec3) -> DMat3 {
        self.matrices(eta).g
    }

    /// Rotation, G and its partial derivatives at once, from three sines and cosines.
    pub fn matrices(&self, eta: DVec3) -> EulerMatrices {
        let [i, j, k] = self.axes;
        let s = self.parity();
        let (sines, cosines) = (eta.x.sin_cos(), (eta.y.sin_cos(), eta.z.sin_cos()));
        let ((sb, cb), (sc, cc)) = cosines;
        let put = |x: f64, y: f64, z: f64| {
            let mut v = [0.0; 3];
            (v[i], v[j], v[k]) = (x, y, z);
            DVec3::from_array(v)
        };
        let first = put(cb * cc, -s * cb * sc, s * sb);
        let second = put(s * sc, cc, 0.0);
        let g = DMat3::from_cols(first, second, DVec3::AXES[k]);
        let d_eta1 = DMat3::from_cols(put(-sb * cc, s * sb * sc, s * cb), DVec3::ZERO, DVec3::ZERO);
        let d_eta2 = DMat3::from_cols(
            put(-cb * sc, -s * cb * cc, 0.0),
            put(s * cc, -sc, 0.0),
            DVec3::ZERO,
        );
        EulerMatrices {
            r: self.rotation_from(sines, first, second),
            g,
            g_partials: [d_eta1, d_eta2],
        }
    }

    /// The rotation from the sine and cosine of the first angle and the first two columns of G:
    /// row i of R_j R_k is column 1 of G, `R_k^T e_j` is column 2, and `R_i` turns the other two
    /// rows of R_j R_k into one another.
    fn rotation_from(&self, (sa, ca): (f64, f64), first: DVec3, second: DVec3) -> DMat3 {
        let [i, j, k] = self.axes;
        let s = self.parity();
        let third = s * first.cross(second);
        let mut rows = [DVec3::ZERO; 3];
        rows[i] = first;
        rows[j] = ca * second - s * sa * third;
        rows[k] = s * sa * second + ca * third;
        DMat3::from_cols_array_2d(&rows.map(|r| r.to_array())).transpose()
    }

    /// Angles of a rotation matrix [rad], the middle one in [-pi/2, pi/2].
    pub fn angles(&self, r: DMat3) -> DVec3 {
        let [i, j, k] = self.axes;
        // e_i . R e_k = s sin(eta_1), s the parity of (i, j, k); in full, for R = R_i R_j R_k:
        let s = self.parity();
        let entry = |row: usize, col: usize| r.col(col)[row];
        let middle = (s * entry(i, k)).clamp(-1.0, 1.0).asin();
        let first = (-s * entry(j, k)).atan2(entry(k, k));
        let last = (-s * entry(i, j)).atan2(entry(i, i));
        DVec3::new(first, middle, last)
    }

    /// Angles of a rotation matrix [rad] where the middle one is +-90 degrees: first and last angle turn about one
    /// axis there, so the attitude determines only their sum or difference. The first is that of `before`, the last
    /// has the rest. The attitude is theirs to within cos(eta_1).
    pub fn singular_angles(&self, r: DMat3, before: DVec3) -> DVec3 {
        let [i, j, _] = self.axes;
        let middle = self.angles(r).y;
        let last = rotation_about(j, -middle) * (rotation_about(i, -before.x) * r);
        DVec3::new(
            before.x,
            middle,
            (self.parity() * last.col(i)[j]).atan2(last.col(i)[i]),
        )
    }

    /// Rates of the angles [rad/s] of which [`Self::singular_angles`] keeps the first, for the angular velocity `w`
    /// in body components: the part of `w` across both axes is that of no angles.
    pub fn singular_rates(&self, eta: DVec3, w: DVec3) -> DVec3 {
        let g = self.g(eta);
        DVec3::new(0.0, g.y_axis.dot(w), g.z_axis.dot(w))
    }

    /// Cosine of the middle angle: the distance from the singularity, |det G|.
    pub fn regularity(&self, eta: DVec3) -> f64 {
        eta.y.cos().abs()
    }

    /// +1 for an even permutation of (1, 2, 3), -1 for an odd one.
    fn parity(&self) -> f64 {
        let [i, j, _] = self.axes;
        if (i + 1) % 3 == j { 1.0 } else { -1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::untilde;
    use std::f64::consts::PI;

    const BOTH: [EulerSequence; 2] = [EulerSequence::BODY_231, EulerSequence::WING_132];

    #[test]
    fn exact_angles_invert_rotation() {
        for s in BOTH {
            let eta = DVec3::new(2.1, -0.7, -1.3);
            assert!((s.angles(s.rotation(eta)) - eta).length() < 1e-14); // a few roundings
        }
    }

    #[test]
    fn exact_singular_angles_have_the_attitude_and_its_rate() {
        let (h, kept) = (1e-6, 0.4);
        for s in BOTH {
            for middle in [0.5 * PI, -0.5 * PI] {
                let eta = |last: f64| DVec3::new(kept, middle, last);
                // The same attitude by a first angle that turned by as much as the last one is short of it.
                let sign = s.g(eta(0.0)).x_axis.dot(s.g(eta(0.0)).z_axis);
                let r = s.rotation(DVec3::new(kept + 0.9, middle, -2.0 - 0.9 * sign));
                let found = s.singular_angles(r, eta(7.0));
                assert!((found - eta(-2.0)).length() < 1e-7); // of the arc sine at 1, root of a rounding
                let rate = s.singular_rates(found, DVec3::AXES[s.axes[2]]);
                let later = s.singular_angles(r * rotation_about(s.axes[2], h), found);
                assert!(((later - found) / h - rate).length() < 1e-8); // a rounding over h
            }
        }
    }

    /// G by rotations of the axes, each into the frame after it.
    fn g_by_rotations(s: EulerSequence, eta: DVec3) -> DMat3 {
        let [i, j, k] = s.axes;
        let (rk_t, rj_t) = (rotation_about(k, -eta.z), rotation_about(j, -eta.y));
        DMat3::from_cols(
            rk_t * (rj_t * DVec3::AXES[i]),
            rk_t * DVec3::AXES[j],
            DVec3::AXES[k],
        )
    }

    /// Its partial derivatives by the angular velocities of these rotations.
    fn g_partials_by_rotations(s: EulerSequence, eta: DVec3) -> [DMat3; 2] {
        let [i, j, k] = s.axes;
        let (rk_t, rj_t) = (rotation_about(k, -eta.z), rotation_about(j, -eta.y));
        let first = rj_t * DVec3::AXES[i];
        let d_first = -DVec3::AXES[j].cross(first);
        let ek = DVec3::AXES[k];
        let d_eta1 = DMat3::from_cols(rk_t * d_first, DVec3::ZERO, DVec3::ZERO);
        let d_eta2 = DMat3::from_cols(
            -ek.cross(rk_t * first),
            -ek.cross(rk_t * DVec3::AXES[j]),
            DVec3::ZERO,
        );
        [d_eta1, d_eta2]
    }

    #[test]
    fn agrees_matrices_with_those_by_rotations_of_the_axes() {
        let same = |a: DMat3, b: DMat3| (a - b).to_cols_array().iter().all(|e| e.abs() < 1e-15);
        let eta = DVec3::new(2.1, -0.7, -1.3);
        for s in BOTH {
            let m = s.matrices(eta);
            assert!(same(m.r, s.rotation(eta)) && same(m.g, g_by_rotations(s, eta))); // a few roundings
            let [b, c] = g_partials_by_rotations(s, eta);
            assert!(same(m.g_partials[0], b) && same(m.g_partials[1], c));
        }
    }

    #[test]
    fn agrees_g_and_g_dot_with_differences_of_the_rotation() {
        let at = |t: f64| DVec3::new(0.4 + t, -0.6 + 0.5 * t * t, 0.9 - 2.0 * t);
        let rate = |t: f64| DVec3::new(1.0, t, -2.0);
        let (t, h) = (0.3, 1e-5);
        for s in BOTH {
            let r = s.rotation(at(t));
            let r_dot = (s.rotation(at(t + h)) - s.rotation(at(t - h))) * (0.5 / h);
            let w = untilde(r.transpose() * r_dot);
            // Second-order differences at h = 1e-5: truncation 1e-10, rounding 1e-11.
            assert!((w - s.g(at(t)) * rate(t)).length() < 1e-9);
            let [dy, dz] = s.matrices(at(t)).g_partials;
            let g_dot = dy * rate(t).y + dz * rate(t).z;
            let gap = (s.g(at(t + h)) - s.g(at(t - h))) * (0.5 / h) - g_dot;
            assert!(gap.to_cols_array().iter().all(|e| e.abs() < 1e-9));
            assert!((s.g(at(t)).determinant().abs() - s.regularity(at(t))).abs() < 1e-14);
        }
    }
}
