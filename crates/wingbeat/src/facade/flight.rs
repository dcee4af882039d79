//! A flight as a value: built and flown without case files or result directories.

use std::ops::ControlFlow;
use std::path::Path;

use wingbeat_analysis::{Trim, TrimProblem};
use wingbeat_case::{IoError, LoadedCase};
use wingbeat_draw::draw_run;
use wingbeat_flight::{
    AirModel, Feedback, FlightError, FlightSetup, MotionMode, Record, Simulation, StartState,
    TimeGrid, faster,
};
use wingbeat_math::DVec3;
use wingbeat_model::{Animal, Start};
use wingbeat_results::{Outcome, RecordedFlight};

use super::error::Error;
use super::run::{Run, new_dir};

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
    /// The case it came from.
    case: Option<Box<LoadedCase>>,
}

impl From<FlightSetup> for Flight {
    fn from(setup: FlightSetup) -> Self {
        Self { setup, case: None }
    }
}

impl From<LoadedCase> for Flight {
    fn from(case: LoadedCase) -> Self {
        Self {
            setup: case.setup.clone(),
            case: Some(Box::new(case)),
        }
    }
}

impl Flight {
    /// A free flight of `animal` in `air`, see [`FlightSetup::new`].
    ///
    /// ```
    /// use wingbeat::model::species::{FlyOptions, drosophila_melanogaster};
    /// use wingbeat::prelude::*;
    /// let fly = drosophila_melanogaster(&FlyOptions { frequency: 200.0, ..Default::default() })?;
    /// let flight = Flight::new("fly", fly, AirModel::None).beats(1.0);
    /// assert_eq!(flight.setup.time.period, Some(1.0 / 200.0)); // s
    /// assert_eq!(flight.fly()?.records.len(), 41); // 40 steps a beat
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(name: &str, animal: Animal, air: AirModel) -> Self {
        FlightSetup::new(name, animal, air).into()
    }

    /// An embedded preset, or a case file.
    ///
    /// # Errors
    /// No such preset or file; a case that is refused.
    pub fn preset(name: &str) -> Result<Self, Error> {
        Self::preset_with(name, &[])
    }

    /// The same with some keys of the case at other values, each written as `KEY=VALUE`.
    ///
    /// ```
    /// use wingbeat::Flight;
    /// let flight = Flight::preset_with("fruit-fly-blade", &["motion.frequency_hz=220"])?;
    /// assert_eq!(flight.setup.animal.wings[0].motion.frequency, 220.0); // Hz
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::preset`]; a key that there is not, or a value that is not allowed.
    pub fn preset_with(name: &str, keys: &[&str]) -> Result<Self, Error> {
        let keys: Vec<String> = keys.iter().map(|&key| key.to_owned()).collect();
        Ok(LoadedCase::find(name, &keys)?.into())
    }

    /// A case put together in Rust, key by key.
    ///
    /// ```
    /// use wingbeat::{Flight, case::LoadedCase};
    /// let mut case = LoadedCase::find("fruit-fly-blade", &[])?.effective();
    /// case.motion.adjust.stroke_amplitude = 0.05; // 5 % more
    /// let flight = Flight::of_case(case)?.beats(0.1);
    /// assert_eq!(flight.fly()?.records.len(), 1 + flight.setup.time.steps);
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    ///
    /// # Errors
    /// A case that is refused.
    pub fn of_case(case: wingbeat_case::raw::Case) -> Result<Self, Error> {
        Ok(LoadedCase::new(case)?.into())
    }

    /// Steps per wingbeat; of a second, for motions without a beat.
    fn steps_per_beat(&self) -> f64 {
        let time = self.setup.time;
        let period = Some(time.period.unwrap_or(1.0));
        let steps = TimeGrid { period, ..time }.steps_per_beat();
        steps.unwrap_or(0) as f64
    }

    /// All wings beat with this frequency [Hz], and what drives joints becomes faster as they do; steps per
    /// beat, number of steps and wingbeats of a smooth start stay.
    pub fn frequency_hz(mut self, frequency: f64) -> Self {
        let steps = self.steps_per_beat();
        let factor = frequency * self.setup.time.period.unwrap_or(1.0 / frequency);
        for wing in &mut self.setup.animal.wings {
            wing.motion.frequency = frequency;
            if let Start::Smooth { duration } = &mut wing.motion.start {
                *duration /= factor;
            }
        }
        for joint in &mut self.setup.joints {
            *joint = faster(joint, factor);
        }
        self.setup.time.period = Some(1.0 / frequency);
        self.setup.time.step = 1.0 / (frequency * steps);
        self
    }

