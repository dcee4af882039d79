//! Questions of flight dynamics, asked of the full flapping model.
//!
//! The chapter in order: [`Beat`] is one wingbeat of free flight as a map of the state; [`trim()`] finds steady
//! flight as a periodic orbit of that map (Newton's method, shooting over one beat), [`sweep()`] over a range
//! of speeds; [`Beat::mean_load`] averages loads over a beat of steadily moving body; [`linear_model`] linearises: the
//! cycle-averaged rigid-body model with its derivatives; [`floquet`] has Floquet's multipliers of the periodic
//! orbit from the monodromy matrix ([`orbit_monodromy`]); [`ModeSet`] names what comes out;
//! [`control_derivatives`] are the controls; [`power()`] is what it takes; [`control`] holds a flyer on its
//! orbit by feedback; an [`episode`] is steered from outside, for who learns; [`wing_modes()`] are the
//! vibrations of elastic wings, [`flutter`] asks when they grow; [`estimate`] says before a flight what it will
//! be like, [`cost`] how long it takes; an [`ensemble`] is the same flight many times over.
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
//! | M | [`orbit_monodromy`] | derivative of the state one beat later by the state now | - |
//!
//! **Wake memory.** Most of this linearises air without memory (blade elements). In a vortex
//! lattice a perturbed flight carries a perturbed wake; [`wake`] trims there and offers both
//! choices of what to hold fixed.
//!
//! What this crate does not know: files, clocks, units other than SI.
#![warn(missing_docs)]

mod beat;
mod closed_loop;
mod continuation;
pub mod control;
pub mod cost;
mod departure;
mod derivatives;
mod design;
mod disturbance;
mod eigen;
pub mod ensemble;
pub mod episode;
mod error;
pub mod flutter;
mod jacobian;
mod least_power;
mod level;
mod lost;
mod mean;
mod modes;
mod moving;
mod part;
mod plausibility;
mod power;
mod problem;
pub mod progress;
mod realisation;
mod regulator;
mod request;
mod residuals;
mod rigid_body;
mod root;
mod route;
mod sensing;
mod sensors;
mod solution;
mod stabiliser;
mod stability;
mod steady;
mod steering;
mod sweep;
mod table;
mod trim;
mod turned;
mod unknown;
pub mod wake;
mod wing_modes;

pub use beat::{Beat, Integration, State};
pub use derivatives::{Control, ControlDerivative, control_derivatives};
pub use eigen::{Eigenpair, eigen};
pub use error::AnalysisError;
pub use flutter::{Condition, FlutterSettings};
pub use jacobian::jacobian;
pub use least_power::trim_within;
pub use level::{Level, Perturbation, STATE};
pub use lost::{Lost, Way};
pub use modes::{Mode, ModeSet, Plane, Scales};
pub use plausibility::{
    Estimate, KeptWake, WingEstimate, doubtful_reynolds_numbers, estimate, kept_wake,
    stroke_amplitude, way_in_a_step,
};
pub use power::{Power, PowerQuantity, power, power_of_trim, power_with_wake};
pub use problem::{TrimProblem, TrimSettings, turned_inside_out};
pub use request::TrimRequest;
pub use residuals::Residuals;
pub use solution::TrimSolution;
pub use stability::{
    LOADS, LinearModel, floquet, floquet_of_trim, input_matrix, linear_model, orbit_monodromy,
    trimmed_controls,
};
pub use steady::{SPEED_OF_SOUND, TRIM_STEPS};
pub use sweep::{Sweep, Swept, sweep};
pub use table::{rigid_animal, table_model};
pub use trim::{Trim, trim, trim_from};
pub use turned::{turned_over, turned_over_with_wake};
pub use unknown::{Bound, UNKNOWNS, Unknown, UnknownKind};
pub use wing_modes::{About, Alike, WingMode, WingModes, wing_modes};
