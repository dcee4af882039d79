//! Mass properties of rigid bodies about a frame origin and their algebra (seed eq. 19).

use crate::linear::matrix::outer;
use crate::linear::six_by_six::{SixBySix, from_quarters};
use crate::rotation::{rotation_about, tilde};
use glam::{DMat3, DVec3};

/// Mass, first and second moment of mass of a rigid body about its frame origin, in body
/// components. The mass centre may be anywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass m [kg].
    pub mass: f64,
    /// First moment `S = integral rho r` [kg m]; the seed's U is `tilde(S)`.
    pub first_moment: DVec3,
    /// Inertia about the origin `J = integral rho (r.r I - r r^T)` [kg m2], the seed's I^{eta eta}.
    pub inertia: DMat3,
}

/// Why a set of numbers is not the mass properties of a body.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MassError {
    /// The mass is negative or not finite.
    #[error("mass {0} kg is not a finite number >= 0")]
    Mass(f64),
    /// A moment is not a finite number.
    #[error("a moment of mass is not a finite number")]
    NotFinite,
    /// A first moment without mass.
    #[error("a body without mass has a first moment of {0:.3e} kg m")]
    Massless(f64),
    /// The inertia matrix is not symmetric.
    #[error("the inertia matrix is not symmetric")]
    NotSymmetric,
    /// A principal moment about the mass centre is negative.
    #[error(
        "the principal moment of inertia {0:.3e} kg m2 about the mass centre is negative; check the products of inertia and the mass centre"
    )]
    Negative(f64),
    /// The principal moments break the triangle inequality.
    #[error(
        "the principal moments of inertia {0:.3e}, {1:.3e} and {2:.3e} kg m2 about the mass centre break the triangle inequality: no distribution of positive mass has them"
    )]
    Triangle(f64, f64, f64),
}

impl MassProperties {
    /// A body without mass.
    pub const ZERO: Self = Self {
        mass: 0.0,
        first_moment: DVec3::ZERO,
        inertia: DMat3::ZERO,
    };

    /// A point mass [kg] at `r` [m].
    pub fn point(mass: f64, r: DVec3) -> Self {
        let t = tilde(r);
        Self {
            mass,
            first_moment: mass * r,
            inertia: t.transpose() * t * mass,
        }
    }

    /// From mass [kg], mass centre [m] and inertia about the mass centre [kg m2].
    pub fn about_centre(mass: f64, centre: DVec3, inertia_centre: DMat3) -> Self {
        let p = Self::point(mass, centre);
        Self {
            inertia: inertia_centre + p.inertia,
            ..p
        }
    }

    /// Mass centre [m]; the origin for a body without mass.
    pub fn centre(&self) -> DVec3 {
        if self.mass > 0.0 {
            self.first_moment / self.mass
        } else {
            DVec3::ZERO
        }
    }

    /// Inertia about the mass centre [kg m2].
    pub fn inertia_about_centre(&self) -> DMat3 {
        self.inertia - Self::point(self.mass, self.centre()).inertia
    }

    /// The same body in another frame: `p` is the old origin in the new frame [m], `r` maps old
    /// components to new.
    pub fn moved(&self, r: DMat3, p: DVec3) -> Self {
        let s = r * self.first_moment;
        let (ts, tp) = (tilde(s), tilde(p));
        Self {
            mass: self.mass,
            first_moment: s + self.mass * p,
            inertia: r * self.inertia * r.transpose() - ts * tp - tp * ts - tp * tp * self.mass,
        }
    }

    /// Force (N components) and moment about the origin (body components) by the acceleration of the origin (N) and
    /// the angular acceleration (body), of a body of the attitude `r`, R_NB \[kg, kg m, kg m2\]: symmetric.
    ///
    /// ```
    /// use wingbeat_math::{DMat3, DVec3, MassProperties};
    /// let body = MassProperties::point(2.0, DVec3::X);
    /// let m = body.matrix(DMat3::IDENTITY);
    /// assert_eq!([m[0][0], m[1][5], m[5][1], m[5][5]], [2.0; 4]); // it turns about axis 3: force along axis 2
    /// ```
    pub fn matrix(&self, r: DMat3) -> SixBySix {
        let s = tilde(self.first_moment);
        let mass = DMat3::from_diagonal(DVec3::splat(self.mass));
        from_quarters([[mass, -(r * s)], [s * r.transpose(), self.inertia]])
    }

