//! Ways to waypoints that no flyer covers in their time.

use wingbeat_analysis::Estimate;
use wingbeat_math::DVec3;

use crate::loaded::LoadedCase;

/// Fastest speed on a way over its mean: of the polynomial by which it is flown ([`wingbeat_math::smoothstep7`]).
const FASTEST: f64 = 35.0 / 16.0;

/// Speed over the mean speed of the wing tips that no flyer that flaps reaches: insects fly at up to 1,
/// cruising birds at up to 2.5.
const SWIFT: f64 = 3.0;

impl LoadedCase {
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
