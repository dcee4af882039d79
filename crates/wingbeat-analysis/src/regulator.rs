//! A stabiliser: proportional-derivative feedback of place, velocity, attitude and rates with
//! the gains of the discrete linear-quadratic regulator, laid out on the full model's own map
//! over one wingbeat, latency included.
//!
//! ```text
//! x[k+1] = M x[k] + B_0 a[k] + B_1 a[k+1]      a: command in force, blended over the beat
//! u[k] = -K (x[k], a[k], commands under way)   command, in force `latency` beats later
//! ```
//!
//! Controls: amplitude of all wings, mean stroke angle of all wings, right-left differences of
//! amplitude and of stroke plane.

use std::collections::VecDeque;

use wingbeat_math::{DVec3, solve_small};
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::beat::{Beat, JOINTS};
use crate::control::{Controller, Sensed};
use crate::level::{Level, Perturbation};
use crate::monodromy::monodromy;
use crate::trim::Trim;

/// Number of controls.
const CONTROLS: usize = 4;
/// Position, velocity, angular velocity, tilt.
const STATES: usize = 12;

/// Departures that weigh alike in the cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Position, in wing lengths.
    pub position: f64,
    /// Velocity, in wing lengths per beat.
    pub velocity: f64,
    /// Tilt \[rad\].
    pub tilt: f64,
    /// Angular velocity, in rad per beat.
    pub rate: f64,
    /// Command \[1, rad\].
    pub command: f64,
}

impl Default for Weights {
    fn default() -> Self {
        Self {
            position: 0.5,
            velocity: 0.2,
            tilt: 0.2,
            rate: 0.2,
            command: 0.05,
        }
    }
}

/// The stabiliser.
#[derive(Clone, Debug)]
pub struct Regulator {
    gain: Vec<f64>,
    /// Commands in force and under way, oldest first.
    memory: VecDeque<[f64; CONTROLS]>,
    latency: usize,
    sides: Vec<f64>,
    /// Largest command of any kind \[1, rad\].
    pub limit: f64,
}

impl Regulator {
    /// Gains for the trimmed flight and commands that act `latency` beats after sensing.
    ///
    /// # Errors
    /// A flight that the strokes cannot stabilise: Riccati's iteration does not settle.
    pub fn new(trim: &Trim, weights: &Weights, latency: usize) -> Result<Self, AnalysisError> {
        let sides: Vec<f64> = trim
            .setup
            .animal
            .wings
            .iter()
            .map(|w| w.side.sign())
            .collect();
        let plant = Plant::new(trim, &sides)?;
        let (a, b, n) = plant.augmented(latency);
        let (q, r) = cost(trim, weights, n);
        let gain = riccati(&a, &b, &q, &r, n)?;
        Ok(Self {
            gain,
            memory: VecDeque::from(vec![[0.0; CONTROLS]; latency + 1]),
            latency,
            sides,
            limit: 0.2,
        })
    }

    /// Feedback gains, `CONTROLS` rows; columns: position, velocity, rate, tilt (SI), then
    /// commands in force and under way.
    pub fn gain(&self) -> &[f64] {
        &self.gain
    }
}

impl Controller for Regulator {
    fn command(&mut self, sensed: &Sensed, _wings: usize) -> Vec<Adjustment> {
        let mut z = sensed.position.to_array().to_vec();
        z.extend(sensed.departure.to_array());
        z.extend(self.memory.iter().flatten());
        let n = z.len();
        let row = |i: usize| -> f64 {
            let sum: f64 = (0..n).map(|j| self.gain[i * n + j] * z[j]).sum();
            (-sum).clamp(-self.limit, self.limit)
        };
        let u: [f64; CONTROLS] = std::array::from_fn(row);
        self.memory.push_back(u);
        self.memory.pop_front();
        debug_assert_eq!(self.memory.len(), self.latency + 1);
        adjustments(&u, &self.sides)
    }

    fn memory(&self) -> Vec<f64> {
        self.memory.iter().flatten().copied().collect()
    }

