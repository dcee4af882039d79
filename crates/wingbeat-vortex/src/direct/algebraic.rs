//! Velocity and stretching by blobs of algebraic smoothing, as vortex particle methods use: direct sums.
//!
//! A blob of strength alpha is vorticity alpha spread over a ball of radius sigma by the
//! high-order algebraic smoothing [Winckelmans & Leonard 1993, J. Comput. Phys. 109:247]. With
//! r = x - x_q, rho = abs(r), s = rho^2 + sigma^2 it moves the air by
//!
//! u(x) = 1/(4 pi) g alpha_q x r,  g = (rho^2 + 5/2 sigma^2) / s^(5/2),
//!
//! and stretches blob p, with h = -(dg/drho)/rho = 3 (rho^2 + 7/2 sigma^2) / s^(7/2), by
//!
//! - transpose scheme, (grad u)^T alpha_p: 1/(4 pi) [g alpha_p x alpha_q + h (alpha_p . (r x alpha_q)) r];
//! - classical scheme, (alpha_p . grad) u: 1/(4 pi) [-g alpha_p x alpha_q + h (alpha_p . r) (r x alpha_q)].
//!
//! Between two blobs sigma^2 is the mean of both, so the transpose scheme keeps the sum of all
//! strengths. Like the sums of filaments these give the same bits for every instruction set and any
//! number of threads.

use crate::cores::INV_4PI;
use crate::direct::block::{BLOCK, Block, add_block, load, par_blocks, store};
use crate::direct::smoothing::{Smoothing, add_velocities, cross_with};
use crate::direct::sum::sum_all;
use crate::instruction_set::InstructionSet;
use crate::sources::{Blob, Points};
use fearless_simd::{Level, dispatch, prelude::*};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How blobs stretch each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stretching {
    /// Not at all: strengths stay.
    Omitted,
    /// (grad u)^T alpha: keeps the total vorticity.
    #[default]
    Transpose,
    /// (alpha . grad) u.
    Classical,
}

/// A direct sum over blobs of algebraic smoothing; the sums allocate nothing.
#[derive(Clone, Debug)]
pub struct AlgebraicSum {
    level: Level,
    sources: Vec<Blob>,
}

impl Default for AlgebraicSum {
    fn default() -> Self {
        Self {
            level: InstructionSet::best(),
            sources: Vec::new(),
        }
    }
}

impl AlgebraicSum {
    /// Replaces the blobs; says whether they differ from those before.
    pub fn load(&mut self, blobs: &[Blob]) -> bool {
        let is_new = self.sources != blobs;
        if is_new {
            self.sources.clear();
            self.sources.extend_from_slice(blobs);
        }
        is_new
    }

    /// Number of blobs.
    pub fn len(&self) -> usize {
        self.sources.len()
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.sources.is_empty()
    }

    /// Adds to `out` [m/s] the velocity of all blobs at `targets` [m].
    pub fn add_velocity(&self, targets: &Points, out: &mut Points) {
        if self.is_empty() {
            return;
        }
        sum_all(self.len(), targets, out, |targets, sum| {
            dispatch!(self.level, simd => add_velocities(simd, &Algebraic, &self.sources, targets, sum));
        });
    }

    /// Adds what all blobs do to the blobs `targets`: `velocity` [m/s], and `rate` of
    /// change of their strengths [m3/s2].
    pub fn add_to_blobs(
        &self,
        targets: &[Blob],
        scheme: Stretching,
        velocity: &mut Points,
        rate: &mut Points,
    ) {
        assert!(velocity.len() == targets.len() && rate.len() == targets.len());
        if self.is_empty() {
            return;
        }
        let all = par_blocks(velocity)
            .zip(par_blocks(rate))
            .zip(targets.par_chunks(BLOCK));
        all.for_each(|(((_, v), (_, s)), blobs)| {
            let blobs = ActedUpon::new(blobs);
            let mut sums = [Block::ZERO, Block::ZERO];
            dispatch!(self.level, simd => match scheme {
                Stretching::Omitted => self.pairs::<_, false, false>(simd, &blobs, &mut sums),
                Stretching::Transpose => self.pairs::<_, true, false>(simd, &blobs, &mut sums),
                Stretching::Classical => self.pairs::<_, true, true>(simd, &blobs, &mut sums),
            });
            add_block(&sums[0], v);
            if scheme != Stretching::Omitted {
                add_block(&sums[1], s);
            }
        });
    }

