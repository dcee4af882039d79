//! Extremes of numbers that may be none.

/// The larger of two; not a number where one of them is not, which [`f64::max`] leaves out.
///
/// ```
/// use wingbeat_math::larger;
/// assert_eq!(larger(1.0, 2.0), 2.0);
/// assert!(larger(f64::NAN, 2.0).is_nan() && larger(2.0, f64::NAN).is_nan());
/// ```
pub fn larger(a: f64, b: f64) -> f64 {
    match a.is_nan() || a > b {
        true => a,
        false => b,
    }
}

/// The smaller of two; not a number where one of them is not, which [`f64::min`] leaves out.
///
/// ```
/// use wingbeat_math::smaller;
/// assert_eq!(smaller(1.0, 2.0), 1.0);
/// assert!(smaller(f64::NAN, 2.0).is_nan() && smaller(2.0, f64::NAN).is_nan());
/// ```
pub fn smaller(a: f64, b: f64) -> f64 {
    match a.is_nan() || a < b {
        true => a,
        false => b,
    }
}

/// The largest of numbers that are not negative, and 0 of none; not a number where one of them is not, which
/// `fold(0.0, f64::max)` leaves out.
///
/// ```
/// use wingbeat_math::largest;
/// assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
/// assert_eq!(largest([]), 0.0);
/// assert!(largest([1.0, f64::NAN, 2.0]).is_nan());
/// ```
pub fn largest(of: impl IntoIterator<Item = f64>) -> f64 {
    of.into_iter().fold(0.0, larger)
}
