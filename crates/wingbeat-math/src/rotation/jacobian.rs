//! How the rotation vector of a body moves with its angular velocity.
//!
//! With theta the rotation vector of a rotation and w its angular velocity in the turned axes, `theta' =
//! A(theta) w`, `A(theta) = 1 + tilde(theta) / 2 + c(theta^2) tilde(theta)^2`, the inverse of the right
//! Jacobian of rotations (Barfoot, State Estimation for Robotics, 2017, eq. 7.76). What acts along theta with
//! f, of power `f . theta'`, is the moment `A^T f` in the turned axes. A has an inverse up to a full turn;
//! turns count up to half a turn here.

use glam::{DMat3, DVec3};

use super::elementary::tilde;

/// `c(x) = (1 - h cot h) / x`, `h = sqrt(x) / 2`, with its first two derivatives by x = theta^2.
#[derive(Clone, Copy, Debug)]
pub struct Curve {
    /// c \[1\].
    pub c: f64,
    /// Its derivative by x \[1\].
    pub first: f64,
    /// Its second derivative by x \[1\].
    pub second: f64,
}

/// Coefficients of the power series of c: `|B_2n| / (2n)!`, n = 1, 2, ... with Bernoulli's numbers.
const SERIES: [f64; 10] = [
    1.0 / 12.0,
    1.0 / 720.0,
    1.0 / 30_240.0,
    1.0 / 1_209_600.0,
    1.0 / 47_900_160.0,
    691.0 / 1_307_674_368_000.0,
    1.0 / 74_724_249_600.0,
    3617.0 / 10_670_622_842_880_000.0,
    43_867.0 / 5_109_094_217_170_944_000.0,
    174_611.0 / 802_857_662_698_291_200_000.0,
];

impl Curve {
    /// At a rotation vector of at most half a turn.
    pub fn at(theta: DVec3) -> Self {
        let x = theta.length_squared();
        // The series converges as (x / 39.5)^n; the closed form loses digits as x^-2.
        if x < 0.5 {
            Self::series(x)
        } else {
            Self::closed(x)
        }
    }

    fn series(x: f64) -> Self {
        let (mut c, mut first, mut second) = (0.0, 0.0, 0.0);
        for s in SERIES.iter().rev() {
            second = second * x + 2.0 * first;
            first = first * x + c;
            c = c * x + s;
        }
        Self { c, first, second }
    }

    /// `a = h cot h` fulfils `a' = (a - a^2) / (2 x) - 1/8`.
    fn closed(x: f64) -> Self {
        let h = 0.5 * x.sqrt();
        let a = h / h.tan();
        let bend = (a - a * a) / (2.0 * x);
        let (a1, c) = (bend - 0.125, (1.0 - a) / x);
        let a2 = a1 * (0.5 - a) / x - bend / x;
        let first = -(a1 + c) / x;
        let second = -(a2 + 2.0 * first) / x;
        Self { c, first, second }
    }
}

/// Inverse of the right Jacobian of rotations, A(theta).
///
/// ```
/// use wingbeat_math::DVec3;
/// use wingbeat_math::rotation_jacobian::{Curve, inverse_right_jacobian};
/// // A body turned by a quarter about axis 3 that turns about its own axis 1.
/// let theta = DVec3::Z * std::f64::consts::FRAC_PI_2;
/// let rate = inverse_right_jacobian(&Curve::at(theta), theta) * DVec3::X;
/// let quarter = std::f64::consts::FRAC_PI_4;
/// assert!((rate - DVec3::new(quarter, quarter, 0.0)).length() < 1e-15);
/// ```
pub fn inverse_right_jacobian(curve: &Curve, theta: DVec3) -> DMat3 {
    let t = tilde(theta);
    DMat3::IDENTITY + t * 0.5 + t * t * curve.c
}
