//! The steady Kalman filter on the map of a wingbeat: what the flyer does is estimated from what is seen, which
//! is noisy, and from what was commanded, which is known.
//!
//! ```text
//! x^[k]    = x-[k] + L (y[k] - x-[k])                       y: what is seen
//! x-[k+1]  = M x^[k] + B_0 a[k] + B_1 a[k+1]                a: command in force
//! L = P (P + R)^-1,  P = M (P - L P) M^T + W                R: noise of what is seen, W: of the flight
//! ```
//!
//! Free joints are states that are not seen: their noise R is beyond any measure, and what is expected of them
//! is corrected by what is seen of the body.
//!
//! With the gains of the regulator on x^ this is the linear-quadratic-Gaussian regulator: the eigenvalues of the closed
//! loop are those of regulator and filter.

use wingbeat_flight::control::fits;

use super::plant::{Plant, STATES, natural_sizes};
use super::riccati::{product, solve_columns};
use crate::AnalysisError;
use crate::beat::Beat;
use crate::control::sensors::Channels;

/// Parts of natural sizes below which noise of what is seen is not counted.
const FLOOR: f64 = 1e-4;
/// Noise of states that are not seen, in natural sizes.
const UNSEEN: f64 = 1e6;
/// Change of a pass, relative to natural sizes, at which the iteration stands.
const TOLERANCE: f64 = 1e-11;
/// Passes of the iteration at most.
const MAX_PASSES: usize = 20_000;

/// Noise of the flight: standard deviations of what a wingbeat changes that no command does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcessNoise {
    /// Of the velocity \[wing lengths per beat\].
    pub velocity: f64,
    /// Of the angular velocity \[rad per beat\].
    pub rate: f64,
}

impl Default for ProcessNoise {
    fn default() -> Self {
        Self {
            velocity: 0.01,
            rate: 0.01,
        }
    }
}

/// The filter.
#[derive(Clone, Debug)]
pub struct Observer {
    /// L of every look of a wingbeat, by rows.
    gains: Vec<Vec<f64>>,
    /// What is expected at the next look, free joints last; none before the first.
    expected: Option<Vec<f64>>,
}

impl Observer {
    /// The filter of a flight on the maps of the parts of `beat`, seen with `noise`.
    ///
    /// # Errors
    /// An iteration that does not converge.
    pub fn new(
        plants: &[Plant],
        beat: &Beat,
        process: &ProcessNoise,
        noise: &Channels<f64>,
    ) -> Result<Self, AnalysisError> {
        let sizes = natural_sizes(beat);
        let [speed, rate] = [sizes[3], sizes[6]];
        let seen = [noise.position, noise.velocity, noise.rate, noise.tilt];
        let moved = [0.0, process.velocity * speed, process.rate * rate, 0.0];
        let r = |(k, size): (usize, &f64)| match seen.get(k / 3) {
            Some(noise) => noise.max(FLOOR * size).powi(2),
            None => (UNSEEN * size).powi(2),
        };
        let r: Vec<f64> = sizes.iter().enumerate().map(r).collect();
        let share = plants.len() as f64;
        let w = |k: usize| moved.get(k / 3).map_or(0.0, |w| w.powi(2) / share);
        let w: Vec<f64> = (0..sizes.len()).map(w).collect();
        let maps: Vec<&[f64]> = plants.iter().map(|p| &p.m[..]).collect();
        let filters = kalman(&maps, &w, &r)?;
        Ok(Self {
            gains: filters.into_iter().map(|f| f.gain).collect(),
            expected: None,
        })
    }

    /// L of every look of a wingbeat, by rows.
    pub fn gains(&self) -> &[Vec<f64>] {
        &self.gains
    }

    /// What is estimated where `seen` is seen at look number `look`; free joints last, at first as on the
    /// trimmed orbit.
    pub fn estimate(&self, look: usize, seen: &[f64; STATES]) -> Vec<f64> {
        let gain = &self.gains[look % self.gains.len()];
        let n = gain.len().isqrt();
        let Some(expected) = &self.expected else {
            let joints = std::iter::repeat_n(0.0, n - STATES);
            return seen.iter().copied().chain(joints).collect();
        };
        let corrected = |i: usize| {
            let row = gain[i * n..].iter();
            let news = seen.iter().zip(expected);
            expected[i] + row.zip(news).map(|(l, (y, x))| l * (y - x)).sum::<f64>()
        };
        (0..n).map(corrected).collect()
    }

