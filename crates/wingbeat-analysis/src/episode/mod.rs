//! Episodes of flight that are steered from outside, step by step: what those need who learn to fly.
//!
//! An [`Episode`] begins near the trimmed flight, disturbed as its [`Task`] says and its seed draws. Controls
//! ([`Controls`], as fractions of their limits) come once per control step, a wingbeat or less; the strokes go
//! over to them smoothly until the next one ([`SteeredStroke`]). The equations are those of a flight
//! ([`FreeFlight`](wingbeat_flight::FreeFlight)), by the classical Runge-Kutta method; air without memory.
//!
//! | number | observed | unit |
//! |---|---|---|
//! | 0-2 | place of the mass centre less the target's: forward, right, down | R |
//! | 3-5 | velocity u, v, w from axes that move with the mean velocity of the trimmed flight, less that at the start of its beat | R / T |
//! | 6-8 | angular velocity p, q, r, likewise | 1 / T |
//! | 9-11 | tilt: rotation vector roll, pitch, heading | rad |
//! | 12-14 | velocity of the target: forward, right, down | R / T |
//! | 15-16 | sine and cosine of the phase of the wingbeat | 1 |
//!
//! R: wing length, T: period of the wingbeat.

mod flyer;
mod kept;
mod recoveries;
mod strokes;
mod task;
mod tumble;

use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::sync::{Arc, Mutex};

use wingbeat_flight::Sensed;
use wingbeat_math::{DVec3, SplitMix64};

use crate::AnalysisError;
use crate::control::departure::{CONTROLS, Controls, Departure, Limits, Reference};
use crate::control::sensors::Sensors;
use crate::trim::Trim;
use kept::{Numbers, of_departure};

pub use flyer::{Flyer, Model, SharedModel};
pub use kept::Kept;
pub use recoveries::Recoveries;
pub use strokes::{SteadyStroke, SteeredStroke, Transition};
pub use task::{Draw, Start, Task};
pub use tumble::{CALM_BEATS, CALM_SPEED, CALM_TILT, Recovery, Tumbles};

/// How many numbers are observed.
pub const OBSERVED: usize = 17;

/// What all episodes of a kind share.
#[derive(Clone)]
pub struct Course {
    /// What is to be done.
    pub task: Task,
    /// The trimmed flight.
    pub trim: Arc<Trim>,
    /// Integration steps from one control to the next; the steps of a wingbeat are the trim's.
    pub interval: usize,
    /// Wingbeats after which an episode is cut off.
    pub beats: usize,
    /// Controls of size 1.
    pub limits: Limits,
    /// Noise and bias of what is observed; every episode has noise of its own.
    pub sensors: Sensors,
    /// Control steps from sensing to observing.
    pub delay: usize,
    reference: Reference,
    model: Arc<Model>,
}

impl Course {
    /// Perfect sensors, default limits, one control per wingbeat, 100 wingbeats.
    ///
    /// # Errors
    /// Numbers that are not finite; what bodies and air refuse; gusts in air that has no wind.
    pub fn new(task: Task, trim: Trim) -> Result<Self, AnalysisError> {
        if task == Task::Gust {
            flyer::check_gusts_blow(&trim.setup)?;
        }
        Ok(Self {
            task,
            interval: trim.beat.steps(),
            beats: 100,
            limits: Limits::default(),
            sensors: Sensors::default(),
            delay: 0,
            reference: Reference::trimmed(&trim)?,
            model: Arc::new(Model::new(&trim)?),
            trim: Arc::new(trim),
        })
    }

    /// Equations for episodes that take turns in one thread.
    ///
    /// # Errors
    /// What bodies and air refuse.
    pub fn model(&self) -> Result<SharedModel, AnalysisError> {
        Ok(Arc::new(Mutex::new(self.model.another(&self.trim)?)))
    }

    /// Control steps of a wingbeat.
    pub fn controls_per_beat(&self) -> f64 {
        self.trim.beat.steps() as f64 / self.interval as f64
    }
}

/// What came of a control step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Reward, between 0 and the length of the step \[wingbeats\].
    pub reward: f64,
    /// The flyer is lost: too far away, or turned over.
    pub is_lost: bool,
    /// The time is over.
    pub is_over: bool,
}

/// An episode.
pub struct Episode {
    course: Arc<Course>,
    flyer: Flyer,
    seed: u64,
    /// Episodes begun with this seed.
    number: u64,
    looks: usize,
    /// Departures under way: the delay.
    seen: VecDeque<Departure>,
}

impl Episode {
    /// The first episode of `seed`, which takes turns with others of `model`.
    ///
    /// # Errors
    /// What bodies and air refuse.
    pub fn new(course: Arc<Course>, model: &SharedModel, seed: u64) -> Result<Self, AnalysisError> {
        let start = Start::drawn(course.task, &course.trim.beat, &mut Draw::new(seed, 0));
        let mut episode = Self {
            flyer: Flyer::new(&course.trim, model, &start)?,
            course,
            seed,
            number: 0,
            looks: 0,
            seen: VecDeque::new(),
        };
        episode.begin()?;
        Ok(episode)
    }

