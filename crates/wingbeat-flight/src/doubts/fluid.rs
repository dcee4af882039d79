//! Whether density and viscosity are those of one fluid.

use crate::setup::FlightSetup;
use wingbeat_air::{AIR_VISCOSITY, Friction};

/// Densities from here on are those of liquids; the densest gases have a tenth of it [kg/m3].
const LIQUID: f64 = 100.0;

impl FlightSetup {
    /// Says that a fluid with the density of a liquid has the kinematic viscosity of air, which it has where none is given.
    pub fn liquid_with_viscosity_of_air(&self) -> Option<String> {
        let air = &self.air.lattice()?.lattice;
        let friction = air.section_drag.map(|d| d.friction);
        let of_friction = match friction {
            Some(Friction::Blasius { viscosity }) => Some(viscosity),
            _ => None,
        };
        let of_air = |viscosity: f64| viscosity == AIR_VISCOSITY;
        let [drags, spreads] =
            [of_friction, air.wake_core.viscosity()].map(|v| v.is_some_and(of_air));
        if self.animal.wings.is_empty() {
            return None; // neither friction of sections nor wakes
        }
        let what = match (drags, spreads && air.shedding.any()) {
            (true, true) => "friction and vortex cores of the wake",
            (true, false) => "friction",
            (false, true) => "the vortex cores of the wake",
            (false, false) => return None,
        };
        (air.density >= LIQUID).then(|| {
            format!(
                "air.density_kg_m3 = {} is that of a liquid, and {what} have the kinematic viscosity of air, {AIR_VISCOSITY:e} m2/s, \
                 15 times that of water: give air.wake_core.algebraic.viscosity_m2_s (1e-6 for water)",
                air.density
            )
        })
    }
}