    /// Time goes by: `x` is what is expected at the next look.
    pub fn expect(&mut self, x: Vec<f64>) {
        self.expected = Some(x);
    }

    /// What it remembers.
    pub fn memory(&self) -> Vec<f64> {
        self.expected.clone().unwrap_or_default()
    }

    /// Goes on from what it remembered.
    ///
    /// # Errors
    /// A memory of another filter.
    pub fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        if !memory.is_empty() {
            fits(memory, self.gains[0].len().isqrt())?;
        }
        self.expected = (!memory.is_empty()).then(|| memory.to_vec());
        Ok(())
    }
}

/// A steady filter.
#[derive(Clone, Debug)]
pub struct Kalman {
    /// L, by rows \[1\].
    pub gain: Vec<f64>,
    /// Covariance P of what is expected, by rows \[1\].
    pub covariance: Vec<f64>,
}

/// The steady filters of a period of maps `x' = M x + w` where x itself is seen with noise: variances `w` of
/// the process and `r` of what is seen, all independent. Riccati's difference equation, run through the periods
/// until it stands.
///
/// # Errors
/// An iteration that does not converge.
pub fn kalman(maps: &[&[f64]], w: &[f64], r: &[f64]) -> Result<Vec<Kalman>, AnalysisError> {
    let n = w.len();
    let mut p = vec![0.0; n * n];
    (0..n).for_each(|i| p[i * n + i] = w[i] + r[i]);
    let mut filters: Vec<Kalman> = vec![];
    for _ in 0..MAX_PASSES {
        let passed: Result<Vec<Kalman>, AnalysisError> = (maps.iter())
            .map(|m| {
                let filter = filter(&p, r)?;
                p = ahead(m, &filter, w, r);
                Ok(filter)
            })
            .collect();
        let last = std::mem::replace(&mut filters, passed?);
        let mut pairs = filters.iter().zip(&last);
        if last.len() == maps.len() && pairs.all(|(a, b)| stands(a, b, n)) {
            return Ok(filters);
        }
    }
    Err(AnalysisError::Numbers(
        "the observer's iteration did not converge: more noise of the flight (control.observer) lets it".into(),
    ))
}

/// Whether two covariances are the same, entries in units of their own sizes.
fn stands(a: &Kalman, b: &Kalman, n: usize) -> bool {
    let (p, q) = (&a.covariance, &b.covariance);
    let size = |k: usize| (p[k / n * (n + 1)] * p[k % n * (n + 1)]).sqrt();
    (0..n * n).all(|k| (p[k] - q[k]).abs() <= TOLERANCE * size(k))
}

/// The filter where the covariance `p` is expected.
fn filter(p: &[f64], r: &[f64]) -> Result<Kalman, AnalysisError> {
    let n = r.len();
    let mut s = p.to_vec();
    (0..n).for_each(|i| s[i * n + i] += r[i]);
    // L = P S^-1 with symmetric P and S.
    Ok(Kalman {
        gain: transposed(&solve_columns(&s, p, n, n)?, n),
        covariance: p.to_vec(),
    })
}

/// The covariance that is expected after the map `m`.
fn ahead(m: &[f64], filter: &Kalman, w: &[f64], r: &[f64]) -> Vec<f64> {
    let n = w.len();
    let after = corrected(&filter.covariance, &filter.gain, r);
    let mut next = product(&product(m, &after, n, n, n), &transposed(m, n), n, n, n);
    (0..n).for_each(|i| next[i * n + i] += w[i]);
    let of = |i: usize, j: usize| 0.5 * (next[i * n + j] + next[j * n + i]);
    (0..n * n).map(|k| of(k / n, k % n)).collect()
}

/// `(1 - L) P (1 - L)^T + L R L^T`: as `P - L P`, without its loss of digits [Bucy & Joseph 1968].
fn corrected(p: &[f64], gain: &[f64], r: &[f64]) -> Vec<f64> {
    let n = r.len();
    let mut left: Vec<f64> = gain.iter().map(|l| -l).collect();
    (0..n).for_each(|i| left[i * n + i] += 1.0);
    let noisy: Vec<f64> = (0..n * n).map(|k| gain[k] * r[k % n]).collect();
    let mut out = product(&product(&left, p, n, n, n), &transposed(&left, n), n, n, n);
    let seen = product(&noisy, &transposed(gain, n), n, n, n);
    out.iter_mut().zip(&seen).for_each(|(x, y)| *x += y);
    out
}

fn transposed(x: &[f64], n: usize) -> Vec<f64> {
    (0..n * n).map(|k| x[k % n * n + k / n]).collect()
}