    /// All mass multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            mass: factor * self.mass,
            first_moment: factor * self.first_moment,
            inertia: self.inertia * factor,
        }
    }

    /// Checks that some distribution of positive mass has these moments.
    ///
    /// # Errors
    /// [`MassError`] names the first condition that fails. Round-off of 1e-9 of the largest entry of the
    /// inertia about the origin is forgiven (meshes of flat plates meet the triangle inequality with equality);
    /// for numbers that were rounded see [`Self::within_rounding`].
    pub fn validate(&self) -> Result<(), MassError> {
        if !(self.mass.is_finite() && self.mass >= 0.0) {
            return Err(MassError::Mass(self.mass));
        }
        if !(self.first_moment.is_finite() && self.inertia.is_finite()) {
            return Err(MassError::NotFinite);
        }
        if self.mass == 0.0 && self.first_moment != DVec3::ZERO {
            return Err(MassError::Massless(self.first_moment.length()));
        }
        let j = self.inertia_about_centre();
        let scale = self
            .inertia
            .to_cols_array()
            .iter()
            .fold(0.0_f64, |a, e| a.max(e.abs()));
        let skew = j - j.transpose();
        if skew.to_cols_array().iter().any(|e| e.abs() > 1e-9 * scale) {
            return Err(MassError::NotSymmetric);
        }
        let [a, b, c] = symmetric_eigenvalues(j);
        if a < -1e-9 * scale {
            return Err(MassError::Negative(a));
        }
        if a + b < c - 1e-9 * scale {
            return Err(MassError::Triangle(a, b, c));
        }
        Ok(())
    }
}

impl MassProperties {
    /// These properties, if the largest principal moment exceeds the sum of the two others by no more
    /// than the part `rounding` [1] of itself: it is then lowered to that sum. Published inertias of
    /// flat wings need this, whose moments fulfil `c = a + b` and have been rounded each for itself.
    ///
    /// # Errors
    /// As [`Self::validate`] for anything else.
    pub fn within_rounding(self, rounding: f64) -> Result<Self, MassError> {
        match self.validate() {
            Err(MassError::Triangle(a, b, c)) if c - (a + b) <= rounding * c => {
                let j = self.inertia_about_centre();
                let (_, axes) = symmetric_eigen(j);
                let excess = (c - (a + b)) * outer(axes.z_axis);
                Ok(Self::about_centre(self.mass, self.centre(), j - excess))
            }
            other => other.map(|()| self),
        }
    }
}

impl std::ops::Add for MassProperties {
    type Output = Self;
    /// Two bodies rigidly joined, both about the same frame.
    fn add(self, o: Self) -> Self {
        Self {
            mass: self.mass + o.mass,
            first_moment: self.first_moment + o.first_moment,
            inertia: self.inertia + o.inertia,
        }
    }
}

/// Eigenvalues of a symmetric 3 x 3 matrix, ascending.
fn symmetric_eigenvalues(m: DMat3) -> [f64; 3] {
    symmetric_eigen(m).0
}

/// Eigenvalues of a symmetric 3 x 3 matrix, ascending, and unit eigenvectors as columns, by Jacobi's
/// rotations: a double root is as good as a single one, where the closed form by the cubic keeps only
/// half the digits.
fn symmetric_eigen(m: DMat3) -> ([f64; 3], DMat3) {
    let (mut a, mut axes) = (m, DMat3::IDENTITY);
    for _ in 0..SWEEPS {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let (off, gap) = (a.col(j)[i], a.col(i)[i] - a.col(j)[j]);
            let r = rotation_about(3 - i - j, turn(i, j) * 0.5 * (2.0 * off).atan2(gap));
            a = r.transpose() * a * r;
            axes *= r;
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a.col(i)[i].total_cmp(&a.col(j)[j]));
    let [x, y, z] = order.map(|i| axes.col(i));
    (order.map(|i| a.col(i)[i]), DMat3::from_cols(x, y, z))
}

/// Sweeps of Jacobi's rotations; they converge quadratically, five reach round-off.
const SWEEPS: usize = 6;

