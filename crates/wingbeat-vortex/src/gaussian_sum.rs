//! The sum over Gaussian blobs: one by one where they are few, else on a mesh.
//!
//! Widths are levels s_j = 2^j s_0; a blob of a width between two of them is a mixture of both with the blob's
//! variance. So blobs of a level differ in position and strength only, and are summed together on a mesh
//! ([`crate::particle_mesh`]) where they are many; the error is measured at every call.

use crate::direct::block::{BLOCK, Block, Targets, par_blocks};
use crate::direct::gaussian::WidthLevel;
use crate::direct::sum::sum_all;
use crate::fast::Tally;
use crate::instruction_set::InstructionSet;
use crate::particle_mesh::mesh::{Mesh, SPACINGS};
use crate::sources::{Blob, Points};
use fearless_simd::{Level, dispatch};
use glam::DVec3;
use rayon::prelude::*;

/// Cost of a node of the mesh, and of a blob or target on it, in pairs of blob and target summed one by one; measured.
const NODE: usize = 25;
const POINT: usize = 150;

/// Largest number of nodes of the finest mesh: some 4 GB of memory in all. A few blobs far off must not ask for more.
const MAX_NODES: usize = 30_000_000;

/// Tolerance from which a mesh may be used: finer ones are not worth a trial.
const FINEST: f64 = 5e-6;

/// Targets at which the mesh is checked against the sum one by one.
const SAMPLES: usize = 16;

/// Samples to a task: one vector of the widest processors.
const SAMPLES_AT_ONCE: usize = 8;

/// A sum over blobs: one by one where they are few, else on a mesh if the tolerance allows it.
///
/// Same bits for every instruction set and any number of threads.
///
/// ```
/// use wingbeat_vortex::{Blob, GaussianSum, Points};
/// use wingbeat_vortex::DVec3;
/// let blob = Blob { position: DVec3::ZERO, strength: DVec3::Z, core: 0.01 };
/// let mut sum = GaussianSum::default();
/// sum.load(&[blob], 0.01, [DVec3::ZERO; 2], 1);
/// let mut v = Points::zeros(1);
/// sum.add_velocity(1e-4, &Points::from_iter([DVec3::X]), &mut v);
/// assert!((v.y[0] * 4.0 * std::f64::consts::PI - 1.0).abs() < 1e-9); // ten widths away: a point
/// ```
#[derive(Clone, Debug)]
pub struct GaussianSum {
    level: Level,
    loaded: Vec<Blob>,
    levels: Vec<WidthLevel>,
    /// One for each of [`SPACINGS`], made when wanted.
    meshes: [Mesh; SPACINGS.len()],
    has_mesh: [bool; SPACINGS.len()],
    /// Targets expected.
    expected: usize,
    /// Corners of the box that the mesh fills \[m\].
    bounds: [DVec3; 2],
    velocity: Points,
    tally: Tally,
}

/// What a sum over blobs did and how well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianReport {
    /// Whether a mesh was used.
    pub is_mesh: bool,
    /// Root mean square of the error at the sampled targets, relative to that of the blobs' velocity there; 0 if
    /// summed one by one \[1\].
    pub error_rms: f64,
}

impl Default for GaussianSum {
    fn default() -> Self {
        Self {
            level: InstructionSet::best(),
            loaded: Vec::new(),
            levels: Vec::new(),
            meshes: Default::default(),
            has_mesh: [false; SPACINGS.len()],
            expected: 0,
            bounds: [DVec3::ZERO; 2],
            velocity: Points::default(),
            tally: Tally::default(),
        }
    }
}

