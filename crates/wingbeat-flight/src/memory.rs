//! What the air remembers from step to step.

use wingbeat_air::AirState;

/// The memory of the air of a flight: plain data, enough to go on bit for bit.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum AirMemory {
    /// Circulations and wakes of a vortex lattice.
    Wakes(Box<AirState>),
}

impl AirMemory {
    /// The circulations and wakes, if it is that of a lattice.
    pub fn wakes(&self) -> Option<&AirState> {
        match self {
            Self::Wakes(wakes) => Some(wakes),
        }
    }

    /// The same to be moved on.
    pub(crate) fn wakes_mut(&mut self) -> Option<&mut AirState> {
        match self {
            Self::Wakes(wakes) => Some(wakes),
        }
    }
}

/// The wakes in a memory that may be missing.
pub(crate) fn wakes_of(memory: Option<&AirMemory>) -> Option<&AirState> {
    memory.and_then(AirMemory::wakes)
}
