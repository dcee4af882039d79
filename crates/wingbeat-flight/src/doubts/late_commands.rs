//! Controllers that the flight is too short for: commands that begin to act only after its end, a single look, waypoints
//! that are to be reached later.

use crate::setup::{Feedback, FlightSetup, MotionMode};

impl FlightSetup {
    /// Says that no command of the controller acts within the flight: its latency is as long as what is flown after the
    /// release.
    pub fn commands_too_late(&self) -> Option<String> {
        let (feedback, steps) = self.steered()?;
        let waits = feedback.latency * feedback.interval;
        (waits >= steps).then(|| {
            let [latency, flown] = [waits, steps].map(|n| n as f64 * self.time.step);
            format!(
                "commands begin to act {latency:.3} s after the look that they follow from (control.latency_beats), and the flight ends {flown:.3} s after the release: none acts; give control.latency_beats less, or fly longer (time)"
            )
        })
    }

    /// Says that the controller looks but once, at the release, where what it is to hold has not been left.
    pub fn single_look(&self) -> Option<String> {
        let (feedback, steps) = self.steered()?;
        let every = feedback.controller.every();
        (every > 1 && every * feedback.interval >= steps).then(|| {
            let flown = steps as f64 * self.time.step;
            format!(
                "the controller looks every {every} wingbeats (control.every_beats), and the flight ends {flown:.3} s after the release: it looks once, at the release; give control.every_beats less, or fly longer (time)"
            )
        })
    }

    /// Says which waypoints are to be reached only after the end of the flight.
    pub fn late_waypoints(&self) -> Option<String> {
        let (feedback, steps) = self.steered()?;
        let flown = steps as f64 * self.time.step;
        let arrivals = feedback.controller.arrivals();
        let is_late = |time: &f64| *time > flown + 0.5 * self.time.step;
        let first = arrivals.iter().position(is_late)?;
        let which = match arrivals.len() - first {
            1 => format!("control.waypoint[{first}] is"),
            _ => format!("the waypoints from control.waypoint[{first}] on are"),
        };
        Some(format!(
            "{which} to be reached after the end of the flight: time_s = {} and the flight ends {flown:.3} s after the release; fly longer (time), or give an earlier time_s",
            arrivals[first]
        ))
    }

    /// The feedback, and the steps from the release to the end of the flight; none if nothing is steered within it.
    fn steered(&self) -> Option<(&Feedback, usize)> {
        let feedback = self.feedback.as_ref()?;
        let MotionMode::Free(start) = &self.mode else {
            return None;
        };
        let steps = self.time.steps.checked_sub(start.held_steps);
        let steps = steps.filter(|&steps| steps > 0)?; // else it is held to its end
        Some((feedback, steps))
    }
}
