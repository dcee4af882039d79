//! The mathematics every other crate of wingbeat stands on.
//!
//! What is here: rotations that move in time, Euler-angle sequences, motions of bodies and loads on them, the
//! algebra of mass properties, dense linear solves, Newton iteration, least squares of passes and time
//! integrators.
//! What this crate does not know: animals, air, joints, files.
//!
//! Vectors and 3 x 3 matrices are [`glam`]'s `f64` types, re-exported here.
//!
//! | symbol | name in code | meaning | seed |
//! |---|---|---|---|
//! | T^{NB} | `R_NB` (`r_nb`) | rotation, B components to N components; columns are the B axes in N | eq. 3 |
//! | tilde(r) | [`tilde`] | skew matrix, `tilde(a) b = a x b` | eq. 14 |
//! | G | [`EulerSequence::g`] | angular velocity in body components = G eta' | eq. 15 |
//! | m, U, I | [`MassProperties`] | mass, first and second inertia tensors about the body origin | eq. 19 |
#![warn(missing_docs)]

mod bodies;
mod linear;
mod nonlinear;
mod numbers;
pub mod ode;
pub mod rotation;

pub use bodies::mass;
pub use bodies::mass::{MassError, MassProperties};
pub use bodies::mirror::{mirrored, mirrored_axial, reflected};
pub use bodies::spatial::{BodyAcceleration, BodyMotion, Wrench};
pub use glam::{DMat3, DQuat, DVec2, DVec3};
pub use linear::iterative::{BiCgStab, Product};
pub use linear::lu::{DenseLu, LuError};
pub use linear::matrix::{outer, trace};
pub use linear::six_by_six::{Six, SixBySix, six};
pub use linear::small_lu::{SingularMatrix, SmallLu, solve_small};
pub use linear::{lu, six_by_six};
pub use nonlinear::newton;
pub use nonlinear::secants::{Secants, Shown};
pub use numbers::extremes::{larger, largest, smaller};
pub use numbers::series;
pub use numbers::series::{DriftingFourier, interpolate, interpolate_pairs, with_harmonics};
pub use numbers::smoothstep::{smoothstep, smoothstep7};
pub use numbers::split_mix::SplitMix64;
pub use numbers::statistics::{median, root_mean_square, to_digits};
pub use rotation::euler;
pub use rotation::euler::{EulerMatrices, EulerSequence};
pub use rotation::jacobian as rotation_jacobian;
pub use rotation::{
    MovingRotation, RotationLaw, facing, heading, r1, r2, r3, rotation_about, rotation_vector,
    rotation_vector_of_matrix, tilde, untilde,
};
