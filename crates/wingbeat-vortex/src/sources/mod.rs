//! Points, filaments and blobs.

mod blob;
mod filaments;
mod points;

pub use blob::Blob;
pub use filaments::Network;
pub use points::Points;
