//! How much of its wakes a lattice keeps, wing by wing, and how far wings go in a step.

use wingbeat_air::AirSettings;
use wingbeat_flight::FlightSetup;

use super::behind::way_to_wings_behind;
use super::limit::rounded;
use super::numbers::{Estimate, WingEstimate};
use super::revolution::Revolution;
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
    /// The way that a wing goes while a row is kept, over the mean chord of all wings \[1\].
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
    let flown = setup.time.steps as f64 * setup.time.step;
    let cuts = Cut::of(setup, lattice);
    let wings = estimate.wings.iter().enumerate();
    let cut = wings.filter_map(|(w, wing)| {
        let revolution = Revolution::of(setup, w);
        let speed = revolution.map_or(0.0, |r| r.tip_speed()).max(wing.speed);
        // Wakes of wings that beat in place stay: what is cut a wing length away is as if it were cut after a wingbeat.
        let beats = (setup.time.period).filter(|_| revolution.is_none() && wing.tip_speed > 0.0);
        let slow = beats.map_or(speed, |p| wing.report.length / p);
        let (time, key) = cuts.time_behind(slow.max(estimate.flight_speed).min(speed))?;
        let is_cut = speed > 0.0 && time < flown;
        is_cut.then_some(CutWake {
            w,
            wing,
            revolution,
            speed,
            time,
            key,
        })
    });
    let cut: Vec<CutWake> = cut.collect();
    let by_itself = cut.iter().filter_map(|wake| felt(setup, &estimate, wake));
    let left = cut
        .iter()
        .filter(|c| Wakes::of(setup, &estimate, c.wing).are_left);
    let behind = left.filter_map(|c| felt_behind(setup, c.w, cuts.reach(estimate.flight_speed)?));
    let worst = by_itself.chain(behind).max_by(|a, b| a.0.total_cmp(&b.0));
    let soonest = cut.iter().min_by(|a, b| a.time.total_cmp(&b.time))?;
    let chords = soonest.time * soonest.speed / setup.animal.mean_chord()?;
    let beats = setup.time.period.map(|p| soonest.time / p);
    let in_beats = beats.map_or(String::new(), |b| format!("{} wingbeats, ", rounded(b)));
    let turns = soonest.revolution.map(|r| soonest.time / r.period());
    let in_turns = turns.map_or(String::new(), |n| format!("{} turns, ", rounded(n)));
    Some(KeptWake {
        time: soonest.time,
        chords,
        beats,
        said: format!(
            "the wake is cut ({}): {in_beats}{in_turns}{} mean chords of the way of the wings are kept",
            soonest.key,
            rounded(chords)
        ),
        is_short: worst.map(|(times, measured)| short(times, measured)),
    })
}

/// The wake of a wing that is cut within the flight.
struct CutWake<'a> {
    w: usize,
    wing: &'a WingEstimate,
    revolution: Option<Revolution>,
    /// The speed at which the wing goes through the air [m/s].
    speed: f64,
    /// Time for which a row is kept \[s\].
    time: f64,
    /// What cuts it, with its value.
    key: String,
}

/// What cuts wakes.
struct Cut {
    rows: Option<usize>,
    step: f64,
    age: Option<f64>,
    distance: Option<f64>,
}

impl Cut {
    fn of(setup: &FlightSetup, lattice: &AirSettings) -> Self {
        Self {
            rows: lattice.max_rows.filter(|_| lattice.particles.is_none()),
            step: setup.time.step,
            age: lattice.max_age,
            distance: lattice.max_distance,
        }
    }

