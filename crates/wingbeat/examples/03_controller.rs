//! A controller of one's own: holds the height by the amplitude of the strokes.
//! `cargo run --release --example 03_controller`

use wingbeat::prelude::*;

/// Proportional-derivative feedback of height; n3 points down.
#[derive(Clone, Debug)]
struct HoldHeight {
    /// Relative amplitude per metre and per metre per second.
    gains: [f64; 2],
    wings: usize,
}

impl Controller for HoldHeight {
    fn command(&mut self, sensed: &Sensed) -> Result<Vec<Adjustment>, String> {
        let [stiffness, damping] = self.gains;
        let amplitude = stiffness * sensed.centre.z + damping * sensed.velocity.z;
        let all = Adjustment {
            stroke_amplitude: amplitude.clamp(-0.2, 0.2),
            ..Adjustment::default()
        };
        Ok(vec![all; self.wings])
    }
}

pub(crate) fn main() -> Result<(), Error> {
    let flight = Flight::preset("fruit-fly-blade")?.beats(10.0);
    let free = flight.fly()?;
    let controller = HoldHeight {
        gains: [300.0, 3.0],
        wings: flight.setup.animal.wings.len(),
    };
    let interval = free.setup.time.steps_per_beat().expect("it flaps");
    let held = flight.feedback(Feedback {
        controller: std::sync::Arc::new(controller),
        interval,
        latency: 0,
        lag: 0.0,
    });
    for (name, run) in [("free", free), ("held", held.fly()?)] {
        let end = run.records.last().expect("a start at least");
        println!("{name}: {:+.3} mm", -1e3 * end.mass_centre.z);
    }
    Ok(())
}