/// Sense of the rotation about the third axis that turns axis i towards axis j.
fn turn(i: usize, j: usize) -> f64 {
    if (i + 1) % 3 == j { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::{r1, r2, r3};

    #[test]
    fn exact_ideal_thin_rods_and_rotated_bodies_are_accepted() {
        // A rod of no thickness has principal moments (0, 1, 1): equality in two conditions.
        let r = r1(0.3) * r2(-1.2) * r3(2.0);
        for d in [
            DVec3::new(0.0, 1.0, 1.0),
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::ONE,
        ] {
            let j = r * DMat3::from_diagonal(d) * r.transpose();
            let e = DVec3::from_array(symmetric_eigenvalues(j));
            assert!((e - d).length() < 1e-14, "{e}"); // a few roundings
            let body = MassProperties::about_centre(1.0, DVec3::ZERO, j);
            assert_eq!(body.validate(), Ok(()));
        }
    }

    /// A flat wing whose moments were rounded to three digits, in some attitude.
    #[test]
    fn exact_rounded_flat_wings_become_flat() {
        let r = r1(0.3) * r2(-1.2) * r3(2.0);
        // 0.0234 + 0.456 = 0.4794: the largest is 4.2e-4 of itself too large.
        let rounded = DVec3::new(0.0234, 0.456, 0.4796);
        let j = r * DMat3::from_diagonal(rounded) * r.transpose();
        let centre = DVec3::new(0.1, -0.2, 0.3);
        let body = MassProperties::about_centre(2.0, centre, j);
        assert!(matches!(body.validate(), Err(MassError::Triangle(..))));
        let mended = body.within_rounding(1e-3).unwrap();
        let flat = DMat3::from_diagonal(DVec3::new(0.0234, 0.456, 0.0234 + 0.456));
        let gap = mended.inertia_about_centre() - r * flat * r.transpose();
        assert!(gap.to_cols_array().iter().all(|e| e.abs() < 1e-15)); // roundings
        assert!((mended.centre() - centre).length() < 1e-15 && mended.mass == 2.0);
        assert!(body.within_rounding(1e-4).is_err());
        // What needs no mending keeps its bits.
        let sound = MassProperties::about_centre(2.0, centre, flat);
        assert_eq!(sound.within_rounding(1e-3), Ok(sound));
    }

    #[test]
    fn exact_moving_a_body_equals_moving_its_points() {
        let points = [
            (1.0, DVec3::new(0.1, 0.2, -0.3)),
            (2.0, DVec3::new(-0.4, 0.5, 0.6)),
            (0.5, DVec3::new(0.7, -0.8, 0.9)),
        ];
        let (r, p) = (r1(0.4) * r3(-1.1), DVec3::new(1.0, -2.0, 0.5));
        let sum = |f: &dyn Fn(DVec3) -> DVec3| {
            points
                .iter()
                .map(|&(m, x)| MassProperties::point(m, f(x)))
                .fold(MassProperties::ZERO, |a, b| a + b)
        };
        let moved = sum(&|x| x).moved(r, p);
        let direct = sum(&|x| r * x + p);
        assert!((moved.first_moment - direct.first_moment).length() < 1e-14); // roundings of O(1) numbers
        assert!(
            (moved.inertia - direct.inertia)
                .to_cols_array()
                .iter()
                .all(|e| e.abs() < 1e-13)
        );
        assert_eq!(moved.validate(), Ok(()));
    }

    #[test]
    fn exact_box_and_impossible_inertias() {
        let ok = MassProperties::about_centre(
            1.0,
            DVec3::X,
            DMat3::from_diagonal(DVec3::new(1.0, 2.0, 3.0)),
        );
        assert_eq!(ok.validate(), Ok(())); // a flat plate: equality in the triangle
        let bad = MassProperties::about_centre(
            1.0,
            DVec3::X,
            DMat3::from_diagonal(DVec3::new(1.0, 2.0, 3.1)),
        );
        assert!(matches!(bad.validate(), Err(MassError::Triangle(..))));
        assert!(matches!(
            ok.scaled(-1.0).validate(),
            Err(MassError::Mass(_))
        ));
    }

    #[test]
    fn refuses_a_first_moment_without_mass() {
        let ghost = MassProperties {
            first_moment: DVec3::new(0.0, 3e-6, 4e-6),
            ..MassProperties::ZERO
        };
        assert_eq!(ghost.validate(), Err(MassError::Massless(5e-6)));
        assert_eq!(MassProperties::ZERO.validate(), Ok(()));
    }
}
