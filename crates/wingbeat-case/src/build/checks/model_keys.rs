//! Keys that the chosen model of the air does not take, where no single key tells.

use crate::build::air::viscosity;
use crate::build::fault::{Built, idle};
use crate::build::resolve;
use crate::error::Fault;
use crate::raw::{AirCase, AirModel, Case, CoreCase, DerivativesCase};
use crate::text::source::CaseSource;

/// Where the model is chosen.
const MODEL: &str = "air.model";

/// Checks what the case says of the air and of the shape of its wings. Keys of the file stand by where the command
/// line chose another model.
pub(crate) fn check(case: &Case, source: &CaseSource) -> Built<()> {
    match case.air.model {
        AirModel::Derivatives => density(&case.air, source),
        AirModel::BladeElement => camber(case, source),
        AirModel::VortexLattice => core_of_no_wake(&case.air, source),
        AirModel::External | AirModel::None => Ok(()),
    }
}

fn stands_by(source: &CaseSource, key: &str) -> bool {
    source.chooses(MODEL) && !source.touches(key)
}

/// Derivatives with dimensions hold the density; the default may stand, as resolved cases have it.
fn density(air: &AirCase, source: &CaseSource) -> Built<()> {
    const KEY: &str = "air.density_kg_m3";
    let has_dimensions = |d: &DerivativesCase| d.dimensionless.is_none();
    let changed = air.density_kg_m3 != AirCase::default().density_kg_m3 && source.gives(KEY);
    match air.derivatives.as_ref().is_some_and(has_dimensions) && changed {
        true if !stands_by(source, KEY) => Err(idle(
            KEY,
            "beside air.derivatives with dimensions, which hold the density",
            "with air.derivatives.dimensionless, which asks for it",
        )),
        _ => Ok(()),
    }
}

/// The size of cores that no wake has. Their viscosity is that of the friction, and their kind decides on that of bound
/// cores: wherever one of these is said, the size has to stand beside it.
fn core_of_no_wake(air: &AirCase, source: &CaseSource) -> Built<()> {
    const KEY: &str = "air.wake_core";
    let CoreCase::Algebraic(own) = &air.wake_core else {
        return Ok(());
    };
    let of_air = own
        .viscosity_m2_s
        .is_none_or(|own| own == viscosity::of_fluid(air));
    let mut plain = AirCase {
        scheme: air.scheme,
        density_kg_m3: air.density_kg_m3,
        viscosity_m2_s: air.viscosity_m2_s,
        ..AirCase::default()
    };
    resolve::air(&mut plain);
    // Where the command line chose the edges, what the file says of wakes stands by.
    let stands_by = source.chooses("air.shed") && !source.touches(KEY);
    let is_idle = air.shed.is_empty() && of_air && air.wake_core != plain.wake_core;
    match is_idle && source.gives(KEY) && !stands_by {
        true => Err(idle(
            KEY,
            "with air.shed = []: there are no wakes, and its viscosity is that of air",
            "with edges in air.shed, or with a viscosity_m2_s of its own",
        )),
        false => Ok(()),
    }
}

/// Blade elements take twist and bending.
fn camber(case: &Case, source: &CaseSource) -> Built<()> {
    for (name, wing) in &case.wing {
        let Some(deformation) = &wing.deformation else {
            continue;
        };
        let bends = !deformation.twist.is_empty() || !deformation.bending.is_empty();
        let key = format!("wing.{name}.deformation.camber");
        if !deformation.camber.is_empty() && !bends && !stands_by(source, &key) {
            return Err(Fault::new(
                key,
                "blade elements do not take the camber of wings, and nothing else deforms this one",
                "camber with air.model = \"vortex_lattice\"; deformation.twist and bending with blade elements",
                "remove it, put camber into the coefficients (air.blade.own), or fly in the vortex lattice",
            ));
        }
    }
    Ok(())
}
