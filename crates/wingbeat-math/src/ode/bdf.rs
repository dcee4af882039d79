//! Backward differentiation formulas of orders four and two [Curtiss & Hirschfelder 1952; Hairer & Wanner,
//! Solving ODEs II, sec. V.1], with the predictors of Adams and Bashforth; that of order four:
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
//!
//! Undamped vibrations of the angular frequency w grow by the formula of order four where w h is more than a
//! few tenths (by 1.4 % a step at 0.6, by 11 % at 1). That of order two damps vibrations of every frequency,
//! and leaves the share `max(rho, |1 - 3 rho| / (3 - rho))` of the fastest from step to step, which is rho from
//! 0.172 on and a third at rho = 0: the generalized-alpha method for equations of
//! first order [Jansen, Whiting & Hulbert 2000], its rates at the middle of a step taken out. Its parameters
//! are those of the method of second order [Chung & Hulbert 1993], by which elastic bodies go: velocities of
//! bodies that carry each other then follow alike from their accelerations, however these jump:
//!
//! ```text
//! predict  p = y[n] + h/2 (3 f[n] - f[n-1])
//! correct  m c = (2 m - 1) y[n] + (1 - m) y[n-1]
//!                + h (g a f(c) + (g + a - 2 g a) f[n] + (1 - g) (1 - a) f[n-1])    (repeated)
//!          m = (2 - rho) / (1 + rho),  a = 1 / (1 + rho),  g = 1/2 + m - a
//! ```
//!
//! It starts with a step of Euler's backward method, which knows no rate at the start: a jump there leaves
//! nothing behind.

use super::corrector::{Convergence, Passing, StepError, StepReport, agree};
use super::hamming::Multistep;

/// Weights, newest first: of past states and rates in the corrector over the sum of the former, of the new rate
/// in it, and of rates in the predictor over their sum.
#[derive(Clone, Copy, Debug)]
struct Weights {
    states: [f64; 4],
    rates: [f64; 2],
    new_rate: f64,
    predictor: [f64; 4],
}

const ORDER_FOUR: Weights = Weights {
    states: [48.0, -36.0, 16.0, -3.0],
    rates: [0.0, 0.0],
    new_rate: 12.0 / 25.0,
    predictor: [55.0, -59.0, 37.0, -9.0],
};

/// m, a and g of the method of order two of the parameter `rho`.
fn parameters(rho: f64) -> [f64; 3] {
    let (m, a) = ((2.0 - rho) / (1.0 + rho), 1.0 / (1.0 + rho));
    [m, a, 0.5 + m - a]
}

/// Weights of f0 to f3 in (y_k - y_0) / h of the first three steps of the method of order two of the
/// parameter `rho`: one of Euler's backward method, one in which the rate at the middle of the step before is
/// that at its end, and one as all later ones.
pub fn order_two_start(rho: f64) -> [[f64; 4]; 3] {
    let [m, a, g] = parameters(rho);
    let (now, before) = (g * a / m, 1.0 - g * a / m);
    let carried = (m - 1.0) / m;
    let last = [(1.0 - g) * (1.0 - a) / m, (g + a - 2.0 * g * a) / m];
    [
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 1.0 + before, now, 0.0],
        [
            0.0,
            1.0 + (1.0 + carried) * before + last[0],
            (1.0 + carried) * now + last[1],
            now,
        ],
    ]
}

/// Starting steps by the formulas of order one, two and three, which ask neither for later rates nor for those at the
/// start: weights of f0 to f3 in `(y_k - y_0) / h`, k = 1, 2, 3.
pub const BACKWARD_START: [[f64; 4]; 3] = [
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 4.0 / 3.0, 2.0 / 3.0, 0.0],
    [0.0, 15.0 / 11.0, 12.0 / 11.0, 6.0 / 11.0],
];

/// The method: step, convergence and scratch.
#[derive(Clone, Debug)]
pub struct Bdf {
    /// Step h [s].
    pub step: f64,
    /// When the corrector is done.
    pub convergence: Convergence,
    /// Natural sizes of the components of y \[unit of y\].
    pub scales: Vec<f64>,
    weights: Weights,
    /// What the past contributes to the corrected state.
    known: Vec<f64>,
    trial: Vec<f64>,
    corrected: Vec<f64>,
    rates: Vec<f64>,
    passing: Passing,
}

impl Bdf {
    /// The method of order four for states of `scales.len()` components.
    pub fn new(step: f64, convergence: Convergence, scales: Vec<f64>) -> Self {
        let zero = vec![0.0; scales.len()];
        Self {
            step,
            convergence,
            scales,
            weights: ORDER_FOUR,
            known: zero.clone(),
            trial: zero.clone(),
            corrected: zero.clone(),
            rates: zero,
            passing: Passing::default(),
        }
    }

    /// That of order two that leaves the share `max(rho, |1 - 3 rho| / (3 - rho))` \[1\] of the fastest
    /// vibrations from step to step.
    pub fn order_two(self, rho: f64) -> Self {
        let [m, a, g] = parameters(rho);
        let weights = Weights {
            states: [2.0 * m - 1.0, 1.0 - m, 0.0, 0.0],
            rates: [(g + a - 2.0 * g * a) / m, (1.0 - g) * (1.0 - a) / m],
            new_rate: g * a / m,
            predictor: [3.0, -1.0, 0.0, 0.0],
        };
        Self { weights, ..self }
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
        let (known, dy) = (&self.known, &mut self.rates);
        let (h, new) = (self.step, self.weights.new_rate);
        let pass = |trial: &[f64], corrected: &mut [f64]| {
            rates(trial, dy)?;
            for ((c, k), f) in corrected.iter_mut().zip(known).zip(dy.iter()) {
                *c = k + new * h * f;
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
        let Weights {
            states,
            rates,
            predictor,
            ..
        } = self.weights;
        let [a, b] = [states, predictor].map(|w| w.iter().sum::<f64>());
        let h = self.step / b;
        let sum =
            |[w3, w2, w1, w0]: [f64; 4], x: [f64; 4]| w3 * x[0] + w2 * x[1] + w1 * x[2] + w0 * x[3];
        for i in 0..self.trial.len() {
            self.known[i] = sum(states, [y3[i], y2[i], y1[i], y0[i]]) / a;
            if rates[0] != 0.0 {
                self.known[i] += self.step * (rates[0] * f3[i] + rates[1] * f2[i]);
            }
            self.trial[i] = y3[i] + h * sum(predictor, [f3[i], f2[i], f1[i], f0[i]]);
        }
    }
}
