//! Wing planforms: leading and trailing edge over the span, and the grid between them.
//!
//! r is the distance from the hinge along the span, x runs towards the leading edge; the hinge
//! (feathering) axis is x = 0.

pub mod beta;
mod contour;
mod edges;
mod fit;
mod grid;
mod outline;

pub use crate::mesh::Spacing;
pub use beta::{Beta, BetaChord, ChordSize};
pub use contour::{EdgePoints, Landmarks};
pub use edges::Edges;
pub use grid::WingShape;
pub use outline::Planform;
