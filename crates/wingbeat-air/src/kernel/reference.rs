//! The kernel in plain scalar arithmetic, operation by operation as the vector kernel does it.
//!
//! Readable form, oracle of the vector code, and the right tool for a handful of evaluations.

use super::model::CoreModel;
use super::sources::{Points, Segments};
use std::f64::consts::PI;
use wingbeat_math::DVec3;

/// Velocity \[m/s\] at `p` induced by the segment a -> b (frame N, m) of circulation `gamma`
/// \[m^2/s\] and regularisation number `core` ([`CoreModel::core`]).
///
/// With n = abs(r), d = r1.r2, c = r1 x r2, c^2 = (n1 n2 - d)(n1 n2 + d), the bare filament is
/// c (n1 + n2)(n1 n2 - d) / (n1 n2 c^2). The textbook difference of cosines loses n1 n2 - d near
/// the extension of the filament; here the small one of n1 n2 -+ d is c^2 over the large one,
/// s = n1 n2 + abs(d). The core factors change only the last c^2 (h^2 = c^2 / r0^2):
/// Scully makes it c^2 + e, Vatistas sqrt(c^4 + e^2), e = r_c^2 r0^2.
///
/// On the line of the filament, its nodes included, the result is zero.
///
/// ```
/// use wingbeat_air::kernel::{reference, CoreModel};
/// use wingbeat_math::DVec3;
/// // One metre from the middle of two metres of bare filament: Gamma/(4 pi h) 2 cos 45 deg.
/// let bare = CoreModel::Scully { radius: 0.0 };
/// let v = reference::segment_velocity(bare, DVec3::Z, -DVec3::X, DVec3::X, 1.0, 0.0);
/// let expected = -DVec3::Y * 2f64.sqrt() / (4.0 * std::f64::consts::PI);
/// assert!((v - expected).length() < 1e-16);
/// ```
pub fn segment_velocity(
    model: CoreModel,
    p: DVec3,
    a: DVec3,
    b: DVec3,
    gamma: f64,
    core: f64,
) -> DVec3 {
    let (r1, r2) = (p - a, p - b);
    let (n1, n2) = (dot(r1, r1).sqrt(), dot(r2, r2).sqrt());
    let (nn, d, c) = (n1 * n2, dot(r1, r2), cross(r1, r2));
    let term = model.kernel_term(core, dot(b - a, b - a));
    let (num, den) = match model {
        CoreModel::CutOff { .. } => (n1 + n2, nn * (nn + d) + term),
        _ => regularised(model, n1 + n2, nn, d, dot(c, c), term),
    };
    let k = if den > 0.0 {
        num * (gamma * STRENGTH) / den
    } else {
        0.0
    };
    c * k
}

/// 1 / (4 pi).
pub(crate) const STRENGTH: f64 = 0.25 / PI;

/// Numerator and denominator of K for the models that multiply the bare filament by a function of h.
fn regularised(model: CoreModel, sum: f64, nn: f64, d: f64, c2: f64, term: f64) -> (f64, f64) {
    let s = nn + d.abs();
    let num = sum * if d > 0.0 { c2 } else { s * s };
    match model {
        CoreModel::Scully { .. } => (num, nn * s * (c2 + term)),
        CoreModel::Vatistas { .. } => (num, nn * s * (c2 * c2 + term * term).sqrt()),
        CoreModel::LambOseen { .. } => (num * one_minus_exp(c2 * term), nn * s * c2),
        CoreModel::CutOff { .. } => unreachable!("the cut-off is not a function of h"),
    }
}

/// u = 1 - exp(-x), x >= 0, to a few units in the last place with products and sums only, so that
/// every processor gives the same bits: a polynomial at x / 64, then six times
/// u(2x) = u(x) (2 - u(x)), which cancels nothing. Above x = 40 it is 1 to machine accuracy.
///
/// The polynomial is summed in pairs (Estrin): its chain of dependent operations is half as long as
/// Horner's, and the chain is what the processor waits for.
pub fn one_minus_exp(x: f64) -> f64 {
    let a = EXP_POLYNOMIAL;
    let y = x.min(40.0) * (1.0 / 64.0);
    let (y2, pair) = (y * y, |i: usize| a[i] + a[i + 1] * y);
    let y4 = y2 * y2;
    let (low, middle) = (pair(0) + pair(2) * y2, pair(4) + pair(6) * y2);
    let mut u = ((low + middle * y4) + pair(8) * (y4 * y4)) * y;
    for _ in 0..6 {
        u = u * (2.0 - u);
    }
    u
}

/// (1 - exp(-y)) / y on \[0, 40/64\], lowest power first: the Chebyshev interpolant at ten points,
/// relative error 4e-16.
pub(crate) const EXP_POLYNOMIAL: [f64; 10] = [
    0.999_999_999_999_999_7,
    -0.499_999_999_999_892_6,
    0.166_666_666_660_986_48,
    -0.041_666_666_550_040_546,
    0.008_333_332_115_531_883,
    -0.001_388_881_570_299_966_8,
    0.000_198_385_840_128_103_94,
    -2.474_026_104_727_837e-5,
    2.670_230_005_253_597_6e-6,
    -2.078_765_350_341_922_4e-7,
];

/// Adds to `out` the velocities \[m/s\] of all segments at all targets, one after the other.
pub fn add_velocity(model: CoreModel, segments: &Segments, targets: &Points, out: &mut Points) {
    for t in 0..targets.len() {
        let p = targets.get(t);
        let mut v = DVec3::ZERO;
        for i in 0..segments.len() {
            let (a, b) = (segments.a(i), segments.b(i));
            v += segment_velocity(model, p, a, b, segments.gamma[i], segments.core[i]);
        }
        out.set(t, out.get(t) + v);
    }
}

/// Scalar product, summed from the left (the order is part of the bits).
fn dot(a: DVec3, b: DVec3) -> f64 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Vector product.
fn cross(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(
        a.y * b.z - a.z * b.y,
        a.z * b.x - a.x * b.z,
        a.x * b.y - a.y * b.x,
    )
}
