//! What no single key tells: keys without effect, sizes, and errors of flights at the key they are about.

pub(crate) mod effects;
pub(crate) mod model_keys;
pub(crate) mod refused;
pub(crate) mod size;
pub(crate) mod spacing;
mod still;
pub(crate) mod wingless;
