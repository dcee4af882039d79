//! Recoveries from random tumbles: a law in the loop, seed by seed, beat by beat.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use wingbeat_math::DVec3;

use super::{Draw, Flyer, Model, Start, Task};
use crate::AnalysisError;
use crate::control::departure::{CONTROLS, Departure, Limits, Reference};
use crate::control::steering::Law;
use crate::trim::Trim;

/// A flyer counts as recovered from the first of so many wingbeats in a row at which it is calm.
pub const CALM_BEATS: usize = 10;
/// Largest tilt of a calm flyer [rad].
pub const CALM_TILT: f64 = 10.0 * std::f64::consts::PI / 180.0;
/// Largest speed of a calm flyer [wing lengths per wingbeat].
pub const CALM_SPEED: f64 = 0.1;

/// What flies in every tumble.
pub struct Tumbles<'a> {
    trim: &'a Trim,
    model: Model,
    reference: Reference,
    /// The feedback; none: the open loop.
    law: Option<Law>,
    /// Wingbeats from sensing to acting.
    latency: usize,
    /// Wingbeats within which it must be calm.
    beats: usize,
    limits: Limits,
}

/// What came of a tumble.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recovery {
    /// Tilt at the start [rad].
    pub tilt: f64,
    /// Angular velocity at the start [rad/s].
    pub rate: f64,
    /// Wingbeats until it was calm, for good; none if it was not within the time, or lost.
    pub beats: Option<usize>,
    /// Farthest from its place while it recovered [m].
    pub strayed: f64,
}

impl<'a> Tumbles<'a> {
    /// Flights of at most `beats` wingbeats about `trim` under `law`, which acts `latency` wingbeats after it has seen.
    ///
    /// # Errors
    /// Numbers that are not finite; what bodies and air refuse.
    pub fn new(
        trim: &'a Trim,
        law: Option<Law>,
        latency: usize,
        beats: usize,
    ) -> Result<Self, AnalysisError> {
        Ok(Self {
            model: Model::new(trim)?,
            reference: Reference::trimmed(trim)?,
            trim,
            law,
            latency,
            beats,
            limits: Limits::default(),
        })
    }

    /// The flight that [`Task::Recover`] draws for `seed`.
    ///
    /// # Errors
    /// What bodies and air refuse.
    pub fn recovery(&self, seed: u64) -> Result<Recovery, AnalysisError> {
        let beat = &self.trim.beat;
        let start = Start::drawn(Task::Recover, beat, &mut Draw::new(seed, 0));
        let model = Arc::new(Mutex::new(self.model.another(self.trim)?));
        let mut flyer = Flyer::new(self.trim, &model, &start)?;
        let mut law = self.law.clone();
        let mut under_way = VecDeque::from(vec![[0.0; CONTROLS]; self.latency]);
        let mut recovery = Recovery {
            tilt: start.by.tilt.length(),
            rate: start.by.rate.length(),
            beats: None,
            strayed: 0.0,
        };
        let mut calm = 0; // wingbeats in a row
        for k in 0..self.beats + CALM_BEATS {
            let Some(d) = self.departure(&flyer, k) else {
                break;
            };
            recovery.strayed = recovery.strayed.max(d.position.length());
            calm = if self.is_calm(&d) { calm + 1 } else { 0 };
            if calm == CALM_BEATS {
                recovery.beats = Some(k + 1 - CALM_BEATS);
                break;
            }
            let formed = law.as_mut().map_or([0.0; CONTROLS], |law| {
                let u = self.limits.applied(law.controls(&d));
                law.remember(&d, u, usize::from(!self.limits.reached(&u)));
                u
            });
            under_way.push_back(formed);
            let command = under_way.pop_front().unwrap_or(formed);
            if flyer.fly(self.trim, &command, beat.steps()).is_err() {
                break;
            }
        }
        Ok(recovery)
    }

    /// What is seen at the start of wingbeat `k`; none where the flyer is lost.
    fn departure(&self, flyer: &Flyer, k: usize) -> Option<Departure> {
        let sensed = flyer.sensed(self.trim, k);
        let d = self.reference.departure(&sensed, DVec3::ZERO);
        let known = d.position.is_finite() && d.state.tilt.is_finite();
        (known && !Task::Recover.is_lost(&self.trim.beat, &d)).then_some(d)
    }

    fn is_calm(&self, d: &Departure) -> bool {
        let beat = &self.trim.beat;
        let speed = d.state.velocity.length() * beat.period() / beat.wing_length();
        d.state.tilt.length() < CALM_TILT && speed < CALM_SPEED
    }
}
