//! Smooth passages from 0 to 1.

/// The cubic smoothstep `3 z^2 - 2 z^3` from 0 at 0 to 1 at 1, once continuously differentiable; constant beyond.
///
/// ```
/// assert_eq!([-1.0, 0.5, 2.0].map(wingbeat_math::smoothstep), [0.0, 0.5, 1.0]);
/// ```
pub fn smoothstep(z: f64) -> f64 {
    let z = z.clamp(0.0, 1.0);
    z * z * (3.0 - 2.0 * z)
}

/// The smoothstep of degree seven from 0 at `start` to 1 `duration` later, three times continuously
/// differentiable; constant before and beyond: value, rate, acceleration at time `t`.
///
/// ```
/// let [value, rate, acceleration] = wingbeat_math::smoothstep7(3.0, 2.0, 2.0);
/// assert_eq!([value, rate, acceleration], [0.5, 35.0 / 16.0 / 2.0, 0.0]);
/// ```
pub fn smoothstep7(t: f64, start: f64, duration: f64) -> [f64; 3] {
    let z = ((t - start) / duration).clamp(0.0, 1.0);
    let y = z * (1.0 - z);
    [
        z.powi(4) * (35.0 + z * (-84.0 + z * (70.0 - 20.0 * z))),
        140.0 * y * y * y / duration,
        420.0 * y * y * (1.0 - 2.0 * z) / (duration * duration),
    ]
}
