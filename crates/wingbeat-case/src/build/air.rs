//! `[air]`: the air's model.

use wingbeat_flight::AirModel;
use wingbeat_model::Animal;

use super::fault::Built;
use super::{blade, derivatives, lattice};
use crate::raw::{AirModel as Model, Case};

/// The air of the flight.
pub(super) fn model(case: &Case, animal: &Animal) -> Built<AirModel> {
    Ok(match case.air.model {
        Model::None => AirModel::None,
        Model::BladeElement => AirModel::BladeElement(blade::options(&case.air)?),
        Model::Derivatives => AirModel::Derivatives(derivatives::table(case, animal)?),
        Model::External => AirModel::External(derivatives::external(&case.air)?),
        Model::VortexLattice => AirModel::VortexLattice(lattice::options(case, animal)?),
    })
}
