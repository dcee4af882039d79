//! Case files, result directories, figures.
//!
//! The chapter in order: [`case`] reads a TOML case into a validated
//! [`wingbeat_flight::FlightSetup`], or says what is wrong with it, where and what to do;
//! [`presets`] are ordinary case files that come with the program; [`result`] writes what a
//! flight leaves behind so that it is readable whenever the flight stops; [`figures`] draws it;
//! [`page`] shows it in a browser; [`export`] writes it in formats of other programs.
//!
//! Only this crate touches files and holds names with units in them. Numbers are SI and radians
//! on the other side of its border.
//!
//! What it does not know: physics. The only formulas are conversions of units and means over a
//! wingbeat.
#![warn(missing_docs)]

pub mod case;
mod error;
pub mod export;
pub mod external;
pub mod figures;
pub mod page;
pub mod presets;
pub mod result;

pub use case::{LoadedCase, OutputSettings};
pub use error::{CaseError, IoError};
pub use result::{History, Manifest, Outcome, ResultDir, RunWriter, Summary};
