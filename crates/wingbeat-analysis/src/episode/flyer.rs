//! A flyer that is steered.

use std::sync::Arc;

use wingbeat_flight::{FlightSetup, FreeFlight, FreeFlightScratch, Sensed};
use wingbeat_math::ode::Rk4;
use wingbeat_math::{DVec3, RotationLaw};

use super::strokes::{SteadyStroke, SteeredStroke};
use super::task::Start;
use crate::AnalysisError;
use crate::beat::State;
use crate::departure::{Controls, adjustments};
use crate::trim::Trim;

/// What the flyers of a trimmed flight have in common: their steady strokes and the air.
#[derive(Clone, Debug)]
pub struct Model {
    steady: Vec<Arc<SteadyStroke>>,
    flight: FreeFlight,
}

impl Model {
    /// Of the flight `trim`.
    ///
    /// # Errors
    /// What bodies and air refuse.
    pub fn new(trim: &Trim) -> Result<Self, AnalysisError> {
        let (period, steps) = (trim.beat.period(), trim.beat.steps());
        let wings = trim.setup.animal.wings.iter();
        let steady: Vec<_> = wings
            .map(|w| Arc::new(SteadyStroke::new(w, period, steps)))
            .collect();
        let law = |k: usize, _: &_| steered(&Arc::new(SteeredStroke::new(Arc::clone(&steady[k]))));
        let flight = FreeFlight::at_any_time(&trim.setup, &law, period / steps as f64)?;
        Ok(Self { steady, flight })
    }
}

/// Free flight under commands, from the trimmed flight on.
pub struct Flyer {
    flight: FreeFlight,
    strokes: Vec<Arc<SteeredStroke>>,
    sides: Vec<f64>,
    method: Rk4,
    scratch: FreeFlightScratch,
    y: State,
    /// Steps made.
    steps: usize,
}

impl Flyer {
    /// The flyer of `trim`, whose model this is, at the start `start`.
    ///
    /// # Errors
    /// What bodies and air refuse.
    pub fn new(trim: &Trim, model: &Model, start: &Start) -> Result<Self, AnalysisError> {
        let stroke = |s: &Arc<_>| Arc::new(SteeredStroke::new(Arc::clone(s)));
        let strokes: Vec<_> = model.steady.iter().map(stroke).collect();
        let flight = flight(trim, model, &strokes, start)?;
        let wings = trim.setup.animal.wings.iter();
        Ok(Self {
            sides: wings.map(|w| w.side.sign()).collect(),
            method: Rk4::new(flight.dim()),
            scratch: flight.scratch(),
            y: start.state(trim),
            steps: 0,
            flight,
            strokes,
        })
    }

    /// Begins again.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn restart(
        &mut self,
        trim: &Trim,
        model: &Model,
        start: &Start,
    ) -> Result<(), AnalysisError> {
        self.strokes.iter().for_each(|s| s.reset());
        self.flight = flight(trim, model, &self.strokes, start)?;
        self.scratch = self.flight.scratch();
        self.y = start.state(trim);
        self.steps = 0;
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
        let commands = adjustments(command, &self.sides);
        for (stroke, to) in self.strokes.iter().zip(&commands) {
            stroke.pass(to, start, duration);
        }
        let (flight, scratch) = (&self.flight, &mut self.scratch);
        for _ in 0..steps {
            let t = self.steps as f64 * h;
            let rates = |t: f64, y: &[f64], dy: &mut [f64]| flight.rates(t, y, scratch, dy);
            self.method.advance(t, h, &mut self.y, rates)?;
            self.steps += 1;
        }
        trim.beat.normalise(&mut self.y);
        Ok(())
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
    ///
    /// # Errors
    /// States that are not finite or singular.
    pub fn sensed(&mut self, trim: &Trim, look: usize) -> Result<Sensed, AnalysisError> {
        let time = self.time(trim);
        Ok(Sensed {
            look,
            time,
            root: self.flight.root(time, &self.y, &mut self.scratch)?,
            centre: DVec3::from_slice(&self.y),
            velocity: DVec3::from_slice(&self.y[7..]) / trim.beat.mass(),
        })
    }
}

/// The equations of an episode: in the air of the model, or in its own where there is a gust.
fn flight(
    trim: &Trim,
    model: &Model,
    strokes: &[Arc<SteeredStroke>],
    start: &Start,
) -> Result<FreeFlight, AnalysisError> {
    let law = |k: usize, _: &_| steered(&strokes[k]);
    let Some(gust) = &start.gust else {
        return Ok(model.flight.with_law(&trim.setup, &law)?);
    };
    let mut setup: FlightSetup = trim.setup.clone();
    if let Some(wind) = setup.air.wind_mut() {
        wind.gusts.push(gust.clone());
    }
    let h = trim.beat.period() / trim.beat.steps() as f64;
    Ok(FreeFlight::at_any_time(&setup, &law, h)?)
}

fn steered(stroke: &Arc<SteeredStroke>) -> Arc<dyn RotationLaw> {
    stroke.clone()
}
