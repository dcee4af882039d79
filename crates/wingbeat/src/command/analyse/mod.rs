//! The analysing commands: each trims first, for there is no stability of no steady flight.

pub(crate) mod derivatives;
pub(crate) mod flutter;
mod found;
mod linear;
pub(crate) mod modes;
pub(crate) mod power;
pub(crate) mod stabilise;
pub(crate) mod stability;
mod sweeping;
pub(crate) mod trim;
pub(crate) mod trimming;
mod tumbling;
