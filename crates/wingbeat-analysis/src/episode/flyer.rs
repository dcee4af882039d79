//! A flyer that is steered.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use wingbeat_air::Gust;
use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{FlightSetup, FreeFlight, FreeFlightScratch, Sensed, WingLaw};
use wingbeat_math::ode::Rk4;
use wingbeat_math::{DVec3, RotationLaw};

use super::kept::{Numbers, of_motion};
use super::strokes::{SteadyStroke, SteeredStroke, Transition};
use super::task::Start;
use crate::AnalysisError;
use crate::beat::State;
use crate::control::departure::{Controls, adjustments, sides};
use crate::stability::disturbance::disturbed;
use crate::trim::Trim;

/// The equations of the flyers of a trimmed flight, with their intermediate results: what they share, so that
/// hundreds that take turns stay in the caches of the processor. A flyer brings its state and its commands.
pub struct Model {
    flight: FreeFlight,
    steady: Vec<Arc<SteadyStroke>>,
    strokes: Vec<Arc<SteeredStroke>>,
    sides: Vec<Option<f64>>,
    method: Rk4,
    scratch: FreeFlightScratch,
}

impl Model {
    /// Of the flight `trim`.
    ///
    /// # Errors
    /// What bodies and air refuse.
    pub fn new(trim: &Trim) -> Result<Self, AnalysisError> {
        let (period, steps) = (trim.beat.period(), trim.beat.steps());
        let wings = trim.setup.animal.wings.iter();
        let steady = wings.map(|w| Arc::new(SteadyStroke::new(w, period, steps)));
        let h = period / steps as f64;
        Self::of(trim, steady.collect(), |law| {
            Ok(FreeFlight::at_any_time(&trim.setup, law, h)?)
        })
    }

    /// Another one of the same flight `trim`: for a thread of its own.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn another(&self, trim: &Trim) -> Result<Self, AnalysisError> {
        Self::of(trim, self.steady.clone(), |law| {
            Ok(self.flight.with_law(&trim.setup, law)?)
        })
    }

    /// Another one in a gust.
    fn in_gust(&self, trim: &Trim, gust: &Gust) -> Result<Self, AnalysisError> {
        let mut setup: FlightSetup = trim.setup.clone();
        check_gusts_blow(&setup)?;
        let winds = setup.air.wind_mut().into_iter();
        winds.for_each(|wind| wind.gusts.push(gust.clone()));
        let h = trim.beat.period() / trim.beat.steps() as f64;
        Self::of(trim, self.steady.clone(), |law| {
            Ok(FreeFlight::at_any_time(&setup, law, h)?)
        })
    }

    fn of(
        trim: &Trim,
        steady: Vec<Arc<SteadyStroke>>,
        flight: impl FnOnce(&WingLaw<'_>) -> Result<FreeFlight, AnalysisError>,
    ) -> Result<Self, AnalysisError> {
        let stroke = |s: &Arc<_>| Arc::new(SteeredStroke::new(Arc::clone(s)));
        let strokes: Vec<_> = steady.iter().map(stroke).collect();
        let flight = flight(&|k, _| -> Arc<dyn RotationLaw> { strokes[k].clone() })?;
        Ok(Self {
            sides: sides(&trim.setup),
            method: Rk4::new(flight.dim()),
            scratch: flight.scratch(),
            flight,
            steady,
            strokes,
        })
    }

    /// Gets ready for a flyer under these commands.
    fn turn_to(&mut self, commands: &[Transition]) {
        let strokes = self.strokes.iter().zip(commands);
        strokes.for_each(|(stroke, command)| stroke.follow(*command));
        self.scratch.forget();
    }
}

/// That the air of the flight has gusts.
///
/// # Errors
/// Air without wind.
pub(super) fn check_gusts_blow(setup: &FlightSetup) -> Result<(), AnalysisError> {
    match setup.air.wind() {
        Some(_) => Ok(()),
        None => Err(AnalysisError::not_covered(
            format!(
                "a gust was asked for, and no gust blows in this air: {}",
                setup.air.name()
            ),
            "fly in blade elements (air.model = \"blade_element\"), or another task: hover, recover, path",
        )),
    }
}

/// A model that several flyers take turns with.
pub type SharedModel = Arc<Mutex<Model>>;

/// Free flight under commands, from the trimmed flight on.
pub struct Flyer {
    shared: SharedModel,
    /// The model that it flies: the shared one, or one of its own in a gust.
    model: SharedModel,
    commands: Vec<Transition>,
    y: State,
    root: BodyMotion,
    /// Steps made.
    steps: usize,
}