impl GaussianSum {
    /// Sums that were checked since it was made.
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Replaces the blobs, none of which has a smaller core than `min_core` \[m2\]; says whether anything differs from
    /// before. `bounds` are the corners of a box \[m\] that holds the blobs and most of the targets to come, some
    /// `expected` of them: so a mesh pays or does not.
    pub fn load(
        &mut self,
        blobs: &[Blob],
        min_core: f64,
        bounds: [DVec3; 2],
        expected: usize,
    ) -> bool {
        let base = min_core.sqrt();
        let has_base = self.levels.first().is_none_or(|r| r.width == base);
        let same = (self.bounds, self.expected) == (bounds, expected);
        if has_base && self.loaded == blobs && (blobs.is_empty() || same) {
            return false;
        }
        (self.bounds, self.expected) = (bounds, expected);
        if !has_base {
            self.levels.clear();
        }
        self.loaded.clear();
        self.loaded.extend_from_slice(blobs);
        self.levels.iter_mut().for_each(|r| r.blobs.clear());
        for blob in blobs {
            // Forty levels are beyond any wake, and an end.
            let ratio = (blob.core / min_core).clamp(1.0, 1e24);
            let level = (0.5 * ratio.log2()).floor();
            let upper = (ratio / 4f64.powf(level) - 1.0) / 3.0;
            let level = level as usize;
            for k in self.levels.len()..level + 2 {
                let width = base * 2f64.powi(k as i32);
                let blobs = Vec::new();
                self.levels.push(WidthLevel { width, blobs });
            }
            let mut put = |k: usize, part: f64| {
                let strength = part * blob.strength;
                self.levels[k].blobs.push(Blob { strength, ..*blob });
            };
            put(level, 1.0 - upper);
            put(level + 1, upper);
        }
        let used = self.levels.iter().rposition(|r| !r.blobs.is_empty());
        self.levels.truncate(used.map_or(0, |k| k + 1));
        self.has_mesh = [false; SPACINGS.len()];
        true
    }

    /// Number of blobs.
    pub fn len(&self) -> usize {
        self.loaded.len()
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.loaded.is_empty()
    }

    /// Adds to `out` \[m/s\] the velocity of all blobs at `targets` \[m\], with an error of at most
    /// `tolerance`: root mean square, relative to that velocity.
    pub fn add_velocity(
        &mut self,
        tolerance: f64,
        targets: &Points,
        out: &mut Points,
    ) -> GaussianReport {
        assert_eq!(targets.len(), out.len(), "as many velocities as targets");
        if tolerance < FINEST || !self.gains_by_mesh() {
            return self.add_each(targets, out);
        }
        self.tally.checked += 1;
        let mut velocity = std::mem::take(&mut self.velocity);
        let mut report = None;
        for k in 0..SPACINGS.len() {
            if !self.has_mesh[k] {
                self.meshes[k].load(&self.levels, self.bounds, SPACINGS[k]);
                self.has_mesh[k] = true;
            }
            velocity.reset(targets.len());
            self.read_mesh(&self.meshes[k], targets, &mut velocity);
            let error_rms = self.error(targets, &velocity);
            let is_mesh = error_rms <= tolerance; // not if it is no number
            if is_mesh {
                report = Some(GaussianReport { is_mesh, error_rms });
                break;
            }
            self.tally.discarded += 1;
        }
        if report.is_some() {
            for (i, v) in velocity.iter().enumerate() {
                out.add(i, v);
            }
        }
        self.velocity = velocity;
        report.unwrap_or_else(|| self.add_each(targets, out))
    }

    fn gains_by_mesh(&self) -> bool {
        let Some(narrowest) = self.levels.first() else {
            return false;
        };
        let nodes = Mesh::nodes(narrowest.width, self.bounds);
        let (points, pairs) = (self.len() + self.expected, self.len() * self.expected);
        nodes <= MAX_NODES && nodes * NODE + points * POINT < pairs
    }

    /// Velocities from the mesh, one by one outside it.
    fn read_mesh(&self, mesh: &Mesh, targets: &Points, out: &mut Points) {
        let [low, high] = self.bounds;
        par_blocks(out).for_each(|(b, [x, y, z])| {
            for i in 0..x.len() {
                let p = targets.get(b * BLOCK + i);
                let is_inside = p.cmpge(low).all() && p.cmple(high).all();
                let v = match is_inside {
                    true => mesh.velocity(p),
                    false => self.velocity_at(p),
                };
                (x[i], y[i], z[i]) = v.into();
            }
        });
    }

