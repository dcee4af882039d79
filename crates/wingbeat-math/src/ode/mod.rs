//! Time integration of `y' = f(t, y)`.
//!
//! [`hamming`] is the predictor-corrector of coupled flight (seed sec. 5 announces one): a
//! right-hand side is evaluated only at the ends of steps, so that it may carry its own history,
//! as a vortex wake does; so does [`bdf`], for those that hold a difference quotient of the state.
//! [`start`] finds their first values at the same order. [`runge_kutta`] is for right-hand sides
//! without history, as are [`adams`] (multistep, order four) and [`dop853`] (order eight, its own
//! steps, dense output).

pub mod adams;
pub mod bdf;
pub mod dop853;
mod dop853_table;
pub mod hamming;
pub mod runge_kutta;
pub mod start;

pub use adams::AdamsBashforthMoulton;
pub use bdf::Bdf;
pub use dop853::{AdaptiveError, AdaptiveReport, Dense, Dop853, Tolerance};
pub use hamming::{Convergence, Hamming, Multistep, StepReport};
pub use runge_kutta::Rk4;
pub use start::{Memoryless, Replay, block_start};

/// Why a step failed.
#[derive(Clone, Debug, PartialEq)]
pub enum StepError<E> {
    /// The right-hand side failed.
    Rates(E),
    /// The corrector did not converge.
    NotConverged(StepReport),
}

/// Largest difference of two states in units of the natural sizes `scales` of their components;
/// an infinite scale takes a component out of the norm. Not a number counts as infinite.
pub fn scaled_difference(a: &[f64], b: &[f64], scales: &[f64]) -> f64 {
    let mut largest = 0.0_f64;
    for ((x, y), s) in a.iter().zip(b).zip(scales) {
        let d = (x - y).abs();
        if d.is_nan() {
            return f64::INFINITY;
        }
        if s.is_finite() {
            largest = largest.max(d / s);
        }
    }
    largest
}

/// Corrector passes from `trial` until two in succession agree; the last one is in `corrected`.
/// `pass(trial, corrected)` makes one.
///
/// # Errors
/// The right-hand side fails; the passes do not converge.
fn agree<E>(
    convergence: Convergence,
    trial: &mut [f64],
    corrected: &mut [f64],
    scales: &[f64],
    mut pass: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
) -> Result<StepReport, StepError<E>> {
    let mut report = StepReport::default();
    while report.passes < convergence.max_passes {
        pass(trial, corrected).map_err(StepError::Rates)?;
        report.passes += 1;
        report.residual = scaled_difference(corrected, trial, scales);
        if report.residual <= convergence.tolerance {
            return Ok(report);
        }
        for (x, c) in trial.iter_mut().zip(corrected.iter()) {
            *x += convergence.relaxation * (c - *x);
        }
    }
    if convergence.tolerance > 0.0 || !report.residual.is_finite() {
        return Err(StepError::NotConverged(report));
    }
    Ok(report)
}
