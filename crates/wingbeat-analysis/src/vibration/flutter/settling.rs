//! Coming to rest in a stream.
//!
//! What is left last is a motion that decays without vibrating, the more slowly, the closer the wing is to
//! static divergence: `q(t) = q + d exp(-t / tau)`. From three shapes equally far apart in time, whose two
//! differences are alike and of the ratio `r < 1`, follows where it leads, `q_3 + (q_3 - q_2) r / (1 - r)`
//! [Aitken 1926]. The wing goes on from there, at rest.

use std::collections::VecDeque;

use wingbeat_flight::{FlightSetup, FlightState, Simulation};
use wingbeat_math::{DVec3, larger};
use wingbeat_structure::{Configuration, NODE};

use crate::AnalysisError;

/// Velocity at which a wing counts as steady at first: of its fastest node over that of the stream \[1\].
pub(super) const STEADY: f64 = 1e-7;

/// Steps before anything is extrapolated: what calms down soon is flown.
const PATIENCE: usize = 400;

/// Periods of the first mode that a wing may take however short the steps are.
const PERIODS: f64 = 30.0;

/// Part of a period of the first mode between shapes that are extrapolated from.
const APART: f64 = 0.25;

/// Most that the two differences of three shapes differ, once scaled to each other, over the smaller \[1\], and how far
/// ahead they lead at most, in their last difference.
const ALIKE: f64 = 0.05;
const FARTHEST: f64 = 300.0;

/// Motion of a wing over that of the fastest one, below which it stays where it is when others go ahead \[1\].
const AT_REST: f64 = 1e-3;

/// How wings come to rest.
pub(super) struct Settling {
    /// Wings with much damping.
    pub setup: FlightSetup,
    /// Speed of the stream [m/s].
    pub speed: f64,
    /// Size of each elastic wing \[m\].
    pub sizes: Vec<f64>,
    /// Period of the slowest mode \[s\].
    pub period: f64,
    /// Steps before the wing is looked at.
    pub least: usize,
    /// Steps after which it may be given up, if they last [`PERIODS`].
    pub most: usize,
    /// Velocity at which it counts as steady, as [`STEADY`] \[1\].
    pub steady: f64,
}

impl Settling {
    /// Flies on from `start`, or from the start of the setup, until the wing rests.
    ///
    /// # Errors
    /// A wing that does not come to rest; what the flight reports.
    pub fn to_rest(&self, start: Option<FlightState>) -> Result<FlightState, AnalysisError> {
        let mut flight = match start {
            Some(state) => Simulation::resume(self.setup.clone(), state)?,
            None => Simulation::new(self.setup.clone())?,
        };
        let (most, apart) = (self.most.max(self.steps(PERIODS)), self.steps(APART).max(1));
        let (mut steps, mut least, mut midway) = (0, self.least, f64::INFINITY);
        let mut shapes = VecDeque::new();
        while steps < least || !self.rests(flight.state()) {
            // Not while the air has still to answer: that the wing rests has not been looked at.
            if steps >= most.max(least) {
                return Err(self.unsteady(flight.state(), steps, midway));
            }
            if steps == most / 2 {
                midway = drift(flight.state(), self.speed);
            }
            flight.step()?;
            steps += 1;
            let extrapolates = self.setup.joints.is_empty() && steps >= PATIENCE;
            if extrapolates && steps.is_multiple_of(apart) {
                shapes.push_back(shapes_of(flight.state()));
                if let Some(ahead) = self.ahead(&shapes) {
                    let state = moved(flight.state(), &ahead);
                    flight = Simulation::resume(self.setup.clone(), state)?;
                    // At rest because it was laid there: the air has still to answer.
                    least = least.max(steps + 2 * apart);
                    shapes.clear();
                }
                if shapes.len() == 3 {
                    shapes.pop_front();
                }
            }
        }
        Ok(flight.state().clone())
    }

    fn steps(&self, periods: f64) -> usize {
        (periods * self.period / self.setup.time.step) as usize
    }

