//! Numbers that stand for many.

/// The root of the mean of the squares; 0 of no numbers.
///
/// ```
/// assert_eq!(wingbeat_math::root_mean_square([3.0, -4.0, 0.0, 0.0]), 2.5);
/// ```
pub fn root_mean_square(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0_usize);
    for x in numbers {
        sum += x * x;
        count += 1;
    }
    (sum / count.max(1) as f64).sqrt()
}

/// The median, of an even count the mean of the two in the middle; none of no numbers.
///
/// ```
/// use wingbeat_math::median;
/// assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
/// assert_eq!(median(vec![4.0, 1.0, 2.0, 9.0]), Some(3.0));
/// assert_eq!(median(vec![]), None);
/// ```
pub fn median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_unstable_by(f64::total_cmp);
    let n = numbers.len();
    (n > 0).then(|| 0.5 * (numbers[(n - 1) / 2] + numbers[n / 2]))
}

/// To `digits` significant digits, at least one: 0.1, not 0.1 and the rounding of a sum. What is not finite stays.
///
/// ```
/// use wingbeat_math::to_digits;
/// assert_eq!(to_digits(0.1 + 0.2, 12), 0.3);
/// assert_eq!(to_digits(-123456.0, 2), -120000.0);
/// assert_eq!(to_digits(f64::INFINITY, 2), f64::INFINITY);
/// ```
pub fn to_digits(x: f64, digits: usize) -> f64 {
    let decimals = digits.saturating_sub(1);
    format!("{x:.decimals$e}").parse().unwrap_or(x)
}