    #[inline(always)]
    fn pairs<S: Simd, const STRETCHES: bool, const CLASSICAL: bool>(
        &self,
        simd: S,
        targets: &ActedUpon,
        sums: &mut [Block; 2],
    ) {
        for lane in (0..targets.count).step_by(S::f64s::LEN) {
            let [px, py, pz] = load(simd, &targets.position, lane);
            let alpha = load(simd, &targets.strength, lane);
            let core = S::f64s::from_slice(simd, &targets.core[lane..lane + S::f64s::LEN]);
            let mut v = load(simd, &sums[0], lane);
            let mut d = load(simd, &sums[1], lane);
            for q in &self.sources {
                let r = [px - q.position.x, py - q.position.y, pz - q.position.z];
                let a = INV_4PI * q.strength;
                let rho2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
                let [g, h] = smoothing(simd, rho2, (core + q.core) * 0.5);
                let c = cross_with::<S>(a, r); // a x r
                for k in 0..3 {
                    v[k] += g * c[k];
                }
                if !STRETCHES {
                    continue;
                }
                let turn = cross_with::<S>(a, alpha); // a x alpha_p
                if CLASSICAL {
                    let along = (alpha[0] * r[0] + alpha[1] * r[1] + alpha[2] * r[2]) * h;
                    for k in 0..3 {
                        d[k] += g * turn[k] - along * c[k];
                    }
                } else {
                    let along = (alpha[0] * c[0] + alpha[1] * c[1] + alpha[2] * c[2]) * h;
                    for k in 0..3 {
                        d[k] -= g * turn[k] + along * r[k];
                    }
                }
            }
            store::<S>(v, &mut sums[0], lane);
            store::<S>(d, &mut sums[1], lane);
        }
    }
}

/// g and h.
#[inline(always)]
fn smoothing<S: Simd>(simd: S, rho2: S::f64s, core: S::f64s) -> [S::f64s; 2] {
    let s = rho2 + core;
    let inverse = S::f64s::splat(simd, 1.0) / s;
    let power5 = s.sqrt() * (inverse * inverse * inverse);
    let g = (rho2 + core * 2.5) * power5;
    let h = (rho2 + core * 3.5) * (power5 * inverse) * 3.0;
    [g, h]
}

/// The smoothing of blobs that act on points.
struct Algebraic;

impl Smoothing for Algebraic {
    fn scale(&self) -> f64 {
        INV_4PI
    }

    #[inline(always)]
    fn factor<S: Simd>(&self, simd: S, rho2: S::f64s, core: f64) -> S::f64s {
        smoothing(simd, rho2, S::f64s::splat(simd, core))[0]
    }
}

/// Up to [`BLOCK`] blobs that are acted upon.
struct ActedUpon {
    position: Block,
    strength: Block,
    core: [f64; BLOCK],
    count: usize,
}

