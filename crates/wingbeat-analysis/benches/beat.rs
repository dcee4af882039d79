//! Wingbeats of the free fruit fly per core-second: three bodies, ten strips a wing, added mass
//! and rotation, momentum form, 100 Runge-Kutta steps a beat.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use wingbeat_analysis::episode::{Course, Episode, OBSERVED, Task};

#[path = "../tests/common/mod.rs"]
mod common;

fn main() {
    let setup = common::fly();
    let beat = wingbeat_analysis::Beat::new(&setup, 100).expect("the fruit fly");
    let trimmed = wingbeat_analysis::trim(&setup, &common::hover(100)).expect("the fruit fly");
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let start = Instant::now();
        let mut y = trimmed.state.clone();
        for _ in 0..100 {
            y = black_box(beat.advance(black_box(&y)).expect("the fruit fly"));
        }
        best = best.min(start.elapsed().as_secs_f64() / 100.0);
    }
    println!("free flight: {:.0} wingbeats per core-second", 1.0 / best);
    for interval in [40, 1] {
        episode(interval);
    }
    let start = Instant::now();
    black_box(wingbeat_analysis::trim(&setup, &common::hover(100)).expect("the fruit fly"));
    println!(
        "trim of hover: {:.0} ms",
        1e3 * start.elapsed().as_secs_f64()
    );
}

/// Control steps of an episode of hover, 40 Runge-Kutta steps a beat, one control every `interval` steps.
fn episode(interval: usize) {
    let trim = wingbeat_analysis::trim(&common::fly(), &common::hover(40)).expect("the fruit fly");
    let mut course = Course::new(Task::Hover, trim).expect("the fruit fly");
    (course.interval, course.beats) = (interval, usize::MAX);
    let mut episode = Episode::new(Arc::new(course), 1).expect("the fruit fly");
    let (mut best, mut seen, count) = (f64::INFINITY, [0.0; OBSERVED], 4000 / interval);
    for seed in 0..20 {
        episode.reset(Some(seed)).expect("the fruit fly");
        let start = Instant::now();
        for _ in 0..count {
            black_box(episode.step(black_box(&[0.01; 4])));
            episode.observe(black_box(&mut seen));
        }
        best = best.min(start.elapsed().as_secs_f64() / count as f64);
    }
    println!(
        "episode: {:.0} control steps, {:.0} wingbeats per core-second",
        1.0 / best,
        interval as f64 / 40.0 / best
    );
}
