//! What is known of the air before a flight.

use wingbeat_air::{AIR_VISCOSITY, Friction};
use wingbeat_flight::AirModel;
use wingbeat_math::DVec3;

/// Velocity of the undisturbed air, N components [m/s].
pub(super) fn stream(air: &AirModel) -> DVec3 {
    air.stream().unwrap_or(DVec3::ZERO)
}

/// Kinematic viscosity [m2/s]: that of friction, of wakes that spread, or of air where the density is that of air.
pub(super) fn viscosity(air: &AirModel) -> Option<f64> {
    if let AirModel::VortexLattice(air) = air {
        let drag = air.lattice.section_drag.as_ref();
        if let Some(Friction::Blasius { viscosity }) = drag.map(|d| &d.friction) {
            return Some(*viscosity);
        }
        if let Some(viscosity) = air.lattice.wake_core.viscosity() {
            return Some(viscosity);
        }
    }
    let is_air = |rho: &f64| (0.3..3.0).contains(rho);
    air.density().filter(is_air).map(|_| AIR_VISCOSITY)
}
