//! Rows of a response, and samples among them.

use wingbeat_math::root_mean_square;

/// A free response, and which of its rows are identified.
#[derive(Clone, Copy, Debug)]
pub struct Sampled<'a> {
    /// Outputs after each step, one row a step, all of one size.
    pub steps: &'a [Vec<f64>],
    /// Step \[s\].
    pub step: f64,
    /// Steps between the samples that are identified; those between tell fast motions from slow ones.
    pub every: usize,
}

impl Sampled<'_> {
    /// Time between samples \[s\].
    pub fn apart(&self) -> f64 {
        self.every as f64 * self.step
    }

    /// How many samples there are.
    pub fn count(&self) -> usize {
        self.steps.len() / self.every
    }

    /// The samples, or the rows so many steps before each of them.
    pub(super) fn before(&self, steps: usize) -> Vec<Vec<f64>> {
        let at = |k: usize| self.steps[(k + 1) * self.every - 1 - steps].clone();
        (0..self.count()).map(at).collect()
    }
}

/// Root mean square over all numbers.
pub(crate) fn rms(samples: &[Vec<f64>]) -> f64 {
    root_mean_square(samples.iter().flatten().copied())
}
