//! Feedback of departures from a reference flight: a law in the loop of any flight, in any air.
//!
//! Once per wingbeat, or in each of equal parts of it, the flyer is sensed; the command formed from it acts
//! some looks later (the latency). Until the next look the angles of the wings go over smoothly from the old
//! command to the new one, so that wing inertia does its part and nothing jumps.

use std::collections::VecDeque;
use std::sync::Arc;

use wingbeat_flight::control::{due, fits};
use wingbeat_flight::{Aim, Controller, Feedback, FlightSetup, RESUME_AS_SAVED, Sensed};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::beat::{Beat, State};
use crate::control::departure::{
    CONTROLS, Controls, Departure, Limits, Reference, adjustments, sides,
};
use crate::control::part::Part;
use crate::control::regulator::Regulator;
use crate::control::regulator::plant::{STATES, states};
use crate::control::route::Route;
use crate::control::sensors::Sensors;
use crate::control::stabiliser::ProportionalDerivative;
use crate::trim::Trim;

/// From departures to controls.
#[derive(Clone, Debug)]
pub enum Law {
    /// Proportional-derivative loops.
    Stabiliser(ProportionalDerivative),
    /// Discrete linear-quadratic regulator.
    Regulator(Regulator),
}

impl Law {
    /// The controls against a departure, without limits.
    pub fn controls(&self, d: &Departure) -> Controls {
        match self {
            Self::Stabiliser(loops) => loops.controls(d),
            Self::Regulator(regulator) => regulator.controls(d),
        }
    }

    /// The departure that is reckoned with where `seen` is seen.
    pub fn estimated(&mut self, seen: &Departure) -> Departure {
        match self {
            Self::Stabiliser(_) => *seen,
            Self::Regulator(regulator) => regulator.estimated(seen),
        }
    }

    /// A beat goes by with the command `u`, and the departure joins the sums so many `times`. The departure that is
    /// reckoned with where nothing is seen at its end: of the stabiliser, which does not reckon, none.
    pub fn remember(&mut self, d: &Departure, u: Controls, times: usize) -> Departure {
        match self {
            Self::Stabiliser(loops) => {
                loops.remember(d, times);
                Departure::default()
            }
            Self::Regulator(regulator) => regulator.remember(d, u, times),
        }
    }

    /// What it remembers, for a flight that is resumed.
    pub fn memory(&self) -> Vec<f64> {
        match self {
            Self::Stabiliser(loops) => loops.memory(),
            Self::Regulator(regulator) => regulator.memory(),
        }
    }

    /// Goes on from what it remembered.
    ///
    /// # Errors
    /// A memory of another law.
    pub fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        match self {
            Self::Stabiliser(loops) => loops.restore(memory),
            Self::Regulator(regulator) => regulator.restore(memory),
        }
    }
}

/// What is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {
    /// A flight that is known.
    Known(Reference),
    /// The flight as it begins, under gravity and with this mean velocity, N components.
    Begun {
        /// Acceleration of gravity [m/s2].
        gravity: DVec3,
        /// Mean velocity [m/s].
        velocity: DVec3,
    },
}

/// The controller of a flight: a law about a reference flight.
#[derive(Clone, Debug)]
pub struct Steering {
    law: Law,
    held: Held,
    /// Of every wing ([`sides`]).
    sides: Vec<Option<f64>>,
    /// Commands of the reference flight.
    base: Adjustment,
    /// Largest departures of commands from those of the reference flight.
    pub limits: Limits,
    /// Beats, or parts of them, from one look to the next; between them nothing is seen, and the command is kept.
    pub every: usize,
    /// Noise and bias of what is seen; none: the truth.
    pub sensors: Option<Sensors>,
    /// Where the reference flight is brought to.
    pub route: Route,
    /// The trimmed flight at the looks of a wingbeat, less that at its start ([`Orbit::points`]).
    pub orbit: Vec<Departure>,
    /// Reference flight and true place of the mass centre at the first look, N components [m].
    first: Option<(Reference, DVec3)>,
    command: Controls,
    /// What is reckoned with until the next look.
    expected: Departure,
}

impl Steering {
    /// `law` in the loop of the flight `setup` that holds `held`.
    pub fn new(law: Law, held: Held, setup: &FlightSetup) -> Self {
        Self {
            law,
            held,
            sides: sides(setup),
            base: Adjustment::default(),
            limits: Limits::default(),
            every: 1,
            sensors: None,
            route: Route::default(),
            orbit: vec![Departure::default()],
            first: None,
            command: [0.0; CONTROLS],
            expected: Departure::default(),
        }
    }

    /// The reference flight has the motion of the setup with this adjustment, which is commanded too.
    pub fn adjusted(mut self, by: &Adjustment) -> Self {
        self.base = *by;
        self
    }

