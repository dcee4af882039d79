//! Periodic cubic spline through a table of samples: twice continuously differentiable.

use crate::error::{ModelError, check_rising, in_row};

/// Cubic spline of period one through samples of an angle.
///
/// The second derivative is continuous and piecewise linear. With moments `M_k = q''(x_k)` and
/// intervals `h_k`, continuity of the slope gives the cyclic tridiagonal system
/// `h_{k-1} M_{k-1} + 2 (h_{k-1} + h_k) M_k + h_k M_{k+1} = 6 (d_k - d_{k-1})`,
/// `d_k` the slopes of the chords.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicSpline {
    /// Knots \[wingbeats\], increasing, first and last one period apart.
    x: Vec<f64>,
    /// Values at the knots \[rad\], the last equal to the first.
    q: Vec<f64>,
    /// Second derivatives at the knots \[rad/wingbeat2\], the last equal to the first.
    m: Vec<f64>,
}

/// The value of the closing row may differ from the first row by this part of the range:
/// published tables carry four to six digits.
const CLOSURE: f64 = 1e-4;

impl PeriodicSpline {
    /// Through rows `(phase \[wingbeats\], angle \[rad\])`; the last row repeats the first value one
    /// period (1.0) later.
    ///
    /// # Errors
    /// [`ModelError::Table`] names the row: fewer than four rows, a number that is not finite,
    /// phases that do not increase, or a last row that does not close the period.
    pub fn new(name: &str, rows: &[(f64, f64)]) -> Result<Self, ModelError> {
        check_rows(name, rows)?;
        let x: Vec<f64> = rows.iter().map(|r| r.0).collect();
        let mut q: Vec<f64> = rows.iter().map(|r| r.1).collect();
        *q.last_mut().expect("rows were counted") = q[0];
        let m = moments(&x, &q);
        Ok(Self { x, q, m })
    }

    /// Value and first two derivatives with respect to the phase.
    pub fn at(&self, phase: f64) -> [f64; 3] {
        let x = self.x[0] + (phase - self.x[0]).rem_euclid(1.0);
        let last = self.x.len() - 2;
        let k = (self.x.partition_point(|&knot| knot <= x).max(1) - 1).min(last);
        let h = self.x[k + 1] - self.x[k];
        let (a, b) = ((self.x[k + 1] - x) / h, (x - self.x[k]) / h);
        let ([q0, q1], [m0, m1]) = ([self.q[k], self.q[k + 1]], [self.m[k], self.m[k + 1]]);
        let cubic = |s: f64| s * (s * s - 1.0);
        let slope = |s: f64| 3.0 * s * s - 1.0;
        [
            a * q0 + b * q1 + (cubic(a) * m0 + cubic(b) * m1) * h * h / 6.0,
            (q1 - q0) / h + (slope(b) * m1 - slope(a) * m0) * h / 6.0,
            a * m0 + b * m1,
        ]
    }

    /// Samples: phase \[wingbeats\] and angle \[rad\], the last one that of the first a period later.
    pub fn rows(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.x.iter().copied().zip(self.q.iter().copied())
    }

    /// Whether all samples are one angle.
    pub(crate) fn is_constant(&self) -> bool {
        self.q.iter().all(|q| *q == self.q[0])
    }

    /// Mean over the period, exact for the cubic pieces.
    pub(crate) fn mean(&self) -> f64 {
        let piece = |k: usize| {
            let h = self.x[k + 1] - self.x[k];
            let (q, m) = (self.q[k] + self.q[k + 1], self.m[k] + self.m[k + 1]);
            0.5 * h * q - h * h * h / 24.0 * m
        };
        (0..self.x.len() - 1).map(piece).sum()
    }

    pub(crate) fn raised(&self, offset: f64) -> Self {
        let mut spline = self.clone();
        spline.q.iter_mut().for_each(|q| *q += offset);
        spline
    }

    pub(crate) fn advanced(&self, lead: f64) -> Self {
        let mut spline = self.clone();
        spline.x.iter_mut().for_each(|x| *x -= lead);
        spline
    }

    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let times = |v: &[f64]| v.iter().map(|c| c * factor).collect();
        Self {
            x: self.x.clone(),
            q: times(&self.q),
            m: times(&self.m),
        }
    }
}

