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

pub mod euler;
mod extremes;
mod iterative;
pub mod lu;
pub mod mass;
mod matrix;
mod mirror;
pub mod newton;
pub mod ode;
pub mod rotation;
pub mod rotation_jacobian;
mod secants;
pub mod series;
pub mod six_by_six;
mod small_lu;
mod smoothstep;
mod spatial;
mod split_mix;
mod statistics;

pub use euler::{EulerMatrices, EulerSequence};
pub use extremes::{larger, largest, smaller};
pub use glam::{DMat3, DQuat, DVec2, DVec3};
pub use iterative::{BiCgStab, Product};
pub use lu::{DenseLu, LuError};
pub use mass::{MassError, MassProperties};
pub use matrix::{outer, trace};
pub use mirror::{mirrored, mirrored_axial, reflected};
pub use rotation::{
    MovingRotation, RotationLaw, r1, r2, r3, rotation_about, rotation_vector,
    rotation_vector_of_matrix, tilde, untilde,
};
pub use secants::{Secants, Shown};
pub use series::{DriftingFourier, interpolate, interpolate_pairs, with_harmonics};
pub use six_by_six::{Six, SixBySix, six};
pub use small_lu::{SingularMatrix, SmallLu, solve_small};
pub use smoothstep::{smoothstep, smoothstep7};
pub use spatial::{BodyAcceleration, BodyMotion, Wrench};
pub use split_mix::SplitMix64;
pub use statistics::{median, root_mean_square, to_digits};
