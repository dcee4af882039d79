//! Blobs spread as Gaussians.
//!
//! With r = x - x_q, t = abs(r) / s a blob of strength alpha and variance s^2 moves the air by
//! \[Winckelmans & Leonard 1993, J. Comput. Phys. 109:247\]
//!
//! u(x) = 1/(4 pi s^3) g alpha x r,  g = (erf(t / sqrt 2) - sqrt(2 / pi) t exp(-t^2 / 2)) / t^3.

use crate::cores::INV_4PI;
use crate::cores::vector::{Double, Precision};
use crate::direct::block::{Block, Targets};
use crate::direct::smoothing::{Smoothing, add_velocities};
use crate::sources::Blob;
use fearless_simd::{Level, dispatch, prelude::*};
use std::f64::consts::LOG2_E;

/// Blobs of one width.
#[derive(Clone, Debug, Default)]
pub(crate) struct WidthLevel {
    /// s \[m\].
    pub width: f64,
    pub blobs: Vec<Blob>,
}

impl WidthLevel {
    /// Adds the velocities of all at the targets.
    #[inline(always)]
    pub fn add<S: Simd>(&self, simd: S, targets: Targets<'_>, sum: &mut Block) {
        let inverse = 1.0 / (self.width * self.width);
        let smoothing = Gaussian {
            inverse,
            scale: INV_4PI * inverse / self.width,
        };
        add_velocities(simd, &smoothing, &self.blobs, targets, sum);
    }
}

/// The smoothing of one width.
struct Gaussian {
    /// 1 / s^2 [1/m2].
    inverse: f64,
    scale: f64,
}

impl Smoothing for Gaussian {
    fn scale(&self) -> f64 {
        self.scale
    }

    #[inline(always)]
    fn factor<S: Simd>(&self, simd: S, rho2: S::f64s, _: f64) -> S::f64s {
        swirl(simd, rho2 * self.inverse)
    }
}

/// g as a function of t^2: nine digits everywhere.
#[inline(always)]
fn swirl<S: Simd>(simd: S, z: S::f64s) -> S::f64s {
    let splat = |x: f64| S::f64s::splat(simd, x);
    let four = splat(4.0);
    let near = polynomial(simd, &NEAR, z.min(four) * 0.5 - 1.0);
    // g t^3 = 1 - t exp(-t^2 / 2) V(1 / t).
    let far = z.max(four);
    let y = splat(1.0) / far.sqrt();
    let v = polynomial(simd, &FAR, y * 4.0 - 1.0);
    let mut fall = [far * (0.5 * LOG2_E)];
    <Double as Precision<S>>::one_minus_exp2(simd, &mut fall);
    let far = splat(1.0) - (splat(1.0) - fall[0]) * (far * y) * v;
    z.simd_lt(four).select(near, far * (y * y * y))
}

#[inline(always)]
fn polynomial<S: Simd>(simd: S, c: &[f64; 12], x: S::f64s) -> S::f64s {
    let x2 = x * x;
    let (mut even, mut odd) = (S::f64s::splat(simd, c[10]), S::f64s::splat(simd, c[11]));
    for k in (0..10).step_by(2).rev() {
        even = even * x2 + c[k];
        odd = odd * x2 + c[k + 1];
    }
    odd * x + even
}

/// The same as [`swirl`], one at a time.
pub(crate) fn swirl_of(z: f64) -> f64 {
    return dispatch!(Level::fallback(), simd => one(simd, z));

    #[inline(always)]
    fn one<S: Simd>(simd: S, z: f64) -> f64 {
        swirl(simd, S::f64s::splat(simd, z)).as_slice()[0]
    }
}

/// g on t^2 = 2 + 2 x, x in \[-1, 1\], lowest power first: the Chebyshev interpolant at twelve points, to 1.2e-13.
const NEAR: [f64; 12] = [
    0.1511770594292601,
    -0.08000292597016749,
    0.0266223258767094,
    -0.006598936326252404,
    0.0013086923912579177,
    -0.00021653944769546335,
    3.074741347349333e-5,
    -3.824038047194136e-6,
    4.2300693706496084e-7,
    -4.2150684174859155e-8,
    3.894341383702765e-9,
    -3.2278272441818224e-10,
];

/// V = sqrt(2 / pi) + y exp(1 / (2 y^2)) erfc(1 / (y sqrt 2)) on y = (1 + x) / 4, likewise, to 9e-10.
const FAR: [f64; 12] = [
    0.8450898819214759,
    0.08980475079980087,
    0.036847088495477257,
    -0.006168127458289765,
    0.00016213463338045413,
    0.0003923494253241263,
    -0.00017791262072922178,
    3.358125379230582e-5,
    1.2112602401335778e-5,
    -1.2257906902706595e-5,
    2.256868946483686e-6,
    7.04298288504713e-7,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// g against the series of its definition about zero, and against 1 / t^3 far off, where it is a point's.
    #[test]
    fn exact_swirl() {
        // Integral of the vorticity within t: 3 sqrt(2 / pi) sum (-z / 2)^n / (n! (2 n + 3)) / 3.
        let series = |z: f64| {
            let (mut term, mut sum) = (1.0, 0.0);
            for n in 0..60 {
                sum += term / (2 * n + 3) as f64;
                term *= -0.5 * z / (n + 1) as f64;
            }
            (2.0 / std::f64::consts::PI).sqrt() * sum
        };
        for z in [0.0, 1e-9, 0.3, 1.0, 3.9, 4.1, 6.0, 9.0, 14.0] {
            let (g, exact) = (swirl_of(z), series(z));
            // The series cancels some digits at the end; the interpolants keep nine.
            assert!((g / exact - 1.0).abs() < 3e-9, "{z}: {g} {exact}");
        }
        for z in [80.0, 1e4, 1e12, 1e100] {
            assert!((swirl_of(z) * z * z.sqrt() - 1.0).abs() < 1e-12, "{z}");
        }
    }
}
