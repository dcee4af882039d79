//! What comes with the program: presets, species, published measurements.

pub(crate) mod data;
pub mod presets;
pub(crate) mod species;
