//! Functions of time: Fourier series with a drift; tables with straight lines between the rows.

use std::f64::consts::TAU;

/// A truncated Fourier series with a drift:
/// `x(t) = x0 + rate t + sum_k a_k cos(2 pi k f t) + b_k sin(2 pi k f t)`, k = 1, 2, ...
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriftingFourier {
    /// Value without the oscillation at t = 0 \[unit of the value\].
    pub constant: f64,
    /// Steady rate of change [1/s].
    pub rate: f64,
    /// Fundamental frequency f [Hz].
    pub frequency: f64,
    /// Cosine coefficients a_1, a_2, ... \[unit of the value\].
    pub cosine: Vec<f64>,
    /// Sine coefficients b_1, b_2, ... \[unit of the value\].
    pub sine: Vec<f64>,
}

impl DriftingFourier {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Self {
            constant: value,
            ..Self::default()
        }
    }

    /// An oscillation with this `frequency` [Hz] about a constant, by its cosine and sine coefficients.
    pub fn periodic(constant: f64, frequency: f64, [cosine, sine]: [Vec<f64>; 2]) -> Self {
        Self {
            constant,
            rate: 0.0,
            frequency,
            cosine,
            sine,
        }
    }

    /// Whether its harmonics move it: those of a frequency of 0 stand still, and so do amplitudes of 0.
    ///
    /// ```
    /// use wingbeat_math::DriftingFourier;
    /// let series = |frequency, a| DriftingFourier::periodic(0.3, frequency, [vec![a], vec![]]);
    /// assert!(series(2.0, 0.1).oscillates());
    /// assert!(!series(0.0, 0.1).oscillates() && !series(2.0, 0.0).oscillates());
    /// ```
    pub fn oscillates(&self) -> bool {
        let mut amplitudes = self.cosine.iter().chain(&self.sine);
        self.frequency != 0.0 && amplitudes.any(|a| *a != 0.0)
    }

    /// Whether it has the same value at all times.
    pub fn is_constant(&self) -> bool {
        self.rate == 0.0 && !self.oscillates()
    }

    /// Value and first two time derivatives at `t` [s].
    ///
    /// ```
    /// use wingbeat_math::DriftingFourier;
    /// let f = DriftingFourier { frequency: 1.0, cosine: vec![0.5], ..DriftingFourier::constant(2.0) };
    /// assert_eq!(f.at(0.0)[..2], [2.5, 0.0]);
    /// ```
    pub fn at(&self, t: f64) -> [f64; 3] {
        let rest = [self.constant + self.rate * t, self.rate, 0.0];
        let base = TAU * self.frequency;
        let turn = |k: usize| (base * k as f64 * t).sin_cos();
        with_harmonics(rest, base, [&self.cosine, &self.sine], turn)
    }
}

/// `x` and its first two derivatives, `rest`, with the harmonics `a_k cos(k w t) + b_k sin(k w t)`, k = 1, 2,
/// ... on top: `base` is w [rad/s], `coefficients` are a and b, and `turn` gives sine and cosine of `k w t`,
/// asked for k in order.
pub fn with_harmonics(
    rest: [f64; 3],
    base: f64,
    coefficients: [&[f64]; 2],
    mut turn: impl FnMut(usize) -> (f64, f64),
) -> [f64; 3] {
    let mut x = rest;
    let [cosine, sine] = coefficients;
    for k in 1..=cosine.len().max(sine.len()) {
        let [a, b] = coefficients.map(|list| list.get(k - 1).copied().unwrap_or(0.0));
        let w = base * k as f64;
        let (s, c) = turn(k);
        let harmonic = a * c + b * s;
        x[0] += harmonic;
        x[1] += w * (b * c - a * s);
        x[2] -= w * w * harmonic;
    }
    x
}

/// Value at `x` of a table of `rows` whose abscissae rise, straight lines between, constant beyond the
/// ends; `row` gives abscissa and value of a row. NaN at NaN.
///
/// ```
/// let rows = [(0.0, 1.0), (2.0, 5.0)];
/// let at = |x| wingbeat_math::interpolate(rows.len(), |k| rows[k], x);
/// assert_eq!([-1.0, 0.5, 3.0].map(at), [1.0, 2.0, 5.0]);
/// assert!(at(f64::NAN).is_nan());
/// ```
pub fn interpolate(rows: usize, row: impl Fn(usize) -> (f64, f64), x: f64) -> f64 {
    if x.is_nan() {
        return x;
    }
    let (mut below, mut next) = (0, rows); // rows before `below` are at or below x, from `next` on above
    while below < next {
        let middle = (below + next) / 2;
        match row(middle).0 <= x {
            true => below = middle + 1,
            false => next = middle,
        }
    }
    if next == 0 || next == rows {
        return row(next.max(1) - 1).1;
    }
    let ((x0, y0), (x1, y1)) = (row(next - 1), row(next));
    y0 + (y1 - y0) * ((x - x0) / (x1 - x0))
}

/// The same of a table of pairs of abscissa and value.
///
/// ```
/// assert_eq!(wingbeat_math::interpolate_pairs(&[(0.0, 1.0), (2.0, 5.0)], 0.5), 2.0);
/// ```
pub fn interpolate_pairs(rows: &[(f64, f64)], x: f64) -> f64 {
    interpolate(rows.len(), |k| rows[k], x)
}
