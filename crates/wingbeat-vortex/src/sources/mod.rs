//! Points, filaments and blobs.

mod blob;
mod filaments;
mod points;

pub use blob::Blob;
pub use filaments::{Network, Segments};
pub use points::Points;
