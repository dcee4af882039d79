//! The linear map over a wingbeat or an equal part of it about a trimmed flight, and what is commanded over it.

use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::beat::level::{Level, Perturbation};
use crate::beat::{Beat, JOINTS};
use crate::control::departure::{CONTROLS, Controls, Departure, adjustments};
use crate::control::part::{Orbit, Part};
use crate::stability::jacobian::jacobian;
use crate::stability::modes::Scales;
use crate::trim::Trim;

use super::riccati::Step;

/// Number of states that are seen: position, velocity, angular velocity, tilt.
pub const STATES: usize = 12;
/// Of the states, those that are summed over the beats: position and heading, as many as there are
/// controls.
pub(super) const SUMMED: [usize; CONTROLS] = [0, 1, 2, 11];

/// Position, velocity, angular velocity, tilt.
pub fn states(departure: &Departure) -> [f64; STATES] {
    let (position, rest) = (departure.position, departure.state.to_array());
    std::array::from_fn(|k| if k < 3 { position[k] } else { rest[k - 3] })
}

/// The linear map over one beat, or a part of it, about the trimmed flight. States are those that are seen, then
/// coordinates and speeds of the free joints.
#[derive(Clone, Debug)]
pub struct Plant {
    /// Number of coordinates and speeds of free joints.
    pub joints: usize,
    /// Of the states, by rows \[1\].
    pub m: Vec<f64>,
    /// Effect of the command in force at the start and of the next one, by rows \[1\].
    pub b: [Vec<f64>; 2],
}

impl Plant {
    /// Of every part of the wingbeat of the trimmed flight, wings on these [`sides`](crate::control::departure::sides).
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn parts(
        trim: &Trim,
        orbit: &Orbit,
        sides: &[Option<f64>],
    ) -> Result<Vec<Self>, AnalysisError> {
        let parts = Part::all(orbit.seen.len());
        parts.map(|p| Self::new(trim, orbit, sides, p)).collect()
    }

    fn new(
        trim: &Trim,
        orbit: &Orbit,
        sides: &[Option<f64>],
        part: Part,
    ) -> Result<Self, AnalysisError> {
        let level = Level::of(&trim.beat, &trim.state);
        let joints = &orbit.joints[part.number];
        let states = STATES + joints.len();
        let mut all = vec![0.0; 3];
        all.extend(orbit.seen[part.number].to_array());
        all.extend(joints);
        all.extend([0.0; 2 * CONTROLS]);
        let map = |z: &[f64]| fly(trim, part, &level, sides, z);
        let mut sizes = natural_sizes(&trim.beat);
        sizes.extend([1.0; 2 * CONTROLS]);
        let steps: Vec<f64> = sizes.iter().map(|size| 1e-4 * size).collect();
        let d = jacobian(map, &all, &steps)?;
        let columns = states + 2 * CONTROLS;
        let block = |from: usize, width: usize| {
            let entry = |k: usize| d[(k / width) * columns + from + k % width];
            (0..states * width).map(entry).collect::<Vec<f64>>()
        };
        Ok(Self {
            joints: joints.len(),
            m: block(0, states),
            b: [block(states, CONTROLS), block(states + CONTROLS, CONTROLS)],
        })
    }

    /// Number of states.
    pub fn states(&self) -> usize {
        STATES + self.joints
    }

    /// The states at its end, in which `now` goes over to `next`.
    pub fn advance(&self, x: &[f64], now: &Controls, next: &Controls) -> Vec<f64> {
        let row = |m: &[f64], v: &[f64], i: usize| -> f64 {
            let row = m[i * v.len()..].iter().zip(v);
            row.map(|(a, b)| a * b).sum()
        };
        let of = |i| row(&self.m, x, i) + row(&self.b[0], now, i) + row(&self.b[1], next, i);
        (0..self.states()).map(of).collect()
    }

    /// The map of states, sums, command in force and commands under way, and the effect of a new
    /// command; actuators go the share `share` of the way to what is due.
    pub(super) fn augmented(&self, sums: usize, latency: usize, share: f64) -> Step {
        let states = self.states();
        let first = states + sums;
        let n = first + CONTROLS * (latency + 1);
        let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n * CONTROLS]);
        for i in 0..states {
            for j in 0..states {
                a[i * n + j] = self.m[i * states + j];
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
            let i = states + k;
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

/// Natural sizes of the states of a plant.
pub(crate) fn natural_sizes(beat: &Beat) -> Vec<f64> {
    let length = beat.wing_length();
    let of = Scales::new(length, beat.period());
    let sizes = [length, of.velocity, of.rate, 1.0];
    let seen = (0..STATES).map(|k| sizes[k / 3]);
    seen.chain(beat.joint_sizes().iter().copied()).collect()
}

/// Position, state and free joints after a part of a beat from the same, command in force and next command.
fn fly(
    trim: &Trim,
    part: Part,
    level: &Level,
    sides: &[Option<f64>],
    z: &[f64],
) -> Result<Vec<f64>, AnalysisError> {
    let (states, commands) = z.split_at(z.len() - 2 * CONTROLS);
    let command = |from: usize| {
        let u = std::array::from_fn(|c| commands[from + c]);
        adjustments(&u, sides)
    };
    let (now, next) = (command(0), command(CONTROLS));
    let beat = part.passing(trim, [&now, &next])?;
    let after = Beat::between(&trim.setup, part.of, &next, &next)?;
    let [start, end] = [part, part.next()].map(|p| p.start(beat.period()));
    let x = std::array::from_fn(|i| states[3 + i]);
    let x = Perturbation::from_array(x).moved(level, trim.velocity);
    let y = x.state_at(&beat, start, level, &states[STATES..]);
    let y = beat.advance_over(part.steps(&beat), &y)?;
    let moved = level.to_n.transpose() * DVec3::from_slice(&y);
    let mut out = (moved + DVec3::from_slice(states)).to_array().to_vec();
    let ahead = Perturbation::at(&after, end, level, &y);
    out.extend(ahead.relative_to(level, trim.velocity).to_array());
    out.extend_from_slice(&y[JOINTS..]);
    Ok(out)
}
