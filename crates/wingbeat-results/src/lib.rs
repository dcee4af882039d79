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
//! The modules in storeys, each on those before it: `common`, `series` (history.csv), `snapshots` (frames),
//! [`summary`], `run` (the directory and who writes it), [`export`].
//!
//! What it does not know: physics, drawing. The only formulas are conversions of units and means
//! over a wingbeat.
#![warn(missing_docs)]

mod common;
pub mod export;
mod run;
mod series;
mod snapshots;
pub mod summary;

pub use common::manifest::{Manifest, Outcome};
pub use common::other_build::FORMAT;
pub use common::{checkpoint, fixed, manifest};
pub use run::directory::{RESULTS, ResultDir, latest_run};
pub use run::recorded::RecordedFlight;
pub use run::writer::RunWriter;
pub use run::{directory, file, saver, writer};
pub use series::columns_page::columns_page;
pub use series::history::History;
pub use series::records::Records;
pub use series::{columns, history, quantity, records, rows};
pub use snapshots::{frames, particles, poses, vtp};
pub use summary::Summary;