    /// How many wingbeats are flown, to the nearest step; of a flight without a step [`Self::fly`] is refused.
    pub fn beats(mut self, beats: f64) -> Self {
        self.setup.time.steps = (beats * self.steps_per_beat()).round() as usize;
        self
    }

    /// In which air.
    pub fn air(mut self, air: AirModel) -> Self {
        self.setup.air = air;
        self
    }

    /// With one more gust.
    ///
    /// ```
    /// use wingbeat::prelude::*;
    /// let gust = Gust {
    ///     amplitude: DVec3::new(-0.5, 0.0, 0.0), // m/s, N: from ahead
    ///     start: 0.01, // s
    ///     slowness: DVec3::ZERO, // everywhere at once
    ///     shape: GustShape::OneMinusCosine { duration: 0.01 }, // s
    /// };
    /// let flight = Flight::preset("fruit-fly-blade")?.gust(gust.clone())?;
    /// assert!(matches!(flight.air(AirModel::None).gust(gust), Err(Error::NoWind { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Air that has no wind: only blade elements and the vortex lattice do.
    pub fn gust(mut self, gust: wingbeat_air::Gust) -> Result<Self, Error> {
        let air = self.setup.air.name();
        let wind = self.setup.air.wind_mut().ok_or(Error::NoWind { air })?;
        wind.gusts.push(gust);
        Ok(self)
    }

    /// Free flight from this start.
    pub fn start(mut self, start: StartState) -> Self {
        self.setup.mode = MotionMode::Free(start);
        self
    }

    /// Under feedback.
    pub fn feedback(mut self, feedback: Feedback) -> Self {
        self.setup.feedback = Some(feedback);
        self
    }

    /// Hover as a question for [`Self::trim`]: no mean velocity; body pitch, stroke amplitude and mean
    /// stroke angle are found, the search begins at the present pitch.
    pub fn hover(&self) -> TrimProblem {
        TrimProblem::straight(DVec3::ZERO, self.setup.angles_at_release().x)
    }

    /// Steady flight as a periodic orbit, see [`wingbeat_analysis::trim_within`]. The trimmed animal flies
    /// on as `Flight::from(trim.free())`. Whether it was found says `trim.solution.converged`.
    ///
    /// ```
    /// use wingbeat::Flight;
    /// let flight = Flight::preset("fruit-fly-blade")?;
    /// let mut hover = flight.hover();
    /// hover.settings.steps = 40; // per wingbeat
    /// let trim = flight.trim(&hover)?;
    /// assert!(trim.solution.converged && trim.solution.error() < 1e-9);
    /// assert!(trim.mean_velocity()?.length() < 1e-6); // m/s
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    ///
    /// # Errors
    /// Air with a memory, wind, applied loads, loops; numbers that stop being finite at once.
    pub fn trim(&self, problem: &TrimProblem) -> Result<Trim, Error> {
        Ok(wingbeat_analysis::trim_within(&self.setup, problem)?)
    }

    /// Flies it to its end.
    ///
    /// # Errors
    /// A setup that is refused; a flight that cannot go on.
    pub fn fly(&self) -> Result<Run, Error> {
        let (run, error) = self.fly_watched(None, |_| ControlFlow::Continue(()))?;
        error.map_or(Ok(run), Err)
    }

    /// Before the first step.
    ///
    /// # Errors
    /// A setup that is refused; of a case as it was read, with its key and line.
    pub fn begin(&self) -> Result<Simulation, Error> {
        if self.setup.time.steps == 0 {
            let remedy =
                "a flight has a step or more: fly longer (Flight::beats), or give setup.time.steps";
            return Err(FlightError::setup("time.steps", "0", remedy).into());
        }
        Simulation::new(self.setup.clone()).map_err(|e| match self.unchanged_case() {
            Some(case) => IoError::from(case.refused(&e)).into(),
            None => e.into(),
        })
    }

