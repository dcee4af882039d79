//! Motion in time.

mod balance;
mod generalized_alpha;
mod solver;
mod step;

pub use balance::{RootWrench, carried_by_frame, kinetic_energy, reaction, relative_momentum};
pub use generalized_alpha::{GeneralizedAlpha, State, Trial, Weights};
pub use solver::{LoadTangent, Solver};
pub(crate) use solver::{inertial, larger, size};
pub use step::{Passes, Step};
