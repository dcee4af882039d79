//! Mechanisms: bodies joined by any joints, to the ground or to each other, in trees and loops.
//!
//! A [`Mechanism`] is more general than a [`crate::System`]: joints may hang on the ground, and
//! several joints may hold one body. [`AbsoluteForm`] writes its motion in absolute coordinates
//! (position and unit quaternion of every body) with multipliers, which are singular nowhere.
//! Reading order: [`joint`] (what a joint asks of two bodies), [`partition`] (which coordinates
//! follow from which, and what is asked twice), `equations` (matrix and right-hand side), [`form`], [`assembly`]
//! (consistent starts), `starts` (whether those are the ones given).

pub(crate) mod assembly;
pub(crate) mod baumgarte;
pub(crate) mod driven;
pub(crate) mod effort;
mod equations;
pub(crate) mod form;
mod given;
pub(crate) mod joint;
pub(crate) mod partition;
mod starts;
mod structure;

pub use structure::Mechanism;
