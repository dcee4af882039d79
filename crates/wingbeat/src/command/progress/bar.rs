//! Progress of a flight on the terminal: a bar with live figures, or a line of JSON now and then
//! for scripts.

use std::path::Path;
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use wingbeat::case::OutputSettings;
use wingbeat::flight::{FlightSetup, Record, Simulation};
use wingbeat::results::fixed::signed;

use crate::command::options::RunOptions;
use crate::command::output::terminal::say;
use crate::command::progress::pace::Pace;

/// Time between two lines of JSON.
const PAUSE: Duration = Duration::from_millis(500);
/// Time between two pictures of the bar.
const FLICKER: Duration = Duration::from_millis(50);
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
    pace: Pace,
}

impl Progress {
    /// For a flight that goes on from step `from`; the bar is hidden when told so or not on a
    /// terminal.
    pub(crate) fn new(setup: &FlightSetup, options: &RunOptions, from: usize) -> Self {
        let target = match options.silent() {
            true => ProgressDrawTarget::hidden(),
            false => ProgressDrawTarget::stderr(),
        };
        let bar = bar(target, setup.time.steps as u64);
        bar.set_position(from as u64);
        Self {
            bar,
            json: options.json,
            began: Instant::now(),
            from,
            said: None,
            steps: setup.time.steps,
            period: setup.time.period,
            weight: setup.animal.mass() * setup.gravity.length(),
            down: wingbeat::results::summary::down(setup),
            pace: Pace::new(setup),
        }
    }

    /// The newest step of the flight, whose history is written at `history`.
    pub(crate) fn show(&mut self, flight: &Simulation, history: &Path, output: &OutputSettings) {
        let record = flight.record();
        if self.bar.is_hidden() && !self.json {
            return;
        }
        self.pace.note_history(history, output, record.step);
        self.pace.note(flight);
        let pause = if self.json { PAUSE } else { FLICKER };
        let last = record.step == self.steps;
        if last || self.said.is_none_or(|t| t.elapsed() >= pause) {
            self.said = Some(Instant::now());
            self.say(record);
        }
    }

    fn say(&self, record: &Record) {
        if self.json {
            say!("{}", self.line(record));
        }
        if !self.bar.is_hidden() {
            self.bar.set_message(self.message(record));
            self.bar.set_position(record.step as u64);
        }
    }

    /// The most wanted first: narrow terminals show only the beginning.
    fn message(&self, record: &Record) -> String {
        let lift = record.lift(self.down);
        let lift = if self.weight > 0.0 {
            format!("lift/weight {}", signed(lift / self.weight, 2))
        } else {
            format!("lift {lift:+.2e} N")
        };
        let beat = self
            .period
            .map_or(String::new(), |p| format!("beat {:.1}, ", record.time / p));
        let left =
            Duration::from_secs_f64(self.pace.seconds_left(record.step).clamp(0.0, 1e9).ceil());
        format!(
            "step {}/{}, {} left, {beat}{lift}, {} wake rings, {} passes",
            record.step,
            self.steps,
            HumanDuration(left),
            record.wake_rings,
            record.corrector_passes
        )
    }

    fn line(&self, record: &Record) -> String {
        let seconds = self.began.elapsed().as_secs_f64().max(1e-9);
        let rate = (record.step - self.from) as f64 / seconds;
        let lift = record.lift(self.down);
        serde_json::json!({
            "step": record.step,
            "steps": self.steps,
            "time_s": record.time,
            "wingbeat": self.period.map(|p| record.time / p),
            "steps_per_second": rate,
            "seconds_left": self.pace.seconds_left(record.step),
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

/// A bar with words beside it that never takes more than one line.
pub(crate) fn bar(target: ProgressDrawTarget, length: u64) -> ProgressBar {
    let style =
        ProgressStyle::with_template("{bar:16} {wide_msg}").expect("the template is well formed");
    let bar = ProgressBar::with_draw_target(Some(length), target);
    bar.set_style(style);
    bar
}

#[cfg(test)]
mod tests {
    use super::*;
    use indicatif::InMemoryTerm;

    #[test]
    fn behaves_the_bar_takes_one_line_however_narrow_the_terminal() {
        for columns in [40, 80, 200] {
            let terminal = InMemoryTerm::new(10, columns);
            let target = ProgressDrawTarget::term_like(Box::new(terminal.clone()));
            let bar = bar(target, 200);
            bar.set_position(120);
            bar.set_message("step 120/200, 12 seconds left, beat 3.0, lift/weight +0.98, 123456 wake rings, 5 passes");
            bar.tick();
            let shown = terminal.contents();
            assert_eq!(shown.lines().count(), 1, "{columns}: {shown}");
            assert!(shown.contains("step 120/200"), "{shown}");
        }
    }
}
