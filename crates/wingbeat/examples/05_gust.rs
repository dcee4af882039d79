//! A gust from the side meets a fruit fly in blade elements: how far it is carried off.
//! `cargo run --release --example 05_gust`

use wingbeat::prelude::*;

/// From the left (n2 points right), once from nothing to 0.5 m/s and back within two wingbeats.
fn side_gust(period: f64) -> Gust {
    Gust {
        amplitude: DVec3::new(0.0, 0.5, 0.0), // m/s
        start: period,                        // s
        slowness: DVec3::ZERO,                // everywhere at once
        shape: GustShape::OneMinusCosine {
            duration: 2.0 * period,
        },
    }
}

/// Path in the gust less path without it [m], wingbeat by wingbeat.
pub(crate) fn carried_off() -> Result<Vec<DVec3>, Error> {
    let flight = Flight::preset("fruit-fly-blade")?.beats(5.0);
    let period = flight.setup.time.period.expect("it flaps");
    let calm = flight.fly()?;
    let gusty = flight.gust(side_gust(period))?.fly()?;
    let steps = calm.setup.time.steps_per_beat().expect("it flaps");
    let both = calm.records.iter().zip(&gusty.records).step_by(steps);
    Ok(both.map(|(a, b)| b.mass_centre - a.mass_centre).collect())
}

pub(crate) fn main() -> Result<(), Error> {
    for (beat, gap) in carried_off()?.iter().enumerate() {
        let [forward, right, down] = (1e6 * *gap).to_array();
        println!(
            "after beat {beat}: {forward:+9.3} um forward, {right:+9.3} right, {:+9.3} up",
            -down
        );
    }
    Ok(())
}
