//! What a command says, where it goes, and the exit code.

pub(crate) mod failure;
pub(crate) mod report;
pub(crate) mod target;
pub(crate) mod terminal;
