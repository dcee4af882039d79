//! Drag of the sections of wings at low Reynolds number: coefficients.

use crate::error::{AirError, require};

/// Drag of the sections of wings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionDrag {
    /// Friction.
    pub friction: Friction,
    /// Profile drag coefficient at zero incidence.
    pub cd0: f64,
    /// Its growth with the square of the incidence [1/rad2].
    pub cd2: f64,
}

/// Friction of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// None.
    None,
    /// Laminar flat plate, both sides.
    Blasius {
        /// Kinematic viscosity nu [m2/s].
        viscosity: f64,
    },
}

/// Mean friction coefficient of one side of a laminar flat plate times sqrt(Re).
const BLASIUS: f64 = 1.328;

impl SectionDrag {
    /// `|U| C` [m/s] of a strip of the given chord [m] at the speed |U| [m/s] and the incidence [rad].
    /// With the speed, because the friction coefficient alone grows beyond bounds at rest.
    pub fn speed_times_coefficient(&self, speed: f64, chord: f64, alpha: f64) -> f64 {
        let friction = match self.friction {
            Friction::None => 0.0,
            Friction::Blasius { viscosity } => 2.0 * BLASIUS * (viscosity * speed / chord).sqrt(),
        };
        friction + speed * (self.cd0 + self.cd2 * alpha * alpha)
    }

    /// # Errors
    /// [`AirError::Setting`] names the first number that makes no sense.
    pub(crate) fn validate(&self) -> Result<(), AirError> {
        let at_least_0 = |x: f64| x.is_finite() && x >= 0.0;
        let number = "a finite number >= 0";
        require(at_least_0(self.cd0), "section drag cd0", self.cd0, number)?;
        require(at_least_0(self.cd2), "section drag cd2", self.cd2, number)?;
        match self.friction {
            Friction::None => Ok(()),
            Friction::Blasius { viscosity } => require(
                viscosity.is_finite() && viscosity > 0.0,
                "section drag viscosity",
                viscosity,
                "a finite viscosity in m2/s above 0",
            ),
        }
    }
}
