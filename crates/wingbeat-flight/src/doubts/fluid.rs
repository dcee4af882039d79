//! Whether density and viscosity are those of one fluid.

use crate::setup::FlightSetup;
use wingbeat_air::{AIR_VISCOSITY, Friction, LIQUID_DENSITY, viscosity_of_density};

/// Part of the kinematic viscosity of a gas by which that of air at the ground is off, from which on it is doubted \[1\].
const OFF: f64 = 0.2;

/// Kinematic viscosities that are taken for that of air where they are a liquid's \[m2/s\]: of air from 0 to 35 degrees
/// Celsius, and beyond by a little.
const OF_GASES: std::ops::RangeInclusive<f64> = 1.2e-5..=1.8e-5;

/// Kinematic viscosity of water at 20 degrees Celsius \[m2/s\].
const WATER_VISCOSITY: f64 = 1e-6;

impl FlightSetup {
    /// Says that a liquid, or a gas that is thinner or denser than air at the ground, has the kinematic viscosity of that
    /// air, unless it was given as that of the fluid.
    pub fn foreign_viscosity_of_air(&self) -> Option<String> {
        let options = self.air.lattice()?;
        if options.has_own_viscosity {
            return None;
        }
        let air = &options.lattice;
        let friction = air.section_drag.map(|d| d.friction);
        let of_friction = match friction {
            Some(Friction::Blasius { viscosity }) => Some(viscosity),
            _ => None,
        };
        let is_liquid = air.density >= LIQUID_DENSITY;
        let of_air = |viscosity: f64| match is_liquid {
            true => OF_GASES.contains(&viscosity),
            false => viscosity == AIR_VISCOSITY,
        };
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
        let of_gas = viscosity_of_density(air.density);
        let density = air.density;
        let viscosity = match drags {
            true => of_friction.unwrap_or(AIR_VISCOSITY),
            false => air.wake_core.viscosity().unwrap_or(AIR_VISCOSITY),
        };
        let (kind, consequence) = match is_liquid {
            true => (
                "that of a liquid",
                format!(
                    "{:.0} times that of water: unless the liquid has it, give air.viscosity_m2_s (1e-6 for water), or where the case has it elsewhere change air.wake_core.{}.viscosity_m2_s and air.section_drag.viscosity_m2_s",
                    viscosity / WATER_VISCOSITY,
                    air.wake_core.name()
                ),
            ),
            false => (
                "not that of air at the ground",
                format!(
                    "where a gas so thin or dense has about {of_gas:.1e}: remove the viscosity from the case (its default goes with the density), or give air.viscosity_m2_s in place of others in the case"
                ),
            ),
        };
        let is_off = (AIR_VISCOSITY / of_gas - 1.0).abs() > OFF;
        (is_liquid || is_off).then(|| {
            format!(
                "air.density_kg_m3 = {density} is {kind}, and {what} have the kinematic viscosity of air, {viscosity:e} m2/s, {consequence}"
            )
        })
    }
}
