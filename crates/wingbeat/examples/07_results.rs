//! A flight written to a result directory, and read back: the numbers are those in memory.
//! `cargo run --release --example 07_results`

use wingbeat::prelude::*;
use wingbeat::results::{Records, ResultDir, Summary};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let dir = std::env::temp_dir().join(format!("wingbeat-results-{}", std::process::id()));
    // The case that is written is that of the flight, changed in Rust or not.
    let flight = Flight::preset("fruit-fly-blade")?
        .frequency_hz(210.0)
        .beats(2.0);
    let run = flight.fly_to(&dir)?;

    let read = ResultDir::read(&dir)?; // checks the hashes of case and history
    let (case, history) = (read.case()?, read.join("history.csv"));
    let mut rows = Records::open(&history, &case.setup)?;
    let mut furthest = 0.0_f64;
    for record in &run.records {
        let theirs = rows.next_record()?.ok_or("a row is missing")?;
        let gap = theirs.mass_centre - record.mass_centre;
        furthest = furthest.max(gap.length());
    }
    println!(
        "{} steps, path differs by {furthest:e} m",
        run.records.len()
    );
    let summary = Summary::read(&case, &history, &read.manifest()?.outcome)?;
    for (computed, theirs) in run.beats().iter().zip(&summary.beats) {
        let lift = theirs.mean.lift_over_weight.ok_or("no weight")?;
        println!(
            "beat {}: {:.6} weights in memory, {lift:.6} on disk",
            computed.beat, computed.lift_over_weight
        );
        assert_eq!(*computed, Beat::from(theirs), "the last bit is written");
    }
    assert_eq!((furthest, summary), (0.0, run.summary()));
    let files = std::fs::read_dir(&dir)?.map(|f| Ok(f?.file_name()));
    let mut files = files.collect::<std::io::Result<Vec<_>>>()?;
    files.sort();
    println!("{}: {files:?}", dir.display());
    std::fs::remove_dir_all(&dir)?;
    Ok(())
}
