//! Modes of a linear system from its free response: the eigensystem realisation algorithm [Juang & Pappa, J.
//! Guid. 8:620, 1985].
//!
//! Samples `y_k = C A^k x_0` fill two Hankel matrices, `H0 = [y_(i+j)]` and `H1 = [y_(i+j+1)]`. With `H0 = U S
//! V^T`, singular values below the noise left out, `A = S^(-1/2) U^T H1 V S^(-1/2)` up to the choice of the
//! state, and `ln(eigenvalue) / step` are growth and angular frequency. How much each mode takes part follows
//! by least squares.

use std::f64::consts::PI;

use faer::{Mat, c64};
use wingbeat_math::root_mean_square;

use crate::AnalysisError;
use crate::eigen::eigen;

/// Singular values below this part of the largest are noise \[1\].
pub const NOISE: f64 = 1e-5;

/// A motion `exp(growth t) cos(frequency t + phase)` found in a response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vibration {
    /// Growth [1/s].
    pub growth: f64,
    /// Angular frequency [rad/s], 0 or more.
    pub frequency: f64,
    /// Its root mean square over that of the whole response \[1\].
    pub share: f64,
}

impl Vibration {
    /// Damping over critical damping \[1\]; negative for a motion that grows.
    pub fn damping(&self) -> f64 {
        -self.growth / self.growth.hypot(self.frequency)
    }

    /// Distance of the eigenvalues of two motions [1/s].
    pub fn distance(&self, other: &Self) -> f64 {
        (self.growth - other.growth).hypot(self.frequency - other.frequency)
    }
}

/// What a response is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Realisation {
    /// Its motions, of rising frequency.
    pub vibrations: Vec<Vibration>,
    /// Order of the linear system.
    pub order: usize,
    /// What they leave of the response, root mean square over that of the response \[1\].
    pub residual: f64,
}

/// The linear system that answers by `samples`: one row of outputs, all of one size, every `step` \[s\].
///
/// ```
/// # use wingbeat_analysis::flutter::realise;
/// let sample = |k: i32| vec![0.9_f64.powi(k)];
/// let samples: Vec<_> = (0..12).map(sample).collect();
/// let found = realise(&samples, 0.1).unwrap();
/// assert_eq!(found.order, 1);
/// assert!((found.vibrations[0].growth - 0.9_f64.ln() / 0.1).abs() < 1e-9);
/// ```
///
/// # Errors
/// [`AnalysisError::Numbers`]: fewer than 4 samples, samples that are zero or not finite, decompositions that fail.
pub fn realise(samples: &[Vec<f64>], step: f64) -> Result<Realisation, AnalysisError> {
    let size = rms(samples);
    if samples.len() < 4 || !(size > 0.0 && size.is_finite()) {
        let what = "a response of 4 samples or more, finite and not zero, is needed";
        return Err(AnalysisError::Numbers(what.into()));
    }
    let (a, order) = state_matrix(samples)?;
    let pairs = eigen(&a, order)?;
    // A pair stands for both; the upper one is taken.
    let values = pairs.iter().map(|p| p.value);
    let values: Vec<_> = values.filter(|z| z[1] >= 0.0).collect();
    let (parts, residual) = shares(samples, &values)?;
    let vibration = |(z, part): (&[f64; 2], &f64)| Vibration {
        growth: z[0].hypot(z[1]).ln() / step,
        frequency: z[1].atan2(z[0]) / step,
        share: part / size,
    };
    let mut vibrations: Vec<_> = values.iter().zip(&parts).map(vibration).collect();
    // At half the sampling rate nothing can be told from its mirror image.
    vibrations.retain(|v| v.frequency < 0.95 * PI / step);
    vibrations.sort_by(|p, q| p.frequency.total_cmp(&q.frequency));
    Ok(Realisation {
        vibrations,
        order,
        residual: residual / size,
    })
}

/// The state matrix by rows, and its order.
fn state_matrix(samples: &[Vec<f64>]) -> Result<(Vec<f64>, usize), AnalysisError> {
    let (outputs, columns) = (samples[0].len(), samples.len() / 2);
    // The last sample is there for the shifted matrix alone.
    let rows = samples.len() - columns;
    let hankel = |shift: usize| {
        Mat::from_fn(rows * outputs, columns, |i, j| {
            samples[i / outputs + j + shift][i % outputs]
        })
    };
    let svd = hankel(0).thin_svd();
    let svd = svd.map_err(|e| AnalysisError::Numbers(format!("singular values: {e:?}")))?;
    let values: Vec<f64> = (0..columns.min(rows * outputs))
        .map(|k| svd.S()[k])
        .collect();
    let order = values.iter().filter(|s| **s > NOISE * values[0]).count();
    let root: Vec<f64> = values.iter().map(|s| s.sqrt()).collect();
    let inner = svd.U().transpose() * hankel(1) * svd.V();
    let entry = |k: usize| {
        let (i, j) = (k / order, k % order);
        inner[(i, j)] / (root[i] * root[j])
    };
    Ok(((0..order * order).map(entry).collect(), order))
}

/// Root mean squares of the parts of the response that go by each eigenvalue, and of what is left.
fn shares(samples: &[Vec<f64>], values: &[[f64; 2]]) -> Result<(Vec<f64>, f64), AnalysisError> {
    let count = samples.len();
    let mut columns: Vec<(usize, Vec<f64>)> = vec![];
    for (mode, z) in values.iter().enumerate() {
        let powers = powers(*z, count);
        columns.push((mode, powers.iter().map(|p| p[0]).collect()));
        if z[1] > 0.0 {
            columns.push((mode, powers.iter().map(|p| p[1]).collect()));
        }
    }
    let norm = |c: &[f64]| c.iter().map(|x| x * x).sum::<f64>().sqrt();
    for (_, c) in &mut columns {
        let size = norm(c).max(f64::MIN_POSITIVE);
        c.iter_mut().for_each(|x| *x /= size);
    }
    let basis = Mat::from_fn(count, columns.len(), |k, j| columns[j].1[k]);
    let outputs = samples[0].len();
    let all = Mat::from_fn(count, outputs, |k, i| samples[k][i]);
    let svd = basis.thin_svd();
    let svd = svd.map_err(|e| AnalysisError::Numbers(format!("singular values: {e:?}")))?;
    let coefficients = svd.pseudoinverse() * &all;
    let table = |m: Mat<f64>| -> Vec<Vec<f64>> {
        let row = |k: usize| (0..outputs).map(|i| m[(k, i)]).collect();
        (0..count).map(row).collect()
    };
    let part = |mode: usize| {
        let of = |k: usize, i: usize| {
            let own = columns.iter().enumerate().filter(|(_, c)| c.0 == mode);
            own.map(|(j, c)| c.1[k] * coefficients[(j, i)]).sum()
        };
        rms(&table(Mat::from_fn(count, outputs, of)))
    };
    let parts = (0..values.len()).map(part).collect();
    Ok((parts, rms(&table(&all - &basis * &coefficients))))
}

/// Powers 0, 1, ... of a complex number.
fn powers([re, im]: [f64; 2], count: usize) -> Vec<[f64; 2]> {
    let z = c64::new(re, im);
    let all = std::iter::successors(Some(c64::new(1.0, 0.0)), |power| Some(power * z));
    all.take(count).map(|power| [power.re, power.im]).collect()
}

/// Root mean square over all numbers.
pub(crate) fn rms(samples: &[Vec<f64>]) -> f64 {
    root_mean_square(samples.iter().flatten().copied())
}
