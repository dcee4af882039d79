//! A stabiliser: proportional-derivative feedback of place, velocity, attitude and rates with
//! the gains of the discrete linear-quadratic regulator, laid out on the full model's own map
//! over one wingbeat, or over each of equal parts of it, latency included.
//!
//! ```text
//! x[k+1] = M x[k] + B_0 a[k] + B_1 a[k+1]      a: command in force, blended over the beat
//! u[k] = -K (x[k], a[k], commands under way)   command, in force `latency` beats later
//! ```
//!
//! Controls: amplitude of all wings, mean stroke angle of all wings, right-left differences of amplitude and of
//! stroke plane. Free joints are states of the map that nobody sees: their departures are what the map makes of
//! what was seen and commanded since the start, `j[k+1] = M_jx x[k] + M_jj j[k] + ...`; the closed loop has the
//! eigenvalues of the regulator and those of `M_jj`. With a weight of their sums, position and heading are
//! summed from beat to beat and fed back too (integral action): what steadily pulls the flyer away, a load or
//! an air that differs from that of the layout, is then found and taken back wholly. Noise of what is seen is
//! filtered by an [`observer`] where there is one.

pub(crate) mod observer;
pub(crate) mod plant;
mod riccati;

use std::collections::VecDeque;

use wingbeat_flight::control::fits;

use crate::AnalysisError;
use crate::control::departure::{CONTROLS, Controls, Departure, check_beats, pass_on, sides};
use crate::control::part::Orbit;
use crate::control::sensors::Channels;
use crate::trim::Trim;

use observer::{Observer, ProcessNoise};
use plant::{Plant, STATES, SUMMED, states};
use riccati::{Step, riccati};

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

impl Weights {
    /// The weights that are far from those of the default, in words.
    fn far(&self) -> Vec<String> {
        let named = |w: &Self| {
            [
                ("position", w.position),
                ("velocity", w.velocity),
                ("tilt", w.tilt),
                ("rate", w.rate),
                ("command", w.command),
            ]
        };
        let pairs = named(self).into_iter().zip(named(&Self::default()));
        let is_far = |own: f64, usual: f64| !(usual / FAR..=usual * FAR).contains(&own);
        let words = |((name, own), (_, usual)): ((&str, f64), (&str, f64))| {
            is_far(own, usual).then(|| format!("{name} = {own:?} (usually {usual})"))
        };
        let sum = self.sum.filter(|own| is_far(*own, USUAL_SUM));
        let sum = sum.map(|own| format!("sum = {own:?} (usually {USUAL_SUM})"));
        pairs.filter_map(words).chain(sum).collect()
    }
}

/// When is looked, and when acted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Looks in a wingbeat, at equal times.
    pub parts: usize,
    /// Looks from sensing to acting.
    pub latency: usize,
    /// Time constant of the actuators \[looks\]; 0: none.
    pub lag: f64,
}

impl Timing {
    /// The share of the way to a command that actuators go from look to look.
    pub fn share(&self) -> f64 {
        wingbeat_flight::control::share(1.0 / self.lag)
    }
}

/// The stabiliser.
#[derive(Clone, Debug)]
pub struct Regulator {
    /// Of every look of a wingbeat.
    gains: Vec<Vec<f64>>,
    /// Sums of position [m] and heading \[rad\]; empty without integral action.
    sums: Vec<f64>,
    /// Commands in force and under way, oldest first.
    commands: VecDeque<Controls>,
    /// Departures of the free joints that are reckoned with [rad or m, and per s].
    joints: Vec<f64>,
    /// Share of the way to a command that actuators go from look to look.
    share: f64,
    plants: Vec<Plant>,
    observer: Option<Observer>,
}

impl Regulator {
    /// Gains for the trimmed flight and commands that act `latency` beats after sensing.
    ///
    /// # Errors
    /// A flight that the strokes cannot stabilise: Riccati's iteration does not converge; free joints that keep
    /// on moving.
    pub fn new(trim: &Trim, weights: &Weights, latency: usize) -> Result<Self, AnalysisError> {
        let timing = Timing {
            parts: 1,
            latency,
            lag: 0.0,
        };
        Self::timed(trim, weights, &timing)
    }

    /// The same for looks at other times.
    ///
    /// # Errors
    /// As [`Self::new`]; steps of the trim that the looks do not divide; a glide.
    pub fn timed(trim: &Trim, weights: &Weights, timing: &Timing) -> Result<Self, AnalysisError> {
        check_beats(trim)?;
        let sides = sides(&trim.setup);
        let orbit = Orbit::new(trim, timing.parts)?;
        let plants = Plant::parts(trim, &orbit, &sides)?;
        let sums = if weights.sum.is_some() { CONTROLS } else { 0 };
        let joints = trim.beat.joint_sizes().len();
        let step = |p: &Plant| p.augmented(sums, timing.latency, timing.share());
        let steps: Vec<Step> = plants.iter().map(step).collect();
        let n = STATES + joints + sums + CONTROLS * (timing.latency + 1);
        let (q, r) = cost(trim, weights, timing.parts, n);
        let found = Self {
            gains: riccati(&steps, &q, &r, n).map_err(|e| unstable(e, weights))?,
            sums: vec![0.0; sums],
            commands: VecDeque::from(vec![[0.0; CONTROLS]; timing.latency + 1]),
            joints: vec![0.0; joints],
            share: timing.share(),
            plants,
            observer: None,
        };
        found.check_joints(trim, timing)?;
        Ok(found)
    }

