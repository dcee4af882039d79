//! Backward differentiation formula of order four [Curtiss & Hirschfelder 1952; Hairer & Wanner,
//! Solving ODEs II, sec. V.1], with the predictor of Adams and Bashforth:
//!
//! ```text
//! predict  p = y[n] + h/24 (55 f[n] - 59 f[n-1] + 37 f[n-2] - 9 f[n-3])
//! correct  c = (48 y[n] - 36 y[n-1] + 16 y[n-2] - 3 y[n-3] + 12 h f(c)) / 25    (repeated)
//! ```
//!
//! For right-hand sides that hold a difference quotient of y, as the loads of a wake hold that of
//! the circulation: `y' = -mu D y / h + ...`, D a backward difference of order one or two, mu the
//! added mass over the mass that carries it. Such a term does not get smaller with the step. Where
//! only f of the new step enters, both differences act on y alike and the method is stable for all
//! mu from 0. Methods that weigh rates of several steps are not: [`super::Hamming`] with the
//! difference of order two up to mu = 0.359, with that of order one up to 0.701; beyond, y alternates
//! from step to step and grows, whatever the step.

use super::corrector::{Convergence, Passing, StepError, StepReport, agree};
use super::hamming::Multistep;

/// The method: step, convergence and scratch.
#[derive(Clone, Debug)]
pub struct Bdf {
    /// Step h [s].
    pub step: f64,
    /// When the corrector is done.
    pub convergence: Convergence,
    /// Natural sizes of the components of y \[unit of y\].
    pub scales: Vec<f64>,
    /// What the past contributes to the corrected state.
    known: Vec<f64>,
    trial: Vec<f64>,
    corrected: Vec<f64>,
    rates: Vec<f64>,
    passing: Passing,
}

impl Bdf {
    /// The method for states of `scales.len()` components.
    pub fn new(step: f64, convergence: Convergence, scales: Vec<f64>) -> Self {
        let zero = vec![0.0; scales.len()];
        Self {
            step,
            convergence,
            scales,
            known: zero.clone(),
            trial: zero.clone(),
            corrected: zero.clone(),
            rates: zero,
            passing: Passing::default(),
        }
    }

    /// One step: `past` moves on by h. `rates(y, dy)` is called at the new time only; its last
    /// call is made with the accepted state.
    ///
    /// # Errors
    /// The right-hand side fails; the corrector does not converge. `past` is then unchanged.
    pub fn advance<E>(
        &mut self,
        past: &mut Multistep,
        mut rates: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<StepReport, StepError<E>> {
        self.predict(past);
        let (known, dy, h) = (&self.known, &mut self.rates, self.step);
        let pass = |trial: &[f64], corrected: &mut [f64]| {
            rates(trial, dy)?;
            for ((c, k), f) in corrected.iter_mut().zip(known).zip(dy.iter()) {
                *c = k + 12.0 / 25.0 * h * f;
            }
            Ok(())
        };
        let (trial, corrected) = (&mut self.trial, &mut self.corrected);
        let report = agree(
            self.convergence,
            trial,
            corrected,
            &self.scales,
            (&mut self.passing, &mut past.shown),
            pass,
        )?;
        rates(&self.corrected, &mut self.rates).map_err(StepError::Rates)?;
        past.push(&self.corrected, &self.rates);
        Ok(report)
    }

    /// The first `trial`, and what the past contributes.
    fn predict(&mut self, past: &Multistep) {
        let ([y0, y1, y2, y3], [f0, f1, f2, f3]) = (&past.y, &past.f);
        let h = self.step / 24.0;
        for i in 0..self.trial.len() {
            self.known[i] = (48.0 * y3[i] - 36.0 * y2[i] + 16.0 * y1[i] - 3.0 * y0[i]) / 25.0;
            self.trial[i] = y3[i] + h * (55.0 * f3[i] - 59.0 * f2[i] + 37.0 * f1[i] - 9.0 * f0[i]);
        }
    }
}
