//! What goes by each eigenvalue in a response, by least squares.

use faer::{Mat, c64};

use super::samples::rms;
use crate::AnalysisError;

/// A column of the basis: the real or the imaginary part of the powers of one eigenvalue, scaled to length 1.
struct Column {
    /// Number of the eigenvalue.
    mode: usize,
    is_imaginary: bool,
    /// Its length before \[1\].
    length: f64,
    numbers: Vec<f64>,
}

/// Powers of eigenvalues over a number of samples.
pub(super) struct Basis {
    columns: Vec<Column>,
    matrix: Mat<f64>,
    inverse: Mat<f64>,
    modes: usize,
}

impl Basis {
    /// Of eigenvalues with an imaginary part of 0 or more.
    ///
    /// # Errors
    /// A decomposition that fails.
    pub fn new(values: &[[f64; 2]], count: usize) -> Result<Self, AnalysisError> {
        let mut columns: Vec<Column> = vec![];
        for (mode, z) in values.iter().enumerate() {
            let powers = powers(*z, count);
            for part in 0..if z[1] > 0.0 { 2 } else { 1 } {
                let mut numbers: Vec<f64> = powers.iter().map(|p| p[part]).collect();
                let length = numbers.iter().map(|x| x * x).sum::<f64>().sqrt();
                let length = length.max(f64::MIN_POSITIVE);
                numbers.iter_mut().for_each(|x| *x /= length);
                columns.push(Column {
                    mode,
                    is_imaginary: part == 1,
                    length,
                    numbers,
                });
            }
        }
        let matrix = Mat::from_fn(count, columns.len(), |k, j| columns[j].numbers[k]);
        let svd = matrix.thin_svd();
        let svd = svd.map_err(|e| AnalysisError::Numbers(format!("singular values: {e:?}")))?;
        Ok(Self {
            inverse: svd.pseudoinverse(),
            columns,
            matrix,
            modes: values.len(),
        })
    }

    /// Root mean squares of the parts of the samples that go by each eigenvalue, and of what is left.
    pub fn shares(&self, samples: &[Vec<f64>]) -> (Vec<f64>, f64) {
        let (count, outputs) = (samples.len(), samples[0].len());
        let all = matrix(samples);
        let coefficients = &self.inverse * &all;
        let table = |m: Mat<f64>| -> Vec<Vec<f64>> {
            let row = |k: usize| (0..outputs).map(|i| m[(k, i)]).collect();
            (0..count).map(row).collect()
        };
        let part = |mode: usize| {
            let of = |k: usize, i: usize| {
                let own = self
                    .columns
                    .iter()
                    .enumerate()
                    .filter(|(_, c)| c.mode == mode);
                own.map(|(j, c)| c.numbers[k] * coefficients[(j, i)]).sum()
            };
            rms(&table(Mat::from_fn(count, outputs, of)))
        };
        let parts = (0..self.modes).map(part).collect();
        (parts, rms(&table(&all - &self.matrix * &coefficients)))
    }

    /// Of each eigenvalue `z` its amplitudes `c`, one an output: its part of sample `k` is `Re(c z^k)`.
    pub fn amplitudes(&self, samples: &[Vec<f64>]) -> Vec<Vec<c64>> {
        let coefficients = &self.inverse * &matrix(samples);
        let outputs = samples[0].len();
        let mut all = vec![vec![c64::new(0.0, 0.0); outputs]; self.modes];
        for (j, column) in self.columns.iter().enumerate() {
            for (i, c) in all[column.mode].iter_mut().enumerate() {
                let x = coefficients[(j, i)] / column.length;
                match column.is_imaginary {
                    true => c.im -= x,
                    false => c.re += x,
                }
            }
        }
        all
    }
}

fn matrix(samples: &[Vec<f64>]) -> Mat<f64> {
    Mat::from_fn(samples.len(), samples[0].len(), |k, i| samples[k][i])
}

/// Powers 0, 1, ... of a complex number.
fn powers([re, im]: [f64; 2], count: usize) -> Vec<[f64; 2]> {
    let z = c64::new(re, im);
    let all = std::iter::successors(Some(c64::new(1.0, 0.0)), |power| Some(power * z));
    all.take(count).map(|power| [power.re, power.im]).collect()
}
