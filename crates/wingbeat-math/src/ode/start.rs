//! Starting values of order four (error of y three steps on: fifth power of h) by the implicit
//! block formulas that integrate the cubic through f[0] to f[3]
//! [Hairer, Norsett & Wanner, Solving ODEs I, sec. III.1]:
//!
//! ```text
//! y1 = y0 +  h/24 (9 f0 + 19 f1 - 5 f2 + f3)
//! y2 = y0 +  h/3  (f0 + 4 f1 + f2)
//! y3 = y0 + 3h/8  (f0 + 3 f1 + 3 f2 + f3)
//! ```
//!
//! The three steps are swept in order, again and again, each with the latest rates of the others;
//! the first sweep has the trapezoidal rule for y1, whose formula asks for later rates. Within a step y and f
//! are iterated until they agree. A right-hand side with a history (a wake) is replayed from the start in every
//! sweep and frozen within a step, as it will be later on.

use super::corrector::{Convergence, Passing, StepError, StepReport, scaled_difference};
use super::hamming::Multistep;

/// Most sweeps over the three starting steps. Smooth right-hand sides converge in six or so; a
/// history that reacts to the smallest change (a wake that passes a wing on this or on that side)
/// may not fall below its own jumps, which the report then shows.
const MAX_SWEEPS: usize = 12;

/// A right-hand side that is replayed over the starting steps.
pub trait Replay {
    /// What can go wrong.
    type Error;

    /// Enters starting step `k` (1 to 3), at the time t0 + k h: moves the history there and
    /// freezes it. Entering step 1 begins again from the start.
    ///
    /// # Errors
    /// The history cannot be moved.
    fn enter(&mut self, k: usize) -> Result<(), Self::Error>;

    /// The rates `f` of the state `y` in starting step `k`.
    ///
    /// # Errors
    /// The right-hand side fails.
    fn rates(&mut self, k: usize, y: &[f64], f: &mut [f64]) -> Result<(), Self::Error>;

    /// Leaves starting step `k`; the state last evaluated is accepted.
    ///
    /// # Errors
    /// The history cannot be kept.
    fn leave(&mut self, k: usize) -> Result<(), Self::Error>;
}

/// A right-hand side `rates(t, y, f)` without a history.
pub struct Memoryless<F> {
    /// Time of the start [s].
    pub t0: f64,
    /// Step h [s].
    pub step: f64,
    /// The right-hand side.
    pub rates: F,
}

impl<E, F: FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>> Replay for Memoryless<F> {
    type Error = E;

    fn enter(&mut self, _k: usize) -> Result<(), E> {
        Ok(())
    }

    fn rates(&mut self, k: usize, y: &[f64], f: &mut [f64]) -> Result<(), E> {
        (self.rates)(self.t0 + k as f64 * self.step, y, f)
    }

    fn leave(&mut self, _k: usize) -> Result<(), E> {
        Ok(())
    }
}

/// Three starting steps of size `step` from the state `y0` with the rates `f0`. Where sweeps over them still differ after
/// the last, by more than `convergence` allows, the report has by how much.
///
/// # Errors
/// The right-hand side fails; y and f of a step do not agree to `convergence`.
pub fn block_start<R: Replay>(
    y0: &[f64],
    f0: &[f64],
    step: f64,
    convergence: Convergence,
    scales: &[f64],
    replay: &mut R,
) -> Result<(Multistep, StepReport), StepError<R::Error>> {
    let mut past = Multistep::from_start(
        std::array::from_fn(|_| y0.to_vec()),
        std::array::from_fn(|_| f0.to_vec()),
    );
    let mut report = StepReport::default();
    for sweep in 0..MAX_SWEEPS {
        let before = past.y.clone();
        for k in 1..4 {
            replay.enter(k).map_err(StepError::Rates)?;
            let weights = if sweep == 0 {
                FIRST[k - 1]
            } else {
                BLOCK[k - 1]
            };
            let inner = agree(k, weights, step, convergence, scales, replay, &mut past)?;
            report.passes = report.passes.max(inner.passes);
            replay.leave(k).map_err(StepError::Rates)?;
        }
        let change = |k: usize| scaled_difference(&before[k], &past.y[k], scales);
        report.residual = crate::numbers::extremes::largest((1..4).map(change));
        if sweep > 0 && report.residual <= convergence.tolerance {
            break;
        }
    }
    match report.residual.is_finite() {
        true => Ok((past, report)),
        false => Err(StepError::NotConverged(report)),
    }
}

