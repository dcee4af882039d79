//! A hovering fruit fly: its trim as a periodic orbit, and Floquet's modes of that orbit.
//! `cargo run --release --example 06_trim_and_modes`

use wingbeat::analysis::{ModeSet, Trim, floquet};
use wingbeat::prelude::*;

/// The trimmed flight and its modes.
pub(crate) fn hover() -> Result<(Trim, ModeSet), Error> {
    let flight = Flight::preset("fruit-fly-blade")?;
    let mut hover = flight.hover();
    hover.settings.steps = 60; // of order four, per wingbeat
    let trim = flight.trim(&hover)?;
    let modes = floquet(&trim.beat, &trim.state)?;
    Ok((trim, modes))
}

pub(crate) fn main() -> Result<(), Error> {
    let (trim, modes) = hover()?;
    let found = &trim.solution;
    println!(
        "residual {:.1e} after {} Newton steps: body pitch {:.2} deg, stroke amplitude {:+.2} %, mean stroke {:+.2} deg",
        found.error(),
        found.iterations,
        found.body_pitch.to_degrees(),
        100.0 * found.adjustment.stroke_amplitude,
        found.adjustment.stroke_offset.to_degrees(),
    );
    for mode in &modes.modes {
        let period = mode.period().map_or("none".into(), |t| format!("{t:.3} s"));
        println!(
            "{:<13} {:<22} growth {:+9.3} 1/s, period {period}",
            format!("{:?}", mode.plane),
            mode.name,
            mode.growth,
        );
    }
    Ok(())
}
