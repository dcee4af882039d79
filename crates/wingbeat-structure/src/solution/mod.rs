//! The equations of all nodes and their solution: equilibrium, small vibrations, motion in time.

pub(crate) mod assembly;
pub(crate) mod dynamics;
pub(crate) mod matrix;
pub(crate) mod modes;
mod slowest;
pub(crate) mod statics;
