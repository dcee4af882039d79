//! Progress on the terminal: of flights and of analyses.

pub(crate) mod bar;
pub(crate) mod pace;
pub(crate) mod watch;
