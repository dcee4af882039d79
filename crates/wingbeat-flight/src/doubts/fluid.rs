//! Whether density and viscosity are those of one fluid.

use crate::setup::FlightSetup;
use wingbeat_air::{AIR_VISCOSITY, Friction, LIQUID_DENSITY, viscosity_of_density};

/// Part of the kinematic viscosity of a gas by which that of air at the ground is off, from which on it is doubted \[1\].
const OFF: f64 = 0.2;

impl FlightSetup {
    /// Says that a liquid, or a gas that is thinner or denser than air at the ground, has the kinematic viscosity of that
    /// air.
    pub fn foreign_viscosity_of_air(&self) -> Option<String> {
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
        let is_liquid = air.density >= LIQUID_DENSITY;
        let of_gas = viscosity_of_density(air.density);
        let density = air.density;
        let (kind, consequence) = match is_liquid {
            true => (
                "that of a liquid",
                "15 times that of water: give air.viscosity_m2_s (1e-6 for water)".to_owned(),
            ),
            false => (
                "not that of air at the ground",
                format!(
                    "where a gas so thin or dense has about {of_gas:.1e}: remove the viscosity from the case (its default goes with the density), or give air.viscosity_m2_s"
                ),
            ),
        };
        let is_off = (AIR_VISCOSITY / of_gas - 1.0).abs() > OFF;
        (is_liquid || is_off).then(|| {
            format!(
                "air.density_kg_m3 = {density} is {kind}, and {what} have the kinematic viscosity of air, {AIR_VISCOSITY:e} m2/s, {consequence}"
            )
        })
    }
}
