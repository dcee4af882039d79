//! How long a response is, and how often it is looked at.

use super::settings::FlutterSettings;
use super::steady::SteadyWing;
use crate::AnalysisError;

/// Samples without which nothing is found, also not in three quarters of a response.
const LEAST: usize = 8;

/// Samples of a response at least, and samples in a period of the fastest mode that is disturbed.
const SAMPLES: [f64; 2] = [80.0, 6.0];

/// When outputs are taken.
pub(super) struct Sampling {
    /// Steps between samples.
    every: usize,
    count: usize,
}

impl Sampling {
    /// Length of the response \[s\] in steps of `step` \[s\].
    pub fn length(&self, step: f64) -> f64 {
        self.steps() as f64 * step
    }

    /// Steps of the response.
    pub fn steps(&self) -> usize {
        self.count * self.every
    }

    /// Steps between samples that are tried in turn: what is folded onto something else by one is not by others.
    pub fn tried(&self) -> Vec<usize> {
        let eighths = [8, 7, 6, 5, 4].map(|part| (self.every * part / 8).max(1));
        let mut all = eighths.to_vec();
        all.dedup();
        all
    }

    /// Of wings steady so.
    ///
    /// # Errors
    /// Too few of them.
    pub fn new(
        step: f64,
        steady: &[SteadyWing],
        settings: &FlutterSettings,
    ) -> Result<Self, AnalysisError> {
        use std::f64::consts::TAU;
        let vacuum = || steady.iter().flat_map(|s| s.vacuum.iter().copied());
        let (first, last) = (
            vacuum().fold(f64::INFINITY, f64::min),
            vacuum().fold(0.0, f64::max),
        );
        let length = settings.periods * TAU / first;
        let apart = (length / SAMPLES[0]).min(TAU / last / SAMPLES[1]);
        let every = ((apart / step) as usize).max(1);
        let count = (length / (every as f64 * step)).ceil() as usize;
        match count < LEAST {
            true => Err(AnalysisError::not_covered(
                format!(
                    "--periods {}: the response has {count} samples of at least {LEAST} that are needed",
                    settings.periods
                ),
                "lengthen it: 1 period of the first mode or more",
            )),
            false => Ok(Self { every, count }),
        }
    }
}
