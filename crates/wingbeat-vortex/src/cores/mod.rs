//! How singularities are regularised: the core models, in scalar and in vector form.

pub(crate) mod exp2;
mod model;
pub(crate) mod vector;

pub use model::{CoreModel, LAMB_ALPHA};

/// 1 / (4 pi).
pub(crate) const INV_4PI: f64 = 0.25 / std::f64::consts::PI;
