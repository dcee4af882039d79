//! Velocity of blobs, one by one, whatever their smoothing.

use crate::direct::block::{Block, Targets, load, store};
use crate::sources::Blob;
use fearless_simd::prelude::*;
use glam::DVec3;

/// How vorticity is spread around a blob's position: with r = x - x_q it moves the air by `scale factor(r^2)
/// alpha x r`.
pub(crate) trait Smoothing {
    /// What is the same for all blobs.
    fn scale(&self) -> f64;

    /// What depends on the squared distance [m2] and on the blob's core [m2].
    fn factor<S: Simd>(&self, simd: S, rho2: S::f64s, core: f64) -> S::f64s;
}

/// Adds the velocities of all blobs at the targets.
#[inline(always)]
pub(crate) fn add_velocities<S: Simd>(
    simd: S,
    smoothing: &impl Smoothing,
    blobs: &[Blob],
    targets: Targets<'_>,
    sum: &mut Block,
) {
    let scale = smoothing.scale();
    for lane in (0..targets.count).step_by(S::f64s::LEN) {
        let [px, py, pz] = load(simd, targets.block, lane);
        let mut v = load(simd, sum, lane);
        for q in blobs {
            let r = [px - q.position.x, py - q.position.y, pz - q.position.z];
            let rho2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
            let g = smoothing.factor(simd, rho2, q.core);
            let c = cross_with::<S>(scale * q.strength, r);
            v[0] += g * c[0];
            v[1] += g * c[1];
            v[2] += g * c[2];
        }
        store::<S>(v, sum, lane);
    }
}

/// a x r.
#[inline(always)]
pub(crate) fn cross_with<S: Simd>(a: DVec3, r: [S::f64s; 3]) -> [S::f64s; 3] {
    [
        r[2] * a.y - r[1] * a.z,
        r[0] * a.z - r[2] * a.x,
        r[1] * a.x - r[0] * a.y,
    ]
}
