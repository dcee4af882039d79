//! Non-linear unsteady vortex lattice with free wakes.
