//! A flight as a value: what of it is written, and when a whole result directory is refused.

use std::path::PathBuf;

use wingbeat::prelude::*;
use wingbeat::results::{Outcome, ResultDir, Summary};

/// A place in the temporary folder where nothing is yet.
fn place(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("wingbeat-value-{name}-{}", std::process::id()))
}

fn short() -> Flight {
    let keys = [
        "time.beats=0.2",
        "output.figures=false",
        "output.page=false",
    ];
    Flight::preset_with("fruit-fly-blade", &keys).expect("a preset")
}

#[test]
fn behaves_written_case_flies_the_same() {
    let dir = place("case");
    let run = short().fly_to(&dir).expect("a flight of a preset");
    let case = ResultDir::read(&dir)
        .and_then(|d| d.case())
        .expect("a case");
    let again = Flight::from(case).fly().expect("the same flight");
    assert_eq!(again.records, run.records);
    std::fs::remove_dir_all(&dir).expect("it was just written");
}

#[test]
fn refuses_whole_results_of_what_no_case_gives() {
    let dir = place("changed");
    let mut lighter = short();
    lighter.setup.gravity.z *= 0.5;
    let mut own = short();
    own.setup.animal.wings[0].motion.phase += f64::EPSILON;
    let built = Flight::from(short().setup);
    for flight in [lighter, own, built] {
        let refused = flight.fly_to(&dir).expect_err("no case gives it");
        assert!(matches!(refused, Error::NoCase { .. }), "{refused}");
        assert!(!dir.exists(), "nothing is written");
    }
}

#[test]
fn behaves_flight_of_rust_leaves_history_and_summary() {
    let dir = place("rust");
    let mut flight = short();
    flight.setup.gravity.z *= 0.5;
    let run = flight.fly().expect("a flight");
    run.write(&dir).expect("a new folder");
    let text = std::fs::read_to_string(dir.join("summary.txt")).expect("a summary");
    assert_eq!(text, run.summary().to_text());
    let refused = run.write(&dir).expect_err("nothing is overwritten");
    assert!(refused.to_string().contains("exists already"), "{refused}");
    std::fs::remove_dir_all(&dir).expect("it was just written");
}

#[test]
fn behaves_flight_that_fails_leaves_what_was_flown() {
    let dir = place("failed");
    let keys = [
        "dynamics.integrator=hamming",
        "corrector.max_passes=3", // enough at first, too few in the second wingbeat
        "motion.start=smooth",
        "motion.start_beats=1",
        "time.beats=2",
        "output.figures=false",
        "output.page=false",
    ];
    let flight = Flight::preset_with("fruit-fly-blade", &keys).expect("a preset");
    let failed = flight.fly_to(&dir).expect_err("it cannot converge");
    assert!(matches!(failed, Error::Flight(_)), "{failed}");
    let read = ResultDir::read(&dir).expect("a result");
    let outcome = read.manifest().expect("a manifest").outcome;
    assert_eq!(outcome, Outcome::Failed(failed.to_string()));
    let case = read.case().expect("a case");
    let summary = Summary::read(&case, &read.join("history.csv"), &outcome).expect("a summary");
    assert_eq!(summary.beats.len(), 1, "the first wingbeat is there");
    std::fs::remove_dir_all(&dir).expect("it was just written");
}
