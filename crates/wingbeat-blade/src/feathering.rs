//! Circulation of a section that feathers while it moves, `C_rot c^2 q`.

use std::f64::consts::PI;

use crate::settings::{BladeSettings, Rotation};
use crate::strip::Strip;

/// The coefficient C_rot of a strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum RotationCoefficient {
    /// The same however the air is met \[1\]: `pi (3/4 - x0)` by Sane & Dickinson (2002), or a number of a case.
    Constant(f64),
    /// `pi (1/4 + (1/2 - x0) cos alpha)`, by x0, the feathering axis behind the leading edge over the chord \[1\];
    /// the cosine is negative where the air comes from behind.
    ///
    /// Thin-airfoil theory takes the normal velocity at 3/4 of the chord from the edge in front: `pi (3/4 - x0)`
    /// from ahead, `pi (x0 - 1/4)` from behind. Between the two it is linear in the cosine, as `pi c (w cos alpha +
    /// C_rot c q / pi)` then depends on the motion of the section alone, not on which axis it is referred to.
    OfEdgeInFront(f64),
}

impl RotationCoefficient {
    /// That of strip `s`. Wakes of strips are those of attached flow by theory, whatever the law, unless there is none or
    /// one coefficient.
    pub fn of(settings: &BladeSettings, s: &Strip) -> Self {
        match settings.rotation {
            Rotation::None => Self::Constant(0.0),
            Rotation::Coefficient(c) => Self::Constant(c),
            Rotation::SaneDickinson if settings.unsteady.is_none() => {
                Self::Constant(PI * (0.75 - s.x0()))
            }
            Rotation::SaneDickinson | Rotation::Circulation => Self::OfEdgeInFront(s.x0()),
        }
    }

    /// Part without the cosine of the angle of attack, and what is multiplied with it \[1\].
    pub fn parts(self) -> [f64; 2] {
        match self {
            Self::Constant(c) => [c, 0.0],
            Self::OfEdgeInFront(x0) => [0.25 * PI, PI * (0.5 - x0)],
        }
    }

    /// How far behind the feathering axis the downwash is that the circulation follows, over the chord \[1\]: part
    /// without the cosine of the angle of attack, and what is multiplied with it.
    ///
    /// In theory a quarter of the chord behind mid chord as the air comes; with one coefficient C_rot where the
    /// force `-rho C_rot c^2 q u` has it.
    pub fn lever(self) -> [f64; 2] {
        match self {
            Self::Constant(c) => [0.0, c / PI],
            Self::OfEdgeInFront(x0) => [0.5 - x0, 0.25],
        }
    }
}
