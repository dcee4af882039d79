//! Elastic bodies: nodes with mass, elements with stiffness, on a frame that moves.
//!
//! An elastic body has nodes, each with a place and an attitude in the frame W of the body that carries it, and
//! elements (geometrically exact beams, shells) between them. Elements know strain energy, internal force and
//! tangent; mass is lumped at nodes, each a small rigid body, so that inertia is exact rigid-body dynamics node
//! by node.
//!
//! | symbol | name in code | meaning |
//! |---|---|---|
//! | u | [`Configuration::position`] | places of the nodes, W components \[m\] |
//! | R | [`Configuration::rotation`] | attitudes of the nodes, node components to W components |
//! | (dx, dtheta) | [`Configuration::moved`] | increments: dx in W components, dtheta in node components, `R exp(dtheta)` |
//! | f | [`Element::internal`] | internal force, the derivative of the strain energy: force in W, moment in node components |
//!
//! This crate does not know air, joints, animals or files.
#![warn(missing_docs)]

mod builder;
mod elements;
mod error;
mod nodes;
mod solution;
mod structure;

pub use builder::StructureBuilder;
pub use elements::beam::{Beam, BeamEnd, BeamSection, Stiffness};
pub use elements::element::{Element, ElementForces, MassBetween};
pub use elements::shell::{self, Lamina, Shell, ShellError, ShellMesh};
pub use error::StructureError;
pub use nodes::configuration::{Configuration, NODE};
pub use nodes::follower::{Follower, NodeWeight};
pub use nodes::frame::FrameMotion;
pub use nodes::loads::{Loading, NodeLoad};
pub use solution::dynamics::{
    GeneralizedAlpha, LoadTangent, Solver, State, Trial, Weights, carried_by_frame, resultant,
};
pub use solution::modes::{Mode, Slowest, first_frequency, modes, slowest_modes};
pub use solution::statics::{StaticSettings, equilibrium};
pub use structure::{Damping, Structure};
