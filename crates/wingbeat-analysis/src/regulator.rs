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
//! amplitude and of stroke plane. With a weight of their sums, position and heading are summed from
//! beat to beat and fed back too (integral action): what steadily pulls the flyer away, a load or an
//! air that differs from that of the layout, is then found and taken back wholly.

use std::collections::VecDeque;

use wingbeat_math::{DVec3, solve_small};

use crate::AnalysisError;
use crate::beat::{Beat, JOINTS};
use crate::departure::{CONTROLS, Controls, Departure, adjustments};
use crate::level::{Level, Perturbation};
use crate::monodromy::monodromy;
use crate::trim::Trim;

/// Position, velocity, angular velocity, tilt.
const STATES: usize = 12;
/// Of the states, those that are summed over the beats: position and heading, as many as there are
/// controls.
const SUMMED: [usize; CONTROLS] = [0, 1, 2, 11];

/// Departures that weigh alike in the cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Position \[wing lengths\].
    pub position: f64,
    /// Velocity \[wing lengths per beat\].
    pub velocity: f64,
    /// Tilt \[rad\].
    pub tilt: f64,
    /// Angular velocity \[rad per beat\].
    pub rate: f64,
    /// Command \[1, rad\].
    pub command: f64,
    /// Sums over the beats of position, in wing lengths, and heading \[rad\]; none: no integral action.
    pub sum: Option<f64>,
}

impl Default for Weights {
    fn default() -> Self {
        Self {
            position: 0.5,
            velocity: 0.2,
            tilt: 0.2,
            rate: 0.2,
            command: 0.05,
            sum: None,
        }
    }
}

/// The stabiliser.
#[derive(Clone, Debug)]
pub struct Regulator {
    gain: Vec<f64>,
    /// Sums of position [m] and heading \[rad\]; empty without integral action.
    sums: Vec<f64>,
    /// Commands in force and under way, oldest first.
    commands: VecDeque<Controls>,
}

impl Regulator {
    /// Gains for the trimmed flight and commands that act `latency` beats after sensing.
    ///
    /// # Errors
    /// A flight that the strokes cannot stabilise: Riccati's iteration does not converge.
    pub fn new(trim: &Trim, weights: &Weights, latency: usize) -> Result<Self, AnalysisError> {
        let wings = &trim.setup.animal.wings;
        let sides: Vec<f64> = wings.iter().map(|w| w.side.sign()).collect();
        let plant = Plant::new(trim, &sides)?;
        let sums = if weights.sum.is_some() { CONTROLS } else { 0 };
        let (a, b, n) = plant.augmented(sums, latency);
        let (q, r) = cost(trim, weights, n);
        let gain = riccati(&a, &b, &q, &r, n)?;
        Ok(Self {
            gain,
            sums: vec![0.0; sums],
            commands: VecDeque::from(vec![[0.0; CONTROLS]; latency + 1]),
        })
    }

    /// Feedback gains, `CONTROLS` rows; columns: position, velocity, rate, tilt (SI), sums, then
    /// commands in force and under way.
    pub fn gain(&self) -> &[f64] {
        &self.gain
    }

    /// The controls against a departure, without limits.
    pub fn controls(&self, departure: &Departure) -> Controls {
        let mut z = states(departure).to_vec();
        z.extend(&self.sums);
        z.extend(self.commands.iter().flatten());
        let n = z.len();
        std::array::from_fn(|i| -(0..n).map(|j| self.gain[i * n + j] * z[j]).sum::<f64>())
    }

    /// A beat goes by: the command `u` joins those under way, the departure the sums, unless the
    /// command is `limited`.
    pub fn remember(&mut self, departure: &Departure, u: Controls, limited: bool) {
        self.commands.push_back(u);
        self.commands.pop_front();
        if !limited {
            let states = states(departure);
            let summed = self.sums.iter_mut().zip(SUMMED);
            summed.for_each(|(sum, k)| *sum += states[k]);
        }
    }

    /// Sums and commands, for a flight that is resumed.
    pub fn memory(&self) -> Vec<f64> {
        let commands = self.commands.iter().flatten();
        self.sums.iter().chain(commands).copied().collect()
    }

    /// Goes on from what it remembered.
    pub fn restore(&mut self, memory: &[f64]) {
        let commands = self.commands.iter_mut().flatten();
        let numbers = self.sums.iter_mut().chain(commands);
        numbers.zip(memory).for_each(|(x, saved)| *x = *saved);
    }
}

/// Position, velocity, angular velocity, tilt.
fn states(departure: &Departure) -> [f64; STATES] {
    let (position, rest) = (departure.position, departure.state.to_array());
    std::array::from_fn(|k| if k < 3 { position[k] } else { rest[k - 3] })
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

    /// The map of states, sums, command in force and commands under way; its effect of a new
    /// command; its order.
    fn augmented(&self, sums: usize, latency: usize) -> (Vec<f64>, Vec<f64>, usize) {
        let first = STATES + sums;
        let n = first + CONTROLS * (latency + 1);
        let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n * CONTROLS]);
        for i in 0..STATES {
            for j in 0..STATES {
                a[i * n + j] = self.m[i * STATES + j];
            }
            for c in 0..CONTROLS {
                a[i * n + first + c] = self.b[0][i * CONTROLS + c];
                let next = self.b[1][i * CONTROLS + c];
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
            if i + CONTROLS < n {
                a[i * n + i + CONTROLS] = 1.0;
            } else {
                b[i * CONTROLS + (i - first) % CONTROLS] = 1.0;
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
    if let Some(sum) = w.sum {
        for (k, state) in SUMMED.into_iter().enumerate() {
            let size = if state < 3 { sum * length } else { sum };
            q[STATES + k] = size.powi(-2);
        }
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
        "Riccati's iteration did not converge: the strokes cannot stabilise this flight".into(),
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
