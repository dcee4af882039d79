//! Commands of a controller that begin to act only after the end of the flight.

use crate::setup::{FlightSetup, MotionMode};

impl FlightSetup {
    /// Says that no command of the controller acts within the flight: its latency is as long as what is flown after the
    /// release.
    pub fn commands_too_late(&self) -> Option<String> {
        let feedback = self.feedback.as_ref()?;
        let MotionMode::Free(start) = &self.mode else {
            return None;
        };
        let steps = self.time.steps.checked_sub(start.held_steps);
        let steps = steps.filter(|&steps| steps > 0)?; // else it is held to its end
        let flown = steps as f64 * self.time.step;
        let waits = feedback.latency * feedback.interval;
        (waits >= steps).then(|| {
            let latency = waits as f64 * self.time.step;
            format!(
                "commands begin to act {latency:.3} s after the look that they follow from (control.latency_beats), and the flight ends {flown:.3} s after the release: none acts; give control.latency_beats less, or fly longer (time)"
            )
        })
    }
}
