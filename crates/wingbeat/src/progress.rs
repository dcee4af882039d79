//! Progress on the terminal: bar, time left, live figures.

use indicatif::{ProgressBar, ProgressStyle};
use wingbeat::flight::{FlightSetup, Record};

/// A progress bar with the figures of the newest step.
pub(crate) struct Progress {
    bar: ProgressBar,
    period: Option<f64>,
    weight: f64,
    down: wingbeat::math::DVec3,
}

impl Progress {
    /// For a flight; hidden when `quiet` or not on a terminal.
    pub(crate) fn new(setup: &FlightSetup, quiet: bool) -> Self {
        let steps = setup.time.steps as u64;
        let bar = if quiet {
            ProgressBar::hidden()
        } else {
            ProgressBar::new(steps)
        };
        let style =
            ProgressStyle::with_template("{bar:30} step {pos}/{len}, {eta_precise} left, {msg}");
        bar.set_style(style.expect("the template is well formed"));
        Self {
            bar,
            period: setup.time.period,
            weight: setup.animal.mass() * setup.gravity.length(),
            down: wingbeat::io::result::summary::down(setup),
        }
    }

    /// The newest step.
    pub(crate) fn show(&self, record: &Record) {
        self.bar.set_position(record.step as u64);
        if !self.bar.is_hidden() {
            self.bar.set_message(self.message(record));
        }
    }

    fn message(&self, record: &Record) -> String {
        let force: wingbeat::math::DVec3 = record.air.iter().map(|l| l.force).sum();
        let lift = -force.dot(self.down);
        let lift = if self.weight > 0.0 {
            format!("lift/weight {:+.2}", lift / self.weight)
        } else {
            format!("lift {lift:+.2e} N")
        };
        let beat = self
            .period
            .map_or(String::new(), |p| format!("beat {:.1}, ", record.time / p));
        format!(
            "{beat}{lift}, {} wake rings, {} passes",
            record.wake_rings, record.corrector_passes
        )
    }

    /// Takes the bar away.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
