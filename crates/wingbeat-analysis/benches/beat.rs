//! Wingbeats of the free fruit fly per core-second: three bodies, ten strips a wing, added mass
//! and rotation, momentum form, 100 steps a beat; as the map of a beat (Runge-Kutta) and as a flight with its
//! records (Hamming's method), which take turns, so that other work on the machine meets both alike.
//!
//! `cargo bench -p wingbeat-analysis --bench beat`

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use wingbeat_analysis::Beat;
use wingbeat_analysis::episode::{Course, Episode, OBSERVED, Task};
use wingbeat_flight::{FlightSetup, Simulation};

#[path = "../tests/common/mod.rs"]
mod common;

/// Wingbeats of a burst.
const BEATS: usize = 50;

fn main() {
    let setup = common::fly();
    let beat = Beat::new(&setup, 100).expect("the fruit fly");
    let trimmed = wingbeat_analysis::trim(&setup, &common::hover(100)).expect("the fruit fly");
    let (mut map, mut flight) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..40 {
        map = map.min(seconds(|| {
            let mut y = trimmed.state.clone();
            for _ in 0..BEATS {
                y = black_box(beat.advance(black_box(&y)).expect("the fruit fly"));
            }
        }));
        flight = flight.min(seconds(|| fly(&setup)));
    }
    let per_second = |time: f64| BEATS as f64 / time;
    println!(
        "wingbeats per core-second: map of a beat {:.0}, flight {:.0}",
        per_second(map),
        per_second(flight)
    );
    let trim = seconds(|| {
        black_box(wingbeat_analysis::trim(&setup, &common::hover(100)).expect("the fruit fly"));
    });
    println!("trim of hover: {:.0} ms", 1e3 * trim);
    for (many, interval) in [(1, 40), (1, 1), (64, 1), (256, 1)] {
        episodes(many, interval);
    }
}

/// Flies [`BEATS`] wingbeats.
fn fly(setup: &FlightSetup) {
    let mut setup = setup.clone();
    setup.time.steps = 100 * BEATS;
    let mut flight = Simulation::new(setup).expect("the fruit fly");
    while !flight.finished() {
        black_box(flight.step().expect("the fruit fly"));
    }
}

/// How long `work` takes \[s\].
fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Control steps of `many` episodes of hover that take turns, 40 Runge-Kutta steps a beat, one control every
/// `interval` steps.
fn episodes(many: usize, interval: usize) {
    let trim = wingbeat_analysis::trim(&common::fly(), &common::hover(40)).expect("the fruit fly");
    let mut course = Course::new(Task::Hover, trim).expect("the fruit fly");
    (course.interval, course.beats) = (interval, usize::MAX);
    let course = Arc::new(course);
    let model = course.model().expect("the fruit fly");
    let episode =
        |seed| Episode::new(Arc::clone(&course), &model, seed as u64).expect("the fruit fly");
    let mut list: Vec<Episode> = (0..many).map(episode).collect();
    let (mut best, mut seen) = (f64::INFINITY, [0.0; OBSERVED]);
    let count = (4000 / interval / many).max(40 / interval);
    for _ in 0..20 {
        list.iter_mut()
            .try_for_each(|e| e.reset(None))
            .expect("the fruit fly");
        let time = seconds(|| {
            for _ in 0..count {
                for episode in &mut list {
                    black_box(episode.step(black_box(&[0.01; 4])));
                    episode.observe(black_box(&mut seen));
                }
            }
        });
        best = best.min(time / (count * many) as f64);
    }
    println!(
        "{many} episodes: {:.0} control steps, {:.0} wingbeats per core-second",
        1.0 / best,
        interval as f64 / 40.0 / best
    );
}
