//! Hamming's modified predictor-corrector [Hamming 1959, J. ACM 6:37; Carnahan, Luther & Wilkes
//! 1969, sec. 6.12], order four.
//!
//! ```text
//! predict  p     = y[n-3] + 4h/3 (2 f[n] - f[n-1] + 2 f[n-2])
//! modify   m     = p - 112/121 (p - c)[n]
//! correct  c     = (9 y[n] - y[n-2] + 3h (f(m) + 2 f[n] - f[n-1])) / 8      (repeated)
//! finish   y     = c + 9/121 (p - c)
//! ```
//!
//! With one, two, three corrector passes the limits of stability on the real axis are
//! |lambda h| = 0.88, 0.72, 1.46, on the imaginary axis 0.28, 0.80, 1.08.

use crate::nonlinear::secants::Shown;

use super::corrector::{Asked, Convergence, Passing, StepError, StepReport, agree};

/// The past that a multistep method needs: plain data, enough to go on bit for bit.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Multistep {
    /// y[n-3], y[n-2], y[n-1], y[n].
    pub y: [Vec<f64>; 4],
    /// f[n-3], f[n-2], f[n-1], f[n].
    pub f: [Vec<f64>; 4],
    /// p - c of the last step \[unit of y\]; zero after the start.
    pub predicted_minus_corrected: Vec<f64>,
    /// What corrector passes of the last steps have shown, oldest first, over the natural sizes of the
    /// components; empty where nothing speeds them up.
    #[serde(default)]
    pub shown: Vec<Shown>,
}

impl Multistep {
    /// The past made of four equidistant starting values and their rates.
    pub fn from_start(y: [Vec<f64>; 4], f: [Vec<f64>; 4]) -> Self {
        let predicted_minus_corrected = vec![0.0; y[0].len()];
        Self {
            y,
            f,
            predicted_minus_corrected,
            shown: vec![],
        }
    }

    /// The newest state.
    pub fn newest(&self) -> &[f64] {
        &self.y[3]
    }

    /// Makes `y` with the rates `f` the newest state; the oldest is forgotten.
    pub fn push(&mut self, y: &[f64], f: &[f64]) {
        self.y.rotate_left(1);
        self.f.rotate_left(1);
        self.y[3].copy_from_slice(y);
        self.f[3].copy_from_slice(f);
    }
}

/// The method: step, convergence and scratch.
#[derive(Clone, Debug)]
pub struct Hamming {
    /// Step h [s].
    pub step: f64,
    /// When the corrector is done.
    pub convergence: Convergence,
    /// Natural sizes of the components of y \[unit of y\].
    pub scales: Vec<f64>,
    followers: Vec<usize>,
    predicted: Vec<f64>,
    /// What the past contributes to the corrector: `9 y[n] - y[n-2]`, `2 f[n]`, `f[n-1]`.
    known: Vec<[f64; 3]>,
    trial: Vec<f64>,
    corrected: Vec<f64>,
    rates: Vec<f64>,
    passing: Passing,
}

impl Hamming {
    /// The method for states of `scales.len()` components.
    pub fn new(step: f64, convergence: Convergence, scales: Vec<f64>) -> Self {
        let zero = vec![0.0; scales.len()];
        Self {
            step,
            convergence,
            scales,
            followers: vec![],
            predicted: zero.clone(),
            known: vec![[0.0; 3]; zero.len()],
            trial: zero.clone(),
            corrected: zero.clone(),
            rates: zero,
            passing: Passing::default(),
        }
    }

    /// The same with these components as followers: nothing depends on them, and they are corrected
    /// once, with their rates in the accepted state. Their scales are infinite.
    pub fn followed_by(self, followers: Vec<usize>) -> Self {
        Self { followers, ..self }
    }

