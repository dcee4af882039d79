//! The wakes: their filaments and blobs, the velocity they make, and how they move, shed and are truncated.

mod account;
mod common_circulation;
mod contact;
mod convection;
mod conversion;
mod cores;
mod filaments;
mod force_free;
mod gathered;
mod joined_nodes;
mod move_step;
mod near_wake;
mod node_flow;
mod particle_flow;
mod particle_motion;
mod separation;
mod shedding;
mod sheet_move;
mod summation;
mod truncation;
mod wake_flow;

pub(crate) use convection::WakeMotion;
pub use filaments::Filaments;
pub(crate) use near_wake::{NEW_VORTEX, NearWakeRow, NearWakeShare, at_edge};
pub(crate) use summation::{NEAR, Sums, WakeVelocityCache};