    /// Whether its nodes rest; what is not a number does not.
    fn rests(&self, state: &FlightState) -> bool {
        drift(state, self.speed) <= self.steady
    }

    /// Where three shapes lead, from the last of them, wing by wing; none where one does not decay in a line.
    fn ahead(&self, shapes: &VecDeque<Vec<Configuration>>) -> Option<Vec<Vec<f64>>> {
        let [a, b, c] = [0, 1, 2].map(|k| shapes.get(k));
        let (first, last) = (increments(a?, b?), increments(b?, c?));
        let moved = |k: usize| product(&last[k], &last[k], self.sizes[k]).sqrt();
        let most = (0..last.len()).map(moved).fold(0.0, f64::max);
        let of = |k: usize| -> Option<Vec<f64>> {
            let factor = match moved(k) < AT_REST * most {
                true => 0.0,
                false => factor(&first[k], &last[k], self.sizes[k])?,
            };
            Some(last[k].iter().map(|x| factor * x).collect())
        };
        (0..last.len()).map(of).collect()
    }

    fn unsteady(&self, state: &FlightState, steps: usize, midway: f64) -> AnalysisError {
        let drift = drift(state, self.speed);
        AnalysisError::NotSteady {
            speed: self.speed,
            time: steps as f64 * self.setup.time.step,
            steps,
            drift,
            remedy: match drift < 0.5 * midway {
                true => {
                    "It still calms down: longer steps (time.step_s) and damping of its own (structure.damping_s) bring it further"
                }
                false => {
                    "A wing that diverges, whose flow separates or whose wake rolls up with narrow cores has no steady state: try lower speeds, less incidence, a stiffer wing or a wider air.wake_core"
                }
            },
        }
    }
}

/// How far the way goes that two successive motions of a wing begin, over the second; none where they do not decay
/// in a line.
fn factor(first: &[f64], last: &[f64], size: f64) -> Option<f64> {
    let [aa, ab, bb] =
        [(first, first), (first, last), (last, last)].map(|(p, q)| product(p, q, size));
    let ratio = ab / aa;
    let off = (bb - ratio * ab).max(0.0).sqrt();
    let factor = ratio / (1.0 - ratio);
    let decays = aa > 0.0 && ratio > 0.0 && ratio < 1.0 && factor < FARTHEST;
    (decays && off <= ALIKE * bb.sqrt()).then_some(factor)
}

/// Inner product of two motions of a wing, displacements over its size \[m\].
fn product(p: &[f64], q: &[f64], size: f64) -> f64 {
    let weight = |k: usize| {
        if k % NODE < 3 { size.powi(-2) } else { 1.0 }
    };
    let all = p.iter().zip(q).enumerate();
    all.map(|(k, (x, y))| weight(k) * x * y).sum()
}

/// Velocity of the fastest node of all elastic wings over that of the stream.
pub(super) fn drift(state: &FlightState, speed: f64) -> f64 {
    let wings = state.wings.iter();
    let nodes = wings.flat_map(|w| w.structure.velocity.chunks_exact(NODE));
    let speeds = nodes.map(|node| DVec3::from_slice(node).length());
    speeds.fold(0.0, larger) / speed
}

fn shapes_of(state: &FlightState) -> Vec<Configuration> {
    let wings = state.wings.iter();
    wings.map(|w| w.structure.configuration.clone()).collect()
}

/// Six numbers of every node, wing by wing, by which `b` is `a` moved ([`Configuration::moved`]).
fn increments(a: &[Configuration], b: &[Configuration]) -> Vec<Vec<f64>> {
    a.iter().zip(b).map(|(a, b)| a.increment_to(b)).collect()
}

/// `state` with its wings moved, at rest.
fn moved(state: &FlightState, ahead: &[Vec<f64>]) -> FlightState {
    let mut state = state.clone();
    for (wing, increment) in state.wings.iter_mut().zip(ahead) {
        let s = &mut wing.structure;
        s.configuration.moved(increment);
        let motions = [&mut s.velocity, &mut s.acceleration, &mut s.algorithmic];
        motions.into_iter().for_each(|m| m.fill(0.0));
    }
    state
}