    /// Feedback of a flight of `steps_per_beat` steps per wingbeat whose commands act `latency` looks later.
    /// Its wings are at the looks where they are on the beat that the law was laid out about: they beat from
    /// the first instant ([`wingbeat_model::Start`]); a [`Design`](crate::control::design::Design) lays a law out about
    /// any start.
    pub fn feedback(self, steps_per_beat: usize, latency: usize) -> Feedback {
        Feedback {
            interval: steps_per_beat / self.orbit.len(),
            controller: Arc::new(self),
            latency,
            lag: 0.0,
        }
    }

    /// The departure that is reckoned with where it looks at a flight that is `truth`.
    fn looked(&mut self, truth: &Sensed) -> Departure {
        let sensed = self.sensors.map_or(*truth, |s| s.seen(truth));
        let (reference, origin) = self.begin(truth, &sensed);
        let aim = self.route.at(sensed.time);
        let orbit = &self.orbit[sensed.look % self.orbit.len()];
        let seen = reference.departure_on(&aim, &sensed, origin).less(orbit);
        self.law.estimated(&seen)
    }

    /// The reference flight and the true place where it began, in a flight that is `truth` and is seen as `sensed`; known
    /// from the first look on.
    fn begin(&mut self, truth: &Sensed, sensed: &Sensed) -> (Reference, DVec3) {
        *self.first.get_or_insert_with(|| {
            let reference = match self.held {
                Held::Known(reference) => reference,
                Held::Begun { gravity, velocity } => Reference::begun(sensed, gravity, velocity),
            };
            (reference, truth.centre)
        })
    }
}

impl Controller for Steering {
    fn command(&mut self, truth: &Sensed) -> Result<Vec<Adjustment>, String> {
        let looks = truth.look.is_multiple_of(self.every);
        let d = if looks {
            let d = self.looked(truth);
            self.command = self.limits.applied(self.law.controls(&d));
            d
        } else {
            Departure {
                look: truth.look,
                ..self.expected
            }
        };
        // A look stands for the beats to the next one.
        let is_summed = looks && !self.limits.reached(&self.command);
        let times = if is_summed { self.every } else { 0 };
        self.expected = self.law.remember(&d, self.command, times);
        let mut list = adjustments(&self.command, &self.sides);
        for (a, side) in list.iter_mut().zip(&self.sides) {
            let base = side.map_or_else(|| self.base.on_wing(), |_| self.base);
            *a = base.then(a);
        }
        Ok(list)
    }

    fn aim(&self, time: f64) -> Option<Aim> {
        let (reference, origin) = self.first?;
        Some(reference.aim(&self.route.at(time), time, origin))
    }

    fn attitude(&self, look: usize, time: f64) -> Option<DMat3> {
        let Held::Known(reference) = &self.held else {
            return None;
        };
        let orbit = &self.orbit[look % self.orbit.len()];
        Some(reference.attitude(&self.route.at(time), orbit))
    }

    fn is_limited(&self) -> bool {
        self.limits.reached(&self.command)
    }

    fn memory(&self) -> Vec<f64> {
        let first = self.first.map_or(vec![], |(reference, origin)| {
            [reference.to_vec(), origin.to_array().to_vec()].concat()
        });
        let (command, law) = (self.command.to_vec(), self.law.memory());
        let mut memory = [vec![first.len() as f64], first, command, law].concat();
        if self.every > 1 {
            memory.extend(states(&self.expected));
        }
        memory
    }

    fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        let numbers = memory.first().map_or(0, |n| *n as usize);
        let parts = memory.get(1..).and_then(|m| m.split_at_checked(numbers));
        let Some((first, (command, law))) =
            parts.and_then(|(first, rest)| Some((first, rest.split_at_checked(CONTROLS)?)))
        else {
            return Err(format!("it has no command; {RESUME_AS_SAVED}"));
        };
        let expected = if self.every > 1 { STATES } else { 0 };
        let (law, expected) = law.split_at(law.len().saturating_sub(expected));
        if self.every > 1 {
            fits(expected, STATES)?;
            self.expected = Departure::from_states(0, expected);
        }
        self.law.restore(law)?;
        self.first = begun(first)?;
        self.command.copy_from_slice(command);
        Ok(())
    }
}

/// Reference flight and place where it began, as they are remembered; none before the first look.
fn begun(memory: &[f64]) -> Result<Option<(Reference, DVec3)>, String> {
    if memory.is_empty() {
        return Ok(None);
    }
    let known = memory.split_last_chunk::<3>();
    let known = known.and_then(|(reference, origin)| {
        let reference = Reference::from_slice(reference)?;
        Some((reference, DVec3::from_array(*origin)))
    });
    (known.map(Some)).ok_or_else(|| format!("its reference flight is none; {RESUME_AS_SAVED}"))
}

