//! Wings, motions and the stepping that the cases share.

pub mod foil;
pub(crate) mod hinged;
pub(crate) mod insect;
pub mod outline;
pub(crate) mod ramp;
pub(crate) mod rig;
pub mod series;
mod stepping;

pub use stepping::{Run, fly, order, rectangle, sphere, total_force, translating};

use wingbeat_air::{AirError, AirLoads, Lattice, NodeMotion};
use wingbeat_math::DVec3;

/// Force on all surfaces [N], step by step.
///
/// # Errors
/// As [`fly`].
pub fn forces(
    lattice: &Lattice,
    motion: impl Fn(f64) -> NodeMotion,
    dt: f64,
    last: usize,
) -> Result<Vec<DVec3>, AirError> {
    let mut force = Vec::with_capacity(last + 1);
    fly(lattice, motion, dt, last, |_, _, loads, _| {
        force.push(total_force(loads))
    })?;
    Ok(force)
}

/// Moment on all surfaces about the origin [N m].
pub fn total_moment(loads: &AirLoads) -> DVec3 {
    loads.surfaces.iter().map(|s| s.moment).sum()
}

/// Limit of a sequence that converges with the given order under halving, from its last two terms.
pub fn extrapolated(coarse: f64, fine: f64, order: f64) -> f64 {
    fine + (fine - coarse) / (order.exp2() - 1.0)
}
