//! Stability derivatives on the root body.

use wingbeat_blade::DerivativeTable;
use wingbeat_dynamics::{AddedMass, Wrench};
use wingbeat_model::Animal;

use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::interface::{Air, AirScratch, Instant};

/// A table of derivatives as the air of the whole animal.
#[derive(Clone, Copy, Debug)]
pub struct TableAir {
    table: DerivativeTable,
    added: Option<AddedMass>,
}

impl TableAir {
    /// # Errors
    /// Wings that are deformed: the table does not know of it.
    pub fn new(animal: &Animal, table: DerivativeTable) -> Result<Self, FlightError> {
        match animal.wings.iter().find(|w| w.deformation.is_some()) {
            None => Ok(Self {
                table,
                added: table.added_mass_of_body().map(|a| AddedMass::new(0, a)),
            }),
            Some(wing) => Err(FlightError::setup(
                "air.model",
                "derivatives",
                format!(
                    "wing `{}` is deformed, of which a table of derivatives knows nothing: leave the deformation out, or take blade elements or the vortex lattice",
                    wing.name
                ),
            )),
        }
    }
}

impl Air for TableAir {
    fn loads(
        &self,
        at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        out.fill(Wrench::default());
        let root = &at.motions[0];
        out[0] = self.table.load(root).turned(root.r);
        Ok(())
    }

    fn added_mass(&self, _t: f64, _scratch: &mut AirScratch, out: &mut Vec<AddedMass>) {
        out.extend(self.added);
    }
}
