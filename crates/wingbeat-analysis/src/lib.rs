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
pub mod control;
pub mod cost;
pub mod ensemble;
pub mod episode;
mod error;
mod plausibility;
mod power;
pub mod progress;
mod stability;
mod sweep;
mod trim;
mod turned;
mod vibration;
pub mod wake;

pub use beat::glide::{glides, period_of_glide};
pub use beat::level::{Level, Perturbation, STATE, STATE_UNITS};
pub use beat::{Beat, Integration, State};
pub use error::AnalysisError;
pub use plausibility::{
    Estimate, KeptWake, WingEstimate, doubtful_reynolds_numbers, estimate, kept_wake,
    stroke_amplitude, way_in_a_step,
};
pub use power::{Power, PowerQuantity, power, power_of_trim, power_with_wake};
pub use stability::derivatives::{Control, ControlDerivative, control_derivatives};
pub use stability::eigen::{Eigenpair, eigen};
pub use stability::jacobian::jacobian;
pub use stability::modes::{Mode, ModeSet, Plane, Scales};
pub use stability::steady::SteadyFlight;
pub use stability::table::{rigid_animal, table_model};
pub use stability::{
    LOADS, LinearModel, floquet, floquet_of_trim, input_matrix, linear_model, orbit_monodromy,
    trimmed_controls,
};
pub use sweep::least_power::trim_within;
pub use sweep::{Sweep, Swept, sweep, sweep_watched};
pub use trim::glide::Glide;
pub use trim::lost::{Lost, Way};
pub use trim::preconditions::TRIM_STEPS;
pub use trim::problem::{TrimProblem, TrimSettings, turned_inside_out};
pub use trim::request::TrimRequest;
pub use trim::residuals::Residuals;
pub use trim::solution::TrimSolution;
pub use trim::tail::tail_wings;
pub use trim::unknown::{Bound, SPEED_OF_SOUND, UNKNOWNS, Unknown, UnknownKind, shifts_body};
pub use trim::{Trim, trim, trim_from};
pub use turned::{turned_over, turned_over_with_wake};
pub use vibration::flutter::{self, Condition, FlutterSettings};
pub use vibration::wing_modes::{About, Alike, WingMode, WingModes, wing_modes};
