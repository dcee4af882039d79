//! Flights and what their summaries say.

use std::sync::atomic::{AtomicUsize, Ordering};
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
use wingbeat_results::{Outcome, ResultDir, RunWriter, Summary};

/// Flies a case to its end and reads the summary of what was written.
pub fn flown(case: &LoadedCase) -> Summary {
    static FLIGHTS: AtomicUsize = AtomicUsize::new(0);
    let number = FLIGHTS.fetch_add(1, Ordering::Relaxed);
    let folder = format!("wingbeat-summary-{}-{number}", std::process::id());
    let dir = ResultDir::overwrite(&std::env::temp_dir().join(folder)).unwrap();
    let path = dir.path().to_owned();
    let summary = flown_into(case, dir);
    std::fs::remove_dir_all(path).unwrap();
    summary
}

/// The same, written into a directory that stays.
pub fn flown_into(case: &LoadedCase, dir: ResultDir) -> Summary {
    let mut writer = RunWriter::new(dir, case, 1).unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    loop {
        writer.write(flight.record(), || flight.snapshot()).unwrap();
        if flight.finished() {
            break;
        }
        flight.step().unwrap();
    }
    writer.finish(Outcome::Finished, |_, _, _| Ok(())).unwrap()
}

pub fn preset(name: &str, set: &[&str]) -> LoadedCase {
    let quiet = ["output.frames_every=0"];
    let set: Vec<String> = set.iter().chain(&quiet).map(|&s| s.to_owned()).collect();
    LoadedCase::find(name, &set).unwrap()
}

pub fn says(summary: &Summary, words: &str) -> bool {
    summary.warnings.iter().any(|w| w.contains(words))
}
