//! Feedback: a controller in the loop of the wingbeat.
//!
//! Once per wingbeat the flyer is sensed; the command formed from it acts some beats later (the
//! latency). Over the beat in which it acts the angles of the wings go over smoothly from the old
//! command to the new one, so that wing inertia does its part and nothing jumps.

use std::collections::VecDeque;
use std::sync::Arc;

use wingbeat_flight::Feedback;
use wingbeat_math::{DMat3, DQuat, DVec3};
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::beat::{Beat, JOINTS, State};
use crate::level::{Level, Perturbation};
use crate::trim::Trim;

/// What a controller sees at the start of a beat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensed {
    /// Number of the beat.
    pub beat: usize,
    /// Mass centre relative to where the trimmed flight would be, level frame [m].
    pub position: DVec3,
    /// Velocity, angular velocity and tilt at this instant, less those of the trimmed flight.
    pub departure: Perturbation,
}

/// A controller: from what is sensed to one adjustment per wing.
pub trait Controller {
    /// Adjustments of the wings, in the animal's order, on top of the trimmed motion.
    fn command(&mut self, sensed: &Sensed, wings: usize) -> Vec<Adjustment>;

    /// Everything it remembers, for a flight that is resumed.
    fn memory(&self) -> Vec<f64> {
        vec![]
    }

    /// Goes on from what it remembered.
    fn restore(&mut self, _memory: &[f64]) {}
}

/// A controller of departures from a trimmed flight in the loop of any flight, in any air: looks
/// once per wingbeat (see [`Steering::feedback`]).
#[derive(Clone, Debug)]
pub struct Steering<C> {
    controller: C,
    level: Level,
    reference: Perturbation,
    /// Mean velocity of the trimmed flight, N components [m/s].
    velocity: DVec3,
    wings: usize,
    /// Mass centre at the first look, N components [m].
    origin: Option<DVec3>,
}

impl<C: Controller> Steering<C> {
    /// `controller` about the trimmed flight.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn new(controller: C, trim: &Trim) -> Result<Self, AnalysisError> {
        let root = trim.beat.root(&trim.state);
        let level = Level::new(root.r, trim.beat.gravity());
        Ok(Self {
            controller,
            reference: Perturbation::of(&trim.beat, &level, &trim.state),
            level,
            velocity: trim.mean_velocity()?,
            wings: trim.setup.animal.wings.len(),
            origin: None,
        })
    }
}

impl<C: Controller + Clone + std::fmt::Debug + Send + Sync + 'static> Steering<C> {
    /// Feedback that looks every `steps_per_beat` steps and whose commands act `latency` beats later.
    pub fn feedback(self, steps_per_beat: usize, latency: usize) -> Feedback {
        Feedback {
            controller: Arc::new(self),
            interval: steps_per_beat,
            latency,
        }
    }
}

impl<C: Controller + Send> wingbeat_flight::Controller for Steering<C> {
    fn command(&mut self, sensed: &wingbeat_flight::Sensed) -> Vec<Adjustment> {
        let origin = *self.origin.get_or_insert(sensed.centre);
        let (root, velocity) = (&sensed.root, sensed.velocity);
        let seen = Perturbation::seen(&self.level, root.r, velocity, root.w).to_array();
        let reference = self.reference.to_array();
        let way = sensed.centre - origin - sensed.time * self.velocity;
        let sensed = Sensed {
            beat: sensed.look,
            position: self.level.to_n.transpose() * way,
            departure: Perturbation::from_array(std::array::from_fn(|i| seen[i] - reference[i])),
        };
        self.controller.command(&sensed, self.wings)
    }

    fn memory(&self) -> Vec<f64> {
        let origin = self.origin.map_or(vec![], |o| o.to_array().to_vec());
        [vec![origin.len() as f64], origin, self.controller.memory()].concat()
    }

    fn restore(&mut self, memory: &[f64]) {
        let Some((&known, rest)) = memory.split_first() else {
            return;
        };
        let (origin, rest) = rest.split_at(known as usize);
        self.origin = (!origin.is_empty()).then(|| DVec3::from_slice(origin));
        self.controller.restore(rest);
    }
}

impl Controller for Box<dyn Controller> {
    fn command(&mut self, sensed: &Sensed, wings: usize) -> Vec<Adjustment> {
        (**self).command(sensed, wings)
    }
}

/// No feedback.
#[derive(Clone, Copy, Debug, Default)]
pub struct Free;