impl Flyer {
    /// A flyer of `trim`, whose model this is, at the start `start`.
    ///
    /// # Errors
    /// What bodies and air refuse; states that are not finite.
    pub fn new(trim: &Trim, model: &SharedModel, start: &Start) -> Result<Self, AnalysisError> {
        let mut flyer = Self {
            shared: Arc::clone(model),
            model: Arc::clone(model),
            commands: vec![Transition::default(); trim.setup.animal.wings.len()],
            y: vec![],
            root: BodyMotion::REST,
            steps: 0,
        };
        flyer.restart(trim, start)?;
        Ok(flyer)
    }

    /// Begins again.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn restart(&mut self, trim: &Trim, start: &Start) -> Result<(), AnalysisError> {
        self.model = match &start.gust {
            None => Arc::clone(&self.shared),
            Some(gust) => {
                let own = locked(&self.shared).in_gust(trim, gust)?;
                Arc::new(Mutex::new(own))
            }
        };
        self.commands.fill(Transition::default());
        self.y = disturbed(trim, &start.by);
        self.steps = 0;
        let model = &mut *locked(&self.model);
        model.turn_to(&self.commands);
        self.root = model.flight.root(0.0, &self.y, &mut model.scratch)?;
        Ok(())
    }

    /// Flies `steps` steps, over which the strokes go over to `command`.
    ///
    /// # Errors
    /// Numbers that are not finite: the flyer is lost.
    pub fn fly(
        &mut self,
        trim: &Trim,
        command: &Controls,
        steps: usize,
    ) -> Result<(), AnalysisError> {
        let h = trim.beat.period() / trim.beat.steps() as f64;
        let (start, duration) = (self.steps as f64 * h, steps as f64 * h);
        let model = &mut *locked(&self.model);
        let strokes = adjustments(command, &model.sides);
        for (now, to) in self.commands.iter_mut().zip(strokes) {
            *now = now.then(&to, start, duration);
        }
        model.turn_to(&self.commands);
        let (flight, scratch) = (&model.flight, &mut model.scratch);
        for _ in 0..steps {
            let t = self.steps as f64 * h;
            let rates = |t: f64, y: &[f64], dy: &mut [f64]| flight.rates(t, y, scratch, dy);
            model.method.advance(t, h, &mut self.y, rates)?;
            self.steps += 1;
        }
        trim.beat.flight().form().to_unit_length(&mut self.y);
        let end = self.steps as f64 * h;
        self.root = model.flight.root(end, &self.y, &mut model.scratch)?;
        Ok(())
    }

    /// State, motion of the root, commands.
    pub(super) fn numbers(&self) -> Vec<f64> {
        let commands = self.commands.iter().flat_map(Transition::numbers);
        let state = self.y.iter().copied();
        state.chain(of_motion(&self.root)).chain(commands).collect()
    }

    /// Goes on from numbers in this order, after so many steps.
    pub(super) fn set_numbers(&mut self, steps: usize, numbers: &mut Numbers<'_>) {
        self.steps = steps;
        self.y.iter_mut().for_each(|y| [*y] = numbers.next());
        self.root = numbers.motion();
        for command in &mut self.commands {
            *command = Transition::of_numbers(numbers.next());
        }
    }

    /// Steps made.
    pub(super) fn steps(&self) -> usize {
        self.steps
    }

    /// The state of the momentum form.
    pub fn state(&self) -> &State {
        &self.y
    }

    /// Time since the start [s].
    pub fn time(&self, trim: &Trim) -> f64 {
        self.steps as f64 * trim.beat.period() / trim.beat.steps() as f64
    }

    /// Phase of the wingbeat [wingbeats].
    pub fn phase(&self, trim: &Trim) -> f64 {
        let steps = trim.beat.steps();
        (self.steps % steps) as f64 / steps as f64
    }

    /// What is seen now, at the look `look`.
    pub fn sensed(&self, trim: &Trim, look: usize) -> Sensed {
        Sensed {
            look,
            time: self.time(trim),
            root: self.root,
            centre: DVec3::from_slice(&self.y),
            velocity: trim.beat.velocity(&self.y),
        }
    }
}

fn locked(model: &SharedModel) -> MutexGuard<'_, Model> {
    model.lock().unwrap_or_else(PoisonError::into_inner)
}
