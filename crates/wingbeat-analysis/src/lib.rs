//! Questions of flight dynamics, asked of the full flapping model.
//!
//! The chapter in order: [`beat`] is one wingbeat of free flight as a map of the state; [`trim`]
//! finds steady flight as a periodic orbit of that map (Newton's method, shooting over one beat);
//! [`mean`] averages loads over a beat of steadily moving body; [`stability`] linearises: the
//! cycle-averaged rigid-body model with its derivatives, and Floquet's multipliers of the
//! periodic orbit from the [`monodromy`] matrix; [`modes`] names what comes out; [`derivatives`]
//! are the controls; [`power`] is what it takes; [`control`] holds a flyer on its orbit by feedback, laid out by
//! [`stabiliser`] or [`regulator`] when a flight is built ([`design`]), along a [`route`] if there is one; an [`episode`] is steered from outside, for who learns;
//! [`wing_modes`] are the vibrations of elastic wings, [`flutter`] asks when they grow.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | T | [`Beat::period`] | period of the wingbeat | s |
//! | R | [`Beat::wing_length`] | wing length | m |
//! | F | [`Level`] | level frame: forward, right, down at the reference attitude | - |
//! | u, v, w | `velocity` | velocity of the mass centre along F turned with the body | m/s |
//! | p, q, r | `rate` | angular velocity about F turned with the body | rad/s |
//! | (phi, theta, psi) | `tilt` | small rotation vector roll, pitch, heading | rad |
//! | A | [`LinearModel::matrix`] | rates of (u, v, w, p, q, r, phi, theta, psi) | - |
//! | M | [`monodromy::monodromy`] | derivative of the state one beat later by the state now | - |
//!
//! **Wake memory.** Most of this linearises air without memory (blade elements). In a vortex
//! lattice a perturbed flight carries a perturbed wake; [`wake`] trims there and offers both
//! choices of what to hold fixed.
//!
//! What this crate does not know: files, clocks, units other than SI.
#![warn(missing_docs)]

pub mod beat;
pub mod control;
pub mod departure;
pub mod derivatives;
pub mod design;
pub mod eigen;
pub mod episode;
mod error;
pub mod flutter;
pub mod least_power;
pub mod level;
pub mod mean;
pub mod modes;
pub mod monodromy;
mod moving;
pub mod part;
pub mod plausibility;
pub mod power;
pub mod progress;
pub mod realisation;
pub mod regulator;
mod rigid_body;
mod root;
pub mod route;
pub mod sensors;
pub mod stabiliser;
pub mod stability;
pub mod steady;
pub mod sweep;
pub mod table;
pub mod trim;
pub mod unknown;
pub mod wake;
pub mod wing_modes;

pub use beat::{Beat, State};
pub use error::AnalysisError;
pub use flutter::{Condition, FlutterSettings};
pub use level::{Level, Perturbation};
pub use modes::{Mode, ModeSet};
pub use plausibility::{Estimate, estimate};
pub use stability::{LinearModel, floquet, linear_model};
pub use steady::{TrimProblem, TrimSettings};
pub use table::table_model;
pub use trim::{Trim, trim};
pub use unknown::Unknown;
pub use wing_modes::{About, WingMode, WingModes, wing_modes};
