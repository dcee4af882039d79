//! How many points a worker takes at once.

use wingbeat_flight::FlightSetup;

use crate::plan::raw::{RawCampaign, Task};

/// Seconds of a block of points that a worker takes at once.
const BLOCK_S: f64 = 0.5;
/// Points of a block at most.
const MAX_BLOCK: usize = 64;
/// Blocks that a campaign has at least, so that workers end together.
const MIN_BLOCKS: usize = 64;
/// Rough seconds of a step in blade elements, and of a trim or the modes of one.
const STEP_S: f64 = 15e-6;
const ANALYSIS_S: f64 = 0.3;

/// Points that a worker takes at once: half a second of them, by a rough estimate that is the same everywhere.
pub fn points_of_block(raw: &RawCampaign, setup: &FlightSetup, points: usize) -> usize {
    let flies_long = setup.air.keeps_wake() || !raw.files.is_empty();
    if flies_long && raw.tasks.contains(&Task::Run) {
        return 1;
    }
    let of = |task: &Task| match task {
        Task::Run => setup.time.steps as f64 * STEP_S,
        Task::Trim | Task::Stability => ANALYSIS_S,
        Task::Power => 0.0,
    };
    let cost: f64 = raw.tasks.iter().map(of).sum();
    let by_time = (BLOCK_S / cost.max(1e-9)) as usize;
    by_time
        .clamp(1, MAX_BLOCK)
        .min((points / MIN_BLOCKS).max(1))
}
