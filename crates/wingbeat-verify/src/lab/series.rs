//! Histories: means, harmonics, differences, tables.

use std::f64::consts::TAU;

use csv::StringRecord;
use wingbeat_case::csv_reader;

/// Columns of a table by their names; comment lines from `#` are left out.
pub struct Table {
    header: StringRecord,
    rows: Vec<StringRecord>,
}

impl Table {
    /// Reads comma-separated text.
    pub fn new(text: &str) -> Self {
        let mut reader = csv_reader(text.as_bytes());
        let header = reader.headers().expect("a header").clone();
        let rows = reader.records().map(|row| row.expect("a row")).collect();
        Self { header, rows }
    }

    /// A column as words.
    pub fn words(&self, name: &str) -> impl Iterator<Item = &str> {
        let k = self.header.iter().position(|h| h == name).expect(name);
        self.rows.iter().map(move |r| &r[k])
    }

    /// A column as numbers.
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        self.words(name).map(|w| w.parse().expect(name)).collect()
    }
}

/// Mean over samples that begin and end at the same phase (trapezoidal rule).
pub fn mean(x: &[f64]) -> f64 {
    let n = x.len() - 1;
    (0.5 * (x[0] + x[n]) + x[1..n].iter().sum::<f64>()) / n as f64
}

/// Root of the mean square.
pub fn rms(x: &[f64]) -> f64 {
    wingbeat_math::root_mean_square(x.iter().copied())
}

/// Complex amplitude (a, b) of a cos(2 pi k x) + b sin(2 pi k x) over samples x(n / n_period) of whole
/// periods, the last sample repeating the first phase.
pub fn harmonic(x: &[f64], per_period: usize, k: usize) -> [f64; 2] {
    let n = x.len() - 1;
    let mut sum = [0.0; 2];
    for (i, v) in x[..n].iter().enumerate() {
        let phase = TAU * (k * i) as f64 / per_period as f64;
        sum[0] += v * phase.cos();
        sum[1] += v * phase.sin();
    }
    sum.map(|s| 2.0 * s / n as f64)
}

/// Value at `x` of a table with rising abscissae, straight lines between, held beyond the ends.
pub fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    wingbeat_math::interpolate(xs.len(), |k| (xs[k], ys[k]), x)
}

/// Linear correlation of two histories.
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len() as f64;
    let (ma, mb) = (a.iter().sum::<f64>() / n, b.iter().sum::<f64>() / n);
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (x, y) in a.iter().zip(b) {
        ab += (x - ma) * (y - mb);
        aa += (x - ma).powi(2);
        bb += (y - mb).powi(2);
    }
    ab / (aa * bb).sqrt()
}
