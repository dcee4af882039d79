//! The circulations of the panels, from the condition that no air goes through them.

mod boundary_condition;
mod circulation;
mod influence;
mod row_blocks;
mod self_influence;
mod unknowns;

pub(crate) use boundary_condition::BoundaryCondition;
pub(crate) use influence::Instant;
pub(crate) use unknowns::is_computed;
