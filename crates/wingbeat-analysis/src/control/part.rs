//! Parts of a wingbeat, for controllers that look more than once in it: equal ones, each a map of the state by itself.

use std::ops::Range;

use wingbeat_math::DVec3;
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::beat::level::{Level, Perturbation};
use crate::beat::{Beat, JOINTS, State};
use crate::control::departure::Departure;
use crate::trim::Trim;

/// Part number `number` of `of` equal ones of a wingbeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// From 0.
    pub number: usize,
    /// As many.
    pub of: usize,
}

impl Part {
    /// The part that begins at look number `look` of a flight with `of` looks a beat.
    pub fn at_look(look: usize, of: usize) -> Self {
        Self {
            number: look % of,
            of,
        }
    }

    /// The parts of a beat.
    pub fn all(of: usize) -> impl Iterator<Item = Self> {
        (0..of).map(move |number| Self { number, of })
    }

    /// The one after it.
    pub fn next(self) -> Self {
        Self::at_look(self.number + 1, self.of)
    }

    /// When it begins [s], in a beat of `period` [s].
    pub fn start(self, period: f64) -> f64 {
        self.number as f64 * period / self.of as f64
    }

    /// Its steps among those of the beat.
    pub fn steps(self, beat: &Beat) -> Range<usize> {
        let each = beat.steps() / self.of;
        self.number * each..(self.number + 1) * each
    }

    /// A wingbeat of `trim` in which adjustments of the wings go over from one to another within this part.
    ///
    /// # Errors
    /// As [`Beat::between`].
    pub fn passing(
        self,
        trim: &Trim,
        [from, to]: [&[Adjustment]; 2],
    ) -> Result<Beat, AnalysisError> {
        let period = trim.beat.period();
        let window = [self.start(period), period / self.of as f64];
        Beat::passing(&trim.setup, trim.beat.steps(), from, to, window)
    }
}

/// The trimmed flight where each part of its wingbeat begins.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// What is seen there from axes that move with the mean velocity, and the place of the mass centre in them,
    /// level frame; less both at the start of the beat.
    pub points: Vec<Departure>,
    /// What is seen there from axes that move with the mean velocity.
    pub seen: Vec<Perturbation>,
    /// Coordinates and speeds of the free joints there [rad or m, and per s].
    pub joints: Vec<Vec<f64>>,
}

impl Orbit {
    /// Of `trim` in `parts` parts, which divide its steps.
    ///
    /// # Errors
    /// Numbers that are not finite; steps that are no multiple of the parts.
    pub fn new(trim: &Trim, parts: usize) -> Result<Self, AnalysisError> {
        let beat = &trim.beat;
        if !beat.steps().is_multiple_of(parts) {
            return Err(AnalysisError::not_covered(
                format!(
                    "a wingbeat of {} steps has no {parts} equal parts",
                    beat.steps()
                ),
                "take a number of parts that divides the steps",
            ));
        }
        let level = Level::of(beat, &trim.state);
        let velocity = trim.mean_velocity()?;
        let mut y: State = trim.state.clone();
        let start = Perturbation::of(beat, &level, &y);
        let start = start.relative_to(&level, trim.velocity);
        let mut orbit = Self {
            points: vec![],
            seen: vec![],
            joints: vec![],
        };
        for part in Part::all(parts) {
            let time = part.start(beat.period());
            let seen = Perturbation::at(beat, time, &level, &y);
            let seen = seen.relative_to(&level, trim.velocity);
            let way = DVec3::from_slice(&y) - DVec3::from_slice(&trim.state) - time * velocity;
            orbit.points.push(Departure {
                look: 0,
                position: level.to_n.transpose() * way,
                state: seen - start,
            });
            orbit.seen.push(seen);
            orbit.joints.push(y[JOINTS..].to_vec());
            y = beat.advance_over(part.steps(beat), &y)?;
        }
        Ok(orbit)
    }
}
