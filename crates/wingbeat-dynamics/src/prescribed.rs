//! What depends on time alone where no joint is free: evaluated once, asked for by every state at that time.

use wingbeat_math::six_by_six::Ldlt;
use wingbeat_math::{DMat3, DVec3, Six, SixBySix};

use crate::added_mass::AddedMass;
use crate::error::DynamicsError;

/// The inverse of the inertia I of the whole, by Cramer's rule.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turning {
    cofactors: [DVec3; 3],
    determinant: f64,
    /// Mean moment of inertia [kg m2].
    scale: f64,
}

impl Turning {
    /// Of the inertia `i` [kg m2].
    pub fn of(i: DMat3) -> Self {
        let (x, y, z) = (i.x_axis, i.y_axis, i.z_axis);
        let yz = y.cross(z);
        Self {
            cofactors: [yz, z.cross(x), x.cross(y)],
            determinant: x.dot(yz),
            scale: (x.x + y.y + z.z) / 3.0,
        }
    }

    /// Solves `I x = h`.
    ///
    /// # Errors
    /// A singular inertia.
    pub fn solve(&self, time: f64, h: DVec3) -> Result<DVec3, DynamicsError> {
        let (scale, [yz, zx, xy]) = (self.scale, self.cofactors);
        // 1e-12 of the mean moment cubed: a rod a million times longer than thick.
        if self.determinant > 1e-12 * scale.powi(3) {
            return Ok(DVec3::new(h.dot(yz), h.dot(zx), h.dot(xy)) / self.determinant);
        }
        Err(DynamicsError::SingularInertia { time, scale })
    }
}

/// Added masses as they join the inertia of the whole.
#[derive(Clone, Debug, Default)]
pub(crate) struct Carried {
    /// The time that all of it belongs to.
    pub at: Option<f64>,
    /// The added masses.
    pub added: Vec<AddedMass>,
    /// J of each: row by row the acceleration of its body by that of the mass centre and the root's angular one; zero
    /// where nothing is felt.
    pub rows: Vec<SixBySix>,
    /// `diag(m, I) + sum J^T A J`.
    pub inertia: Ldlt,
    /// s0 of the bodies in the state last asked for.
    pub at_rest: Vec<Six>,
}
