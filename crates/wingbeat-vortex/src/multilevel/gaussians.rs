//! The kernel as a sum of Gaussians over any range of distances: `x^(-3/2) = sum c_k t_k^(3/2) exp(-t_k x)`.
//!
//! `x^(-3/2)` is the integral of `t^(1/2) exp(-t x)` over t, divided by Gamma(3/2). By the trapezium rule in
//! the logarithm of t it is a sum over exponents t each [`RATIO`] times smaller than the one before, with equal
//! numbers c [Beylkin & Monzon 2010, Appl. Comput. Harmon. Anal. 28:131]; the error swings with the logarithm
//! of x and has the same size everywhere. At both ends, where the rule breaks off, c are fitted: least squares
//! of the relative error.

/// An exponent over the next one.
const RATIO: f64 = 2.4;

/// The largest exponent times the smallest x.
const FIRST: f64 = 4.0;

/// The smallest exponent times the largest x.
const LAST: f64 = 0.6;

/// c of the first Gaussians, of those between, and of the last ones; largest error 6e-4, root mean square 3.3e-4.
const BEGIN: [f64; 4] = [1.00688, 0.98499, 0.98887, 0.98736];
const BETWEEN: f64 = 0.98786;
const END: [f64; 5] = [0.98876, 0.98466, 1.0102, 0.81212, 1.7898];

/// How many Gaussians hold for x from 1 to `range`.
pub(super) fn count(range: f64) -> usize {
    let ratio = (FIRST / LAST * range.max(1.0)).ln() / RATIO.ln();
    (1 + ratio.ceil() as usize).max(BEGIN.len() + END.len())
}

/// Exponent and weight of Gaussian number k of `count`, for x from `least` \[m2\] on: \[1/m2\] and \[1/m3\].
pub(super) fn gaussian(k: usize, count: usize, least: f64) -> [f64; 2] {
    let exponent = FIRST / least * RATIO.powi(-(k as i32));
    let at_end = (k + END.len()).checked_sub(count);
    let c = match at_end {
        Some(i) => END[i],
        None => BEGIN.get(k).copied().unwrap_or(BETWEEN),
    };
    [exponent, c * exponent * exponent.sqrt()]
}
