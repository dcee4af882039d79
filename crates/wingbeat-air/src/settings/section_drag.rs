//! Drag of the sections of wings at low Reynolds number: coefficients.

use crate::error::{AirError, is_positive, require};

/// Drag of the sections of wings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionDrag {
    /// Friction.
    pub friction: Friction,
    /// Profile drag coefficient at zero incidence \[1\].
    pub cd0: f64,
    /// Its growth with the square of the incidence [1/rad2].
    pub cd2: f64,
}

/// Friction of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// None.
    None,
    /// Laminar flat plate, both faces, less on one where the flow leaves the leading edge, see
    /// [`SectionDrag::speed_times_friction`].
    Blasius {
        /// Kinematic viscosity nu [m2/s].
        viscosity: f64,
    },
}

/// Mean friction coefficient of one side of a laminar flat plate times sqrt(Re).
const BLASIUS: f64 = 1.328;
/// What the speeding up of the flow at the trailing edge adds, times Re^(7/8).
const TRAILING_EDGE: f64 = 2.67;

impl SectionDrag {
    /// No drag.
    pub const NONE: Self = Self {
        friction: Friction::None,
        cd0: 0.0,
        cd2: 0.0,
    };

    /// `|U| C_f` [m/s] of both sides of a strip of the given chord [m] at the speed |U| [m/s] along it. With the speed,
    /// because the coefficient alone grows beyond bounds at rest. On each side
    ///
    /// `C_f = 1.328 / sqrt(Re) + 2.67 / Re^(7/8)`, `Re = |U| c / nu`
    ///
    /// # Source
    /// Blasius 1908; trailing edge: Stewartson 1969, Mathematika 16:106, Messiter 1970, SIAM J. Appl. Math.
    /// 18:241, the number by Jobe & Burggraf 1974, Proc. R. Soc. Lond. A 340:91. Solutions of the Navier-Stokes
    /// equations have 0.740, 0.311, 0.180, 0.0812 and 0.0496 at Re = 10, 40, 100, 400 and 1000 (steady, in
    /// elliptic coordinates): this is 5 % more at 10 and within 3 % from 40 on, Blasius alone is 26 % short at 100.
    pub fn speed_times_friction(&self, speed: f64, chord: f64) -> f64 {
        match self.friction {
            Friction::None => 0.0,
            Friction::Blasius { viscosity } => {
                let unit = viscosity / chord; // speed of Re = 1
                let (blasius, edge) = ((unit * speed).sqrt(), unit.powf(0.875) * speed.powf(0.125));
                2.0 * (BLASIUS * blasius + TRAILING_EDGE * edge)
            }
        }
    }

    /// Profile drag coefficient at the incidence [rad].
    pub fn profile(&self, alpha: f64) -> f64 {
        self.cd0 + self.cd2 * alpha * alpha
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
                is_positive(viscosity),
                "section drag viscosity",
                viscosity,
                "a finite viscosity in m2/s above 0",
            ),
        }
    }
}
