//! `[time]`: the grid of steps.

use wingbeat_flight::TimeGrid;

use crate::build::fault::Built;
use crate::error::Fault;
use crate::raw::Case;

/// Steps at most: the history would have a terabyte.
const MAX_STEPS: usize = 1_000_000_000;

/// The time grid.
pub(crate) fn grid(case: &Case) -> Built<TimeGrid> {
    let (time, frequency) = (&case.time, case.motion.frequency_hz.value());
    let period = (frequency > 0.0).then(|| 1.0 / frequency);
    let step = match (time.step_s, period, time.steps_per_beat) {
        (Some(step), _, _) => step,
        (None, Some(period), Some(n)) => period / n as f64,
        _ => return Err(no_beat("time.step_s", "step_s")),
    };
    let (key, steps) = match (time.steps, period, time.beats) {
        (Some(steps), _, _) => ("time.steps", steps as f64),
        (None, Some(period), Some(beats)) => ("time.beats", counted(beats, period / step)?),
        _ => return Err(no_beat("time.steps", "steps")),
    };
    if steps > MAX_STEPS as f64 {
        // Beyond what counts exactly, a power of ten says more than its digits.
        let shown = match steps < 1e15 {
            true => format!("{steps:.0}"),
            false => format!("{steps:.3e}"),
        };
        return Err(Fault::new(
            key,
            format!("{shown} steps are too many"),
            format!("as much as {MAX_STEPS} steps make"),
            "fly fewer beats, or with longer steps",
        ));
    }
    Ok(TimeGrid {
        step,
        steps: steps as usize,
        period,
    })
}

/// Whole steps in so many wingbeats of `each` steps \[1\].
fn counted(beats: f64, each: f64) -> Built<f64> {
    let steps = (beats * each).round();
    match steps < 1.0 {
        true => Err(Fault::new(
            "time.beats",
            format!(
                "this is {:.2e} of a step, and not one is flown",
                beats * each
            ),
            format!("a step or more: {:.3e} wingbeats are one", 1.0 / each),
            "fly longer, or give `steps` in place of `beats`",
        )),
        false => Ok(steps),
    }
}

fn no_beat(key: &str, name: &str) -> Fault {
    Fault::new(
        key,
        "this key is missing: without a wingbeat frequency, time cannot be counted in beats",
        "step_s and steps",
        format!("add `{name} = ...` to [time], or frequency_hz to [motion]"),
    )
}
