//! `[air]`: its models, their settings, what blows.

pub(crate) mod blade;
pub(crate) mod buoyancy;
pub(crate) mod derivatives;
pub(crate) mod lattice;
pub(crate) mod lengths;
pub(crate) mod model;
pub(crate) mod viscosity;
pub(crate) mod wind;
