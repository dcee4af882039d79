//! `[output]`.

use std::time::Duration;

use crate::output::{OutputSettings, SaveSettings};
use crate::raw::OutputCase;

/// What is written and when the state is saved.
pub(crate) fn output(case: &OutputCase) -> OutputSettings {
    OutputSettings {
        history_every: case.history_every,
        frames_every: case.frames_every,
        figures: case.figures,
        page: case.page,
        save: SaveSettings {
            every: case.checkpoint_every,
            interval: Duration::from_secs_f64(case.checkpoint_interval_s),
            keep: case.keep_checkpoint,
        },
    }
}
