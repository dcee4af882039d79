//! The circulations of the panels, from the condition that no air goes through them.

mod boundary_condition;
mod circulation;
mod influence;
mod leading_edges;
mod leaving;
mod row_blocks;
mod self_influence;
mod suction;
mod unknowns;

pub(crate) use boundary_condition::BoundaryCondition;
pub(crate) use influence::Instant;
pub(crate) use suction::{section_speed, suction_per_speed, suction_unit};
pub(crate) use unknowns::is_computed;
