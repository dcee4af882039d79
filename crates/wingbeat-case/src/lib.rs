//! Case files: from text to a validated setup, and back to text with everything filled in.
//!
//! The way of a case: text -> `source` (document, positions of keys, overrides) -> `decode` (raw types of
//! [`raw`], unknown keys refused) -> [`keys`] (every value in its range) -> `files` (meshes and tables read in) ->
//! `resolve` (keys that follow from others) -> [`keys`] (every key has an effect) -> `build` ->
//! [`wingbeat_flight::FlightSetup`], or an error that says what is wrong, where and what to do. [`presets`] are
//! ordinary case files that come with the program, [`insect`] writes them for other animals.
//!
//! Names in cases carry units; numbers are SI and radians on the other side of this border.
//!
//! [`Document`] reads files of other languages, as those of campaigns, in the same way.
//!
//! What it does not know: physics, results.
#![warn(missing_docs)]

mod build;
mod carrier;
mod data;
mod decode;
mod differences;
mod digits;
mod document;
mod error;
pub mod external;
mod files;
mod fitted;
mod idle;
pub mod insect;
pub mod keys;
mod loaded;
mod measured;
mod mixed_angles;
mod nearest;
mod output;
mod own_control;
mod own_motion;
pub mod presets;
pub mod raw;
mod resolve;
mod source;
mod species;
mod trimmed;
mod ways;
mod written;

pub use build::{OwnControl, column_name};
pub use data::data_sets;
pub use differences::{Difference, differences};
pub use document::{Document, overridden};
pub use error::{CaseError, IoError};
pub use files::{TableGaps, csv_reader};
pub use fitted::FittedTable;
pub use keys::{SCHEMA_FILE, schema, with_schema};
pub use loaded::LoadedCase;
pub use mixed_angles::MixedAngles;
pub use nearest::nearest;
pub use output::{OutputSettings, SaveSettings};
pub use trimmed::{derivative_case, lacks_feedback, trimmed_case, wake_trimmed_case};
pub use written::case_of;
