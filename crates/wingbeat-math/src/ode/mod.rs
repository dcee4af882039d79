//! Time integration of `y' = f(t, y)`.
//!
//! [`hamming`] is the predictor-corrector of coupled flight (seed sec. 5 announces one): a
//! right-hand side is evaluated only at the ends of steps, so that it may carry its own history,
//! as a vortex wake does; so does [`bdf`], for those that hold a difference quotient of the state.
//! [`start`] finds their first values at the same order. [`runge_kutta`] is for right-hand sides
//! without history, as are [`adams`] (multistep, order four) and [`dop853`] (order eight, its own
//! steps).

pub mod adams;
pub mod bdf;
mod corrector;
pub mod dop853;
mod dop853_table;
pub mod hamming;
pub mod runge_kutta;
mod stability;
pub mod start;

pub use adams::AdamsBashforthMoulton;
pub use bdf::{BACKWARD_START, Bdf, order_two_start};
pub use corrector::{Asked, Convergence, StepError, StepReport, scaled_difference};
pub use dop853::{AdaptiveError, AdaptiveReport, Dop853, Tolerance};
pub use hamming::{Hamming, Multistep};
pub use runge_kutta::Rk4;
pub use stability::EqualSteps;
pub use start::{Memoryless, Replay, block_start, stepwise_start};
