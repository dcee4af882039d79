//! A preset at another frequency, its lift beat by beat.
//! `cargo run --release --example 01_first_flight`

use wingbeat::prelude::*;

pub(crate) fn main() -> Result<(), Error> {
    let run = Flight::preset("fruit-fly-blade")?
        .frequency_hz(210.0)
        .beats(5.0)
        .fly()?;
    for beat in run.beats() {
        println!("beat {}: {:.3} weights", beat.beat, beat.lift_over_weight);
    }
    Ok(())
}
