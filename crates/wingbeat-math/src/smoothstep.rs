//! A smooth passage from 0 to 1.

/// The cubic smoothstep `3 z^2 - 2 z^3` from 0 at 0 to 1 at 1, once continuously differentiable; constant beyond.
///
/// ```
/// assert_eq!([-1.0, 0.5, 2.0].map(wingbeat_math::smoothstep), [0.0, 0.5, 1.0]);
/// ```
pub fn smoothstep(z: f64) -> f64 {
    let z = z.clamp(0.0, 1.0);
    z * z * (3.0 - 2.0 * z)
}
