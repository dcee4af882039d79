//! What is drawn: sample number s of a key follows from the seed, the key and s alone, so that samples can be had in
//! any order and more of them leave the first ones as they are (a Latin hypercube apart, whose parts are as many as its
//! samples). A Sobol sequence has a dimension in place of the key: how many keys of such a sequence stand before it in the file.
//!
//! Random numbers are SHA-256 of (seed, key, s), read as a fraction. Values are rounded to 12 digits, which
//! hides the last bits in which mathematical libraries of different systems differ.

use sha2::{Digest, Sha256};
use statrs::function::erf::erfc_inv;
use wingbeat_math::to_digits;

use crate::plan::raw::{Ends, Normal, Variation};

/// Samples of a Sobol sequence at most, as the library has them.
pub const MAX_SOBOL: usize = 1 << 16;
/// Keys of a Sobol sequence at most.
pub const MAX_SOBOL_KEYS: usize = sobol_burley::NUM_DIMENSIONS as usize;

/// How the values of a key are drawn.
#[derive(Clone, Debug)]
pub struct Sampler {
    key: String,
    seed: u64,
    law: Law,
}

/// From a number between 0 and 1 to a value.
#[derive(Clone, Debug)]
enum Law {
    Uniform(Ends),
    LogUniform(Ends),
    Normal(Normal),
    /// With the part of each sample.
    LatinHypercube(Ends, Vec<u32>),
    /// With the number of its dimension.
    Sobol(Ends, u32),
}

impl Sampler {
    /// Of a parameter that is drawn. A Latin hypercube has as many equal parts as `samples`, one value in each, in random
    /// order; a Sobol sequence, whose seed is below 2^32, its `dimension` of this number.
    ///
    /// # Panics
    /// A parameter whose values are listed.
    pub fn new(key: &str, seed: u64, how: &Variation, samples: usize, dimension: usize) -> Self {
        let law = match how {
            Variation::Uniform(ends) => Law::Uniform(*ends),
            Variation::LogUniform(ends) => Law::LogUniform(*ends),
            Variation::Normal(normal) => Law::Normal(*normal),
            Variation::LatinHypercube(ends) => {
                Law::LatinHypercube(*ends, parts(key, seed, samples))
            }
            Variation::Sobol(ends) => Law::Sobol(*ends, dimension as u32),
            Variation::List(_) | Variation::Range(_) | Variation::LogRange(_) => {
                unreachable!("listed parameters are axes")
            }
        };
        Self {
            key: key.to_owned(),
            seed,
            law,
        }
    }

    /// Whether it is a dimension of a Sobol sequence.
    pub fn is_sobol(&self) -> bool {
        matches!(self.law, Law::Sobol(..))
    }

    /// The key.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// Sample number `s`.
    pub fn value(&self, s: usize) -> f64 {
        let u = || fraction(random(self.seed, &self.key, "value", s));
        let value = match &self.law {
            Law::Uniform(ends) => between(ends, u()),
            Law::LogUniform(ends) => (ends.from.ln() + u() * (ends.to / ends.from).ln()).exp(),
            Law::Normal(normal) => quantile(normal, u()),
            Law::LatinHypercube(ends, parts) => {
                between(ends, (f64::from(parts[s]) + u()) / parts.len() as f64)
            }
            Law::Sobol(ends, dimension) => between(
                ends,
                f64::from(sobol_burley::sample(s as u32, *dimension, self.seed as u32)),
            ),
        };
        to_digits(value, 12)
    }
}

/// The numbers below `samples` in random order.
fn parts(key: &str, seed: u64, samples: usize) -> Vec<u32> {
    let mut parts: Vec<u32> = (0..samples as u32).collect();
    for k in (1..samples).rev() {
        // Fisher-Yates; the remainder of 64 bits is uneven by less than 1e-9.
        let other = random(seed, key, "order", k) % (k as u64 + 1);
        parts.swap(k, other as usize);
    }
    parts
}

fn between(ends: &Ends, u: f64) -> f64 {
    ends.from + u * (ends.to - ends.from)
}

/// The value below which a part `u` of a normal distribution lies, of what its ends leave.
fn quantile(normal: &Normal, u: f64) -> f64 {
    use std::f64::consts::SQRT_2;
    let scaled = |x: f64| (x - normal.mean) / normal.standard_deviation;
    let below = |x: Option<f64>, open: f64| x.map_or(open, |x| cumulative(scaled(x)));
    let [low, high] = [below(normal.from, 0.0), below(normal.to, 1.0)];
    let part = low + u * (high - low);
    let x = normal.mean - normal.standard_deviation * SQRT_2 * erfc_inv(2.0 * part);
    let least = normal.from.unwrap_or(f64::NEG_INFINITY);
    x.clamp(least, normal.to.unwrap_or(f64::INFINITY))
}

