//! What is known of the air before a flight.

use wingbeat_air::{CoreModel, Friction};
use wingbeat_flight::AirModel;
use wingbeat_math::DVec3;

/// Kinematic viscosity of air at 20 degrees Celsius [m2/s].
const AIR_VISCOSITY: f64 = 1.5e-5;

/// Velocity of the undisturbed air, N components [m/s].
pub(super) fn stream(air: &AirModel) -> DVec3 {
    air.stream().unwrap_or(DVec3::ZERO)
}

/// Density [kg/m3], where the air has one.
pub(super) fn density(air: &AirModel) -> Option<f64> {
    match air {
        AirModel::VortexLattice(air) => Some(air.lattice.density),
        AirModel::BladeElement(air) => Some(air.blade.density),
        AirModel::None | AirModel::Derivatives(_) | AirModel::External(_) | AirModel::Own(_) => {
            None
        }
    }
}

pub(super) fn viscosity(air: &AirModel) -> Option<f64> {
    if let AirModel::VortexLattice(air) = air {
        let drag = air.lattice.section_drag.as_ref();
        if let Some(Friction::Blasius { viscosity }) = drag.map(|d| &d.friction) {
            return Some(*viscosity);
        }
        if let CoreModel::LambOseen { viscosity, .. } | CoreModel::Algebraic { viscosity, .. } =
            air.lattice.wake_core
        {
            return Some(viscosity);
        }
    }
    let is_air = |rho: &f64| (0.3..3.0).contains(rho);
    density(air).filter(is_air).map(|_| AIR_VISCOSITY)
}
