//! The flapping animal: geometry, quad meshes, mass properties, wing motion laws.
#![warn(missing_docs)]

pub mod animal;
pub mod error;
pub mod integrate;
pub mod mesh;
pub mod motion;

pub use animal::{Animal, BodyPart, Wing};
pub use error::ModelError;
pub use integrate::MassInput;
pub use mesh::{GridMesh, QuadMesh, Side};
pub use motion::{AngleLaw, AngleLaws, Start, WingMotion};
