//! Surfaces and what follows from them alone: edges, panels, rings, strips, pairs of mirror images.

mod aft;
mod assembly;
mod borders;
mod carry_through;
mod control;
mod corners;
mod joined_edge;
mod node_motion;
mod panels;
mod rings;
mod shed_around;
mod strips;
mod suction_strips;
mod surface;
mod symmetry;
mod topology;
mod wash;

pub(crate) use borders::borders;
pub(crate) use carry_through::{Carried, carried, middle_columns};
pub(crate) use control::Controls;
pub(crate) use corners::vector_area;
pub use joined_edge::JoinedEdge;
pub use node_motion::NodeMotion;
pub use panels::Panels;
pub(crate) use rings::{Rings, rings};
pub(crate) use shed_around::{ShedAround, joined_groups, shed_around};
pub(crate) use strips::{Strip, column, opposite, section, spanwise, strips};
pub(crate) use suction_strips::SuctionStrips;
pub use surface::{SheddingSegment, Surface};
pub use symmetry::MirrorPairs;
pub(crate) use symmetry::Symmetry;
pub use topology::{Edge, JoinedColumns, PanelEdge, Sheet, Topology, WakeColumn};
pub(crate) use wash::Wash;
