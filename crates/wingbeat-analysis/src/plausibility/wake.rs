//! How much of its wakes a lattice keeps, and how far wings go in a step.

use wingbeat_flight::{AirModel, FlightSetup};

use super::limit::rounded;
use super::numbers::WingEstimate;
use super::sizes::sizes;

/// Way over the root of the area of both wings from which on what is left out of a wake is felt little. A rectangle of
/// aspect ratio 8 in a stream has 36, 25, 14, 7, 2.4 and 0.7 % less lift with 0.25, 0.5, 1, 2, 4 and 8 chords of wake
/// kept, one of aspect ratio 2 has 3.8, 1.3 and 0.4 % less with 1, 2 and 4.
const ROOTS: f64 = 1.4;

/// The same in wingbeats, where wings come back into their wakes. A fruit fly in hover has 19, 3, 11, 5 and 3 % more
/// lift with 0.5, 1, 1.5, 2 and 3 beats of wake kept, and its beats scatter by 2 %.
const BEATS: f64 = 1.0;

/// Wing lengths through the air in a wingbeat below which wings come back into their wakes \[1\].
const PASSES: f64 = 2.0;

/// What a lattice keeps of wakes that it cuts within the flight.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptWake {
    /// Time for which a row is kept [s].
    pub time: f64,
    /// The way that the fastest wing goes while a row is kept, over its mean chord \[1\].
    pub chords: f64,
    /// The time for which a row is kept in wingbeats \[1\]; none without.
    pub beats: Option<f64>,
    /// What cuts, and how much it keeps, in words.
    pub said: String,
    /// Why what is left out is felt in the forces, and what to do, in words; none where it is felt little.
    pub is_short: Option<String>,
}

/// What is kept of wakes that are cut before the flight ends; none where all is kept, or where rows that are too many
/// become particles.
pub fn kept_wake(setup: &FlightSetup) -> Option<KeptWake> {
    let AirModel::VortexLattice(air) = &setup.air else {
        return None;
    };
    let lattice = &air.lattice;
    if setup.animal.wings.is_empty() || !lattice.shedding.any() {
        return None;
    }
    let estimate = sizes(setup);
    let fastest = fastest(&estimate.wings)?;
    let in_chords = fastest.speed / fastest.report.mean_chord;
    let flown = setup.time.steps as f64 * setup.time.step;
    let rows = lattice.max_rows.filter(|_| lattice.particles.is_none());
    let of_rows = rows.map(|n| {
        (
            n as f64 * setup.time.step,
            format!("air.max_wake_rows = {n}"),
        )
    });
    let of_age =
        (lattice.max_age).map(|age| (age, format!("air.max_wake_age_s = {}", rounded(age))));
    let of_way = lattice.max_distance.map(|way| {
        let said = format!("air.max_wake_distance_m = {}", rounded(way));
        (way / fastest.speed, said)
    });
    let all = [of_rows, of_age, of_way].into_iter().flatten();
    let (time, key) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    if time >= flown {
        return None;
    }
    let (chords, beats) = (time * in_chords, setup.time.period.map(|p| time / p));
    let sides = setup.animal.wings.len().min(2) as f64;
    let roots = time * fastest.speed / (sides * fastest.report.area).sqrt();
    let in_beats = beats.map_or(String::new(), |b| format!("{} wingbeats, ", rounded(b)));
    Some(KeptWake {
        time,
        chords,
        beats,
        said: format!(
            "the wake is cut ({key}): {in_beats}{} mean chords of the way of the wings are kept",
            rounded(chords)
        ),
        is_short: match comes_back(setup, estimate.flight_speed) {
            true => beats
                .filter(|b| *b < BEATS)
                .map(|b| short(BEATS / b, IN_HOVER)),
            false => (roots < ROOTS).then(|| short(ROOTS / roots, IN_A_STREAM)),
        },
    })
}

/// What was measured of short wakes.
const IN_HOVER: &str =
    "lift in hover came out 19 % high with half a wingbeat, 3 to 11 % with one to three";
const IN_A_STREAM: &str = "lift in a stream came out 36, 14, 7 and 2 % low with 0.25, 1, 2 and 4 chords at an aspect ratio of 8";

/// What wakes that are too short do, by the part that they should be longer.
fn short(times: f64, measured: &str) -> String {
    format!(
        "what is left out is felt: {measured}; keep {} times as much, or all",
        rounded((10.0 * times).ceil() / 10.0)
    )
}

/// Whether wings come back into their wakes.
fn comes_back(setup: &FlightSetup, flight_speed: f64) -> bool {
    let length = setup.animal.wing_length();
    (setup.time.period).is_some_and(|period| flight_speed * period < PASSES * length)
}

/// The wing that goes fastest; none if none goes.
fn fastest(wings: &[WingEstimate]) -> Option<&WingEstimate> {
    let moving = wings.iter().filter(|w| w.speed > 0.0);
    moving.max_by(|a, b| a.speed.total_cmp(&b.speed))
}

/// Way of the fastest tip in a step over the mean chord of its wing \[1\]; 0 where nothing goes.
pub fn way_in_a_step(setup: &FlightSetup) -> f64 {
    let estimate = sizes(setup);
    let way = |w: &WingEstimate| w.speed * setup.time.step / w.report.mean_chord;
    fastest(&estimate.wings).map_or(0.0, way)
}
