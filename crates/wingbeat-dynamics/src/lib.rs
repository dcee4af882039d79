//! Constrained multibody dynamics of flapping flight (seed sec. 3 and 4).
#![warn(missing_docs)]

pub mod budget;
mod error;
pub mod euler;
mod formulation;
pub mod inverse;
mod momentum;
mod motion;
pub mod posture;
mod solution;
mod system;
mod tether;
mod workspace;

pub use error::DynamicsError;
pub use euler::{Baumgarte, EulerForm};
pub use formulation::Formulation;
pub use momentum::MomentumForm;
pub use motion::{BodyAcceleration, BodyMotion, Wrench};
pub use solution::{Budget, HingeReaction, Solution, Violation};
pub use system::{Body, Hinge, NaturalUnits, System};
pub use tether::{RootMotion, tethered, tethered_motions};
pub use workspace::Workspace;
