//! Constrained multibody dynamics of flapping flight (seed sec. 3 and 4).
//!
//! A [`System`] is a tree of rigid bodies: a free root (the central body) and bodies that hang on it by hinges
//! whose rotation is prescribed in time (the wings), and joints that close loops. Given the external loads as
//! one [`Wrench`] per body, three [`Formulation`]s of the same mechanics answer how it moves and what its
//! hinges carry:
//!
//! - [`MomentumForm`], the default: mass centre, attitude quaternion and the two momenta of the
//!   whole, 13 numbers. Constraints and momenta hold by construction.
//! - [`EulerForm`], the seed's: six absolute coordinates per body with Euler angles, Lagrange
//!   multipliers, Baumgarte stabilization, the saddle-point system of seed eq. 30.
//!
//! - [`QuaternionForm`]: positions and quaternions of all bodies with multipliers, singular
//!   nowhere, with loops ([`Mechanism`]); also for a root on a moving support.
//!
//! Hinges may leave freedoms beside what they prescribe ([`JointModel`]), with springs, dampers,
//! stops and actuators along them.
//!
//! [`tethered`] answers the inverse question: what a support of the root carries.
//!
//! The chapter, in reading order: [`System`], `configuration` (where the bodies are, seen from the root),
//! [`MomentumForm`], `free` (the equations of free joints), `inverse` (reactions), `budget` (energy, momenta),
//! then the seed's form in [`euler`] and that of mechanisms in `mechanism`.
//!
//! | symbol | name in code | meaning | unit | frame | seed |
//! |---|---|---|---|---|---|
//! | R_i | [`BodyMotion::p`] | position of a body's frame origin | m | N | eq. 3 |
//! | T_i^{NB} | [`BodyMotion::r`] | rotation, body components to N components | 1 | | eq. 3 |
//! | omega_i | [`BodyMotion::w`] | angular velocity relative to N | rad/s | body | eq. 15 |
//! | eta_i | `eta` | Euler angles phi, theta, psi | rad | | eq. 2 |
//! | C(t) | [`Joint::law`] | prescribed rotation, child to parent components | 1 | | eq. 4 |
//! | D | `HingeKinematics::d` | prescribed orientation seen from the child | 1 | child | eq. 4 |
//! | Phi | `connection`, `orientation` | constraints | m, 1 | N, child | eq. 4, 5 |
//! | B_q | `connection_jacobian`, `orientation_jacobian` | constraint Jacobian | | | eq. 11 |
//! | M_i | `mass_matrix` | mass matrix of a body | kg, kg m, kg m2 | | eq. 18, 19 |
//! | Q^v | `quadratic_velocity` | quadratic velocity vector | N, N m | | eq. 26 |
//! | lambda | [`Solution::multipliers`] | multipliers of connection and orientation | N, N m | N, child | eq. 11 |
//! | alpha, beta | [`Baumgarte`] | stabilization constants | 1/s | | eq. 29 |
//! | S | `Baumgarte::right_side` | right-hand side of the constraint rows | m/s2, 1/s2 | | eq. 30 |
//! | P, H | state of [`MomentumForm`] | momenta of the whole, H about its mass centre | kg m/s, kg m2/s | N | |
//! | I, h, c | [`Composite`] | inertia, relative angular momentum, mass centre of the whole | kg m2, kg m2/s, m | root | |
//!
//! The multipliers mean: hinge force on a wing = -(lambda_1, lambda_2, lambda_3) in N components,
//! hinge moment on it = -(lambda_8, lambda_9, lambda_7) in wing components, and so on for every
//! hinge.
//!
//! What this crate does not know: air, panels, animals, files, units other than SI.
#![warn(missing_docs)]

mod added_mass;
mod baumgarte;
mod body;
mod budget;
mod check;
mod configuration;
mod cycle;
mod driven;
mod effort;
mod error;
pub mod euler;
mod euler_form;
mod formulation;
mod free;
mod inverse;
mod joint;
mod joint_model;
mod mechanism;
mod mirror;
mod mobility;
mod momentum;
mod offsets;
mod placement;
mod prescribed;
mod quaternion;
mod response;
mod shape;
mod solution;
mod system;
mod tether;
mod workspace;

pub use added_mass::AddedMass;
pub use baumgarte::Baumgarte;
pub use body::{
    Body, NaturalUnits, angular_momentum, kinetic_energy, linear_momentum, weight_wrench,
};
pub use budget::{budget, load_power, mass_centre, relative_energy};
pub use configuration::{Composite, CompositeRates, Configuration, ConfigurationTable};
pub use cycle::Cycle;
pub use driven::driven;
pub use effort::Passive;
pub use error::DynamicsError;
pub use euler_form::EulerForm;
pub use formulation::{Formulation, add_by_response};
pub use joint::Joint;
pub use joint_model::{Element, ElementLaw, JointModel, JointType, TravelLaw};
pub use mechanism::Mechanism;
pub use mechanism::form::{AbsoluteForm, AbsoluteScratch, Stabilization};
pub use mirror::MirrorSymmetry;
pub use mobility::mobilities;
pub use momentum::MomentumForm;
pub use offsets::JointOffsets;
pub use placement::Placement;
pub use quaternion::QuaternionForm;
pub use shape::ShapeMass;
pub use solution::{Budget, HingeReaction, Solution, Violation};
pub use system::System;
pub use tether::{RootMotion, tethered, tethered_motions};
pub use wingbeat_math::{BodyAcceleration, BodyMotion, Six, Wrench};
pub use workspace::Workspace;
