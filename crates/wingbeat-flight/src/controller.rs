//! A controller in the loop of the flight: what it sees, what it answers, and where it steers to.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::DVec3;
use wingbeat_model::motion::Adjustment;

/// What a controller sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Number of this look, from 0.
    pub look: usize,
    /// Time since the release [s].
    pub time: f64,
    /// Motion of the root body.
    pub root: BodyMotion,
    /// Mass centre of the whole, N components [m].
    pub centre: DVec3,
    /// Velocity of the mass centre, N components [m/s].
    pub velocity: DVec3,
}

/// Where the mass centre of a flyer is to be, and where the flyer is to head.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aim {
    /// Place of the mass centre, N components [m].
    pub position: DVec3,
    /// Its velocity, N components [m/s].
    pub velocity: DVec3,
    /// Heading: the angle about n3 from n1 \[rad\].
    pub heading: f64,
    /// Its rate [rad/s].
    pub heading_rate: f64,
}

/// A controller: from what is sensed to one adjustment per wing.
pub trait Controller: Send {
    /// Adjustments of the wings, in the animal's order, on top of the motion of the case. Changes of
    /// frequency are not possible in flight.
    ///
    /// # Errors
    /// Why it has none; the flight ends with it.
    fn command(&mut self, sensed: &Sensed) -> Result<Vec<Adjustment>, String>;

    /// Where it steers to at `time` [s] since the release; none before its first look, or if it does not know.
    fn aim(&self, _time: f64) -> Option<Aim> {
        None
    }

    /// Whether its newest command stands at a limit, beyond which it would go.
    fn is_limited(&self) -> bool {
        false
    }

    /// Everything it remembers, for a flight that is resumed.
    fn memory(&self) -> Vec<f64> {
        vec![]
    }

    /// Goes on from what it remembered.
    fn restore(&mut self, _memory: &[f64]) {}
}
