//! Direct sums: every source at every target, in vector instructions.

mod algebraic;
pub(crate) mod block;
pub(crate) mod gaussian;
pub(crate) mod lanes;
pub(crate) mod moments;
pub(crate) mod packed;
pub mod reference;
pub(crate) mod single;
mod smoothing;
pub(crate) mod sum;

pub use algebraic::{AlgebraicSum, Stretching};
pub use block::BLOCK;
pub use packed::WINDOW;
pub use sum::{UnitEdges, add_velocity};
