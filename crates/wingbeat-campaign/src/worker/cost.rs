//! What a campaign will take, from three sample points that are flown and thrown away.

use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use wingbeat_results::manifest::hexadecimal;

use crate::campaign::Campaign;
use crate::worker::point::{self, Done};

/// Bytes of a result of so many numbers on the disk, which gives files whole blocks.
const BLOCK_BYTES: u64 = 4096;

/// What a campaign will take.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// Sample points: number, time, why it failed.
    pub samples: Vec<(usize, Duration, Option<String>)>,
    /// Bytes of the results alone, without files that are kept.
    pub results_bytes: u64,
}

impl Cost {
    /// Flies the first, the middle and the last point in memory.
    pub fn of(campaign: &Campaign) -> Self {
        let last = campaign.plan().points() - 1;
        let mut points = vec![0, last / 2, last];
        points.dedup();
        let fly = |i: usize| {
            let begun = Instant::now();
            let hash = hexadecimal(&campaign.hash(i));
            let done = point::fly(campaign, i, &hash, None, &AtomicBool::new(false));
            let failed = match done {
                Done::Result(result) => result.failed.map(|(_, words)| words),
                Done::Stopped | Done::Busy => None,
                Done::Unwritten(e) => Some(e.to_string()),
            };
            (i, begun.elapsed(), failed)
        };
        Self {
            samples: points.into_iter().map(fly).collect(),
            results_bytes: BLOCK_BYTES * campaign.plan().points() as u64,
        }
    }

    /// Time of a point, the mean of the samples.
    pub fn per_point(&self) -> Duration {
        let sum: Duration = self.samples.iter().map(|s| s.1).sum();
        sum / self.samples.len().max(1) as u32
    }
}