    /// The sum one by one at one place.
    fn velocity_at(&self, p: DVec3) -> DVec3 {
        let (mut block, mut sum) = (Block::ZERO, Block::ZERO);
        block.set(0, p);
        self.add_block(&block, 1, &mut sum);
        sum.get(0)
    }

    fn add_block(&self, block: &Block, count: usize, sum: &mut Block) {
        let targets = Targets { block, count };
        for level in &self.levels {
            dispatch!(self.level, simd => level.add(simd, targets, sum));
        }
    }

    /// Root mean square error of these velocities at sampled targets, relative to that of the velocity.
    fn error(&self, targets: &Points, velocity: &Points) -> f64 {
        let count = targets.len().min(SAMPLES);
        let index = |k: usize| (k * targets.len() / count + k * k) % targets.len();
        let mut sums = [[0.0; 2]; SAMPLES / SAMPLES_AT_ONCE];
        sums.par_iter_mut()
            .enumerate()
            .for_each(|(task, [error, scale])| {
                let these = task * SAMPLES_AT_ONCE..count.min((task + 1) * SAMPLES_AT_ONCE);
                let (mut block, mut exact) = (Block::ZERO, Block::ZERO);
                for (lane, k) in these.clone().enumerate() {
                    block.set(lane, targets.get(index(k)));
                }
                self.add_block(&block, these.len(), &mut exact);
                for (lane, k) in these.enumerate() {
                    let exact = exact.get(lane);
                    *error += exact.distance_squared(velocity.get(index(k)));
                    *scale += exact.length_squared();
                }
            });
        let [error, scale] = [0, 1].map(|k| sums.iter().map(|s| s[k]).sum::<f64>());
        if error == 0.0 {
            0.0
        } else {
            (error / scale).sqrt()
        }
    }

