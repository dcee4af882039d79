//! Progress on the terminal: a bar with live figures, or a line of JSON now and then for scripts.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use wingbeat::flight::{FlightSetup, Record};
use wingbeat::results::fixed::signed;

use crate::Manner;
use crate::terminal::say;

/// Time between two lines of JSON.
const PAUSE: Duration = Duration::from_millis(500);

/// Shows the newest step.
pub(crate) struct Progress {
    bar: ProgressBar,
    json: bool,
    began: Instant,
    from: usize,
    said: Option<Instant>,
    steps: usize,
    period: Option<f64>,
    weight: f64,
    down: wingbeat::math::DVec3,
}

impl Progress {
    /// For a flight that goes on from step `from`; the bar is hidden when told so or not on a
    /// terminal.
    pub(crate) fn new(setup: &FlightSetup, manner: &Manner, from: usize) -> Self {
        let bar = if manner.silent() {
            ProgressBar::hidden()
        } else {
            ProgressBar::new(setup.time.steps as u64)
        };
        let style = ProgressStyle::with_template(
            "{bar:24} step {pos}/{len}, {per_sec}, {eta_precise} left, {msg}",
        );
        bar.set_style(style.expect("the template is well formed"));
        bar.set_position(from as u64);
        bar.reset_eta();
        Self {
            bar,
            json: manner.json,
            began: Instant::now(),
            from,
            said: None,
            steps: setup.time.steps,
            period: setup.time.period,
            weight: setup.animal.mass() * setup.gravity.length(),
            down: wingbeat::results::summary::down(setup),
        }
    }

    /// The newest step.
    pub(crate) fn show(&mut self, record: &Record) {
        let last = record.step == self.steps;
        if self.json && (last || self.said.is_none_or(|t| t.elapsed() >= PAUSE)) {
            self.said = Some(Instant::now());
            say!("{}", self.line(record));
        }
        self.bar.set_position(record.step as u64);
        if !self.bar.is_hidden() {
            self.bar.set_message(self.message(record));
        }
    }

    /// Air force against gravity \[N\].
    fn lift(&self, record: &Record) -> f64 {
        let force: wingbeat::math::DVec3 = record.air.iter().map(|l| l.force).sum();
        -force.dot(self.down)
    }

    fn message(&self, record: &Record) -> String {
        let lift = self.lift(record);
        let lift = if self.weight > 0.0 {
            format!("lift/weight {}", signed(lift / self.weight, 2))
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

    fn line(&self, record: &Record) -> String {
        let seconds = self.began.elapsed().as_secs_f64().max(1e-9);
        let rate = (record.step - self.from) as f64 / seconds;
        let lift = self.lift(record);
        serde_json::json!({
            "step": record.step,
            "steps": self.steps,
            "time_s": record.time,
            "wingbeat": self.period.map(|p| record.time / p),
            "steps_per_second": rate,
            "seconds_left": (self.steps - record.step) as f64 / rate.max(1e-9),
            "wake_rings": record.wake_rings,
            "lift_newton": lift,
            "lift_over_weight": (self.weight > 0.0).then(|| lift / self.weight),
            "corrector_passes": record.corrector_passes,
        })
        .to_string()
    }

    /// Takes the bar away.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
