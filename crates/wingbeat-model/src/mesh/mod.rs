//! Meshes of four-node quadrilaterals (seed sec. 2): flat wing grids, closed surfaces of the body, and integrals
//! over both.

mod closed;
pub mod import;
pub mod integrate;
mod quads;
pub mod revolution;

pub use quads::{GridMesh, QuadMesh, Side, Spacing, mirror_name, side_in_name};
