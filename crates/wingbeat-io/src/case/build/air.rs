//! `[air]`: the air's model, and the settings of the vortex lattice.

use wingbeat_air::{AirSettings, CirculationRate, CoreModel, SheddingKinds};
use wingbeat_flight::{AirModel, AirOptions};
use wingbeat_model::Animal;

use super::{Built, at_least, blade, not_negative, positive, vector};
use crate::case::raw::{AirCase, AirModel as Model, Case, CirculationRateCase, CoreCase, EdgeCase};

/// Default cut-off over the mean panel length, the published benchmark's.
const CUT_OFF: f64 = 0.01;

/// Vortex cores where the case leaves them open.
pub(super) fn fill_defaults(case: &mut Case, animal: &Animal) {
    if case.air.bound_core.is_none() {
        let length_m = CUT_OFF * mean_panel_length(animal);
        case.air.bound_core = Some(CoreCase::CutOff { length_m });
    }
    if case.air.wake_core.is_none() {
        case.air.wake_core.clone_from(&case.air.bound_core);
    }
}

/// Square root of the mean area of a wing panel [m]; 1 without wings.
fn mean_panel_length(animal: &Animal) -> f64 {
    let reports = animal.wing_reports();
    let area: f64 = reports.iter().map(|r| r.area).sum();
    let panels: usize = reports.iter().map(|r| r.panels).sum();
    if panels == 0 {
        1.0
    } else {
        (area / panels as f64).sqrt()
    }
}

/// The air of the flight.
pub(super) fn options(case: &AirCase) -> Built<AirModel> {
    match case.model {
        Model::None => Ok(AirModel::None),
        Model::BladeElement => Ok(AirModel::BladeElement(blade::options(case)?)),
        Model::VortexLattice => Ok(AirModel::VortexLattice(lattice(case)?)),
    }
}

fn lattice(case: &AirCase) -> Built<AirOptions> {
    let limit = |key: &str, value: Option<f64>| value.map(|v| positive(key, v)).transpose();
    let sheds = |edge: EdgeCase| case.shed.contains(&edge);
    let lattice = AirSettings {
        density: positive("air.density_kg_m3", case.density_kg_m3)?,
        free_stream: vector(case.stream_m_s),
        bound_core: core("air.bound_core", case.bound_core.as_ref())?,
        wake_core: core("air.wake_core", case.wake_core.as_ref())?,
        shedding: SheddingKinds {
            trailing: sheds(EdgeCase::Trailing),
            tip: sheds(EdgeCase::Tip),
            leading: sheds(EdgeCase::Leading),
            root: sheds(EdgeCase::Root),
        },
        rate: match case.circulation_rate {
            CirculationRateCase::Backward => CirculationRate::Backward,
            CirculationRateCase::BackwardSecond => CirculationRate::BackwardSecond,
            CirculationRateCase::Omitted => CirculationRate::Omitted,
        },
        max_rows: match case.max_wake_rows {
            Some(rows) => Some(at_least("air.max_wake_rows", rows, 1)?),
            None => None,
        },
        max_displacement: limit("air.max_displacement_m", case.max_displacement_m)?,
        clearance: not_negative("air.clearance_m", case.clearance_m)?,
    };
    Ok(AirOptions {
        lattice,
        body_surfaces: case.body,
    })
}

fn core(path: &str, case: Option<&CoreCase>) -> Built<CoreModel> {
    let number = |key: &str, value: f64| not_negative(&format!("{path}.{key}"), value);
    Ok(match case.expect("defaults were filled in") {
        CoreCase::CutOff { length_m } => CoreModel::CutOff {
            delta: number("cut_off.length_m", *length_m)?,
        },
        CoreCase::Vatistas { radius_m } => CoreModel::Vatistas {
            radius: number("vatistas.radius_m", *radius_m)?,
        },
        CoreCase::Scully { radius_m } => CoreModel::Scully {
            radius: number("scully.radius_m", *radius_m)?,
        },
        CoreCase::LambOseen {
            radius_m,
            viscosity_m2_s,
        } => CoreModel::LambOseen {
            radius: number("lamb_oseen.radius_m", *radius_m)?,
            viscosity: number("lamb_oseen.viscosity_m2_s", *viscosity_m2_s)?,
        },
    })
}
