//! The directory of a run and who writes it: files that are never written over, frames, checkpoints, the recorded
//! flight.

pub mod directory;
pub mod file;
mod framer;
pub(crate) mod recorded;
pub mod saver;
pub mod writer;
