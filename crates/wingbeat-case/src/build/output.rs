//! `[output]`.

use std::time::Duration;

use super::{Built, not_negative};
use crate::error::Fault;
use crate::output::{OutputSettings, SaveSettings};
use crate::raw::OutputCase;

/// What is written and when the state is saved.
pub(crate) fn output(case: &OutputCase) -> Built<OutputSettings> {
    let key = "output.checkpoint_interval_s";
    let seconds = not_negative(key, case.checkpoint_interval_s)?;
    let interval = Duration::try_from_secs_f64(seconds).map_err(|_| {
        Fault::new(
            key,
            "this is longer than time can be counted",
            "a finite number >= 0",
            "20 is the default; 0 saves by steps only",
        )
    })?;
    Ok(OutputSettings {
        frames_every: case.frames_every,
        figures: case.figures,
        page: case.page,
        save: SaveSettings {
            every: case.checkpoint_every,
            interval,
            keep: case.keep_checkpoint,
        },
    })
}
