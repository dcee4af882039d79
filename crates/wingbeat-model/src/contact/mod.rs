//! Wings that pass through each other, lie in each other or in the body, or whose roots meet: what a vortex
//! lattice has to know.

pub(crate) mod bent;
pub(crate) mod coincident;
pub(crate) mod crossing;
mod flown_sheets;
pub(crate) mod inside;
pub(crate) mod narrow;
pub(crate) mod sheet;
pub(crate) mod touching;
