//! Modes of a linear system from its free response: the eigensystem realisation algorithm [Juang & Pappa, J.
//! Guid. 8:620, 1985].
//!
//! Samples `y_k = C A^k x_0` fill two Hankel matrices, `H0 = [y_(i+j)]` and `H1 = [y_(i+j+1)]`. With `H0 = U S
//! V^T`, singular values below the noise left out, `A = S^(-1/2) U^T H1 V S^(-1/2)` up to the choice of the
//! state, and `ln(eigenvalue) / time between samples` are growth and angular frequency, this one up to whole
//! turns between samples: what is faster than half of the sampling rate is folded. How much each mode takes part
//! follows by least squares (`basis`), and from what it does in the steps between the samples how many whole turns
//! it makes there (`turns`).

mod basis;
mod samples;
mod turns;

use std::f64::consts::PI;

use faer::Mat;

use crate::AnalysisError;
use crate::stability::eigen::eigen;
use basis::Basis;
pub use samples::Sampled;
pub(crate) use samples::rms;

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
    /// Motions whose frequency is not known, as they appear in the samples: near half of the sampling rate, or two of
    /// different frequency that appear as one.
    pub untold: Vec<Vibration>,
    /// Order of the linear system.
    pub order: usize,
    /// What they leave of the samples, root mean square over that of the samples \[1\].
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
    realise_sampled(&Sampled {
        steps: samples,
        step,
        every: 1,
    })
}

/// The linear system that answers so, by samples that are some steps apart. Motions faster than half of the sampling
/// rate, but not than half a turn a step, have their own frequencies.
///
/// ```
/// # use wingbeat_analysis::flutter::{Sampled, realise_sampled};
/// // 9.5 turns a second, sampled 8 times a second: it appears to make 1.5.
/// let turn = std::f64::consts::TAU * 9.5;
/// let steps: Vec<_> = (1..=192).map(|k| vec![(turn * k as f64 / 64.0).cos()]).collect();
/// let response = Sampled { steps: &steps, step: 1.0 / 64.0, every: 8 };
/// let found = realise_sampled(&response).unwrap();
/// assert!((found.vibrations[0].frequency - turn).abs() < 1e-6);
/// ```
///
/// # Errors
/// [`AnalysisError::Numbers`]: fewer than 4 samples, samples that are zero or not finite, decompositions that fail.
pub fn realise_sampled(response: &Sampled) -> Result<Realisation, AnalysisError> {
    let (samples, apart) = (response.before(0), response.apart());
    let size = rms(&samples);
    if samples.len() < 4 || !(size > 0.0 && size.is_finite()) {
        let what = "a response of 4 samples or more, finite and not zero, is needed";
        return Err(AnalysisError::Numbers(what.into()));
    }
    let (a, order) = state_matrix(&samples)?;
    let pairs = eigen(&a, order)?;
    // A pair stands for both; the upper one is taken.
    let values = pairs.iter().map(|p| p.value);
    let values: Vec<_> = values.filter(|z| z[1] >= 0.0).collect();
    let basis = Basis::new(&values, samples.len())?;
    let (parts, residual) = basis.shares(&samples);
    let turns = turns::between(response, &basis, &values);
    let (mut vibrations, mut untold) = (vec![], vec![]);
    for ((z, part), turns) in values.iter().zip(&parts).zip(turns) {
        let vibration = |turns: f64| Vibration {
            growth: z[0].hypot(z[1]).ln() / apart,
            frequency: (z[1].atan2(z[0]) + 2.0 * PI * turns).abs() / apart,
            share: part / size,
        };
        // At half the sampling rate nothing can be told from its mirror image.
        let is_told = z[1].atan2(z[0]) < 0.95 * PI;
        match turns.filter(|_| is_told) {
            Some(turns) => vibrations.push(vibration(turns)),
            None => untold.push(vibration(0.0)),
        }
    }
    for all in [&mut vibrations, &mut untold] {
        all.sort_by(|p, q| p.frequency.total_cmp(&q.frequency));
    }
    Ok(Realisation {
        vibrations,
        untold,
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
