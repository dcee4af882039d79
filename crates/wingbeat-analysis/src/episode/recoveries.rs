//! What came of many tumbles: how many recovered, how soon, how far away.

use wingbeat_math::median;

use super::Recovery;

/// Recoveries from some tumbles.
///
/// ```
/// use wingbeat_analysis::episode::{Recoveries, Recovery};
/// let flown = |beats, strayed| Recovery { tilt: 1.0, rate: 0.0, beats, strayed };
/// let tumbles = [flown(Some(20), 0.25), flown(None, 2.0), flown(Some(10), 0.5), flown(Some(30), 1.0)];
/// let all = Recoveries::of(tumbles.iter().collect());
/// assert_eq!(all.recovered()[0], 0.75);
/// assert_eq!(all.beats(0.5), Some(20));
/// assert_eq!(all.strayed(), Some(0.5)); // m
/// let two = Recoveries::of(tumbles[..3].iter().collect());
/// assert_eq!(two.strayed(), Some(0.375));
/// ```
pub struct Recoveries<'a> {
    all: Vec<&'a Recovery>,
    /// Wingbeats that those who recovered needed, in order.
    beats: Vec<usize>,
}

impl<'a> Recoveries<'a> {
    /// Of these tumbles.
    pub fn of(all: Vec<&'a Recovery>) -> Self {
        let mut beats: Vec<usize> = all.iter().filter_map(|r| r.beats).collect();
        beats.sort_unstable();
        Self { all, beats }
    }

    /// Number of tumbles.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Part that recovered, and its standard error \[1\]: that of Jeffreys' estimate (k + 1/2)/(n + 1), which
    /// is not zero where all or none did.
    pub fn recovered(&self) -> [f64; 2] {
        let (k, n) = (self.beats.len() as f64, self.all.len() as f64);
        let p = (k + 0.5) / (n + 1.0);
        [k / n, (p * (1.0 - p) / (n + 1.0)).sqrt()]
    }

    /// The wingbeats that a part `quantile` of those who recovered do not exceed; none where none did.
    pub fn beats(&self, quantile: f64) -> Option<usize> {
        let last = self.beats.len().checked_sub(1)?;
        Some(self.beats[(quantile * last as f64).round() as usize])
    }

    /// Median of the farthest distances of those who recovered [m]; none where none did.
    pub fn strayed(&self) -> Option<f64> {
        let recovered = self.all.iter().filter(|r| r.beats.is_some());
        median(recovered.map(|r| r.strayed).collect())
    }
}
