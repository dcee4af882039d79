//! Which rows of wake become vortex particles.

use crate::error::{AirError, is_positive, require};
use wingbeat_vortex::Stretching;

/// Which rows of wake become particles, and how these behave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleSettings {
    /// Newest rows that stay rings, 1 or more; none: all rows stay.
    pub after: Option<usize>,
    /// Whether columns that leave leading edges keep their newest row of rings only.
    pub leading_at_once: bool,
    /// Radius sigma of new particles [m]; segments longer than it become several particles.
    pub radius: f64,
    /// Effective kinematic viscosity nu [m2/s]: sigma^2 grows as `4 nu age`, core spreading
    /// [Leonard 1980, J. Comput. Phys. 37:289].
    pub viscosity: f64,
    /// How strengths change; filaments and wind stretch particles unless this is omitted.
    pub stretching: Stretching,
}

impl ParticleSettings {
    /// # Errors
    /// [`AirError::Setting`] names the first number that makes no sense.
    pub(crate) fn validate(&self) -> Result<(), AirError> {
        require(
            self.after != Some(0),
            "particles: after",
            0,
            "at least 1 row of rings: the one on the edge; or none to keep all",
        )?;
        require(
            self.after.is_some() || self.leading_at_once,
            "particles",
            format!("{self:?}"),
            "rows to be kept or leading_at_once: otherwise nothing becomes a particle",
        )?;
        require(
            is_positive(self.radius),
            "particles: radius",
            self.radius,
            "a finite length in m above 0",
        )?;
        require(
            self.viscosity.is_finite() && self.viscosity >= 0.0,
            "particles: viscosity",
            self.viscosity,
            "a finite number of m2/s, 0 for cores that stay",
        )
    }

    /// sigma^2 [m2] of a particle of this age [s].
    pub fn core(&self, age: f64) -> f64 {
        self.radius * self.radius + 4.0 * self.viscosity * age.max(0.0)
    }
}
