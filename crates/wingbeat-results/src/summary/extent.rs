//! The range of a number over a flight.

use serde::{Deserialize, Serialize};
use wingbeat_math::{larger, smaller};

/// Ends of the range of a number, and its largest magnitude; not numbers where one of the numbers is not.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Extent {
    pub least: f64,
    pub highest: f64,
    pub most: f64,
}

impl Default for Extent {
    fn default() -> Self {
        Self {
            least: f64::INFINITY,
            highest: f64::NEG_INFINITY,
            most: 0.0,
        }
    }
}

impl Extent {
    pub fn take(&mut self, value: f64) {
        self.least = smaller(self.least, value);
        self.highest = larger(self.highest, value);
        self.most = larger(self.most, value.abs());
    }

    /// From end to end; 0 of nothing.
    pub fn range(&self) -> f64 {
        larger(self.highest - self.least, 0.0)
    }
}
