//! Vortex blobs.

use glam::DVec3;

/// A vortex blob, or vortex particle: vorticity spread around a point by a smoothing function.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Blob {
    /// Position, N components \[m\].
    pub position: DVec3,
    /// Strength alpha, vorticity times volume, N components [m3/s].
    pub strength: DVec3,
    /// Square of the length over which it is spread \[m2\], above 0: the variance of each component of a Gaussian
    /// ([`crate::GaussianSum`]), sigma^2 of the algebraic smoothing ([`crate::AlgebraicSum`]).
    pub core: f64,
}
