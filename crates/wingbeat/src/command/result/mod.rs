//! The commands about results: numbers, figures, pages, exports, velocities of the air.

pub(crate) mod export;
pub(crate) mod plot;
pub(crate) mod show;
pub(crate) mod velocity;
pub(crate) mod view;
