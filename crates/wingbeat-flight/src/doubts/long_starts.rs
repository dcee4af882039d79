//! Smooth starts that are not over when the flight is, or its hold.

use wingbeat_model::Start;

use super::starts_apart::tether;
use crate::setup::{FlightSetup, MotionMode};

/// Part of a smooth start that is rounding of the steps \[1\].
const ROUNDING: f64 = 1e-6;

impl FlightSetup {
    /// Longest smooth starts of the strokes of the wings, and of the tether that moves the body while it is held \[s\];
    /// 0 of what starts at once, or does not move.
    pub fn smooth_starts(&self) -> [f64; 2] {
        let wings = self.animal.wings.iter().filter(|w| !w.is_still());
        let strokes = wings.map(|w| duration(&w.motion.start));
        let tether = tether(&self.mode).filter(|t| self.is_held() && !t.rests());
        [
            strokes.fold(0.0, f64::max),
            tether.map_or(0.0, |t| duration(&t.start)),
        ]
    }

    /// Says which smooth starts last longer than the flight, or than the hold of the body that they move.
    pub fn starts_that_do_not_end(&self) -> Vec<String> {
        let end = self.time.steps as f64 * self.time.step;
        let [strokes, tether] = self.smooth_starts();
        let hold = match &self.mode {
            MotionMode::Free(start) => end.min(start.held_steps as f64 * self.time.step),
            MotionMode::Tethered(_) => end,
        };
        let lasts = |start: f64, until: f64| start > until * (1.0 + ROUNDING);
        let mut list = vec![];
        if lasts(strokes, end) {
            list.push(format!(
                "the strokes start smoothly over {strokes:.3} s (motion.start_beats), and the flight lasts {end:.3} s: the wings never beat at their frequency and with their whole amplitude; give motion.start_beats less, or fly longer (time)"
            ));
        }
        if lasts(tether, hold) {
            let until = match hold < end {
                true => {
                    format!("the body is held for {hold:.3} s (flight.held_beats, flight.held_s)")
                }
                false => format!("the flight lasts {end:.3} s"),
            };
            list.push(format!(
                "the tether starts smoothly over {tether:.3} s (flight.tether.start_s), and {until}: it never moves at its whole rate; give flight.tether.start_s less, or more time"
            ));
        }
        list
    }

    fn is_held(&self) -> bool {
        match &self.mode {
            MotionMode::Tethered(_) => true,
            MotionMode::Free(start) => start.held_steps > 0,
        }
    }
}

fn duration(start: &Start) -> f64 {
    match *start {
        Start::Impulsive => 0.0,
        Start::Smooth { duration } => duration,
    }
}
