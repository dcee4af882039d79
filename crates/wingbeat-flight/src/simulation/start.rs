//! The coupled right-hand side over the starting steps of a multistep method.

use wingbeat_math::ode::Replay;

use crate::carried::CarriedState;
use crate::elastic::ElasticState;
use crate::equations::{Equations, Memory, Scratch};
use crate::error::FlightError;
use crate::interface::memory::AirMemory;

/// The coupled right-hand side over the starting steps: the wake is replayed with them.
pub(super) struct StartingSteps<'a> {
    pub equations: &'a Equations,
    pub scratch: Scratch,
    pub first: usize,
    pub at_start: &'a Option<AirMemory>,
    pub air: Option<AirMemory>,
    pub wings_at_start: &'a [ElasticState],
    pub wings: Vec<ElasticState>,
    pub carried_at_start: &'a [CarriedState],
    pub carried: Vec<CarriedState>,
}

impl StartingSteps<'_> {
    pub fn time(&self, k: usize) -> f64 {
        (self.first + k) as f64 * self.equations.step
    }
}

impl Replay for StartingSteps<'_> {
    type Error = FlightError;

    fn enter(&mut self, k: usize) -> Result<(), FlightError> {
        if k == 1 {
            self.air.clone_from(self.at_start);
            self.wings.clear();
            self.wings.extend_from_slice(self.wings_at_start);
            self.carried.clear();
            self.carried.extend_from_slice(self.carried_at_start);
        }
        self.equations.advance_air(&mut self.air, &mut self.scratch)
    }

    fn rates(&mut self, k: usize, y: &[f64], f: &mut [f64]) -> Result<(), FlightError> {
        let t = self.time(k);
        let memory = Memory {
            air: self.air.as_ref(),
            wings: &self.wings,
            carried: &self.carried,
        };
        self.equations.evaluate(t, y, memory, &mut self.scratch, f)
    }

    fn leave(&mut self, _k: usize) -> Result<(), FlightError> {
        let remembered = (&mut self.wings[..], &mut self.carried[..]);
        (self.equations).accept(&mut self.air, remembered, &self.scratch)
    }
}
