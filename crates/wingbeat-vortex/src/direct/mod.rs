//! Direct sums: every source at every target, in vector instructions.

pub(crate) mod block;
pub(crate) mod gaussian;
pub(crate) mod lanes;
pub(crate) mod packed;
pub(crate) mod particles;
pub mod reference;
pub(crate) mod single;
pub(crate) mod sum;

pub use block::BLOCK;
pub use packed::WINDOW;
pub use particles::{Particle, ParticleSum, Stretching};
pub use sum::{DirectSum, UnitEdges, add_velocity};
