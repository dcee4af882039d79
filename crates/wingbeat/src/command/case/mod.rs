//! The commands about cases: what there is to start from, whether it can be flown, what that costs.

pub(crate) mod check;
pub(crate) mod expectation;
pub(crate) mod new;
pub(crate) mod programs;
