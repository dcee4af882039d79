//! The equations of the seed's form ([`crate::EulerForm`]): six absolute coordinates per body and multipliers.
//!
//! Reading order: [`coordinates`] (seed eq. 2, 3, 14-16), [`constraint`] (eq. 4, 5, 27), [`forces`] (eq. 6-10),
//! [`inertia`] (eq. 17-26), [`condensed`] (eq. 28-30, solved through the tree), [`assembly`] (consistent initial
//! conditions).

pub mod assembly;
pub mod condensed;
pub mod constraint;
pub mod coordinates;
pub mod forces;
pub mod inertia;
pub(crate) mod scratch;
