//! Result directories: written while the flight runs, readable whenever it stops.
//!
//! ```text
//! case.toml       the case with everything filled in; reproduces the run
//! history.csv     one row per step, appended: a kill leaves a readable prefix
//! flight.pvd      index of the frames for ParaView
//! frames/         surfaces_NNNNNN.vtp, wakes_NNNNNN.vtp and, of wakes that become vortex particles,
//!                 particles_NNNNNN.vtp; each written whole or not at all
//! figures/        drawings made from history.csv
//! manifest.json   version, hash of the case, threads, counts, timings, warnings
//! checkpoint.bin  the state from which `wingbeat resume` goes on; removed when the flight is done
//! flight.html     the flight page, if it was asked for
//! summary.txt     what happened and how far it can be trusted; summary.json the same numbers
//! ```
//!
//! [`export`] writes a result in formats of other programs. Names of columns carry units; numbers
//! are SI and radians on the other side of this border.
//!
//! What it does not know: physics, drawing. The only formulas are conversions of units and means
//! over a wingbeat.
#![warn(missing_docs)]

mod arrays;
pub mod checkpoint;
pub mod columns;
mod columns_page;
pub mod directory;
pub mod export;
pub mod file;
pub mod fixed;
mod framer;
pub mod frames;
pub mod history;
pub mod manifest;
mod other_build;
pub mod particles;
pub mod poses;
pub mod quantity;
mod recorded;
pub mod records;
pub mod rows;
pub mod saver;
pub mod summary;
mod table;
pub mod vtp;
mod whole;
pub mod writer;

pub use columns_page::columns_page;
pub use directory::{RESULTS, ResultDir, latest_run};
pub use history::History;
pub use manifest::{Manifest, Outcome};
pub use other_build::FORMAT;
pub use recorded::RecordedFlight;
pub use records::Records;
pub use summary::Summary;
pub use writer::RunWriter;
