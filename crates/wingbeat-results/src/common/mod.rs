//! What the other parts share: files written whole, the manifest, checkpoints, results of other builds, numbers for
//! people.

pub mod checkpoint;
pub mod fixed;
pub mod manifest;
pub(crate) mod other_build;
pub(crate) mod whole;
