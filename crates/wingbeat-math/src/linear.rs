//! Linear algebra: dense factorisations, linear equations by iteration, six by six matrices.

pub mod iterative;
pub mod lu;
pub mod matrix;
pub mod six_by_six;
pub mod small_lu;
