//! `[output]`: what a run writes, and when it saves its state.

use std::time::Duration;

use crate::raw::OutputCase;

/// What is written beside the history.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutputSettings {
    /// Steps between rows of the history, 1 for every step.
    pub history_every: usize,
    /// Steps between frames of surfaces and wakes; 0 writes none.
    pub frames_every: usize,
    /// Whether figures are drawn.
    pub figures: bool,
    /// Whether the flight page is written.
    pub page: bool,
    /// When the state is saved.
    pub save: SaveSettings,
}

/// How often the state is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SaveSettings {
    /// Steps between checkpoints; 0: not by steps.
    pub every: usize,
    /// Wall time between checkpoints; zero: not by time.
    pub interval: Duration,
    /// Whether the state after the last step is saved and kept.
    pub keep: bool,
}

impl Default for SaveSettings {
    fn default() -> Self {
        Self {
            every: 0,
            interval: Duration::from_secs(20),
            keep: false,
        }
    }
}

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
