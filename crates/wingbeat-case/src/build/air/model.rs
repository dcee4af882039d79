//! `[air]`: the air's model.

use std::sync::Arc;

use wingbeat_flight::AirModel;
use wingbeat_model::Animal;

use crate::build::air::{blade, derivatives, lattice};
use crate::build::fault::Built;
use crate::build::program::program;
use crate::external::ProcessAir;
use crate::raw::{AirModel as Model, Case};

/// The air of the flight.
pub(crate) fn model(case: &Case, animal: &Animal) -> Built<AirModel> {
    Ok(match case.air.model {
        Model::None => AirModel::None,
        Model::BladeElement => {
            AirModel::BladeElement(blade::options(&case.air, case.animal.scale)?)
        }
        Model::Derivatives => AirModel::Derivatives(derivatives::table(case, animal)?),
        Model::External => {
            let external = case.air.external.as_ref();
            let chosen = "air.model = \"external\"";
            let program = program(external, "air.external", chosen, "docs/external-air.md")?;
            AirModel::External(Arc::new(ProcessAir(program)))
        }
        Model::VortexLattice => AirModel::VortexLattice(lattice::options(case, animal)?),
    })
}
