//! How far a sum is off: at some targets, against the direct sum.

use crate::cores::CoreModel;
use crate::direct::block::{BLOCK, Block, Targets};
use crate::direct::lanes::{add_patches, add_patches_with_vorticity};
use crate::direct::packed::Packed;
use crate::sources::Points;
use fearless_simd::Level;
use glam::DVec3;
use rayon::prelude::*;

/// Targets, at most, at which the tree is checked against the direct sum: one of every
/// [`SAMPLE_EVERY`].
pub(super) const SAMPLES: usize = BLOCK;
const SAMPLE_EVERY: usize = 250;
const MIN_SAMPLES: usize = 16;

/// What the direct sum takes.
pub(super) type Sources<'a> = (Level, CoreModel, &'a Packed);

/// The direct sum at targets spread over their numbers.
pub(super) struct Check {
    pub count: usize,
    pub index: [usize; SAMPLES],
    velocity: [DVec3; SAMPLES],
    /// Root mean square velocity [m/s].
    pub scale: f64,
    /// The vorticity of algebraic cores there, if it is wanted, and its root mean square [1/s].
    vorticity: Option<([DVec3; SAMPLES], f64)>,
}

impl Check {
    /// Velocities.
    pub fn new(sources: Sources<'_>, targets: &Points) -> Self {
        let (count, index) = spread(targets.len());
        let [velocity, _] = direct::<1>(sources, targets, &index[..count]);
        let scale = root_mean_square(&velocity[..count]);
        Self {
            count,
            index,
            velocity,
            scale,
            vorticity: None,
        }
    }

    /// Velocities and vorticities of algebraic cores.
    pub fn with_vorticity(sources: Sources<'_>, targets: &Points) -> Self {
        let (count, index) = spread(targets.len());
        let [velocity, vorticity] = direct::<2>(sources, targets, &index[..count]);
        let [scale, of_vorticity] = [&velocity, &vorticity].map(|v| root_mean_square(&v[..count]));
        Self {
            count,
            index,
            velocity,
            scale,
            vorticity: Some((vorticity, of_vorticity)),
        }
    }

    /// Whether vorticities are checked, too.
    pub fn has_vorticity(&self) -> bool {
        self.vorticity.is_some()
    }

    /// Root mean square and largest error of these velocities, relative to the scale; zero where
    /// nothing moves.
    pub fn error(&self, velocity: &[DVec3]) -> [f64; 2] {
        difference(&self.velocity, velocity, self.scale)
    }

    /// The larger ones of velocities and vorticities, if those are wanted.
    pub fn error_of_both(&self, velocity: &[DVec3], vorticity: &[DVec3]) -> [f64; 2] {
        let [rms, max] = self.error(velocity);
        let other = self.vorticity.as_ref();
        let [other_rms, other_max] = other.map_or([0.0; 2], |(exact, scale)| {
            difference(exact, vorticity, *scale)
        });
        [rms.max(other_rms), max.max(other_max)]
    }
}

/// How many of so many targets, and which.
fn spread(targets: usize) -> (usize, [usize; SAMPLES]) {
    let few = targets.min(MIN_SAMPLES);
    let count = (targets / SAMPLE_EVERY).clamp(few, SAMPLES);
    let index = std::array::from_fn(|k| {
        // A square more than even steps: no pattern in the numbering is always missed.
        (k.min(count - 1) * targets / count + k * k) % targets
    });
    (count, index)
}

/// Velocities [m/s] and, with `K` = 2, vorticities [1/s] at the targets with these numbers.
fn direct<const K: usize>(
    (level, model, packed): Sources<'_>,
    targets: &Points,
    index: &[usize],
) -> [[DVec3; SAMPLES]; 2] {
    let mut both = [[DVec3::ZERO; SAMPLES]; 2];
    let [velocity, vorticity] = &mut both;
    let (velocity, vorticity) = (&mut velocity[..index.len()], &mut vorticity[..index.len()]);
    // Eight targets to a task: one vector of the widest processors.
    (velocity.par_chunks_mut(8).zip(vorticity.par_chunks_mut(8)))
        .zip(index.par_chunks(8))
        .for_each(|((v, w), index)| {
            let (mut block, mut velocity, mut vorticity) = (Block::ZERO, Block::ZERO, Block::ZERO);
            for (lane, &i) in index.iter().enumerate() {
                block.set(lane, targets.get(i));
                block.softening[lane] = targets.softening(i);
            }
            let all = 0..packed.patches.len();
            let targets = Targets {
                block: &block,
                count: v.len(),
            };
            let all = std::iter::once(all);
            if K > 1 {
                let both = [&mut velocity, &mut vorticity];
                add_patches_with_vorticity(level, packed, all, targets, both);
            } else {
                add_patches(level, model, packed, all, targets, &mut velocity);
            }
            for lane in 0..v.len() {
                (v[lane], w[lane]) = (velocity.get(lane), vorticity.get(lane));
            }
        });
    both
}

fn root_mean_square(vectors: &[DVec3]) -> f64 {
    let square: f64 = vectors.iter().map(|v| v.length_squared()).sum();
    (square / vectors.len() as f64).sqrt()
}

/// Root mean square and largest difference, relative to the scale.
fn difference(exact: &[DVec3], sum: &[DVec3], scale: f64) -> [f64; 2] {
    let square = exact.iter().zip(sum).map(|(a, b)| a.distance_squared(*b));
    let (total, max) = square.fold((0.0, 0.0), |(total, max): (f64, f64), e| {
        (total + e, max.max(e))
    });
    let scale = if scale > 0.0 { scale } else { 1.0 };
    [
        (total / sum.len() as f64).sqrt() / scale,
        max.sqrt() / scale,
    ]
}
