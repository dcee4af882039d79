//! Nonlinear equations: Newton iteration, and least squares of former passes.

pub mod newton;
pub mod secants;
