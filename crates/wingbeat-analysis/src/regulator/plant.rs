//! The linear map over a wingbeat or an equal part of it about a trimmed flight, and what is commanded over it.

use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::beat::Beat;
use crate::departure::{CONTROLS, Controls, Departure, adjustments};
use crate::level::{Level, Perturbation};
use crate::monodromy::monodromy;
use crate::part::{Orbit, Part};
use crate::trim::Trim;

use super::riccati::Step;

/// Number of states: position, velocity, angular velocity, tilt.
pub const STATES: usize = 12;
/// Of the states, those that are summed over the beats: position and heading, as many as there are
/// controls.
pub(super) const SUMMED: [usize; CONTROLS] = [0, 1, 2, 11];

/// Position, velocity, angular velocity, tilt.
pub fn states(departure: &Departure) -> [f64; STATES] {
    let (position, rest) = (departure.position, departure.state.to_array());
    std::array::from_fn(|k| if k < 3 { position[k] } else { rest[k - 3] })
}

/// The linear map over one beat, or a part of it, about the trimmed flight.
#[derive(Clone, Debug)]
pub struct Plant {
    /// Of the states, by rows \[1\].
    pub m: Vec<f64>,
    /// Effect of the command in force at the start and of the next one, by rows \[1\].
    pub b: [Vec<f64>; 2],
}

impl Plant {
    /// Of every part of the wingbeat of the trimmed flight, wings on these sides (right +1, left -1).
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn parts(trim: &Trim, orbit: &Orbit, sides: &[f64]) -> Result<Vec<Self>, AnalysisError> {
        let parts = Part::all(orbit.seen.len());
        parts.map(|p| Self::new(trim, orbit, sides, p)).collect()
    }

    fn new(trim: &Trim, orbit: &Orbit, sides: &[f64], part: Part) -> Result<Self, AnalysisError> {
        let root = trim.beat.root(&trim.state);
        let level = Level::new(root.r, trim.beat.gravity());
        let mut all = vec![0.0; 3];
        all.extend(orbit.seen[part.number].to_array());
        all.extend([0.0; 2 * CONTROLS]);
        let joints = &orbit.joints[part.number];
        let map = |z: &[f64]| fly(trim, part, joints, &level, sides, z);
        let speed = trim.beat.wing_length() / trim.beat.period();
        let rate = 1.0 / trim.beat.period();
        let sizes = [trim.beat.wing_length(), speed, rate, 1.0];
        let step = |k: usize| 1e-4 * if k < STATES { sizes[k / 3] } else { 1.0 };
        let steps: Vec<f64> = (0..all.len()).map(step).collect();
        let d = monodromy(map, &all, &steps)?;
        let columns = STATES + 2 * CONTROLS;
        let block = |from: usize, width: usize| {
            let entry = |k: usize| d[(k / width) * columns + from + k % width];
            (0..STATES * width).map(entry).collect::<Vec<f64>>()
        };
        Ok(Self {
            m: block(0, STATES),
            b: [block(STATES, CONTROLS), block(STATES + CONTROLS, CONTROLS)],
        })
    }

    /// The states at its end, in which `now` goes over to `next`.
    pub fn advance(&self, x: &[f64; STATES], now: &Controls, next: &Controls) -> [f64; STATES] {
        std::array::from_fn(|i| {
            let row = |m: &[f64], v: &[f64]| -> f64 {
                let n = v.len();
                m[i * n..(i + 1) * n]
                    .iter()
                    .zip(v)
                    .map(|(a, b)| a * b)
                    .sum()
            };
            row(&self.m, x) + row(&self.b[0], now) + row(&self.b[1], next)
        })
    }

    /// The map of states, sums, command in force and commands under way, and the effect of a new
    /// command; actuators go the share `share` of the way to what is due.
    pub(super) fn augmented(&self, sums: usize, latency: usize, share: f64) -> Step {
        let first = STATES + sums;
        let n = first + CONTROLS * (latency + 1);
        let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n * CONTROLS]);
        for i in 0..STATES {
            for j in 0..STATES {
                a[i * n + j] = self.m[i * STATES + j];
            }
            for c in 0..CONTROLS {
                let [now, next] = [0, 1].map(|k| self.b[k][i * CONTROLS + c]);
                // Actuators go over to what is due by their share.
                a[i * n + first + c] = now + (1.0 - share) * next;
                let next = share * next;
                if latency == 0 {
                    b[i * CONTROLS + c] = next;
                } else {
                    a[i * n + first + CONTROLS + c] = next;
                }
            }
        }
        for (k, state) in SUMMED.into_iter().enumerate().take(sums) {
            let i = STATES + k;
            (a[i * n + i], a[i * n + state]) = (1.0, 1.0);
        }
        // The queue moves up; the new command joins at its end.
        for i in first..n {
            let acts = i < first + CONTROLS;
            let share = if acts { share } else { 1.0 };
            a[i * n + i] = 1.0 - share;
            if i + CONTROLS < n {
                a[i * n + i + CONTROLS] = share;
            } else {
                b[i * CONTROLS + (i - first) % CONTROLS] = share;
            }
        }
        Step { a, b }
    }
}

/// Position and state after a part of a beat from position, state, command in force and next command. Free
/// joints start as on the trimmed orbit: what they remember of the beat before is left to feedback.
fn fly(
    trim: &Trim,
    part: Part,
    joints: &[f64],
    level: &Level,
    sides: &[f64],
    z: &[f64],
) -> Result<Vec<f64>, AnalysisError> {
    let command = |from: usize| {
        let u = std::array::from_fn(|c| z[from + c]);
        adjustments(&u, sides)
    };
    let (now, next) = (command(STATES), command(STATES + CONTROLS));
    let beat = part.passing(trim, [&now, &next])?;
    let after = Beat::between(&trim.setup, part.of, &next, &next)?;
    let [start, end] = [part, part.next()].map(|p| p.start(beat.period()));
    let x = std::array::from_fn(|i| z[3 + i]);
    let y = Perturbation::from_array(x).state_at(&beat, start, level, joints);
    let y = beat.advance_over(part.steps(&beat), &y)?;
    let moved = level.to_n.transpose() * DVec3::from_slice(&y);
    let mut out = (moved + DVec3::from_slice(z)).to_array().to_vec();
    out.extend(Perturbation::at(&after, end, level, &y).to_array());
    Ok(out)
}