    /// With the steady Kalman filter for a flight `trim` that is seen with `noise`.
    ///
    /// # Errors
    /// An iteration that does not converge.
    pub fn observed(
        mut self,
        trim: &Trim,
        process: &ProcessNoise,
        noise: &Channels<f64>,
    ) -> Result<Self, AnalysisError> {
        self.observer = Some(Observer::new(&self.plants, &trim.beat, process, noise)?);
        Ok(self)
    }

    /// The maps that it is laid out on, one for each part of a wingbeat.
    pub fn plants(&self) -> &[Plant] {
        &self.plants
    }

    /// The departure that is estimated where `seen` is seen.
    pub fn estimated(&mut self, seen: &Departure) -> Departure {
        let Some(observer) = &self.observer else {
            return *seen;
        };
        let x = observer.estimate(seen.look, &states(seen));
        self.joints.copy_from_slice(&x[STATES..]);
        Departure::from_states(seen.look, &x)
    }

    /// Feedback gains of every look of a wingbeat, `CONTROLS` rows; columns: position, velocity, rate, tilt
    /// (SI), free joints, sums, then commands in force and under way.
    pub fn gains(&self) -> &[Vec<f64>] {
        &self.gains
    }

    /// The controls against a departure, without limits.
    pub fn controls(&self, departure: &Departure) -> Controls {
        let mut z = self.states(departure);
        z.extend(&self.sums);
        z.extend(self.commands.iter().flatten());
        let n = z.len();
        let gain = &self.gains[departure.look % self.gains.len()];
        std::array::from_fn(|i| -(0..n).map(|j| gain[i * n + j] * z[j]).sum::<f64>())
    }

    /// What is seen, and free joints as they are reckoned with.
    fn states(&self, departure: &Departure) -> Vec<f64> {
        let seen = states(departure);
        seen.iter().chain(&self.joints).copied().collect()
    }

    /// A beat goes by: the command `u` joins those under way, the departure so many `times` the sums. The departure
    /// that is expected at its end.
    pub fn remember(&mut self, departure: &Departure, u: Controls, times: usize) -> Departure {
        let now = pass_on(&mut self.commands, u, self.share);
        let plant = &self.plants[departure.look % self.plants.len()];
        let ahead = plant.advance(&self.states(departure), &now, &self.commands[0]);
        self.joints.copy_from_slice(&ahead[STATES..]);
        if times > 0 {
            let states = states(departure);
            let summed = self.sums.iter_mut().zip(SUMMED);
            summed.for_each(|(sum, k)| *sum += times as f64 * states[k]);
        }
        let expected = Departure::from_states(departure.look + 1, &ahead);
        if let Some(observer) = &mut self.observer {
            observer.expect(ahead);
        }
        expected
    }

    /// Sums, commands, and the filter's states or those of the free joints, for a flight that is resumed.
    pub fn memory(&self) -> Vec<f64> {
        let commands = self.commands.iter().flatten();
        let unseen = match &self.observer {
            Some(observer) => observer.memory(),
            None => self.joints.clone(),
        };
        let numbers = self.sums.iter().chain(commands).copied();
        numbers.chain(unseen).collect()
    }

    /// Goes on from what it remembered.
    ///
    /// # Errors
    /// A memory of another regulator.
    pub fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        let known = self.sums.len() + self.commands.len() * CONTROLS;
        let (seen, unseen) = memory.split_at(known.min(memory.len()));
        fits(seen, known)?;
        match &mut self.observer {
            Some(observer) => {
                observer.restore(unseen)?;
                if let Some(joints) = unseen.get(STATES..) {
                    self.joints.copy_from_slice(joints);
                }
            }
            None => {
                fits(unseen, self.joints.len())?;
                self.joints.copy_from_slice(unseen);
            }
        }
        let commands = self.commands.iter_mut().flatten();
        let numbers = self.sums.iter_mut().chain(commands);
        numbers.zip(seen).for_each(|(x, seen)| *x = *seen);
        Ok(())
    }
}

/// A weight so many times the default, or so small a part of it, may be why no gains are found; those of one
/// tenth of it fly.
const FAR: f64 = 100.0;

/// Sums over the beats that weigh as position and tilt usually do.
const USUAL_SUM: f64 = 2.0;

/// What an iteration without gains means: weights far from those of the default leave nothing to balance within
/// its passes and digits.
fn unstable(error: AnalysisError, weights: &Weights) -> AnalysisError {
    let AnalysisError::Numbers(problem) = error else {
        return error;
    };
    let far = weights.far();
    AnalysisError::Numbers(match far.is_empty() {
        true => format!("{problem}: the strokes cannot stabilise this flight"),
        false => format!(
            "{problem}, with weights so far from the usual ones (control.weights): {}; bring them nearer",
            far.join(", ")
        ),
    })
}

/// Diagonals of the cost of states and commands.
fn cost(trim: &Trim, w: &Weights, parts: usize, n: usize) -> (Vec<f64>, [f64; CONTROLS]) {
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
        let first = STATES + trim.beat.joint_sizes().len();
        for (k, state) in SUMMED.into_iter().enumerate() {
            // As many times as often is summed.
            let sum = parts as f64 * sum;
            let size = if state < 3 { sum * length } else { sum };
            q[first + k] = size.powi(-2);
        }
    }
    (q, [w.command.powi(-2); CONTROLS])
}
