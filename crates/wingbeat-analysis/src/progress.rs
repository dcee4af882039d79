//! How far an analysis is, told to whoever listens through the `log` crate. Nobody need listen: an
//! event that nobody wants costs one comparison, and none changes a result.
//!
//! | target | level | text | fields |
//! |---|---|---|---|
//! | [`TASK`] | info | what is being done | `done`, `of`: parts of it; `of` is 0 where nobody knows |
//! | [`BEAT`] | trace | - | - : one wingbeat of a map was flown |
//! | [`STEP`] | trace | - | `step`, `steps`: a step of a flight was made |

pub use wingbeat_flight::simulation::STEP_EVENT as STEP;

/// A part of a task begins.
pub const TASK: &str = "wingbeat::task";
/// A wingbeat of a map was flown.
pub const BEAT: &str = "wingbeat::beat";

/// Part `done` of `of` is done; 0 where nobody knows how many there will be.
pub(crate) fn task(what: &str, done: usize, of: usize) {
    log::info!(target: TASK, done, of; "{what}");
}

/// A wingbeat was flown.
pub(crate) fn beat() {
    log::trace!(target: BEAT, "");
}
