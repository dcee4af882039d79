//! From circulations to forces, in the order of the theory.

mod closed;
mod joukowski;
mod lag;
mod leading_strip;
mod nodal;
mod pressure;
mod rate;
mod resultants;
mod section_drag;
mod separation;
mod values;
mod vortex_lift;

pub(crate) use closed::outer_forces;
pub(crate) use joukowski::{Flow, Segments};
pub(crate) use pressure::{circulation_rate, forces, pressure_jump, velocity_jump};
pub(crate) use rate::{couple_of_rate, rate_weights};
pub(crate) use resultants::{check_finite, impulse, resultants};
pub(crate) use section_drag::add_section_drag;
pub(crate) use separation::leading_values;
pub use values::{AirLoads, SurfaceLoads};
