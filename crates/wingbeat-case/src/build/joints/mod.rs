//! `[joint.NAME]`.

pub(crate) mod element;
pub(crate) mod joint;
pub(crate) mod mirrored;
