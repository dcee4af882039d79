//! Feedback that holds a flyer on its orbit.
//!
//! The chapter in order: a [`Departure`] is what a flight is off its [`Reference`], along a [`Route`] if there
//! is one, as [`Sensors`] see it; a [`Law`] makes [`Controls`] of it: [`ProportionalDerivative`] loops, or a
//! [`Regulator`] laid out on a [`Plant`], what is seen filtered by an [`Observer`]. A [`Steering`] puts a law
//! into the loop of a flight, [`SteeredBeats`] flies one beat by beat; a [`Design`] lays it out when a flight
//! is built.

pub(crate) mod closed_loop;
pub(crate) mod departure;
pub(crate) mod design;
pub(crate) mod part;
pub(crate) mod regulator;
pub(crate) mod route;
pub(crate) mod sensing;
pub(crate) mod sensors;
pub(crate) mod stabiliser;
pub(crate) mod steering;

pub use departure::{CONTROLS, Controls, Departure, Limits, Reference, adjustments, sides};
pub use design::{Design, LawDesign, Target};
pub use part::{Orbit, Part};
pub use regulator::observer::{Kalman, Observer, ProcessNoise, kalman};
pub use regulator::plant::{Plant, STATES, states};
pub use regulator::{Regulator, Timing, Weights};
pub use route::{Route, Waypoint};
pub use sensing::Sensing;
pub use sensors::{Channels, Sensors};
pub use stabiliser::{ProportionalDerivative, Stiffness};
pub use steering::{Held, Law, SteeredBeats, Steering};

pub use crate::stability::disturbance::disturbed;