/// A flight under feedback on the map of wingbeats: as a flight of the trimmed setup with the looks of its
/// controller, at two thirds of its cost.
pub struct SteeredBeats<'a> {
    trim: &'a Trim,
    controller: Option<Steering>,
    reference: Reference,
    /// Share of the way to a command that actuators go until the next look.
    share: f64,
    /// Commands under way: the latency.
    queue: VecDeque<Vec<Adjustment>>,
    acting: Vec<Adjustment>,
    state: State,
    sensed: Sensed,
}

impl<'a> SteeredBeats<'a> {
    /// From the state `state` at the start of a beat of `trim`; commands act `latency` looks after
    /// they were formed.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn new(
        trim: &'a Trim,
        state: State,
        controller: Option<Steering>,
        latency: usize,
    ) -> Result<Self, AnalysisError> {
        let none = vec![Adjustment::default(); trim.setup.animal.wings.len()];
        Ok(Self {
            trim,
            controller,
            reference: Reference::trimmed(trim)?,
            share: 1.0,
            queue: VecDeque::from(vec![none.clone(); latency]),
            acting: none,
            sensed: seen(&trim.beat, &state, 0, Part::at_look(0, 1)),
            state,
        })
    }

    /// The same with actuators that lag ([`Timing::share`](crate::control::regulator::Timing::share)), for tests of what
    /// regulators are laid out on.
    #[must_use]
    pub fn lagged(mut self, share: f64) -> Self {
        self.share = share;
        self
    }

    /// The same with these commands in force and under way, oldest first, at the start.
    ///
    /// # Errors
    /// Commands that are not one per wing.
    pub fn commanded(mut self, commands: Vec<Vec<Adjustment>>) -> Result<Self, AnalysisError> {
        let mut commands = VecDeque::from(commands);
        if let Some(acting) = commands.pop_front() {
            let held = Beat::between(&self.trim.setup, 1, &acting, &acting)?;
            self.sensed = seen(&held, &self.state, 0, Part::at_look(0, 1));
            (self.acting, self.queue) = (acting, commands);
        }
        Ok(self)
    }

    /// The controller.
    pub fn controller(&self) -> Option<&Steering> {
        self.controller.as_ref()
    }

    /// What the flight departs by from the trimmed one at the start of this beat.
    pub fn departure(&self) -> Departure {
        self.reference.departure(&self.sensed, DVec3::ZERO)
    }

    /// Wingbeats that were flown.
    pub fn beats(&self) -> usize {
        self.sensed.look / self.parts()
    }

    /// Looks in a wingbeat.
    fn parts(&self) -> usize {
        self.controller.as_ref().map_or(1, |c| c.orbit.len())
    }

    /// The commands in force.
    pub fn acting(&self) -> &[Adjustment] {
        &self.acting
    }

    /// One wingbeat.
    ///
    /// # Errors
    /// Numbers that are not finite: the flyer is lost.
    pub fn beat(&mut self) -> Result<(), AnalysisError> {
        Part::all(self.parts()).try_for_each(|part| self.look(part))
    }

    /// The part of the wingbeat from one look to the next.
    fn look(&mut self, part: Part) -> Result<(), AnalysisError> {
        let next = match &mut self.controller {
            Some(controller) => {
                let command = controller.command(&self.sensed);
                let command = command.map_err(AnalysisError::Numbers)?;
                due(&mut self.queue, command, &self.acting, self.share)
            }
            None => self.acting.clone(),
        };
        let (trim, look) = (self.trim, self.sensed.look + 1);
        let beat = part.passing(trim, [&self.acting, &next])?;
        let number = self.sensed.look / part.of + 1;
        let lost = |e| AnalysisError::Numbers(format!("beat {number}: the flyer is lost ({e})"));
        let steps = part.steps(&trim.beat);
        self.state = beat.advance_over(steps, &self.state).map_err(lost)?;
        self.acting = next;
        // The next part begins as this one ended.
        let held = Beat::between(&trim.setup, part.of, &self.acting, &self.acting)?;
        self.sensed = seen(&held, &self.state, look, part.next());
        Ok(())
    }
}

/// What is seen of the state `y` at the look number `look`, where this part of a wingbeat begins.
fn seen(beat: &Beat, y: &[f64], look: usize, part: Part) -> Sensed {
    Sensed {
        look,
        time: look as f64 * beat.period() / part.of as f64,
        root: beat.root_at(part.start(beat.period()), y),
        centre: DVec3::from_slice(y),
        velocity: beat.velocity(y),
    }
}