    /// Flies it to its end and writes the whole result directory while it does: case, manifest,
    /// history, frames, summary, and the figures and the page that the case asks for. What flies is the
    /// case that is written ([`Self::to_case`]), so that `wingbeat run DIR/case.toml` repeats it to the last bit.
    ///
    /// ```
    /// use wingbeat::{Error, Flight};
    /// let dir = std::env::temp_dir().join(format!("wingbeat-fly-to-{}", std::process::id()));
    /// Flight::preset_with("fruit-fly-blade", &["time.beats=0.1"])?.fly_to(&dir)?;
    /// assert!(dir.join("case.toml").is_file() && dir.join("manifest.json").is_file());
    /// # std::fs::remove_dir_all(&dir).expect("it was just written");
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::to_case`], [`Self::fly`] and [`Run::write`].
    pub fn fly_to(&self, dir: impl AsRef<Path>) -> Result<Run, Error> {
        let dir = Some(dir.as_ref());
        let (run, error) = self.fly_watched(dir, |_| ControlFlow::Continue(()))?;
        error.map_or(Ok(run), Err)
    }

    /// Flies it while `watch`, which sees the start and every step, lets it; into a result directory if `dir`
    /// names one, as [`Self::fly_to`], from which `wingbeat resume` goes on if it was stopped. What was flown
    /// is kept, also where an error ended it.
    ///
    /// ```
    /// use std::ops::ControlFlow::{Break, Continue};
    /// let flight = wingbeat::Flight::preset("fruit-fly-blade")?;
    /// let three = |f: &wingbeat::flight::Simulation| if f.state().step < 3 { Continue(()) } else { Break(()) };
    /// let (run, error) = flight.fly_watched(None, three)?;
    /// assert_eq!((run.records.len(), error.is_none()), (4, true));
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    ///
    /// # Errors
    /// What keeps it from beginning: as [`Self::begin`] and, with `dir`, as [`Self::to_case`] and [`Run::write`].
    pub fn fly_watched(
        &self,
        dir: Option<&Path>,
        mut watch: impl FnMut(&Simulation) -> ControlFlow<()>,
    ) -> Result<(Run, Option<Error>), Error> {
        let mut records = vec![];
        let each = |flight: &Simulation| {
            records.push(flight.record().clone());
            Ok::<_, Error>(watch(flight))
        };
        let Some(dir) = dir else {
            let mut flight = self.begin()?;
            let flown = flight.fly(each).map(|()| Outcome::of(&flight));
            return Ok(ended(&flight, records, flown));
        };
        let case = self.to_case()?;
        let flight = Self::from(case.clone()).begin()?;
        let threads = rayon::current_num_threads();
        let mut recorded = RecordedFlight::begin(new_dir(dir)?, &case, flight, threads)?;
        let flown = recorded.fly(each);
        let (run, error) = ended(recorded.flight(), records, flown);
        match &error {
            Some(Error::Io(e)) => recorded.abandon(e.to_string()),
            _ => _ = recorded.finish(run.outcome.clone(), draw_run)?,
        }
        Ok((run, error))
    }

    /// The case it came from, if nothing was changed since.
    fn unchanged_case(&self) -> Option<&LoadedCase> {
        // Setups hold laws of any kind, so they are compared in the form that holds every number.
        let same = |case: &&LoadedCase| format!("{:?}", case.setup) == format!("{:?}", self.setup);
        self.case.as_deref().filter(same)
    }

    /// The case that gives this flight; for one built or changed in Rust, a case whose setup is this one to
    /// rounding.
    ///
    /// # Errors
    /// [`IoError::NoKeys`] for what a case cannot say: an air or controller of one's own, joints, loads or
    /// segments that were made or changed in Rust.
    pub fn to_case(&self) -> Result<LoadedCase, Error> {
        match self.unchanged_case() {
            Some(case) => Ok(case.clone()),
            None => Ok(wingbeat_case::case_of(&self.setup, self.case.as_deref())?),
        }
    }
}

/// What was flown, and the error that ended it.
fn ended(
    flight: &Simulation,
    mut records: Vec<Record>,
    flown: Result<Outcome, Error>,
) -> (Run, Option<Error>) {
    let (outcome, error) = match flown {
        Ok(outcome) => (outcome, None),
        Err(e @ Error::Io(_)) => (Outcome::Unwritten(e.to_string()), Some(e)),
        Err(e) => (Outcome::Failed(e.to_string()), Some(e)),
    };
    let newest = flight.record();
    let is_lacking = records.last().is_none_or(|r| r.step < newest.step);
    if is_lacking && matches!(outcome, Outcome::Unwritten(_)) {
        records.push(newest.clone()); // flown, and not written
    }
    let setup = flight.setup().clone();
    let run = Run {
        setup,
        records,
        outcome,
    };
    (run, error)
}
