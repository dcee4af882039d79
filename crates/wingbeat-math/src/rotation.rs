//! Rotations, elementary and moving in time; Euler angles; what a rotation vector does as a body turns.

mod elementary;
pub mod euler;
mod facing;
pub mod jacobian;

pub use elementary::{
    MovingRotation, RotationLaw, r1, r2, r3, rotation_about, rotation_vector,
    rotation_vector_of_matrix, tilde, untilde,
};
pub use facing::{facing, heading};
