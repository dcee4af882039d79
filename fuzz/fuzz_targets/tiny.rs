//! Flights of a few panels, whose states are small.

use wingbeat_flight::Simulation;
use wingbeat_case::LoadedCase;

/// Preset and overrides of each flight.
const FLIGHTS: [(&str, &[&str]); 5] = [
    ("fruit-fly-vacuum", &[]),
    ("fruit-fly-blade", &[]),
    ("fruit-fly-tethered", &["air.body=false"]),
    (
        "fruit-fly-hover",
        &["air.body=false", "flight.held_beats=0.05"],
    ),
    (
        "rectangular-wing",
        &["air.particles={after_rows=2, radius_m=0.01}"],
    ),
];

/// How many there are.
pub const COUNT: usize = FLIGHTS.len();

/// The flight at its start.
pub fn flight(number: usize) -> Simulation {
    let (preset, set) = FLIGHTS[number];
    let mesh = ["wing.right.mesh.chordwise=1", "wing.right.mesh.spanwise=2"];
    let set: Vec<String> = set.iter().chain(&mesh).map(|s| (*s).to_owned()).collect();
    let case = LoadedCase::find(preset, &set).expect("a preset");
    Simulation::new(case.setup).expect("a preset")
}
