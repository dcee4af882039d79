//! How much of its wakes a lattice keeps, and how far wings go in a step.

use wingbeat_flight::FlightSetup;

use super::limit::rounded;
use super::numbers::{Estimate, WingEstimate};
use super::sizes::sizes;
use wingbeat_math::{DVec3, RotationLaw};
use wingbeat_model::Wing;

/// Way over the root of the area of both wings from which on what is left out of a wake is felt little. A rectangle of
/// aspect ratio 8 in a stream has 36, 25, 14, 7, 2.4 and 0.7 % less lift with 0.25, 0.5, 1, 2, 4 and 8 chords of wake
/// kept, one of aspect ratio 2 has 3.8, 1.3 and 0.4 % less with 1, 2 and 4.
const ROOTS: f64 = 1.4;

/// The same in wingbeats, where wings come back into their wakes. A fruit fly in hover has 19, 3, 11, 5 and 3 % more
/// lift with 0.5, 1, 1.5, 2 and 3 beats of wake kept, and its beats scatter by 2 %.
const BEATS: f64 = 1.0;

/// Way through the air in a wingbeat over the stroke of a tip from end to end from which on wings surely leave their
/// wakes behind; up to one stroke they come back into them, where it is longer than a chord \[1\].
const LEAVES: f64 = 2.0;

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
    let lattice = &setup.air.lattice()?.lattice;
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
        is_short: {
            let wakes = Wakes::of(setup, &estimate, fastest);
            let in_hover = beats.filter(|b| wakes.are_met && *b < BEATS);
            let in_hover = in_hover.map(|b| (BEATS / b, IN_HOVER));
            let in_a_stream = wakes.are_left && roots < ROOTS;
            let in_a_stream = in_a_stream.then_some((ROOTS / roots, IN_A_STREAM));
            let both = [in_hover, in_a_stream].into_iter().flatten();
            let worst = both.max_by(|a, b| a.0.total_cmp(&b.0));
            worst.map(|(times, measured)| short(times, measured))
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
        "what is left out is felt in what lift there is: {measured}; keep {} times as much, or all",
        rounded((10.0 * times).ceil() / 10.0)
    )
}

/// What becomes of wakes; both may be, in doubt.
struct Wakes {
    /// Whether wings come back into them.
    are_met: bool,
    /// Whether wings leave them behind.
    are_left: bool,
}

impl Wakes {
    /// By the way through the air in a wingbeat beside the stroke of the fastest wing.
    fn of(setup: &FlightSetup, estimate: &Estimate, fastest: &WingEstimate) -> Self {
        let Some(period) = setup.time.period else {
            return Self {
                are_met: false,
                are_left: true,
            };
        };
        let passed = estimate.flight_speed * period;
        let stroke = (setup.animal.wings.iter().map(stroke_of_tip))
            .fold(0.5 * fastest.tip_speed * period, f64::max);
        // Carried by a tether, a wing passes the air faster than the body does at the start.
        let is_carried = fastest.speed > fastest.tip_speed.max(estimate.flight_speed);
        let is_long = stroke > fastest.report.mean_chord;
        let stays = !is_carried && passed == 0.0;
        Self {
            are_met: is_carried || passed < LEAVES * stroke || passed == 0.0,
            are_left: !stays && (is_carried || passed > stroke || !is_long),
        }
    }
}

/// Farthest that two places of a tip are apart in a beat of a rigid wing, at 100 instants \[m\].
fn stroke_of_tip(wing: &Wing) -> f64 {
    let motion = wing.motion.impulsive();
    if motion.frequency == 0.0 {
        return 0.0;
    }
    let tip = wing.mesh.nodes[wing.mesh.node(0, wing.mesh.cols)];
    let at = |k: usize| motion.at(k as f64 / (100.0 * motion.frequency)).c * tip;
    let places: Vec<DVec3> = (0..100).map(at).collect();
    let ways = places
        .iter()
        .flat_map(|x| places.iter().map(|y| x.distance(*y)));
    ways.fold(0.0, f64::max)
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
