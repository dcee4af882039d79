//! Adams-Bashforth-Moulton, order four: predict, evaluate, correct, evaluate.
//!
//! ```text
//! predict  p = y[n] + h/24 (55 f[n] - 59 f[n-1] + 37 f[n-2] - 9 f[n-3])
//! correct  c = y[n] + h/24 (9 f(p) + 19 f[n] - 5 f[n-1] + f[n-2])
//! ```

use super::Multistep;

/// The method with its scratch.
#[derive(Clone, Debug)]
pub struct AdamsBashforthMoulton {
    /// Step h \[s\].
    pub step: f64,
    state: Vec<f64>,
    rates: Vec<f64>,
}

impl AdamsBashforthMoulton {
    /// For states of `dim` components and the step `step` \[s\].
    pub fn new(step: f64, dim: usize) -> Self {
        Self {
            step,
            state: vec![0.0; dim],
            rates: vec![0.0; dim],
        }
    }

    /// One step: `past` moves on by h. `rates(y, dy)` is called twice at the new time, the second
    /// time with the accepted state.
    ///
    /// # Errors
    /// The right-hand side fails; `past` is then unchanged.
    pub fn advance<E>(
        &mut self,
        past: &mut Multistep,
        mut rates: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let ([_, _, _, y], [f0, f1, f2, f3]) = (&past.y, &past.f);
        let h = self.step / 24.0;
        for (i, s) in self.state.iter_mut().enumerate() {
            *s = y[i] + h * (55.0 * f3[i] - 59.0 * f2[i] + 37.0 * f1[i] - 9.0 * f0[i]);
        }
        rates(&self.state, &mut self.rates)?;
        for (i, s) in self.state.iter_mut().enumerate() {
            *s = y[i] + h * (9.0 * self.rates[i] + 19.0 * f3[i] - 5.0 * f2[i] + f1[i]);
        }
        rates(&self.state, &mut self.rates)?;
        past.push(&self.state, &self.rates);
        Ok(())
    }
}
