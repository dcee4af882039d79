//! `[flight]`, `[time]`, `[output]` and `[control]`.

pub(crate) mod control;
pub(crate) mod mechanics;
pub(crate) mod output;
pub(crate) mod own_control;
pub(crate) mod route;
pub(crate) mod time;
