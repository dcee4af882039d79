//! Bodies: motions of them and loads on them, mass properties, mirror images.

pub mod mass;
pub mod mirror;
pub mod spatial;
