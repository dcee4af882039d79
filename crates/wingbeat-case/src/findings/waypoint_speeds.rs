//! Ways to waypoints that no flyer covers in their time, or that the flight is too short for; looks that it is too
//! short for.

use wingbeat_analysis::Estimate;
use wingbeat_flight::MotionMode;
use wingbeat_math::DVec3;

use crate::loaded::LoadedCase;

/// Fastest speed on a way over its mean: of the polynomial by which it is flown ([`wingbeat_math::smoothstep7`]).
const FASTEST: f64 = 35.0 / 16.0;

/// Speed over the mean speed of the wing tips that no flyer that flaps reaches: insects fly at up to 1,
/// cruising birds at up to 2.5.
const SWIFT: f64 = 3.0;

impl LoadedCase {
    /// Which waypoints are to be reached only after the end of the flight, in a sentence.
    pub fn late_waypoints(&self) -> Option<String> {
        let control = self.raw.control.as_ref()?;
        self.setup.feedback.as_ref()?;
        let MotionMode::Free(start) = &self.setup.mode else {
            return None;
        };
        let time = &self.setup.time;
        let flown = time.steps.saturating_sub(start.held_steps) as f64 * time.step;
        let is_late = |t: f64| t > flown + 0.5 * time.step;
        let first = control.waypoint.iter().position(|w| is_late(w.time_s))?;
        let which = match control.waypoint.len() - first {
            1 => format!("control.waypoint[{first}] is"),
            _ => format!("the waypoints from control.waypoint[{first}] on are"),
        };
        Some(format!(
            "{which} to be reached after the end of the flight: time_s = {} and the flight ends {flown:.3} s after the release; fly longer (time), or give an earlier time_s",
            control.waypoint[first].time_s
        ))
    }

    /// That a controller looks but once, at the release, where what it is to hold has not been left, in a sentence.
    pub fn single_look(&self) -> Option<String> {
        let every = self.raw.control.as_ref()?.every_beats;
        let feedback = self.setup.feedback.as_ref().filter(|_| every > 1)?;
        let MotionMode::Free(start) = &self.setup.mode else {
            return None;
        };
        let time = &self.setup.time;
        let steps = time.steps.saturating_sub(start.held_steps);
        (steps > 0 && every * feedback.interval >= steps).then(|| {
            format!(
                "the controller looks every {every} wingbeats (control.every_beats), and the flight ends {:.3} s after the release: it looks once, at the release; give control.every_beats less, or fly longer (time)",
                steps as f64 * time.step
            )
        })
    }

    /// Which ways to waypoints are too fast for a flyer of these numbers, in sentences.
    pub fn doubtful_ways(&self, estimate: &Estimate) -> Vec<String> {
        let control = self.raw.control.as_ref();
        let Some(control) = control.filter(|_| self.setup.feedback.is_some()) else {
            return vec![];
        };
        let tips = estimate.wings.iter().map(|w| w.tip_speed);
        let tips = tips.fold(0.0, f64::max);
        let (mut time, mut place) = (0.0, DVec3::ZERO);
        let mut doubts = vec![];
        for (k, w) in control.waypoint.iter().enumerate() {
            let to = w.position_m.map_or(place, DVec3::from_array);
            let speed = FASTEST * to.distance(place) / (w.time_s - time);
            if speed > SWIFT * tips {
                doubts.push(format!(
                    "control.waypoint[{k}]: the way there takes up to {speed:.3} m/s, {:.1} times the mean speed of the wing tips, and no flyer that flaps is faster than {SWIFT} times that: is position_m in metres, and time_s in seconds?",
                    speed / tips
                ));
            }
            (time, place) = (w.time_s, to);
        }
        doubts
    }
}