impl ActedUpon {
    fn new(blobs: &[Blob]) -> Self {
        let mut out = Self {
            position: Block::ZERO,
            strength: Block::ZERO,
            core: [1.0; BLOCK],
            count: blobs.len(),
        };
        for (i, p) in blobs.iter().enumerate() {
            out.position.set(i, p.position);
            out.strength.set(i, p.strength);
            out.core[i] = p.core;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn cloud(n: usize) -> Vec<Blob> {
        let wave = |k: usize, f: f64| (k as f64 * f).sin();
        let at = |k: usize| Blob {
            position: DVec3::new(wave(k, 1.3), wave(k, 2.1), wave(k, 0.7)),
            strength: DVec3::new(wave(k, 0.9), wave(k, 1.7), wave(k, 2.9)),
            core: 0.01 + 0.02 * wave(k, 0.4).abs(),
        };
        (1..=n).map(at).collect()
    }

    fn rates(cloud: &[Blob], scheme: Stretching) -> [Points; 2] {
        let mut sum = AlgebraicSum::default();
        sum.load(cloud);
        let mut out = [Points::zeros(cloud.len()), Points::zeros(cloud.len())];
        let [v, s] = &mut out;
        sum.add_to_blobs(cloud, scheme, v, s);
        out
    }

    /// Sums of exactly opposite terms: the total changes by roundings.
    #[test]
    fn conserves_total_strength_in_the_transpose_scheme() {
        let cloud = cloud(150);
        let total = |s| {
            let [_, rate] = rates(&cloud, s);
            let sizes: f64 = rate.iter().map(|r| r.length()).sum();
            rate.iter().sum::<DVec3>().length() / sizes
        };
        assert!(total(Stretching::Transpose) < 1e-14);
        assert!(
            total(Stretching::Classical) > 1e-4,
            "the classical one does not"
        );
    }

    /// Both schemes against central differences of the velocity that the particles make.
    #[test]
    fn agrees_stretching_with_differences_of_the_velocity() {
        let mut cloud = cloud(40);
        cloud.iter_mut().for_each(|p| p.core = 0.02);
        let mut sum = AlgebraicSum::default();
        sum.load(&cloud);
        let velocity = |x: DVec3| {
            let mut out = Points::zeros(1);
            sum.add_velocity(&Points::from_iter([x]), &mut out);
            out.get(0)
        };
        let e = 1e-4;
        let [_, classical] = rates(&cloud, Stretching::Classical);
        let [_, transpose] = rates(&cloud, Stretching::Transpose);
        for (i, p) in cloud.iter().enumerate() {
            let slope = DVec3::AXES
                .map(|a| (velocity(p.position + e * a) - velocity(p.position - e * a)) / (2.0 * e));
            let along = slope[0] * p.strength.x + slope[1] * p.strength.y + slope[2] * p.strength.z;
            let across = DVec3::from(slope.map(|s| s.dot(p.strength)));
            let size = slope.iter().map(|s| s.length()).sum::<f64>();
            // Differences of second order: e^2 over the core, 5e-7.
            let errors = [along - classical.get(i), across - transpose.get(i)];
            assert!(errors.iter().all(|e| e.length() < 2e-6 * size));
        }
    }

    #[test]
    fn exact_velocities_are_those_of_particles_that_stretch_where_they_do_not() {
        let cloud = cloud(70);
        let [of, with] = [Stretching::Omitted, Stretching::Transpose].map(|s| rates(&cloud, s));
        assert_eq!(of[0], with[0]);
        assert_eq!(of[1], Points::zeros(cloud.len()));
    }

    #[test]
    fn invariant_same_bits_for_every_instruction_set_and_thread_count() {
        let cloud = cloud(200);
        let of = |set: InstructionSet, threads: usize| {
            let level = set.level()?;
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let sum = AlgebraicSum {
                level,
                sources: cloud.clone(),
            };
            let mut out = [Points::zeros(200), Points::zeros(200)];
            let [v, s] = &mut out;
            pool.unwrap()
                .install(|| sum.add_to_blobs(&cloud, Stretching::Transpose, v, s));
            Some(out)
        };
        let best = of(InstructionSet::Best, 1);
        assert_eq!(best, of(InstructionSet::Best, 3));
        for set in InstructionSet::available() {
            assert_eq!(best, of(set, 2), "{set:?}");
        }
    }
}
