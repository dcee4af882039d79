//! Progress of an analysis on the terminal, from the events of `wingbeat_analysis::progress`: what is
//! being done, how much of it, and since when. Nothing is shown where nobody looks, but what takes
//! its parts one after the other tells of each in a line.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget};
use log::{LevelFilter, Log, Metadata, Record};
use wingbeat::analysis::progress::{BEAT, STEP, TASK};

use crate::command::output::terminal::tell;

/// Time between two pictures while nothing happens.
const TICK: Duration = Duration::from_millis(250);

/// What is shown now, if anything is.
static SHOWN: Mutex<Option<Shown>> = Mutex::new(None);

/// Shows what is being done until it is dropped.
pub(crate) struct Watch {
    bar: ProgressBar,
}

impl Watch {
    /// For a command that begins with this; shown on a terminal only.
    pub(crate) fn new(what: &str) -> Self {
        Self::of(what, 0)
    }

    /// For a command of so many parts that [`Self::part`] counts.
    pub(crate) fn of(what: &str, parts: u64) -> Self {
        let bar = super::bar::bar(ProgressDrawTarget::stderr(), parts.max(1));
        if !bar.is_hidden() {
            bar.set_message(what.to_owned());
            bar.enable_steady_tick(TICK);
            let _ = log::set_logger(&Listener); // already set by an earlier watch
            log::set_max_level(LevelFilter::Trace);
            *shown() = Some(Shown {
                bar: bar.clone(),
                counts_parts: parts > 0,
                told: Told::new(what),
            });
        }
        Self { bar }
    }

    /// One part is done; `say` writes to the terminal meanwhile.
    pub(crate) fn part(&self, say: impl FnOnce()) {
        self.bar.suspend(say);
        self.bar.inc(1);
    }

    /// Tells how far the work is where nobody sees the bar: a line on the standard error.
    pub(crate) fn told(&self, how_far: &str) {
        if self.bar.is_hidden() {
            tell!("{how_far}");
        }
    }
}

/// Does something while its progress is shown.
pub(crate) fn watched<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let _watch = Watch::new(what);
    work()
}

impl Drop for Watch {
    fn drop(&mut self) {
        log::set_max_level(LevelFilter::Off);
        *shown() = None;
        self.bar.finish_and_clear();
    }
}

fn shown() -> MutexGuard<'static, Option<Shown>> {
    SHOWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A bar and what was told beside it.
struct Shown {
    bar: ProgressBar,
    /// Whether the bar counts parts that the command tells; else parts of the task.
    counts_parts: bool,
    told: Told,
}

impl Shown {
    fn hear(&mut self, record: &Record<'_>) {
        let field = |name: &str| {
            let value = record.key_values().get(name.into());
            value.and_then(|v| v.to_u64()).unwrap_or(0)
        };
        match record.target() {
            TASK => {
                self.told = Told::new(&record.args().to_string());
                if field("of") > 0 && !self.counts_parts {
                    self.bar.set_length(field("of"));
                    self.bar.set_position(field("done"));
                    self.told.task += &format!(", {} of {}", field("done"), field("of"));
                }
            }
            BEAT => self.told.beats += 1,
            _ => self.told.step = Some([field("step"), field("steps")]),
        }
        self.bar.set_message(self.told.words(self.bar.elapsed()));
    }
}

/// What was told so far.
struct Told {
    task: String,
    beats: u64,
    step: Option<[u64; 2]>,
}

impl Told {
    fn new(task: &str) -> Self {
        Self {
            task: task.to_owned(),
            beats: 0,
            step: None,
        }
    }

    fn words(&self, elapsed: Duration) -> String {
        let mut text = format!("{} s, {}", elapsed.as_secs(), self.task);
        if let Some([step, steps]) = self.step {
            text += &format!(", step {step}/{steps}");
        } else if self.beats > 0 {
            text += &format!(", {} wingbeats flown", self.beats);
        }
        text
    }
}

/// Turns events into words beside the bar.
struct Listener;

impl Log for Listener {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        [TASK, BEAT, STEP].contains(&metadata.target())
    }

    fn log(&self, record: &Record<'_>) {
        // Flights of several threads may tell at once; who comes too soon is not heard.
        if self.enabled(record.metadata())
            && let Ok(mut shown) = SHOWN.try_lock()
            && let Some(shown) = shown.as_mut()
        {
            shown.hear(record);
        }
    }

    fn flush(&self) {}
}