/// Part of the standard normal distribution below `x`.
pub fn cumulative(x: f64) -> f64 {
    0.5 * statrs::function::erf::erfc(-x / std::f64::consts::SQRT_2)
}

/// 64 random bits.
fn random(seed: u64, key: &str, what: &str, s: usize) -> u64 {
    let mut hash = Sha256::new_with_prefix(seed.to_le_bytes());
    hash.update((s as u64).to_le_bytes());
    hash.update(what);
    hash.update([0]);
    hash.update(key);
    let digest = hash.finalize();
    let mut bits = [0; 8];
    bits.copy_from_slice(&digest[..8]);
    u64::from_le_bytes(bits)
}

/// Above 0 and below 1.
fn fraction(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENDS: Ends = Ends { from: 2.0, to: 6.0 };

    fn moments(values: &[f64]) -> [f64; 2] {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let square = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
        [mean, square / (n - 1.0)]
    }

    /// Means and variances as of the laws; 20,000 samples scatter by sigma / 141, four times which is allowed.
    #[test]
    fn exact_moments_of_what_is_drawn() {
        let n = 20_000;
        let draw = |s: Sampler| -> Vec<f64> { (0..n).map(|k| s.value(k)).collect() };
        let draw = |how: Variation| draw(Sampler::new("a", 7, &how, n, 0));
        let [mean, variance] = moments(&draw(Variation::Uniform(ENDS)));
        assert!((mean - 4.0).abs() < 4.0 * 1.155 / 141.0, "{mean}");
        assert!((variance - 16.0 / 12.0).abs() < 0.04, "{variance}");
        let normal = |from, to| Normal {
            mean: 3.0,
            standard_deviation: 0.5,
            from,
            to,
        };
        let [mean, variance] = moments(&draw(Variation::Normal(normal(None, None))));
        assert!((mean - 3.0).abs() < 4.0 * 0.5 / 141.0, "{mean}");
        assert!(
            (variance - 0.25).abs() < 4.0 * 0.25 * 1.414 / 141.0,
            "{variance}"
        );
        // Cut off at the mean: the half-normal distribution, mean sigma sqrt(2 / pi).
        let half = draw(Variation::Normal(normal(Some(3.0), None)));
        let [mean, _] = moments(&half);
        assert!(
            (mean - 3.0 - 0.5 * 0.797_885).abs() < 4.0 * 0.3 / 141.0,
            "{mean}"
        );
        assert!(half.iter().all(|x| *x >= 3.0));
        let logs: Vec<f64> = draw(Variation::LogUniform(ENDS));
        let logs: Vec<f64> = logs.iter().map(|x| x.ln()).collect();
        let middle = 0.5 * (2.0_f64.ln() + 6.0_f64.ln());
        assert!((moments(&logs)[0] - middle).abs() < 4.0 * 0.317 / 141.0);
    }

    /// Two keys of one seed are independent, and so are two seeds of one key.
    #[test]
    fn invariant_keys_and_seeds_are_independent() {
        let n = 20_000;
        let draw = |key: &str, seed| -> Vec<f64> {
            let s = Sampler::new(key, seed, &Variation::Uniform(ENDS), n, 0);
            (0..n).map(|k| s.value(k) - 4.0).collect()
        };
        let first = draw("a", 1);
        for other in [draw("b", 1), draw("a", 2)] {
            let product = first.iter().zip(&other).map(|(x, y)| x * y).sum::<f64>();
            let r = product / n as f64 / (16.0 / 12.0);
            assert!(r.abs() < 4.0 / 141.0, "{r}");
        }
    }

    #[test]
    fn exact_latin_hypercube_and_sobol_have_one_sample_in_each_part() {
        let n = 64;
        for how in [Variation::LatinHypercube(ENDS), Variation::Sobol(ENDS)] {
            let sampler = Sampler::new("a", 3, &how, n, 1);
            let part = |k: usize| ((sampler.value(k) - 2.0) / 4.0 * n as f64) as usize;
            let mut parts: Vec<usize> = (0..n).map(part).collect();
            assert!(parts.windows(2).any(|w| w[1] < w[0]), "not in order");
            parts.sort_unstable();
            assert_eq!(parts, (0..n).collect::<Vec<_>>());
        }
    }
}
