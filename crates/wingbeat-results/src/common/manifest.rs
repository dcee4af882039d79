//! manifest.json: what was run, with what, how long it took and how it ended.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use wingbeat_flight::Simulation;

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Still running; of a killed run only the file says so, whoever reads it finds
    /// [`Self::Interrupted`].
    Running,
    /// All steps were made.
    Finished,
    /// Stopped by Ctrl-C or SIGTERM, or killed; everything up to there is written.
    Interrupted,
    /// A file could not be written, e.g. on a full disk; `wingbeat resume` goes on from the last
    /// checkpoint.
    Unwritten(String),
    /// An error ended the flight; everything up to there is written.
    Failed(String),
}

impl Outcome {
    /// Of a flight that no error ended.
    pub fn of(flight: &Simulation) -> Self {
        match flight.finished() {
            true => Self::Finished,
            false => Self::Interrupted,
        }
    }

    /// Whether the run ended in order, so that its history holds what the manifest says and no
    /// more. A run that was killed, or could not be written, may have appended rows since.
    pub fn is_sealed(&self) -> bool {
        !matches!(self, Self::Running | Self::Unwritten(_))
    }
}

/// What a result directory says about itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// What its files mean, [`crate::FORMAT`].
    pub format: u64,
    /// Version of wingbeat.
    pub version: String,
    /// Name of the case.
    pub case: String,
    /// File or preset the case came from.
    pub origin: String,
    /// SHA-256 of case.toml in this directory.
    pub case_sha256: String,
    /// Length of history.csv when this was written \[bytes\]; more may follow.
    pub history_bytes: u64,
    /// SHA-256 of that part of history.csv.
    pub history_sha256: String,
    /// How the run ended.
    pub outcome: Outcome,
    /// Threads that were allowed.
    pub threads: usize,
    /// Steps made.
    pub steps: usize,
    /// Steps that were asked for.
    pub steps_planned: usize,
    /// Frames written.
    pub frames: usize,
    /// Panels of all surfaces of the lattice, in frames or not.
    pub panels: usize,
    /// Wake rings at the end.
    pub wake_rings: usize,
    /// Wall time of the flight, writing included \[s\].
    pub wall_time_s: f64,
    /// Wall time of the writing alone \[s\].
    pub writing_time_s: f64,
    /// Sums over the wakes of a lattice that were checked, where the flight ended in order.
    #[serde(default)]
    pub checked_sums: u64,
    /// Sums made for them in vain, their error being above `air.summation_tolerance`: they cost time, and no result is
    /// of them.
    #[serde(default)]
    pub discarded_sums: u64,
    /// What a reader of the results should know.
    pub warnings: Vec<String>,
    /// Axes of the frames.
    pub frame_axes: String,
}

impl Manifest {
    /// As JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a manifest is JSON") + "\n"
    }
}

/// SHA-256 in hexadecimal.
pub fn sha256(data: &[u8]) -> String {
    hexadecimal(&Sha256::digest(data))
}

/// A digest in hexadecimal.
pub fn hexadecimal(digest: &[u8]) -> String {
    digest.iter().map(|b| format!("{b:02x}")).collect()
}
