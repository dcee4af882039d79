//! Flights and refusals that several tests look at.

use std::path::Path;

use wingbeat_case::LoadedCase;
use wingbeat_flight::{FlightError, FlightSetup, Record, Simulation};

/// The records of a flight, that of its start first.
pub fn fly(setup: FlightSetup) -> Vec<Record> {
    let flown = Simulation::new(setup).and_then(|mut flight| go_on(&mut flight));
    flown.unwrap_or_else(|e| panic!("{e}"))
}

/// The records of a flight from where it stands to its end.
pub fn go_on(flight: &mut Simulation) -> Result<Vec<Record>, FlightError> {
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        records.push(flight.step()?.clone());
    }
    Ok(records)
}

/// The case of this text with overrides, and why there is none.
pub fn load(text: &str, set: &[&str]) -> Result<LoadedCase, String> {
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    LoadedCase::from_text("case.toml", text, Path::new(""), &set).map_err(|e| e.to_string())
}

/// A preset with overrides, and why there is none.
pub fn found(preset: &str, set: &[&str]) -> Result<LoadedCase, String> {
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    LoadedCase::find(preset, &set).map_err(|e| e.to_string())
}

/// A preset with overrides.
pub fn preset(name: &str, set: &[&str]) -> LoadedCase {
    found(name, set).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// What is said about a preset with overrides.
pub fn refusal(preset: &str, set: &[&str]) -> String {
    found(preset, set).expect_err(preset)
}
