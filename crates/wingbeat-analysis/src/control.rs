//! Feedback that holds a flyer on its orbit.
//!
//! The chapter in order: a [`Departure`] is what a flight is off its [`Reference`], along a [`Route`] if there
//! is one, as [`Sensors`] see it; a [`Law`] makes [`Controls`] of it: [`ProportionalDerivative`] loops, or a
//! [`Regulator`] laid out on a [`Plant`], what is seen filtered by an [`Observer`]. A [`Steering`] puts a law
//! into the loop of a flight, [`SteeredBeats`] flies one beat by beat; a [`Design`] lays it out when a flight
//! is built.

pub use crate::departure::{CONTROLS, Controls, Departure, Limits, Reference, adjustments};
pub use crate::design::{Design, LawDesign, Target};
pub use crate::disturbance::disturbed;
pub use crate::part::{Orbit, Part};
pub use crate::regulator::observer::{Kalman, Observer, ProcessNoise, kalman};
pub use crate::regulator::plant::{Plant, STATES, states};
pub use crate::regulator::{Regulator, Timing, Weights};
pub use crate::route::{Route, Waypoint};
pub use crate::sensing::Sensing;
pub use crate::sensors::{Channels, Sensors};
pub use crate::stabiliser::{ProportionalDerivative, Stiffness};
pub use crate::steering::{Held, Law, SteeredBeats, Steering};