    /// One step: `past` moves on by h. `rates(y, dy)` is called at the new time only; its last call is
    /// made with the accepted state.
    ///
    /// # Errors
    /// The right-hand side fails; the corrector does not converge. `past` is then unchanged.
    pub fn advance<E>(
        &mut self,
        past: &mut Multistep,
        mut rates: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<StepReport, StepError<E>> {
        self.advance_asking(past, |_, y, dy| rates(y, dy))
    }

    /// As [`Self::advance`] with rates that know what they are asked for. `rates(asked, y, dy)` is called at
    /// the new time only; its last call is made with the accepted state.
    ///
    /// # Errors
    /// The right-hand side fails; the corrector does not converge. `past` is then unchanged.
    pub fn advance_asking<E>(
        &mut self,
        past: &mut Multistep,
        mut rates: impl FnMut(Asked, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<StepReport, StepError<E>> {
        self.predict(past);
        let report = self.correct(&mut past.shown, &mut rates)?;
        let ends = self.corrected.iter().zip(&self.predicted);
        for (y, (c, p)) in self.trial.iter_mut().zip(ends) {
            *y = finished(*p, *c);
        }
        rates(Asked::Accepted, &self.trial, &mut self.rates).map_err(StepError::Rates)?;
        for k in 0..self.followers.len() {
            let i = self.followers[k];
            self.corrected[i] = corrected(&self.known[i], self.rates[i], self.step);
            self.trial[i] = finished(self.predicted[i], self.corrected[i]);
        }
        self.shift(past);
        Ok(report)
    }

    /// Predictor and modifier: `predicted` and the first `trial`; what the corrector knows beforehand.
    fn predict(&mut self, past: &Multistep) {
        let ([y0, y1, _, y3], [_, f1, f2, f3]) = (&past.y, &past.f);
        let ahead = 4.0 * self.step / 3.0;
        let past_y = y0
            .iter()
            .zip(y1)
            .zip(y3)
            .zip(&past.predicted_minus_corrected);
        let past_f = f1.iter().zip(f2).zip(f3);
        let own = (self.predicted.iter_mut())
            .zip(&mut self.trial)
            .zip(&mut self.known);
        for (((p, m), known), ((((y0, y1), y3), gap), ((f1, f2), f3))) in
            own.zip(past_y.zip(past_f))
        {
            *p = y0 + ahead * (2.0 * f3 - f2 + 2.0 * f1);
            *m = *p - 112.0 / 121.0 * gap;
            *known = [9.0 * y3 - y1, 2.0 * f3, *f2];
        }
    }

    /// Corrector passes until convergence; leaves the result in `corrected`.
    fn correct<E>(
        &mut self,
        shown: &mut Vec<Shown>,
        rates: &mut impl FnMut(Asked, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<StepReport, StepError<E>> {
        let (dy, h, known) = (&mut self.rates, self.step, &self.known);
        let pass = |trial: &[f64], result: &mut [f64]| {
            rates(Asked::Pass, trial, dy)?;
            for ((c, known), rate) in result.iter_mut().zip(known).zip(dy.iter()) {
                *c = corrected(known, *rate, h);
            }
            Ok(())
        };
        let (trial, result) = (&mut self.trial, &mut self.corrected);
        agree(
            self.convergence,
            trial,
            result,
            &self.scales,
            (&mut self.passing, shown),
            pass,
        )
    }

    /// Makes the accepted state the newest of `past`.
    fn shift(&mut self, past: &mut Multistep) {
        past.push(&self.trial, &self.rates);
        let gaps = self.predicted.iter().zip(&self.corrected);
        for (gap, (p, c)) in past.predicted_minus_corrected.iter_mut().zip(gaps) {
            *gap = p - c;
        }
    }
}

/// A component of the new state by the corrector, from what is known beforehand and the `rate` there.
fn corrected(&[y, f3, f2]: &[f64; 3], rate: f64, h: f64) -> f64 {
    (y + 3.0 * h * (rate + f3 - f2)) / 8.0
}

/// The final modifier: a component of the accepted state.
fn finished(predicted: f64, corrected: f64) -> f64 {
    corrected + 9.0 / 121.0 * (predicted - corrected)
}
