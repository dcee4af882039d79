//! Time integration of `y' = f(t, y)`.
//!
//! [`hamming`] is the predictor-corrector of coupled flight (seed sec. 5 announces one): a
//! right-hand side is evaluated only at the ends of steps, so that it may carry its own history,
//! as a vortex wake does. [`start`] finds its first values at the same order. [`runge_kutta`] is
//! for right-hand sides without history, as are [`adams`] (multistep, order four) and [`dop853`]
//! (order eight, its own steps, dense output).

pub mod adams;
pub mod dop853;
mod dop853_table;
pub mod hamming;
pub mod runge_kutta;
pub mod start;

pub use adams::AdamsBashforthMoulton;
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
