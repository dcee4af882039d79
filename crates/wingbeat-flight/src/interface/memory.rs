//! What the air remembers from step to step.

use wingbeat_air::AirState;
use wingbeat_blade::WingMemory;

/// The memory of the air of a flight: plain data, enough to go on bit for bit.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum AirMemory {
    /// Circulations and wakes of a vortex lattice.
    Wakes(Box<AirState>),
    /// Wakes of the strips of blade elements, wing by wing.
    Strips(Vec<WingMemory>),
}

impl AirMemory {
    /// The circulations and wakes, if it is that of a lattice.
    pub fn wakes(&self) -> Option<&AirState> {
        match self {
            Self::Wakes(wakes) => Some(wakes),
            Self::Strips(_) => None,
        }
    }

    /// The same to be moved on.
    pub fn wakes_mut(&mut self) -> Option<&mut AirState> {
        match self {
            Self::Wakes(wakes) => Some(wakes),
            Self::Strips(_) => None,
        }
    }

    /// The wakes of the strips, wing by wing, if it is that of blade elements.
    pub fn strips(&self) -> Option<&[WingMemory]> {
        match self {
            Self::Wakes(_) => None,
            Self::Strips(wings) => Some(wings),
        }
    }

    /// That of strips to be changed.
    pub fn strips_mut(&mut self) -> Option<&mut [WingMemory]> {
        match self {
            Self::Wakes(_) => None,
            Self::Strips(wings) => Some(wings),
        }
    }

    /// The same at the start of a flight that goes on from it.
    pub(crate) fn restarted(self) -> Self {
        match self {
            Self::Strips(wings) => Self::Strips(wings.into_iter().map(|w| w.at(0.0)).collect()),
            wakes @ Self::Wakes(_) => wakes,
        }
    }

    /// Says at what time \[s\] it was accepted: flights in steps of another length count other times.
    pub(crate) fn set_time(&mut self, time: f64) {
        if let Self::Strips(wings) = self {
            wings.iter_mut().for_each(|w| w.set_time(time));
        }
    }
}

/// The wakes in a memory that may be missing.
pub(crate) fn wakes_of(memory: Option<&AirMemory>) -> Option<&AirState> {
    memory.and_then(AirMemory::wakes)
}