    fn restore(&mut self, memory: &[f64]) {
        for (command, saved) in self.memory.iter_mut().zip(memory.chunks_exact(CONTROLS)) {
            command.copy_from_slice(saved);
        }
    }
}

/// The four controls as adjustments of the wings.
fn adjustments(u: &[f64; CONTROLS], sides: &[f64]) -> Vec<Adjustment> {
    let wing = |s: &f64| Adjustment {
        stroke_amplitude: u[0] + 0.5 * s * u[2],
        stroke_offset: u[1],
        stroke_plane: 0.5 * s * u[3],
        ..Adjustment::default()
    };
    sides.iter().map(wing).collect()
}

/// The linear map over one beat about the trimmed flight.
struct Plant {
    m: Vec<f64>,
    /// Effect of the command in force at the start and of the next one.
    b: [Vec<f64>; 2],
}

impl Plant {
    fn new(trim: &Trim, sides: &[f64]) -> Result<Self, AnalysisError> {
        let root = trim.beat.root(&trim.state);
        let level = Level::new(root.r, trim.beat.gravity());
        let x = Perturbation::of(&trim.beat, &level, &trim.state).to_array();
        let mut all = vec![0.0; 3];
        all.extend(x);
        all.extend([0.0; 2 * CONTROLS]);
        let map = |z: &[f64]| fly(trim, &level, sides, z);
        let speed = trim.beat.wing_length() / trim.beat.period();
        let rate = 1.0 / trim.beat.period();
        let sizes = [trim.beat.wing_length(), speed, rate, 1.0];
        let step = |k: usize| 1e-4 * if k < STATES { sizes[k / 3] } else { 1.0 };
        let steps: Vec<f64> = (0..all.len()).map(step).collect();
        let d = monodromy(map, &all, &steps)?;
        let columns = STATES + 2 * CONTROLS;
        let part = |from: usize, width: usize| {
            let entry = |k: usize| d[(k / width) * columns + from + k % width];
            (0..STATES * width).map(entry).collect::<Vec<f64>>()
        };
        Ok(Self {
            m: part(0, STATES),
            b: [part(STATES, CONTROLS), part(STATES + CONTROLS, CONTROLS)],
        })
    }

    /// The map of states, command in force and commands under way; its effect of a new command;
    /// its order.
    fn augmented(&self, latency: usize) -> (Vec<f64>, Vec<f64>, usize) {
        let n = STATES + CONTROLS * (latency + 1);
        let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n * CONTROLS]);
        for i in 0..STATES {
            for j in 0..STATES {
                a[i * n + j] = self.m[i * STATES + j];
            }
            for c in 0..CONTROLS {
                a[i * n + STATES + c] = self.b[0][i * CONTROLS + c];
                let next = self.b[1][i * CONTROLS + c];
                if latency == 0 {
                    b[i * CONTROLS + c] = next;
                } else {
                    a[i * n + STATES + CONTROLS + c] = next;
                }
            }
        }
        // The queue moves up; the new command joins at its end.
        for i in STATES..n {
            if i + CONTROLS < n {
                a[i * n + i + CONTROLS] = 1.0;
            } else {
                b[i * CONTROLS + (i - STATES) % CONTROLS] = 1.0;
            }
        }
        (a, b, n)
    }
}

/// Position and state after a beat from position, state, command in force and next command. Free
/// joints start as on the trimmed orbit: what they remember of the beat before is left to feedback.
fn fly(trim: &Trim, level: &Level, sides: &[f64], z: &[f64]) -> Result<Vec<f64>, AnalysisError> {
    let command = |from: usize| {
        let u = std::array::from_fn(|c| z[from + c]);
        adjustments(&u, sides)
    };
    let (now, next) = (command(STATES), command(STATES + CONTROLS));
    let steps = trim.beat.steps();
    let beat = Beat::between(&trim.setup, steps, &now, &next)?;
    let after = Beat::between(&trim.setup, 1, &next, &next)?;
    let x = std::array::from_fn(|i| z[3 + i]);
    let y = Perturbation::from_array(x).state(&beat, level, &trim.state[JOINTS..]);
    let end = beat.advance(&y)?;
    let moved = level.to_n.transpose() * DVec3::from_slice(&end);
    let mut out = (moved + DVec3::from_slice(z)).to_array().to_vec();
    out.extend(Perturbation::of(&after, level, &end).to_array());
    Ok(out)
}

