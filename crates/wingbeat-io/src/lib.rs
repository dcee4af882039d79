//! Case files, result directories, figures.
#![warn(missing_docs)]

pub mod case;
mod error;
pub mod presets;

pub use case::{LoadedCase, OutputSettings};
pub use error::{CaseError, IoError};
