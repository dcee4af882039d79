//! Case files: from text to a validated setup, and back to text with everything filled in.
//!
//! The way of a case: text -> `source` (document, positions of keys, overrides) -> `decode`
//! (raw types of [`raw`], unknown keys refused) -> `files` (meshes and tables read in) ->
//! `build` (every number checked) -> [`wingbeat_flight::FlightSetup`], or an error that says what is
//! wrong, where and what to do. [`presets`] are ordinary case files that come with the program.
//!
//! Names in cases carry units; numbers are SI and radians on the other side of this border.
//!
//! What it does not know: physics, results.
#![warn(missing_docs)]

mod build;
mod decode;
mod differences;
mod error;
pub mod external;
mod files;
mod loaded;
mod output;
pub mod presets;
pub mod raw;
mod source;
mod trimmed;

pub use build::data_sets;
pub use decode::nearest;
pub use differences::{Difference, differences};
pub use error::{CaseError, IoError};
pub use loaded::{LoadedCase, schema};
pub use output::{OutputSettings, SaveSettings};
pub use trimmed::{derivative_case, trimmed_case, wake_trimmed_case};
