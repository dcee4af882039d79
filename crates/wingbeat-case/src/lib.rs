//! Case files: from text to a validated setup, and back to text with everything filled in.
//!
//! The way of a case: text -> `text` (document, positions of keys, overrides) -> `decode` (raw types of
//! [`raw`], unknown keys refused) -> [`keys`] (every value in its range) -> `files` (meshes and tables read in) ->
//! `build` (keys that follow from others resolved, every key has an effect) ->
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
mod decode;
mod document;
mod error;
pub mod external;
mod files;
mod findings;
pub mod insect;
pub mod keys;
mod loaded;
mod motion;
mod own_control;
pub mod raw;
mod shipped;
mod text;
mod written;

pub use build::{OutputSettings, OwnControl, SaveSettings, column_name};
pub use document::{Document, overridden};
pub use error::{CaseError, IoError};
pub use files::{TableGaps, csv_reader};
pub use findings::fitted::{FittedTable, Outlier};
pub use findings::mixed_angles::MixedAngles;
pub use keys::{SCHEMA_FILE, schema, with_schema};
pub use loaded::LoadedCase;
pub use shipped::data::data_sets;
pub use shipped::presets;
pub use text::nearest::nearest;
pub use text::shell::{operand, shell, shell_path};
pub use written::averaged::derivative_case;
pub use written::case_of;
pub use written::differences::{Difference, differences};
pub use written::trimmed::{lacks_feedback, trimmed_case, wake_trimmed_case};
