//! The kernel as a sum of Gaussians: `x^(-3/2) = sum w exp(-t x)`, x between 1 and [`RANGE`].
//!
//! A Gaussian of `D^2 = dx^2 + dy^2 + dz^2 + q + e` is a product of functions of one difference each, so what
//! the points of one grid do at the points of another one is summed direction by direction.

/// The largest x over the smallest.
pub(crate) const RANGE: f64 = 25.0;

/// Pairs (t, w), least squares of the relative error over the range; largest error 5e-4.
pub(crate) const GAUSSIANS: [(f64, f64); 5] = [
    (0.047_995_231_1, 0.024_488_836_8),
    (0.213_159_154, 0.127_783_447),
    (0.590_159_357, 0.477_956_177),
    (1.457_209_96, 1.761_797_65),
    (3.564_742_58, 6.986_905_72),
];