    /// Time for which a row that goes away from its wing with that `speed` [m/s] is kept \[s\], and the key that cuts it
    /// with its value.
    fn time_behind(&self, speed: f64) -> Option<(f64, String)> {
        let of_rows =
            (self.rows).map(|n| (n as f64 * self.step, format!("air.max_wake_rows = {n}")));
        let of_age = self
            .age
            .map(|age| (age, format!("air.max_wake_age_s = {}", rounded(age))));
        let of_way = self.distance.map(|way| {
            let said = format!("air.max_wake_distance_m = {}", rounded(way));
            (way / speed, said)
        });
        let all = [of_rows, of_age, of_way].into_iter().flatten();
        all.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// How far downstream [m] rows are kept that the air carries away with `speed` [m/s].
    fn reach(&self, speed: f64) -> Option<f64> {
        let of_rows = self.rows.map(|n| n as f64 * self.step * speed);
        let of_age = self.age.map(|age| age * speed);
        let all = [of_rows, of_age, self.distance].into_iter().flatten();
        all.reduce(f64::min)
    }
}

/// By what factor the wake of wing `w`, which goes `reach` downstream \[m\], is too short for wings behind it
/// \[1\], and what was measured of such wakes; none where what is left out is felt little, or nothing is behind
/// it.
fn felt_behind(setup: &FlightSetup, w: usize, reach: f64) -> Option<(f64, &'static str)> {
    let way = way_to_wings_behind(setup, w)?;
    (reach < way).then_some((way / reach, BEHIND))
}

/// By what factor the `wake` of a wing is too short for the wing itself \[1\], and what was measured of such wakes;
/// none where what is left out is felt little.
fn felt(setup: &FlightSetup, estimate: &Estimate, wake: &CutWake) -> Option<(f64, &'static str)> {
    let (wing, time) = (wake.wing, wake.time);
    let sides = setup.animal.wings.len().min(2) as f64;
    let roots = time * wake.speed / (sides * wing.report.area).sqrt();
    let wakes = Wakes::of(setup, estimate, wing);
    let in_turns = (wake.revolution).and_then(|r| r.felt(time, estimate.flight_speed));
    let beats = setup.time.period.map(|p| time / p);
    let flaps = wake.revolution.is_none() || wing.tip_speed > 0.0;
    let in_hover = beats.filter(|b| flaps && wakes.are_met && *b < BEATS);
    let in_hover = in_hover.map(|b| (BEATS / b, IN_HOVER));
    let in_a_stream = wakes.are_left && roots < ROOTS;
    let in_a_stream = in_a_stream.then_some((ROOTS / roots, IN_A_STREAM));
    let all = [in_turns, in_hover, in_a_stream].into_iter().flatten();
    all.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// What was measured of short wakes.
const IN_HOVER: &str =
    "lift in hover came out 19 % high with half a wingbeat, 3 to 11 % with one to three";
const IN_A_STREAM: &str = "lift of an attached wing in a stream came out 36, 14, 7 and 2 % low with 0.25, 1, 2 and 4 chords at an aspect ratio of 8, of a plane section at 30 deg whose leading edge sheds 13, 6 and 2 % high with 1.5, 3 and 6 chords";

/// The tail, of half the span, four and eight chords behind: with a wake that ends a quarter, a half and a
/// whole wing length beyond it its lift is 21 to 30, 10 to 13 and 4 % low.
const BEHIND: &str = "a tail behind a wing of aspect ratio 8 had 41 to 70 % more lift where the wake of the wing ended ahead of it, 52 to 91 % less where it ended at it, and 4 % less with a wing length more";

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
    /// By the way of `wing` through the air in a wingbeat beside the longest stroke.
    fn of(setup: &FlightSetup, estimate: &Estimate, wing: &WingEstimate) -> Self {
        let Some(period) = setup.time.period else {
            return Self {
                are_met: false,
                are_left: true,
            };
        };
        let passed = estimate.flight_speed * period;
        let stroke = (setup.animal.wings.iter().map(stroke_of_tip))
            .fold(0.5 * wing.tip_speed * period, f64::max);
        // Carried by a tether, a wing passes the air faster than the body does at the start.
        let is_carried = wing.speed > wing.tip_speed.max(estimate.flight_speed);
        let is_long = stroke > wing.report.mean_chord;
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

/// The longest way of a tip in a step over the mean chord of its wing \[1\]; 0 where nothing goes.
pub fn way_in_a_step(setup: &FlightSetup) -> f64 {
    let way = |w: &WingEstimate| w.speed * setup.time.step / w.report.mean_chord;
    sizes(setup).wings.iter().map(way).fold(0.0, f64::max)
}