/// Three starting steps by formulas that ask for no later rate: `weights` of f0 to f3 in (y_k - y_0) / h.
///
/// # Errors
/// As [`block_start`].
pub fn stepwise_start<R: Replay>(
    (y0, f0): (&[f64], &[f64]),
    step: f64,
    weights: &[[f64; 4]; 3],
    (convergence, scales): (Convergence, &[f64]),
    replay: &mut R,
) -> Result<(Multistep, StepReport), StepError<R::Error>> {
    let mut past = Multistep::from_start(
        std::array::from_fn(|_| y0.to_vec()),
        std::array::from_fn(|_| f0.to_vec()),
    );
    let mut report = StepReport::default();
    for k in 1..4 {
        replay.enter(k).map_err(StepError::Rates)?;
        let w = weights[k - 1];
        let inner = agree(k, w, step, convergence, scales, replay, &mut past)?;
        report.passes = report.passes.max(inner.passes);
        report.residual = crate::numbers::extremes::larger(report.residual, inner.residual);
        replay.leave(k).map_err(StepError::Rates)?;
    }
    Ok((past, report))
}

/// Weights of f0 to f3 in (y_k - y_0) / h.
const BLOCK: [[f64; 4]; 3] = [
    [9.0 / 24.0, 19.0 / 24.0, -5.0 / 24.0, 1.0 / 24.0],
    [1.0 / 3.0, 4.0 / 3.0, 1.0 / 3.0, 0.0],
    [3.0 / 8.0, 9.0 / 8.0, 9.0 / 8.0, 3.0 / 8.0],
];

/// The same without the rates still unknown: trapezoidal rule, Simpson's rule, and all four.
const FIRST: [[f64; 4]; 3] = [[0.5, 0.5, 0.0, 0.0], BLOCK[1], BLOCK[2]];

/// Iterates y and f of starting step `k` until they agree.
fn agree<R: Replay>(
    k: usize,
    weights: [f64; 4],
    step: f64,
    convergence: Convergence,
    scales: &[f64],
    replay: &mut R,
    past: &mut Multistep,
) -> Result<StepReport, StepError<R::Error>> {
    let Convergence {
        tolerance,
        max_passes,
        ..
    } = convergence;
    let mut report = StepReport::default();
    let (mut passing, mut corrected) = (Passing::default(), past.y[k].clone());
    let mut f = std::mem::take(&mut past.f[k]);
    loop {
        replay
            .rates(k, &past.y[k], &mut f)
            .map_err(StepError::Rates)?;
        if report.passes > 0 && report.residual <= tolerance {
            break;
        }
        if report.passes == max_passes {
            if tolerance > 0.0 || !report.residual.is_finite() {
                return Err(StepError::NotConverged(report));
            }
            break;
        }
        for i in 0..f.len() {
            let rate = |j: usize| if j == k { f[i] } else { past.f[j][i] };
            let sum: f64 = (0..4).map(|j| weights[j] * rate(j)).sum();
            corrected[i] = past.y[0][i] + step * sum;
        }
        report.passes += 1;
        report.residual = scaled_difference(&corrected, &past.y[k], scales);
        // What is accepted is what the formulas say, for sums over rates as for the state.
        let accepts = report.residual <= tolerance;
        let accelerated_from = convergence.accelerated_from.filter(|_| !accepts);
        let how = Convergence {
            accelerated_from,
            ..convergence
        };
        let trial = (&mut past.y[k][..], &corrected[..]);
        passing.go_on(&how, report.passes, trial, scales);
    }
    past.f[k] = f;
    Ok(report)
}
