//! The commands that fly a case.

pub(crate) mod ensemble;
pub(crate) mod run;
