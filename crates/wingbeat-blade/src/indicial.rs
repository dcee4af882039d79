//! How the circulation of a section builds up after its downwash has changed: unsteady thin-airfoil theory.
//!
//! A section that moves with the speed V sheds what its circulation changes by, and this wake, which leaves it
//! straight behind, induces a downwash lambda on it. With `s = int V dt / b` the way in half chords b, the
//! circulation follows the downwash w of the section's own motion at three quarters of its chord as if that
//! were `w - lambda` (Duhamel's integral; phi is Wagner's function, C Theodorsen's):
//!
//! ```text
//! w - lambda = int phi(s - s') dw(s')        phi(s) = 1 - sum Re r exp(-p s)
//! lambda = sum Re r z,  dz/ds = -p z + dw/ds       C(k) = 1 - sum r ik / (p + ik)
//! ```
//!
//! *Peters* has N states of induced flow [Peters, Karunamoorthy & Cao, J. Aircraft 32:313, 1995]: `A dlambda/ds +
//! lambda_n = c dw/ds`, `lambda = sum b_n lambda_n / 2`, with the binomial weights b_n. Its eigenvectors part
//! the states: p are the eigenvalues of `A^-1`. *Jones* [NACA Rep. 681, 1940] has two exponentials. Largest
//! error of C over C for k from 0.05 to 1: Jones 2.3 %; Peters 3.8, 4.3, 1.7 and 1.1 % with 4, 5, 6 and 8
//! states. Beyond 8 it grows again (5 % at 12).

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};

use crate::error::{BladeError, require};

/// Theories of the wake of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsteady {
    /// Two exponentials [Jones 1940].
    Jones,
    /// States of induced flow [Peters, Karunamoorthy & Cao 1995].
    Peters {
        /// Their number N, 2 to 8.
        states: usize,
    },
}

/// Most states of Peters' theory.
const MAX_STATES: usize = 8;

impl Unsteady {
    /// Checks the number of states.
    ///
    /// # Errors
    /// [`BladeError::Value`] where it is not allowed.
    pub fn check(self) -> Result<(), BladeError> {
        let Self::Peters { states } = self else {
            return Ok(());
        };
        let allowed =
            "a whole number from 2 to 8 (with more, the sum of binomial weights is worse again)";
        let ok = (2..=MAX_STATES).contains(&states);
        require(ok, "unsteady.states", states as f64, allowed)
    }

    /// How circulation builds up by this theory.
    ///
    /// ```
    /// use wingbeat_blade::Unsteady;
    /// let wagner = Unsteady::Jones.indicial(); // phi = 1 - 0.165 exp(-0.0455 s) - 0.335 exp(-0.3 s)
    /// assert!((wagner.at(0.0) - 0.5).abs() < 1e-15);
    /// ```
    pub fn indicial(self) -> Indicial {
        match self {
            Self::Jones => Indicial::of(&[(0.0455, 0.165), (0.3, 0.335)]),
            Self::Peters { states } => Indicial::peters(states),
        }
    }
}

/// A part `Re r exp(-p s)` of an indicial function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// p \[1\], its imaginary part 0 or more: of a conjugate pair one stands for both.
    pub rate: c64,
    /// r \[1\]; of a pair, of both together.
    pub weight: c64,
}

impl Pole {
    /// Numbers that its state has.
    pub(crate) fn numbers(&self) -> usize {
        1 + usize::from(self.rate.im > 0.0)
    }
}

/// An indicial function `phi(s) = 1 - sum Re r exp(-p s)` of the way s in half chords.
#[derive(Clone, Debug, PartialEq)]
pub struct Indicial {
    poles: Vec<Pole>,
}

impl Indicial {
    /// Exponentials: rates and weights.
    fn of(parts: &[(f64, f64)]) -> Self {
        let pole = |(rate, weight): &(f64, f64)| Pole {
            rate: c64::from(*rate),
            weight: c64::from(*weight),
        };
        Self {
            poles: parts.iter().map(pole).collect(),
        }
    }

    /// Kuessner's function of a sharp gust that meets the leading edge at s = 0: three exponentials fitted to
    /// that of von Karman & Sears [J. Aeronaut. Sci. 5:379, 1938], within 0.015 for s up to 60. Sears & Sparks'
    /// two are 0.08 short at first.
    pub fn kuessner() -> Self {
        Self::of(&[(0.0675, 0.3), (0.538, 0.544), (16.0, 0.156)])
    }

