//! Loads that follow the accelerations of bodies: the air that a wing carries along.
//!
//! The load of body i is `-A_i (a, alpha)` beside what depends on position and velocity alone, so
//! loads and accelerations follow from each other. Both sides are affine: the unknown loads
//! `z = -A a(z)` solve a linear system, exactly and whatever the formulation,
//!
//! ```text
//! a(z) = a(0) + S z        (1 + A S) z = -A a(0)
//! ```
//!
//! S holds the accelerations of all bodies under unit loads. Where all joints are prescribed the
//! momentum form has it closed: the added masses join the inertia of the whole,
//! `(diag(m, I) + sum J^T A J) (a_c, alpha) = loads - sum J^T A s0` ([`MomentumForm`]).
//!
//! [`MomentumForm`]: crate::MomentumForm

use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, Six, SixBySix, Wrench, six};

/// Air that a body carries along: force and moment about the body's origin are
/// `-A (a, alpha)`, all in body components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AddedMass {
    body: usize,
    matrix: SixBySix,
    /// Directions along which it is felt, the first `felt` of them.
    directions: [usize; 6],
    felt: usize,
}

impl AddedMass {
    /// The symmetric `matrix` A of body number `body`: rows force and moment, columns acceleration
    /// of the origin and angular acceleration [kg, kg m, kg m2].
    pub fn new(body: usize, matrix: SixBySix) -> Self {
        let (mut directions, mut felt) = ([0; 6], 0);
        for (k, row) in matrix.iter().enumerate() {
            if row.iter().any(|x| *x != 0.0) {
                directions[felt] = k;
                felt += 1;
            }
        }
        Self {
            body,
            matrix,
            directions,
            felt,
        }
    }

    /// Index of the body.
    pub fn body(&self) -> usize {
        self.body
    }

    /// A.
    pub fn matrix(&self) -> &SixBySix {
        &self.matrix
    }

    /// Force and moment under the acceleration `s` (origin, angular), body components.
    pub fn load(&self, s: &Six) -> Six {
        let mut load = [0.0; 6];
        for &i in self.directions() {
            for &j in self.directions() {
                load[i] -= self.matrix[i][j] * s[j];
            }
        }
        load
    }

    /// The same as a wrench on a body that moves like `m` and accelerates like `a`.
    pub fn wrench(&self, m: &BodyMotion, a: &BodyAcceleration) -> Wrench {
        wrench(m.r, &self.load(&seen(m, a)))
    }

    /// Directions along which the added mass is felt; A is zero along all others.
    pub(crate) fn directions(&self) -> &[usize] {
        &self.directions[..self.felt]
    }
}

/// Acceleration of the origin and angular acceleration, body components.
pub(crate) fn seen(m: &BodyMotion, a: &BodyAcceleration) -> Six {
    let linear = m.r.transpose() * a.linear;
    six(linear, a.angular)
}

/// The load of six body components on a body of the attitude `r`.
pub(crate) fn wrench(r: DMat3, load: &Six) -> Wrench {
    Wrench {
        force: r * DVec3::from_slice(load),
        moment: r * DVec3::from_slice(&load[3..]),
    }
}
