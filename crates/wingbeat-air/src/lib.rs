//! Non-linear unsteady vortex lattice with free wakes.

pub mod kernel;
