//! Trim and Floquet's modes in air that remembers: the vortex lattice.
//!
//! A periodic orbit of body **and** wake has thousands of unknowns. What is done instead: the body
//! is held for some wingbeats with constant velocity and attitude while the wake grows, then
//! released; the free wingbeat that follows is the map of the state. Trim asks that this beat
//! changes nothing but the place (the residuals of [`TrimProblem`](crate::TrimProblem)). For stability the map is
//! differentiated, and two things can be held fixed:
//!
//! - [`WakeMemory::Given`]: the wake of the trimmed hold; the disturbance is put on the body at
//!   its release (its velocities and attitude jump, the wake does not).
//! - [`WakeMemory::Carried`]: the hold is flown in the disturbed motion already, so the wake is that
//!   of a steadily disturbed flight; only angular velocity, which a hold cannot have, jumps.
//!
//! Neither is the full monodromy of body and wake; the two bracket what the memory does within
//! a wingbeat.
//!
//! Wings that loads bend remember, too, and so do strips of blade elements that leave wakes. In air without
//! wakes in space these have few enough unknowns, damped ones, and a trim finds the whole periodic orbit, wings
//! and strips included ([`WakeTrim::past`]); its Floquet modes carry the leading modes of the wings and the
//! states of the strips' wakes along ([`elastic_floquet`]).

mod differences;
mod fewer;
mod free_beat;
mod glide;
mod modes;
mod orbit;
mod steady;
mod sway;
mod tow;
mod trim;
mod wings;

pub use fewer::change_by_last_mode;
pub use modes::{WakeMemory, wake_floquet, wake_modes, wake_monodromy};
pub use orbit::check_alike;
pub use steady::{steady_controls, steady_flight, steady_inputs, steady_model};
pub use tow::Tow;
pub use trim::{WakeSettings, WakeTrim, check_trim_with_wake, trim_with_wake};
pub use wings::{ElasticMonodromy, elastic_floquet, elastic_modes, elastic_monodromy};
