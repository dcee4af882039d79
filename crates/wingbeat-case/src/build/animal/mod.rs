//! The animal: body, segments, wings, what they are made of and how they move.

pub(crate) mod body;
pub(crate) mod deformation;
pub(crate) mod hinge;
pub(crate) mod motion;
pub(crate) mod segment;
pub(crate) mod structure;
pub(crate) mod wing;
