//! Scratch memory of the air.

use crate::geometry::{NodeMotion, Wash};
use crate::lattice::Lattice;
use crate::loads::Segments;
use crate::solve::BoundaryCondition;
use crate::wake::{Filaments, Sums, WakeMotion};
use wingbeat_math::DenseLu;
use wingbeat_vortex::Tally;

/// Scratch memory of the air, good for any lattice: no result depends on what it held before, but for the velocity of
/// the free wakes at places that have moved by less than 1e-5 of a panel since it was last summed there, which is
/// taken again. Finite differences with steps as small as that lack its gradient; a workspace each has it. What is
/// known of the shapes of a lattice is computed when it is first used.
#[derive(Default)]
pub struct AirWorkspace {
    pub(crate) filaments: Filaments,
    /// Nodes of the rings.
    pub(crate) rings: NodeMotion,
    /// The surfaces where the rings meet them.
    pub(crate) wash: Wash,
    pub(crate) sums: Sums,
    pub(crate) boundary: BoundaryCondition,
    pub(crate) segments: Segments,
    pub(crate) wakes: WakeMotion,
    pub(crate) response: ResponseRoom,
}

/// Memory of how a surface answers to normal velocities.
#[derive(Default)]
pub(crate) struct ResponseRoom {
    /// Influence of the surface on itself, row by row, and its inverse, by columns \[m\].
    pub matrix: Vec<f64>,
    pub inverse: Vec<f64>,
    pub lu: DenseLu,
}

impl AirWorkspace {
    /// Sums that were checked so far in all calls.
    pub fn tally(&self) -> Tally {
        self.sums.tally()
    }

    /// The filaments of the last call.
    pub fn filaments(&self) -> &Filaments {
        &self.filaments
    }
}

impl Lattice {
    /// Scratch memory for this lattice.
    pub fn workspace(&self) -> AirWorkspace {
        AirWorkspace::default()
    }
}
