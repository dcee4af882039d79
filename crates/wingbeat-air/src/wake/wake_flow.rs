//! Velocity at all that is moved of the wakes, nodes and particles.

use crate::lattice::Lattice;
use crate::state::AirState;
use crate::wake::filaments::Filaments;
use crate::wake::node_flow::NodeFlow;
use crate::wake::particle_flow::ParticleFlow;
use crate::wake::summation::Sums;

/// Velocities of the accepted step.
#[derive(Default)]
pub(crate) struct WakeFlow {
    pub nodes: NodeFlow,
    pub particles: ParticleFlow,
    /// Numbers of the first node and the first particle of each sheet among all that are moved.
    pub first: Vec<[usize; 2]>,
}

impl WakeFlow {
    /// Takes them from filaments that have their circulations.
    pub(crate) fn take(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        filaments: &Filaments,
        sums: &mut Sums,
    ) {
        sums.load_for_wakes(lattice.settings(), filaments);
        self.nodes.take(lattice, state, filaments, sums);
        self.particles.take(lattice, state, sums);
        self.first.clear();
        let mut next = [0; 2];
        for (k, sheet) in state.sheets.iter().enumerate() {
            self.first.push(next);
            if lattice.reflected_sheet(k).is_none() {
                next[0] += (sheet.rows() + 1) * (sheet.columns + 1);
                next[1] += sheet.particles.len();
            }
        }
    }
}
