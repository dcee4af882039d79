//! The Runge-Kutta method of order eight of Dormand and Prince with an error estimate of orders
//! five and three and step control [Hairer, Norsett & Wanner 1993, Solving ODEs I, sec. II.5; coefficients as
//! published with it].
//!
//! For dynamics alone: its steps are long, so the right-hand side must be smooth.

use super::dop853_table::{A, B, B_THIRD, C, E_FIFTH};

/// Accuracy asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Error per step relative to the size of a component \[1\].
    pub relative: f64,
    /// Error per step over the component's natural size \[1\].
    pub absolute: f64,
    /// Most steps, accepted and rejected.
    pub max_steps: usize,
}

/// Why the integration ended early.
#[derive(Clone, Debug, PartialEq)]
pub enum AdaptiveError<E> {
    /// The right-hand side failed, at the start or in the smallest step there is.
    Rates(E),
    /// The steps became too small to move the time: a singularity or a jump.
    StepTooSmall {
        /// Time \[s\].
        time: f64,
        /// Step \[s\].
        step: f64,
    },
    /// The allowed number of steps was used up.
    TooManySteps {
        /// Time reached \[s\].
        time: f64,
    },
}

/// What an integration cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AdaptiveReport {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected.
    pub rejected: usize,
}

/// The method with its scratch.
#[derive(Clone, Debug)]
pub struct Dop853 {
    tolerance: Tolerance,
    scales: Vec<f64>,
    first: f64,
    k: Vec<Vec<f64>>,
    stage: Vec<f64>,
    next: Vec<f64>,
}

impl Dop853 {
    /// For states whose components have the natural sizes `scales`.
    pub fn new(tolerance: Tolerance, scales: Vec<f64>) -> Self {
        let zero = vec![0.0; scales.len()];
        Self {
            tolerance,
            k: vec![zero.clone(); 13],
            stage: zero.clone(),
            next: zero,
            scales,
            first: 1e-3,
        }
    }

    /// The same with a first step of `fraction` of the interval; a thousandth if nothing is said.
    pub fn starting_with(self, fraction: f64) -> Self {
        Self {
            first: fraction,
            ..self
        }
    }

    /// From `t0` to `t1` \[s\]; `y` moves on. Where the right-hand side fails in a trial state the step is made
    /// shorter.
    ///
    /// # Errors
    /// [`AdaptiveError`]; `y` then holds the last accepted state.
    pub fn integrate<E>(
        &mut self,
        (t0, t1): (f64, f64),
        y: &mut [f64],
        mut f: impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<AdaptiveReport, AdaptiveError<E>> {
        let mut report = AdaptiveReport::default();
        let (mut t, mut h) = (t0, self.first * (t1 - t0));
        let mut failure = None;
        f(t, y, &mut self.k[0]).map_err(AdaptiveError::Rates)?;
        while (t1 - t) * (t1 - t0) > 0.0 {
            if report.accepted + report.rejected >= self.tolerance.max_steps {
                return Err(AdaptiveError::TooManySteps { time: t });
            }
            if t + 0.1 * h == t {
                let too_small = AdaptiveError::StepTooSmall { time: t, step: h };
                return Err(failure.map_or(too_small, AdaptiveError::Rates));
            }
            let last = ((t + h) - t1) * (t1 - t0) >= 0.0;
            h = if last { t1 - t } else { h };
            match self.attempt(t, h, y, &mut f) {
                Ok(error) if error <= 1.0 => {
                    y.copy_from_slice(&self.next);
                    self.k.swap(0, 12);
                    (t, report.accepted) = (if last { t1 } else { t + h }, report.accepted + 1);
                    h *= factor(error);
                    failure = None;
                    continue;
                }
                Ok(error) if error.is_finite() => h *= factor(error).min(1.0),
                Ok(_) => h *= 0.1,
                // A trial state may lie where the right-hand side has no value although the
                // solution does not: come less near.
                Err(e) => {
                    failure = Some(e);
                    h *= 0.1;
                }
            }
            report.rejected += 1;
        }
        Ok(report)
    }

    /// Tries a step of length `h`: the new state in `next`, and where its error, which is returned, is at most 1
    /// the rates there, with which the next step begins.
    fn attempt<E>(
        &mut self,
        t: f64,
        h: f64,
        y: &[f64],
        f: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<f64, E> {
        self.stages(t, h, y, f)?;
        let error = self.error(h, y);
        if error <= 1.0 {
            f(t + h, &self.next, &mut self.k[12])?;
        }
        Ok(error)
    }

    /// The twelve stages and the new state in `next`.
    fn stages<E>(
        &mut self,
        t: f64,
        h: f64,
        y: &[f64],
        f: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        for s in 1..12 {
            combine(&self.k, A[s], h, y, &mut self.stage);
            f(t + C[s] * h, &self.stage, &mut self.k[s])?;
        }
        combine(&self.k, B, h, y, &mut self.next);
        Ok(())
    }

    /// Error of the step in units of the tolerance.
    fn error(&self, h: f64, y: &[f64]) -> f64 {
        let (mut fifth, mut third) = (0.0, 0.0);
        for (i, scale) in self.scales.iter().enumerate() {
            let size = y[i].abs().max(self.next[i].abs());
            let unit = self.tolerance.absolute * scale + self.tolerance.relative * size;
            fifth += (weighted(&self.k, E_FIFTH, i) / unit).powi(2);
            let gap = weighted(&self.k, B, i) - weighted(&self.k, B_THIRD, i);
            third += (gap / unit).powi(2);
        }
        let sum = fifth + 0.01 * third;
        // Components of infinite scale follow and do not count.
        let n = self.scales.iter().filter(|s| s.is_finite()).count().max(1) as f64;
        if sum > 0.0 {
            h.abs() * fifth / (n * sum).sqrt()
        } else {
            sum
        }
    }
}

/// Factor for the length of the next step after one of this error.
fn factor(error: f64) -> f64 {
    (0.9 * error.max(1e-12).powf(-0.125)).clamp(0.333, 6.0)
}

/// `sum of w_j k_j[i]`.
fn weighted(k: &[Vec<f64>], weights: &[(usize, f64)], i: usize) -> f64 {
    weights.iter().map(|&(j, w)| w * k[j - 1][i]).sum()
}

/// `out = y + h sum of w_j k_j`.
fn combine(k: &[Vec<f64>], weights: &[(usize, f64)], h: f64, y: &[f64], out: &mut [f64]) {
    for (i, o) in out.iter_mut().enumerate() {
        *o = y[i] + h * weighted(k, weights, i);
    }
}