    /// The next episode: the first of `seed` if one is given.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn reset(&mut self, seed: Option<u64>) -> Result<(), AnalysisError> {
        match seed {
            Some(seed) => (self.seed, self.number) = (seed, 0),
            None => self.number += 1,
        }
        let mut draw = Draw::new(self.seed, self.number);
        let start = Start::drawn(self.course.task, &self.course.trim.beat, &mut draw);
        self.flyer.restart(&self.course.trim, &start)?;
        self.begin()
    }

    fn begin(&mut self) -> Result<(), AnalysisError> {
        self.looks = 0;
        let truth = self.sensed()?;
        let first = self.departure(&self.sensors().seen(&truth));
        self.seen = vec![first; self.course.delay + 1].into();
        Ok(())
    }

    /// The sensors of the course, with noise of this episode's own.
    fn sensors(&self) -> Sensors {
        let shared = self.course.sensors;
        Sensors {
            seed: SplitMix64::mixed_with(shared.seed ^ self.seed, &[self.number]),
            ..shared
        }
    }

    /// One control step under `controls`, fractions of their limits.
    pub fn step(&mut self, controls: &[f64; CONTROLS]) -> Outcome {
        let course = Arc::clone(&self.course);
        let sizes = course.limits.sizes();
        let command: Controls = std::array::from_fn(|i| sizes[i] * controls[i].clamp(-1.0, 1.0));
        self.looks += 1;
        let over = self.looks as f64 >= course.beats as f64 * course.controls_per_beat();
        let flown = self.flyer.fly(&course.trim, &command, course.interval);
        let Ok(truth) = flown.and_then(|()| self.sensed()) else {
            return Outcome {
                reward: 0.0,
                is_lost: true,
                is_over: over,
            };
        };
        let (beat, departure) = (&course.trim.beat, self.departure(&truth));
        let sensed = self.departure(&self.sensors().seen(&truth));
        self.seen.pop_front();
        self.seen.push_back(sensed);
        let is_lost = course.task.is_lost(beat, &departure);
        let reward = course.task.reward(beat, &departure, controls) / course.controls_per_beat();
        Outcome {
            reward: if is_lost { 0.0 } else { reward },
            is_lost,
            is_over: over,
        }
    }

    /// What it remembers.
    pub fn keep(&self) -> Kept {
        let mut numbers = self.flyer.numbers();
        numbers.extend(self.seen.iter().flat_map(of_departure));
        let [looks, steps] = [self.looks, self.flyer.steps()].map(|count| count as u64);
        Kept {
            counts: [self.seed, self.number, looks, steps],
            numbers,
        }
    }

    /// Goes on from there.
    ///
    /// # Errors
    /// What an episode of another course remembers; what bodies and air refuse.
    pub fn go_on(&mut self, kept: &Kept) -> Result<(), AnalysisError> {
        if kept.numbers.len() != self.keep().numbers.len() {
            return Err(AnalysisError::not_covered(
                "the episode that was kept is of another flyer, or has another delay",
                "go on in an environment of the same flight and the same settings",
            ));
        }
        let [seed, number, looks, steps] = kept.counts;
        (self.seed, self.number, self.looks) = (seed, number, looks as usize);
        // Its gust, if it has one, is drawn again.
        let (course, mut draw) = (&self.course, Draw::new(seed, number));
        let start = Start::drawn(course.task, &course.trim.beat, &mut draw);
        self.flyer.restart(&course.trim, &start)?;
        let numbers = &mut Numbers(&kept.numbers);
        self.flyer.set_numbers(steps as usize, numbers);
        for seen in &mut self.seen {
            *seen = numbers.departure();
        }
        Ok(())
    }

    /// What is observed, [`OBSERVED`] numbers.
    pub fn observe(&self, out: &mut [f64]) {
        let beat = &self.course.trim.beat;
        let (length, period) = (beat.wing_length(), beat.period());
        let d = self.seen();
        let (_, target) = self.course.task.target(beat, self.time());
        let phase = TAU * self.flyer.phase(&self.course.trim);
        let parts = [
            d.position / length,
            d.state.velocity * period / length,
            d.state.rate * period,
            d.state.tilt,
            target * period / length,
        ];
        for (numbers, part) in out.chunks_mut(3).zip(parts) {
            part.write_to_slice(numbers);
        }
        [out[15], out[16]] = [phase.sin(), phase.cos()];
    }

    /// What is seen to depart from the target.
    pub fn seen(&self) -> Departure {
        *self.seen.front().expect("one at least")
    }

    /// The same with its velocity less that of the target: what a controller brings to zero that follows the target.
    pub fn seen_on_the_way(&self) -> Departure {
        let (_, velocity) = self.course.task.target(&self.course.trim.beat, self.time());
        let mut departure = self.seen();
        departure.state.velocity -= velocity;
        departure
    }

    /// What departs from the target, in truth.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn truth(&self) -> Result<Departure, AnalysisError> {
        let truth = self.sensed()?;
        Ok(self.departure(&truth))
    }

    /// Time since the start [s].
    pub fn time(&self) -> f64 {
        self.flyer.time(&self.course.trim)
    }

    fn sensed(&self) -> Result<Sensed, AnalysisError> {
        let sensed = self.flyer.sensed(&self.course.trim, self.looks);
        match sensed.centre.is_finite() && sensed.root.w.is_finite() {
            true => Ok(sensed),
            false => Err(AnalysisError::Numbers("the flyer is lost".into())),
        }
    }

    fn departure(&self, sensed: &Sensed) -> Departure {
        let mut departure = self.course.reference.departure(sensed, DVec3::ZERO);
        let beat = &self.course.trim.beat;
        departure.position -= self.course.task.target(beat, sensed.time).0;
        departure
    }
}
