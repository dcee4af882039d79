//! Constrained multibody dynamics of flapping flight (seed sec. 3 and 4).
#![warn(missing_docs)]

mod error;
mod formulation;
mod motion;
pub mod posture;
mod solution;
mod system;
mod workspace;

pub use error::DynamicsError;
pub use formulation::Formulation;
pub use motion::{BodyAcceleration, BodyMotion, Wrench};
pub use solution::{Budget, HingeReaction, Solution, Violation};
pub use system::{Body, Hinge, NaturalUnits, System};
pub use workspace::Workspace;
