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
mod budget;
mod configuration;
mod cycle;
mod error;
mod formulation;
mod free;
mod mechanism;
mod prescribed;
mod response;
mod solution;
mod system;

pub use added_mass::AddedMass;
pub use budget::{budget, load_power, mass_centre, relative_energy};
pub use configuration::{Composite, Configuration, ConfigurationTable};
pub use cycle::Cycle;
pub use error::DynamicsError;
pub use formulation::euler;
pub use formulation::euler_form::EulerForm;
pub use formulation::mobility::mobilities;
pub use formulation::momentum::{MomentumForm, MomentumState};
pub use formulation::quaternion::QuaternionForm;
pub use formulation::tether::{RootMotion, tethered, tethered_motions};
pub use formulation::workspace::Workspace;
pub use formulation::{Formulation, add_by_response};
pub use mechanism::Mechanism;
pub use mechanism::baumgarte::Baumgarte;
pub use mechanism::driven::driven;
pub use mechanism::effort::Passive;
pub use mechanism::form::{AbsoluteForm, AbsoluteScratch, Stabilization};
pub use solution::{Budget, HingeReaction, Solution, Violation};
pub use system::System;
pub use system::body::{
    Body, NaturalUnits, angular_momentum, inertia_wrench, kinetic_energy, linear_momentum,
    weight_wrench,
};
pub use system::joint::Joint;
pub use system::joint_model::{Element, ElementLaw, JointModel, JointType, TravelLaw};
pub use system::mirror::MirrorSymmetry;
pub use system::offsets::JointOffsets;
pub use system::placement::Placement;
pub use system::shape::ShapeMass;
pub use wingbeat_math::{BodyAcceleration, BodyMotion, Six, Wrench};
