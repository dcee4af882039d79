//! Motion in time.

mod carried;
mod generalized_alpha;
mod response;
mod solver;

pub use carried::{carried_by_frame, resultant};
pub use generalized_alpha::{GeneralizedAlpha, State, Trial, Weights};
pub use solver::{LoadTangent, Solver};
pub(crate) use solver::{inertial, size};
