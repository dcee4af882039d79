//! The circulations of the panels, from the condition that no air goes through them.

mod boundary_condition;
mod circulation;
mod influence;
mod leading_edges;
mod leading_section;
mod leaving;
mod row_blocks;
mod self_influence;
mod suction;
mod unknowns;

pub(crate) use boundary_condition::BoundaryCondition;
pub(crate) use influence::Instant;
pub(crate) use leading_section::LeadingSection;
pub(crate) use unknowns::is_computed;
