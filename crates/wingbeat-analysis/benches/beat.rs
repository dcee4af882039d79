//! Wingbeats of the free fruit fly per core-second: three bodies, ten strips a wing, added mass
//! and rotation, momentum form, 100 steps a beat; as the map of a beat (Runge-Kutta) and as a flight with its
//! records (Hamming's method), which take turns, so that other work on the machine meets both alike.
//!
//! `cargo bench -p wingbeat-analysis --bench beat`

use std::hint::black_box;
use std::time::Instant;

use wingbeat_analysis::Beat;
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