    fn add_each(&self, targets: &Points, out: &mut Points) -> GaussianReport {
        for level in self.levels.iter().filter(|r| !r.blobs.is_empty()) {
            sum_all(level.blobs.len(), targets, out, |targets, sum| {
                dispatch!(self.level, simd => level.add(simd, targets, sum));
            });
        }
        GaussianReport {
            is_mesh: false,
            error_rms: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cores::LAMB_ALPHA;

    /// A long straight line of blobs is the vortex of Lamb and Oseen: strength, width and sense of rotation.
    #[test]
    fn exact_line_of_blobs() {
        let (radius, apart) = (0.3_f64, 0.05);
        let variance = radius * radius / (2.0 * LAMB_ALPHA);
        let blob = |k: i32| Blob {
            position: DVec3::Z * (apart * f64::from(k)),
            strength: DVec3::Z * apart,
            core: variance,
        };
        let blobs: Vec<Blob> = (-4000..=4000).map(blob).collect();
        let mut sum = GaussianSum::default();
        sum.load(&blobs, variance, [DVec3::ZERO; 2], 1);
        for h in [0.05_f64, 0.3, 1.0] {
            let core = 1.0 - (-LAMB_ALPHA * (h / radius).powi(2)).exp();
            let exact = DVec3::Y * (core / (std::f64::consts::TAU * h));
            // The line ends 200 m off: (h / 200)^2 / 2 is missing.
            let v = sum.velocity_at(DVec3::X * h);
            assert!((v - exact).length() < 2e-5 * exact.length(), "{v} {exact}");
        }
    }

    fn cloud(n: usize) -> Vec<Blob> {
        let wave = |k: usize, f: f64| (k as f64 * f).sin();
        let at = |k: usize| Blob {
            position: DVec3::new(3.0 * wave(k, 1.3), 2.0 * wave(k, 2.1), wave(k, 0.7)),
            strength: DVec3::new(wave(k, 0.9), wave(k, 1.7), wave(k, 2.9)),
            core: 0.04 * 1000f64.powf(wave(k, 0.4).powi(2)),
        };
        (1..=n).map(at).collect()
    }

    /// The mesh against the sum one by one, at the blobs and between them.
    #[test]
    fn agrees_mesh_with_direct_sum() {
        let blobs = cloud(3000);
        let targets: Points = blobs.iter().map(|b| 0.99 * b.position).collect();
        let mut sum = GaussianSum::default();
        sum.load(&blobs, 0.04, BOX, blobs.len());
        let of = |sum: &mut GaussianSum, tolerance| {
            let mut v = Points::zeros(targets.len());
            (sum.add_velocity(tolerance, &targets, &mut v), v)
        };
        let (report, mesh) = of(&mut sum, 1e-4);
        let (other, each) = of(&mut sum, 0.0);
        let (finer, fine) = of(&mut sum, 1e-5);
        assert!(report.is_mesh && !other.is_mesh);
        let square = |v: &Points| v.iter().map(|v| v.length_squared()).sum::<f64>();
        let error = |v: &Points| {
            let off = v
                .iter()
                .zip(each.iter())
                .map(|(a, b)| a.distance_squared(b));
            (off.sum::<f64>() / square(&each)).sqrt()
        };
        println!("mesh {:e}, finer {:e}", error(&mesh), error(&fine));
        assert!(error(&mesh) < 5e-5 && finer.is_mesh && error(&fine) < 1e-5);
        // Sixteen samples tell the size of the error.
        assert!((0.3..3.0).contains(&(error(&mesh) / report.error_rms)));
    }

    const BOX: [DVec3; 2] = [DVec3::new(-3.0, -2.0, -1.0), DVec3::new(3.0, 2.0, 1.0)];

    /// A target outside the box is summed one by one, those inside do not notice.
    #[test]
    fn limit_targets_outside_the_mesh() {
        let blobs = cloud(2000);
        let mut targets: Points = blobs.iter().map(|b| 0.99 * b.position).collect();
        let mut sum = GaussianSum::default();
        sum.load(&blobs, 0.04, BOX, blobs.len());
        let of = |sum: &mut GaussianSum, targets: &Points| {
            let mut v = Points::zeros(targets.len());
            assert!(sum.add_velocity(1e-4, targets, &mut v).is_mesh);
            v
        };
        let inside = of(&mut sum, &targets);
        targets.push(DVec3::new(4.0, 0.5, 30.0));
        let all = of(&mut sum, &targets);
        assert_eq!(all.get(7), inside.get(7));
        let exact = sum.velocity_at(targets.get(2000));
        assert_eq!(all.get(2000), exact);
    }

    /// Few blobs in a huge box: no mesh, no memory.
    #[test]
    fn limit_a_blob_far_off() {
        let mut blobs = cloud(300);
        blobs[0].position = DVec3::splat(1e9);
        let targets: Points = blobs.iter().map(|b| b.position).collect();
        let mut sum = GaussianSum::default();
        sum.load(&blobs, 0.04, [-DVec3::ONE, DVec3::splat(1e9)], 300);
        let mut v = Points::zeros(300);
        assert!(!sum.add_velocity(1e-4, &targets, &mut v).is_mesh);
        assert!(v.iter().all(|v| v.is_finite()));
    }

    #[test]
    fn invariant_same_bits_for_every_instruction_set_and_thread_count() {
        let blobs = cloud(2000);
        let targets: Points = blobs.iter().map(|b| 0.99 * b.position).collect();
        let of = |set: InstructionSet, threads: usize, tolerance: f64| {
            let mut sum = GaussianSum {
                level: set.level()?,
                ..GaussianSum::default()
            };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let mut out = Points::zeros(targets.len());
            let report = pool.unwrap().install(|| {
                sum.load(&blobs, 0.04, BOX, blobs.len());
                sum.add_velocity(tolerance, &targets, &mut out)
            });
            assert_eq!(report.is_mesh, tolerance > 0.0);
            Some(out)
        };
        for tolerance in [0.0, 1e-4] {
            let best = of(InstructionSet::Best, 1, tolerance);
            assert_eq!(best, of(InstructionSet::Best, 2, tolerance));
            assert_eq!(best, of(InstructionSet::Best, 4, tolerance));
            for set in InstructionSet::available() {
                assert_eq!(best, of(set, 2, tolerance), "{set:?}");
            }
        }
    }
}
