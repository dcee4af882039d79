//! A proportional-derivative stabiliser: attitude and altitude, each by its own stroke control.
//!
//! ```text
//! pitch    <- mean stroke angle of all wings        roll    <- right-left difference of amplitude
//! heading  <- right-left difference of stroke plane  altitude <- amplitude of all wings
//! u = -(omega^2 (x + iota sum of x) + 2 zeta omega x') / B
//! ```
//!
//! with B the acceleration per unit of the control, that of the mean rigid body with the added mass of the air
//! ([`input_matrix`]; of roll and heading a 2 x 2 matrix, for either control does both): each loop, alone and
//! without latency, has the natural frequency omega and the damping zeta. With iota above 0 it is
//! proportional-integral- derivative: sums over the looks take back wholly what pulls steadily, and stand still
//! while a command is at its limit. Drift is braked by leaning against it: the pitch and roll held are `-+
//! omega_v u / g`. The place is not held; the regulator ([`crate::control::regulator`]) holds it, and bears longer
//! latencies.

use wingbeat_flight::control::fits;
use wingbeat_math::DVec3;
use wingbeat_model::Wing;

use crate::AnalysisError;
use crate::control::departure::{Controls, Departure, check_beats};
use crate::stability::{input_matrix, trimmed_controls};
use crate::trim::Trim;

/// Rows of the input matrix: w, p, q, r.
const DOWN: usize = 2;
const ROLL_RATE: usize = 3;
const PITCH_RATE: usize = 4;
const YAW_RATE: usize = 5;

/// How stiff the loops are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// Natural frequency of pitch [rad per wingbeat].
    pub pitch: f64,
    /// Natural frequency of roll and heading [rad per wingbeat]: stiff enough to hold the lateral
    /// divergence.
    pub lateral: f64,
    /// Natural frequency of altitude [rad per wingbeat].
    pub altitude: f64,
    /// Rate at which drift is braked [1 per wingbeat].
    pub drift: f64,
    /// Damping ratio of all \[1\].
    pub damping: f64,
    /// Rate iota at which departures are summed [1 per wingbeat]; 0: no integral action.
    pub integral: f64,
}

impl Default for Stiffness {
    fn default() -> Self {
        Self {
            pitch: 0.25,
            lateral: 0.45,
            altitude: 0.1,
            drift: 0.1,
            damping: 1.0,
            integral: 0.0,
        }
    }
}

/// What the controls do, and the stiffness asked for.
#[derive(Clone, Debug)]
pub struct ProportionalDerivative {
    /// Acceleration upward-negative per relative amplitude of all wings [m/s2].
    lift: f64,
    /// Pitch acceleration per mean stroke angle [1/s2].
    nod: f64,
    /// Inverse of roll and heading accelerations (rows) per difference of amplitude and of
    /// stroke plane (columns) [s2].
    lateral: [[f64; 2]; 2],
    /// Natural frequencies of roll, pitch, heading and altitude [rad/s].
    omega: [f64; 4],
    /// Lean per drift [rad s/m].
    lean: f64,
    /// Damping ratio \[1\].
    damping: f64,
    /// Share of a departure that joins its sum from look to look \[1\].
    integral: f64,
    /// Sums of roll, pitch, heading \[rad\] and altitude [m], in looks times shares.
    sums: [f64; 4],
}

impl ProportionalDerivative {
    /// The stabiliser of the trimmed flight.
    ///
    /// # Errors
    /// A setup without control derivatives; a control without effect; a glide.
    pub fn new(trim: &Trim, stiffness: &Stiffness) -> Result<Self, AnalysisError> {
        check_beats(trim)?;
        let list = trimmed_controls(trim)?;
        let rates = input_matrix(&trim.beat, &trim.state, &list)?;
        let effect = |name: &str, wing: &str, row: usize| {
            let found = list
                .iter()
                .position(|d| d.control == name && d.wing == wing);
            found.map_or(0.0, |k| rates[row * list.len() + k])
        };
        let apart = |name: &str, row: usize| -> f64 {
            let part = |w: &Wing| 0.5 * w.side.sign() * effect(name, &w.name, row);
            trim.setup.animal.wings.iter().map(part).sum()
        };
        let [bank, yaw] = ["stroke_amplitude", "stroke_plane"]
            .map(|name| [apart(name, ROLL_RATE), apart(name, YAW_RATE)]);
        let det = bank[0] * yaw[1] - yaw[0] * bank[1];
        let lift = effect("stroke_amplitude", "all", DOWN);
        let nod = effect("stroke_offset", "all", PITCH_RATE);
        if [det, lift, nod].iter().any(|x| *x == 0.0 || !x.is_finite()) {
            return Err(AnalysisError::Numbers(
                "a control of the stabiliser has no effect on this flyer".into(),
            ));
        }
        let (period, k) = (trim.beat.period(), stiffness);
        Ok(Self {
            lift,
            nod,
            lateral: [
                [yaw[1] / det, -yaw[0] / det],
                [-bank[1] / det, bank[0] / det],
            ],
            omega: [k.lateral, k.pitch, k.lateral, k.altitude].map(|x| x / period),
            lean: k.drift / period / trim.beat.gravity().length(),
            damping: k.damping,
            integral: k.integral,
            sums: [0.0; 4],
        })
    }

    /// The same with so many looks in a wingbeat.
    #[must_use]
    pub fn looking(mut self, parts: usize) -> Self {
        self.integral /= parts as f64;
        self
    }

    /// The controls against a departure, without limits.
    pub fn controls(&self, departure: &Departure) -> Controls {
        let d = &departure.state;
        let errors = self.errors(departure);
        let wanted = |k: usize, rate: f64| {
            let omega = self.omega[k];
            -omega * omega * (errors[k] + self.sums[k]) - 2.0 * self.damping * omega * rate
        };
        let turn = |k: usize| wanted(k, d.rate[k]);
        let [roll, heading] = [turn(0), turn(2)];
        let amplitude = wanted(3, d.velocity.z) / self.lift;
        let [bank, yaw] = self.lateral.map(|row| row[0] * roll + row[1] * heading);
        [amplitude, turn(1) / self.nod, bank, yaw]
    }

    /// Departures of roll, pitch, heading and altitude from what is held.
    fn errors(&self, departure: &Departure) -> [f64; 4] {
        let d = &departure.state;
        // Nose up accelerates backwards, right wing down accelerates to the right.
        let lean = self.lean * DVec3::new(d.velocity.y, -d.velocity.x, 0.0);
        let tilt = d.tilt + lean;
        [tilt.x, tilt.y, tilt.z, departure.position.z]
    }

    /// Time goes by: the departure joins the sums so many `times`.
    pub fn remember(&mut self, departure: &Departure, times: usize) {
        if self.integral > 0.0 && times > 0 {
            let errors = self.errors(departure);
            let share = times as f64 * self.integral;
            let sums = self.sums.iter_mut().zip(errors);
            sums.for_each(|(sum, x)| *sum += share * x);
        }
    }

    /// Sums, for a flight that is resumed; nothing without integral action.
    pub fn memory(&self) -> Vec<f64> {
        match self.integral > 0.0 {
            true => self.sums.to_vec(),
            false => vec![],
        }
    }

    /// Goes on from what it remembered.
    ///
    /// # Errors
    /// A memory of other loops.
    pub fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        fits(memory, self.memory().len())?;
        self.sums = memory.try_into().unwrap_or_default(); // without integral action
        Ok(())
    }
}