    /// Peters' theory with `n` states: `lambda = b . x / 2`, `A dx/ds + x = c dw/ds`, parted by the
    /// eigenvectors of `A^-1`.
    fn peters(n: usize) -> Self {
        let [b, c] = [binomial(n), (1..=n).map(|k| 2.0 / k as f64).collect()];
        let a = induced(&b, &c);
        let column = Mat::from_fn(n, 1, |i, _| c[i]);
        let lu = a.partial_piv_lu();
        let inverse = lu.solve(Mat::<f64>::identity(n, n));
        let driven = lu.solve(&column);
        let parted = inverse.eigen().expect("Peters' matrix has eigenvectors");
        let (u, p) = (parted.U(), parted.S().column_vector());
        let driven = Mat::from_fn(n, 1, |i, _| c64::from(driven[(i, 0)]));
        let share = u.partial_piv_lu().solve(&driven);
        let pole = |j: usize| {
            let seen: c64 = (0..n).map(|i| u[(i, j)] * (0.5 * b[i])).sum();
            let (rate, weight) = (p[j], seen * share[(j, 0)]);
            let both = if rate.im == 0.0 { 1.0 } else { 2.0 };
            Pole {
                rate,
                weight: both * weight,
            }
        };
        let mut poles: Vec<Pole> = (0..n).map(pole).filter(|p| p.rate.im >= 0.0).collect();
        poles.sort_by(|a, b| a.rate.re.total_cmp(&b.rate.re));
        Self { poles }
    }

    /// Its parts, of rising rate.
    pub fn poles(&self) -> &[Pole] {
        &self.poles
    }

    /// Numbers that the states of a strip have.
    pub(crate) fn numbers(&self) -> usize {
        self.poles.iter().map(Pole::numbers).sum()
    }

    /// phi(s) \[1\] after a way of `s` half chords.
    pub fn at(&self, s: f64) -> f64 {
        let parts = (self.poles.iter()).map(|p| (p.weight * passed(p.rate, s).0).re);
        1.0 - parts.sum::<f64>()
    }

    /// Real and imaginary part of the answer \[1\] to oscillations of the reduced frequency k = omega b / V: of
    /// Wagner's function that is Theodorsen's.
    pub fn answer(&self, k: f64) -> [f64; 2] {
        let conjugate = |p: &Pole| Pole {
            rate: p.rate.conj(),
            weight: p.weight.conj(),
        };
        let mut sum = c64::ONE;
        for p in &self.poles {
            // Re r exp(-p s) is half of each of a pair.
            for q in [*p, conjugate(p)] {
                sum -= q.weight * c64::new(0.0, 0.5 * k) / (q.rate + c64::new(0.0, k));
            }
        }
        [sum.re, sum.im]
    }
}

/// The binomial weights b_n of Peters' theory.
fn binomial(n: usize) -> Vec<f64> {
    let factorial = |k: usize| (1..=k).map(|i| i as f64).product::<f64>();
    let weight = |k: usize| {
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        match k == n {
            true => sign,
            false => sign * factorial(n + k - 1) / (factorial(n - k - 1) * factorial(k).powi(2)),
        }
    };
    (1..=n).map(weight).collect()
}

/// `A = D + d b^T + c d^T + c b^T / 2`.
fn induced(b: &[f64], c: &[f64]) -> Mat<f64> {
    let d = |i: usize| if i == 0 { 0.5 } else { 0.0 };
    Mat::from_fn(b.len(), b.len(), |i, j| {
        let step = match (i, j) {
            _ if i == j + 1 => 0.5 / (i + 1) as f64,
            _ if i + 1 == j => -0.5 / (i + 1) as f64,
            _ => 0.0,
        };
        step + d(i) * b[j] + c[i] * d(j) + 0.5 * c[i] * b[j]
    })
}

/// `exp(-p s)` and `(1 - exp(-p s)) / (p s)`.
pub(crate) fn passed(rate: c64, s: f64) -> (c64, c64) {
    /// Ways below which the quotient is its series: its next term is x^5 / 720.
    const SHORT: f64 = 1e-2;
    let x = rate * s;
    let size = (-x.re).exp();
    let left = match x.im == 0.0 {
        true => c64::from(size),
        false => c64::new(size * x.im.cos(), -size * x.im.sin()),
    };
    if x.re.abs() + x.im.abs() > SHORT {
        return (left, (1.0 - left) / x);
    }
    // 1 - x/2 (1 - x/3 (1 - x/4 (1 - x/5))).
    let mut sum = c64::ONE;
    for k in [5.0, 4.0, 3.0, 2.0] {
        sum = 1.0 - sum * (x / k);
    }
    (left, sum)
}