impl Controller for Free {
    fn command(&mut self, _sensed: &Sensed, wings: usize) -> Vec<Adjustment> {
        vec![Adjustment::default(); wings]
    }
}

/// A controller that looks only every so many beats and holds its command in between.
#[derive(Clone, Debug)]
pub struct Sampled<C> {
    controller: C,
    every: usize,
    held: Vec<Adjustment>,
}

impl<C: Controller> Sampled<C> {
    /// `controller`, asked every `every` beats (at least 1).
    pub fn new(controller: C, every: usize) -> Self {
        Self {
            controller,
            every: every.max(1),
            held: vec![],
        }
    }
}

impl<C: Controller> Controller for Sampled<C> {
    fn command(&mut self, sensed: &Sensed, wings: usize) -> Vec<Adjustment> {
        if sensed.beat.is_multiple_of(self.every) || self.held.is_empty() {
            self.held = self.controller.command(sensed, wings);
        }
        self.held.clone()
    }
}

/// A flight under control, beat by beat.
pub struct ControlledFlight<'a> {
    trim: &'a Trim,
    level: Level,
    steps: usize,
    /// Commands under way: the latency.
    queue: VecDeque<Vec<Adjustment>>,
    acting: Vec<Adjustment>,
    state: State,
    /// Way of the trimmed flight in a beat, N components [m].
    travel: DVec3,
    reference: Perturbation,
    sensed: Sensed,
}

impl<'a> ControlledFlight<'a> {
    /// From the trimmed flight disturbed by the rotation vector `tilt` \[rad\] (roll, pitch, heading)
    /// and the velocity `velocity` [m/s] (level frame); commands act `latency` beats after they
    /// were sensed.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn new(
        trim: &'a Trim,
        tilt: DVec3,
        velocity: DVec3,
        latency: usize,
    ) -> Result<Self, AnalysisError> {
        let root = trim.beat.root(&trim.state);
        let level = Level::new(root.r, trim.beat.gravity());
        let turned = level.to_n * DMat3::from_quat(DQuat::from_scaled_axis(tilt));
        let v = DVec3::from_slice(&trim.state[7..]) / trim.beat.mass();
        let r = turned * level.to_root.transpose();
        let state = trim.beat.state_with(
            DVec3::ZERO,
            r,
            turned * level.to_n.transpose() * v + level.to_n * velocity,
            root.w,
            &trim.state[JOINTS..],
        );
        let none = vec![Adjustment::default(); trim.setup.animal.wings.len()];
        let mut flight = Self {
            level,
            steps: trim.beat.steps(),
            queue: VecDeque::from(vec![none.clone(); latency]),
            acting: none,
            reference: Perturbation::of(&trim.beat, &level, &trim.state),
            sensed: Sensed::default(),
            state,
            travel: trim.mean_velocity()? * trim.beat.period(),
            trim,
        };
        flight.sense(0, &trim.beat);
        Ok(flight)
    }

    /// What was sensed last.
    pub fn sensed(&self) -> &Sensed {
        &self.sensed
    }

    /// The commands in force.
    pub fn acting(&self) -> &[Adjustment] {
        &self.acting
    }

    /// One wingbeat.
    ///
    /// # Errors
    /// Numbers that are not finite: the flyer is lost.
    pub fn beat(&mut self, controller: &mut dyn Controller) -> Result<&Sensed, AnalysisError> {
        let command = controller.command(&self.sensed, self.acting.len());
        self.queue.push_back(command);
        let next = self.queue.pop_front().expect("one was just pushed");
        let beat = Beat::between(&self.trim.setup, self.steps, &self.acting, &next)?;
        let number = self.sensed.beat + 1;
        let lost = |e| AnalysisError::Numbers(format!("beat {number}: the flyer is lost ({e})"));
        self.state = beat.advance(&self.state).map_err(lost)?;
        self.acting = next;
        // The next beat begins as this one ended.
        self.sense(
            number,
            &Beat::between(&self.trim.setup, 1, &self.acting, &self.acting)?,
        );
        Ok(&self.sensed)
    }

    /// Looks at the state at the start of the wingbeat `beat`.
    fn sense(&mut self, number: usize, beat: &Beat) {
        let seen = Perturbation::of(beat, &self.level, &self.state).to_array();
        let reference = self.reference.to_array();
        let departure = std::array::from_fn(|i| seen[i] - reference[i]);
        self.sensed = Sensed {
            beat: number,
            position: self.level.to_n.transpose()
                * (DVec3::from_slice(&self.state) - number as f64 * self.travel),
            departure: Perturbation::from_array(departure),
        };
    }
}
