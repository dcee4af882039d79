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

mod assembly;
mod beam;
mod block;
mod builder;
mod configuration;
mod dynamics;
mod element;
mod error;
mod follower;
mod frame;
mod inertia;
mod loads;
mod matrix;
mod modes;
mod screw;
pub mod shell;
mod slowest;
mod statics;
mod structure;

pub use beam::{Beam, BeamEnd, BeamSection, Stiffness};
pub use builder::StructureBuilder;
pub use configuration::{Configuration, NODE};
pub use dynamics::{
    GeneralizedAlpha, LoadTangent, Solver, State, Trial, Weights, carried_by_frame, resultant,
};
pub use element::{Element, ElementForces, MassBetween};
pub use error::StructureError;
pub use follower::{Follower, NodeWeight};
pub use frame::FrameMotion;
pub use loads::{Loading, NodeLoad};
pub use modes::{Mode, Slowest, first_frequency, modes, slowest_modes};
pub use shell::{Lamina, Shell, ShellError, ShellMesh};
pub use statics::{StaticSettings, equilibrium};
pub use structure::{Damping, Structure};
