//! What is integrated.

use wingbeat_math::ode::{Multistep, StepReport};

use crate::carried::CarriedState;
use crate::elastic::ElasticState;
use crate::equations::Memory;
use crate::interface::memory::AirMemory;
use crate::simulation::control::ControlState;
use crate::simulation::recorder::Ledger;

/// Everything that is integrated: plain data, enough to go on bit for bit.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct FlightState {
    /// Accepted steps.
    pub step: usize,
    /// Stage of the flight: held or released.
    pub stage: usize,
    /// Step at which the stage, and with it the past, was started.
    pub started_at: usize,
    /// States and rates of bodies and quadratures. During the first three steps of a stage it
    /// holds that whole start; after that the newest four steps.
    pub past: Multistep,
    /// What the starter did.
    pub start_report: StepReport,
    /// The air after the newest step, its wake not yet moved on; none in vacuum.
    pub air: Option<AirMemory>,
    /// The elastic wings after the newest step; empty where there are none.
    #[serde(default)]
    pub wings: Vec<ElasticState>,
    /// The wings that carry air along (on free joints, or of a light flyer); empty where there are none.
    pub carried: Vec<CarriedState>,
    /// What balances are counted from.
    pub ledger: Ledger,
    /// What feedback remembers; none without.
    pub control: Option<ControlState>,
}

impl FlightState {
    /// What is remembered beside the state vector.
    pub(crate) fn memory(&self) -> Memory<'_> {
        Memory {
            air: self.air.as_ref(),
            wings: &self.wings,
            carried: &self.carried,
        }
    }
}

/// Where a flight goes on from another one: all that is remembered beside the motion of rigid bodies, but for
/// wakes in space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Past {
    /// Elastic wings, in their order; empty where there are none.
    pub wings: Vec<ElasticState>,
    /// The air, where strips remember their wakes.
    pub air: Option<AirMemory>,
}

impl Past {
    /// That of a flight in this state.
    pub fn of(state: &FlightState) -> Self {
        Self {
            wings: state.wings.clone(),
            air: state.air.clone(),
        }
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.wings.is_empty() && self.air.is_none()
    }
}
