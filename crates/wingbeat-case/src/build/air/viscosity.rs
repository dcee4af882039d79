//! `air.viscosity_m2_s`: the viscosity of the fluid, which older cases give by its cores.

use wingbeat_air::viscosity_of_density;

use crate::build::fault::{Built, idle};
use crate::error::Fault;
use crate::raw::{AirCase, CoreCase, FrictionCase};

const KEY: &str = "air.viscosity_m2_s";

/// Kinematic viscosity of the fluid [m2/s], as given or of a gas of its density.
pub(crate) fn of_fluid(air: &AirCase) -> f64 {
    let of_density = || viscosity_of_density(air.density_kg_m3);
    air.viscosity_m2_s.unwrap_or_else(of_density)
}

/// Refuses a viscosity of the fluid beside one of its cores or its friction, and one that nothing in the lattice takes.
pub(crate) fn given_once(air: &AirCase) -> Built<()> {
    let Some(given) = air.viscosity_m2_s else {
        return Ok(());
    };
    let spreads = match &air.wake_core {
        CoreCase::LambOseen(core) => Some(("lamb_oseen", core)),
        CoreCase::Algebraic(core) => Some(("algebraic", core)),
        _ => None,
    };
    let of_core = spreads.and_then(|(name, core)| {
        let other = core.viscosity_m2_s?;
        Some((format!("air.wake_core.{name}.viscosity_m2_s"), other))
    });
    let drag = air.section_drag.as_ref();
    let of_friction = drag.and_then(|d| d.viscosity_m2_s);
    let of_friction = of_friction.map(|v| ("air.section_drag.viscosity_m2_s".to_owned(), v));
    if let Some((other, value)) = of_core.or(of_friction) {
        return Err(Fault::new(
            KEY,
            format!("{given} stands beside {other} = {value}: the viscosity is given twice"),
            "one of them",
            format!(
                "remove {other}; where wakes are to spread faster than the fluid makes them, remove {KEY} and give the fluid's as air.section_drag.viscosity_m2_s"
            ),
        ));
    }
    let has_no_friction = drag.is_some_and(|d| d.friction == FrictionCase::None);
    match spreads.is_none() && has_no_friction {
        true => Err(idle(
            KEY,
            "with cores that do not spread and air.section_drag.friction = none",
            "with friction of the sections, or with cores that spread (algebraic, lamb_oseen)",
        )),
        false => Ok(()),
    }
}
