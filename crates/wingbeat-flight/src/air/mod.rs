//! The models of the air behind the interface ([`Air`]).
//!
//! | model | module | memory |
//! |---|---|---|
//! | vortex lattice | `lattice` | circulations and wakes |
//! | blade elements | `blade` | none, or wakes of the strips |
//! | stability derivatives | `table` | none |
//! | another program | [`external`] | its own |
//! | vacuum | here | none |
//!
//! A model of your own implements [`Air`] and flies as [`AirModel::Own`].

mod bent;
mod blade;
pub(crate) mod dynamic_pressure;
pub mod external;
mod lattice;
mod mirror;
mod on_plane;
mod shared_edge;
mod strips;
mod surfaces;
mod table;

use std::sync::Arc;

use wingbeat_dynamics::{System, Wrench};
use wingbeat_math::DVec3;

use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::setup::{AirModel, FlightSetup};

pub(crate) use self::mirror::wing_pairs;
pub use crate::interface::{Air, AirScratch, Instant};
pub use blade::BladeAir;
pub use lattice::LatticeAir;
pub use on_plane::EdgeOnPlane;
pub(crate) use on_plane::ON_PLANE;
pub use shared_edge::check_joined_tip;
pub(crate) use shared_edge::tip_gap;
pub use strips::strips;
pub(crate) use surfaces::SurfaceMap;
pub use surfaces::check_joined;

/// No air at all.
#[derive(Clone, Copy, Debug)]
struct Vacuum;

impl Air for Vacuum {
    fn loads(
        &self,
        _at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        out.fill(Wrench::default());
        Ok(())
    }

    fn nodal_forces(
        &self,
        wing: usize,
        at: &Instant<'_>,
        _scratch: &mut AirScratch,
        out: &mut Vec<DVec3>,
    ) -> Result<(), FlightError> {
        let nodes = at.shapes.get(wing).and_then(Option::as_ref);
        out.clear();
        out.resize(nodes.map_or(0, |n| n.position.len()), DVec3::ZERO);
        Ok(())
    }
}

impl AirModel {
    /// The air of a flight of `setup`, whose bodies are `system`.
    ///
    /// # Errors
    /// Settings that a model refuses, and what the animal has that it knows nothing of.
    pub fn build(setup: &FlightSetup, system: &System) -> Result<Arc<dyn Air>, FlightError> {
        Ok(match &setup.air {
            Self::None => Arc::new(Vacuum),
            Self::BladeElement(options) => Arc::new(BladeAir::new(&setup.animal, options)?),
            Self::VortexLattice(options) => Arc::new(LatticeAir::new(setup, options)?),
            Self::Derivatives(table) => Arc::new(table::TableAir::new(&setup.animal, *table)?),
            Self::External(program) => {
                Arc::new(external::Session::open(program.as_ref(), system, setup)?)
            }
            Self::Own(air) => air.clone(),
        })
    }
}
