//! Wingbeats of the free fruit fly per core-second: three bodies, ten strips a wing, added mass
//! and rotation, momentum form, 100 Runge-Kutta steps a beat.

use std::hint::black_box;
use std::time::Instant;

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
    let start = Instant::now();
    black_box(wingbeat_analysis::trim(&setup, &common::hover(100)).expect("the fruit fly"));
    println!(
        "trim of hover: {:.0} ms",
        1e3 * start.elapsed().as_secs_f64()
    );
}