fn check_rows(name: &str, rows: &[(f64, f64)]) -> Result<(), ModelError> {
    check_rising(name, "phase", rows)?;
    let n = rows.len();
    let bad = |problem| in_row(name, n.saturating_sub(1), problem);
    if n < 4 {
        return Err(bad(format!(
            "{n} row(s); a periodic table needs at least 4"
        )));
    }
    check_closure(n, rows[0], rows[n - 1], range(rows)).map_err(bad)
}

fn check_closure(n: usize, first: (f64, f64), last: (f64, f64), range: f64) -> Result<(), String> {
    let period = last.0 - first.0;
    if (period - 1.0).abs() > 1e-9 {
        let unit = match period {
            90.0..=101.0 => ": phases in per cent are to be divided by 100",
            330.0..=361.0 => ": phases in degrees are to be divided by 360",
            _ => {
                ": times are to be divided by the period of a wingbeat; samples of several beats are fitted by `harmonics`"
            }
        };
        return Err(format!(
            "the table spans {period} wingbeats, not 1{unit}; row {n} must repeat the first row one period after it"
        ));
    }
    if (last.1 - first.1).abs() > CLOSURE * range {
        return Err(format!(
            "the table is not periodic: it ends at {} and starts at {}; the last row must repeat the first value (measured angles are fitted by `harmonics`; take out a drift first)",
            last.1, first.1
        ));
    }
    Ok(())
}

fn range(rows: &[(f64, f64)]) -> f64 {
    let fold = |(lo, hi): (f64, f64), r: &(f64, f64)| (lo.min(r.1), hi.max(r.1));
    let (lo, hi) = rows.iter().fold((f64::INFINITY, f64::NEG_INFINITY), fold);
    (hi - lo).max(f64::MIN_POSITIVE)
}

/// Second derivatives at the knots, the last repeating the first.
fn moments(x: &[f64], q: &[f64]) -> Vec<f64> {
    let n = x.len() - 1;
    let h: Vec<f64> = (0..n).map(|k| x[k + 1] - x[k]).collect();
    let d: Vec<f64> = (0..n).map(|k| (q[k + 1] - q[k]) / h[k]).collect();
    let before = |k: usize| (k + n - 1) % n;
    let diagonal: Vec<f64> = (0..n).map(|k| 2.0 * (h[before(k)] + h[k])).collect();
    let right: Vec<f64> = (0..n).map(|k| 6.0 * (d[k] - d[before(k)])).collect();
    let mut m = solve_cyclic(&diagonal, &h, &right);
    m.push(m[0]);
    m
}

/// Solves the symmetric cyclic tridiagonal system whose row k is
/// `h[k-1] y[k-1] + diagonal[k] y[k] + h[k] y[k+1]`, by the Sherman-Morrison formula on the
/// corner entries `h[n-1]`. The matrix is diagonally dominant.
fn solve_cyclic(diagonal: &[f64], h: &[f64], right: &[f64]) -> Vec<f64> {
    let n = diagonal.len();
    let corner = h[n - 1];
    let gamma = -diagonal[0];
    let mut d = diagonal.to_vec();
    d[0] -= gamma;
    d[n - 1] -= corner * corner / gamma;
    let mut u = vec![0.0; n];
    (u[0], u[n - 1]) = (gamma, corner);
    let y = solve_tridiagonal(&d, h, right.to_vec());
    let z = solve_tridiagonal(&d, h, u);
    let dot = |w: &[f64]| w[0] + w[n - 1] * corner / gamma;
    let factor = dot(&y) / (1.0 + dot(&z));
    y.iter().zip(&z).map(|(y, z)| y - factor * z).collect()
}

/// Thomas algorithm; sub- and superdiagonal of row k are `h[k-1]` and `h[k]`.
fn solve_tridiagonal(diagonal: &[f64], h: &[f64], mut y: Vec<f64>) -> Vec<f64> {
    let n = diagonal.len();
    let mut d = diagonal.to_vec();
    for k in 1..n {
        let w = h[k - 1] / d[k - 1];
        d[k] -= w * h[k - 1];
        y[k] -= w * y[k - 1];
    }
    y[n - 1] /= d[n - 1];
    for k in (0..n - 1).rev() {
        y[k] = (y[k] - h[k] * y[k + 1]) / d[k];
    }
    y
}
