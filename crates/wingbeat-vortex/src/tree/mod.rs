//! Far sources by the expansions of the cells of a tree.

pub(crate) mod cells;
pub(crate) mod groups;
mod harmonics;
#[cfg(test)]
mod harmonics_tests;
mod moments;
