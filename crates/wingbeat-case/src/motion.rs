//! Which wings ride on other wings, and which have a motion of their own.

pub(crate) mod carrier;
pub(crate) mod own_motion;
