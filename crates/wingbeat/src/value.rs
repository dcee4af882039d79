//! A flight as a value: built, flown and read without case files or result directories.

use std::path::Path;

use wingbeat_case::{IoError, LoadedCase};
use wingbeat_flight::{
    AirModel, Feedback, FlightError, FlightSetup, Record, Simulation, StartState,
};
use wingbeat_math::DVec3;
use wingbeat_model::Animal;
use wingbeat_results::history::HistoryWriter;

/// A flight to be flown. What has no method of its own is set in [`Flight::setup`].
///
/// ```
/// use wingbeat::Flight;
/// let run = Flight::preset("fruit-fly-blade")?.frequency_hz(210.0).beats(2.0).fly()?;
/// let last = run.beats().last().copied().expect("two beats");
/// assert_eq!(last.beat, 2);
/// assert!(last.lift_over_weight > 0.5 && last.lift_over_weight < 2.0);
/// # Ok::<(), wingbeat::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Flight {
    /// All of it: animal, air, mode, joints, formulation, integrator, time grid, feedback.
    pub setup: FlightSetup,
}

/// Why a flight could not be built, flown or written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The case or a file.
    #[error(transparent)]
    Io(#[from] IoError),
    /// The flight.
    #[error(transparent)]
    Flight(#[from] FlightError),
}

impl Flight {
    /// A free flight of `animal` in `air`, see [`FlightSetup::new`].
    pub fn new(name: &str, animal: Animal, air: AirModel) -> Self {
        let setup = FlightSetup::new(name, animal, air);
        Self { setup }
    }

    /// An embedded preset, or a case file.
    ///
    /// # Errors
    /// No such preset or file; a case that is refused.
    pub fn preset(name: &str) -> Result<Self, Error> {
        let setup = LoadedCase::find(name, &[])?.setup;
        Ok(Self { setup })
    }

    /// Steps per wingbeat; of a second, for motions without a beat.
    fn steps_per_beat(&self) -> f64 {
        let time = &self.setup.time;
        (time.period.unwrap_or(1.0) / time.step).round()
    }

    /// All wings beat with this frequency [Hz]; steps per beat and number of steps stay.
    pub fn frequency_hz(mut self, frequency: f64) -> Self {
        let steps = self.steps_per_beat();
        for wing in &mut self.setup.animal.wings {
            wing.motion.frequency = frequency;
        }
        self.setup.time.period = Some(1.0 / frequency);
        self.setup.time.step = 1.0 / (frequency * steps);
        self
    }

    /// How many wingbeats are flown.
    pub fn beats(mut self, beats: f64) -> Self {
        self.setup.time.steps = (beats * self.steps_per_beat()).round() as usize;
        self
    }

    /// In how many steps a wingbeat is flown; the number of beats stays.
    pub fn steps_per_beat_count(mut self, steps: usize) -> Self {
        let beats = self.setup.time.steps as f64 / self.steps_per_beat();
        self.setup.time.step = self.setup.time.period.unwrap_or(1.0) / steps as f64;
        self.beats(beats)
    }

    /// In which air.
    pub fn air(mut self, air: AirModel) -> Self {
        self.setup.air = air;
        self
    }

    /// Free flight from this start.
    pub fn start(mut self, start: StartState) -> Self {
        self.setup.mode = wingbeat_flight::MotionMode::Free(start);
        self
    }

    /// Under feedback.
    pub fn feedback(mut self, feedback: Feedback) -> Self {
        self.setup.feedback = Some(feedback);
        self
    }

    /// Flies it to its end.
    ///
    /// # Errors
    /// A setup that is refused; a flight that cannot go on.
    pub fn fly(&self) -> Result<Run, Error> {
        let mut flight = Simulation::new(self.setup.clone())?;
        let mut records = vec![flight.record().clone()];
        while !flight.finished() {
            records.push(flight.step()?.clone());
        }
        Ok(Run {
            setup: self.setup.clone(),
            records,
        })
    }
}

/// A flight that was flown.
#[derive(Clone, Debug)]
pub struct Run {
    /// What was flown.
    pub setup: FlightSetup,
    /// One record per step, the start first.
    pub records: Vec<Record>,
}

/// Means over one wingbeat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beat {
    /// Number of the beat, from 1.
    pub beat: usize,
    /// Force of the air against gravity over the weight [1].
    pub lift_over_weight: f64,
    /// Force of the air along n1 (forward) [N].
    pub thrust_newton: f64,
    /// Power of all actuators and of prescribed deformation [W].
    pub power_watt: f64,
}

impl Run {
    /// Means over every whole wingbeat, each over the steps that end in it.
    pub fn beats(&self) -> Vec<Beat> {
        let time = &self.setup.time;
        let steps = (time.period.unwrap_or(f64::INFINITY) / time.step).round() as usize;
        let down = self.setup.gravity.try_normalize().unwrap_or(DVec3::Z);
        let weight = self.setup.animal.mass() * self.setup.gravity.length();
        let whole = self.records[1..].chunks_exact(steps.max(1)).enumerate();
        let mean = |records: &[Record], of: &dyn Fn(&Record) -> f64| {
            records.iter().map(of).sum::<f64>() / records.len() as f64
        };
        whole
            .map(|(k, records)| Beat {
                beat: k + 1,
                lift_over_weight: mean(records, &|r| r.lift(down)) / weight,
                thrust_newton: mean(records, &|r| r.air_force().x),
                power_watt: mean(records, &|r| r.hinge_power()),
            })
            .collect()
    }

    /// Writes `history.csv` (see docs/results.md) into the new folder `dir`.
    ///
    /// # Errors
    /// The folder exists already or cannot be written.
    pub fn write(&self, dir: impl AsRef<Path>) -> Result<(), Error> {
        let dir = dir.as_ref();
        std::fs::create_dir(dir).map_err(IoError::write(dir))?;
        let mut history = HistoryWriter::create(&dir.join("history.csv"), &self.setup)?;
        for record in &self.records {
            history.append(record, true)?;
        }
        Ok(())
    }
}
