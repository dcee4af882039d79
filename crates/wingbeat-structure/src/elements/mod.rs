//! What joins nodes elastically: beams and shells.

pub(crate) mod beam;
pub(crate) mod element;
pub mod shell;
