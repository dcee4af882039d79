//! The equations of the seed's form ([`crate::EulerForm`]): six absolute coordinates per body and multipliers.
//!
//! Reading order: `coordinates` (seed eq. 2, 3, 14-16), `constraint` (eq. 4, 5, 27), `forces` (eq. 6-10),
//! `inertia` (eq. 17-26), `condensed` (eq. 28-30, solved through the tree), `assembly` (consistent initial
//! conditions).

pub(crate) mod assembly;
pub(crate) mod condensed;
pub(crate) mod constraint;
pub(crate) mod coordinates;
pub(crate) mod forces;
pub(crate) mod inertia;
pub(crate) mod scratch;

pub use assembly::{consistent_coordinates, consistent_rates, kinematics};
pub use condensed::Condensed;
pub use constraint::{AngleJacobian, HingeKinematics};
pub use coordinates::{BodyKinematics, COORDINATES, REGULARITY_LIMIT};
pub use forces::generalized_wrench;
pub use inertia::{
    MassBlocks, equations, kinetic_energy_gradient, mass_matrix, mass_matrix_rate,
    quadratic_velocity,
};
