//! `[time]`: the grid of steps.

use wingbeat_flight::TimeGrid;

use super::{Built, at_least, at_most, positive};
use crate::error::Fault;
use crate::raw::Case;

/// Steps per wingbeat where the case does not say.
const STEPS_PER_BEAT: usize = 40;
/// Wingbeats where the case does not say.
const BEATS: f64 = 5.0;
/// Steps at most: the history would have a terabyte.
const MOST_STEPS: usize = 1_000_000_000;

/// The time grid. Defaults are filled into the case.
pub(super) fn grid(case: &mut Case) -> Built<TimeGrid> {
    let frequency = case.motion.frequency_hz.unwrap_or(0.0);
    let time = &mut case.time;
    if time.step_s.is_some() && time.steps_per_beat.is_some() {
        return Err(Fault::new(
            "time.step_s",
            "the step is given twice",
            "steps_per_beat or step_s",
            "remove one of them",
        ));
    }
    if time.steps.is_some() && time.beats.is_some() {
        return Err(Fault::new(
            "time.steps",
            "the length of the flight is given twice",
            "beats or steps",
            "remove one of them",
        ));
    }
    let period = (frequency > 0.0).then(|| 1.0 / frequency);
    let step = match (time.step_s, period) {
        (Some(step), _) => positive("time.step_s", step)?,
        (None, Some(period)) => {
            let n = *time.steps_per_beat.get_or_insert(STEPS_PER_BEAT);
            period / at_least("time.steps_per_beat", n, 4)? as f64
        }
        (None, None) => return Err(no_beat("time.step_s", "step_s")),
    };
    let steps = match (time.steps, period) {
        (Some(steps), _) => at_least("time.steps", steps, 1)?,
        (None, Some(period)) => {
            let beats = positive("time.beats", *time.beats.get_or_insert(BEATS))?;
            ((beats * period / step).round() as usize).max(1)
        }
        (None, None) => return Err(no_beat("time.steps", "steps")),
    };
    let key = if time.steps.is_some() {
        "time.steps"
    } else {
        "time.beats"
    };
    at_most(
        key,
        steps,
        MOST_STEPS,
        "fly less long, or with longer steps",
    )?;
    Ok(TimeGrid {
        step,
        steps,
        period,
    })
}

fn no_beat(key: &str, name: &str) -> Fault {
    Fault::new(
        key,
        "this key is missing: without a wingbeat frequency, time cannot be counted in beats",
        "step_s and steps",
        format!("add `{name} = ...` to [time], or frequency_hz to [motion]"),
    )
}