/// Diagonals of the cost of states and commands.
fn cost(trim: &Trim, w: &Weights, n: usize) -> (Vec<f64>, [f64; CONTROLS]) {
    let (length, period) = (trim.beat.wing_length(), trim.beat.period());
    let sizes = [
        w.position * length,
        w.velocity * length / period,
        w.rate / period,
        w.tilt,
    ];
    let mut q = vec![0.0; n];
    for k in 0..STATES {
        q[k] = sizes[k / 3].powi(-2);
    }
    (q, [w.command.powi(-2); CONTROLS])
}

/// The gain of the discrete regulator: Riccati's difference equation, run until it stands.
fn riccati(
    a: &[f64],
    b: &[f64],
    q: &[f64],
    r: &[f64; CONTROLS],
    n: usize,
) -> Result<Vec<f64>, AnalysisError> {
    let mut p = vec![0.0; n * n];
    (0..n).for_each(|i| p[i * n + i] = q[i]);
    let mut gain = vec![0.0; CONTROLS * n];
    for pass in 0..5000 {
        let pa = product(&p, a, n, n, n);
        let pb = product(&p, b, n, n, CONTROLS);
        let mut s = transposed_product(b, &pb, n, CONTROLS, CONTROLS);
        (0..CONTROLS).for_each(|i| s[i * CONTROLS + i] += r[i]);
        let bpa = transposed_product(b, &pa, n, CONTROLS, n);
        let next = solve_columns(&s, &bpa, n)?;
        let mut closed = a.to_vec();
        let bk = product(b, &next, n, CONTROLS, n);
        closed.iter_mut().zip(&bk).for_each(|(x, y)| *x -= y);
        let mut new = transposed_product(a, &product(&p, &closed, n, n, n), n, n, n);
        (0..n).for_each(|i| new[i * n + i] += q[i]);
        let change = next
            .iter()
            .zip(&gain)
            .fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
        let size = next.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for i in 0..n {
            for j in 0..n {
                p[i * n + j] = 0.5 * (new[i * n + j] + new[j * n + i]);
            }
        }
        gain = next;
        // A command needs as many passes as there are beats under way before it costs anything.
        if pass > n && change <= 1e-9 * size {
            return Ok(gain);
        }
    }
    Err(AnalysisError::Numbers(
        "Riccati's iteration did not settle: the strokes cannot stabilise this flight".into(),
    ))
}

/// `X Y`, X of shape n x m, Y of shape m x l.
fn product(x: &[f64], y: &[f64], n: usize, m: usize, l: usize) -> Vec<f64> {
    let mut out = vec![0.0; n * l];
    for i in 0..n {
        for k in 0..m {
            let f = x[i * m + k];
            for j in 0..l {
                out[i * l + j] += f * y[k * l + j];
            }
        }
    }
    out
}

/// `X^T Y`, X of shape m x n, Y of shape m x l.
fn transposed_product(x: &[f64], y: &[f64], m: usize, n: usize, l: usize) -> Vec<f64> {
    let mut out = vec![0.0; n * l];
    for k in 0..m {
        for i in 0..n {
            let f = x[k * n + i];
            for j in 0..l {
                out[i * l + j] += f * y[k * l + j];
            }
        }
    }
    out
}

/// `S^-1 Y` column by column.
fn solve_columns(s: &[f64], y: &[f64], n: usize) -> Result<Vec<f64>, AnalysisError> {
    let mut out = vec![0.0; CONTROLS * n];
    for j in 0..n {
        let mut column: Vec<f64> = (0..CONTROLS).map(|i| y[i * n + j]).collect();
        solve_small(&mut s.to_vec(), &mut column)
            .map_err(|e| AnalysisError::Numbers(format!("Riccati's iteration: {e}")))?;
        (0..CONTROLS).for_each(|i| out[i * n + j] = column[i]);
    }
    Ok(out)
}
