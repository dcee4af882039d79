//! What steady flight asks of a wingbeat: that it changes nothing but place and heading.
//!
//! Straight flight of what is the same right and left has six residuals, in its plane of symmetry; all other steady
//! flight (turns, sideslip, wings that differ) has twelve:
//!
//! ```text
//! dP / (m g T) = 0    dH / (m g R T) = 0    d attitude = 0    dx / R = V T / R
//! ```
//!
//! P and H, momentum and angular momentum about the mass centre, and the attitude are seen from axes that turn with
//! the flight about the vertical. The unknowns are velocity and angular velocity at the start of the beat and half as
//! many controls as there are residuals.

use wingbeat_math::{DMat3, DVec3, EulerSequence, larger, r3};

use crate::trim::problem::TrimProblem;

/// The flyer at an instant: mass centre and momentum, angular momentum about the mass centre (N components),
/// attitude of the root (root to N).
pub(crate) struct FlyerMotion {
    pub centre: DVec3,
    pub momentum: DVec3,
    pub spin: DVec3,
    pub rotation: DMat3,
}

/// Scales of a flight: wing length R [m], period T [s], weight m g [N].
pub(crate) struct Measures {
    pub length: f64,
    pub period: f64,
    pub weight: f64,
}

/// Which residuals are asked of a wingbeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Residuals {
    /// Of straight flight in the plane of symmetry: six.
    Symmetric,
    /// Of any steady flight: twelve.
    All,
}

/// Rows of [`Residuals::All`] that make [`Residuals::Symmetric`].
const SYMMETRIC: [usize; 6] = [0, 2, 4, 7, 9, 11];

/// Names of the twelve residuals: in words, and for programs.
const NAMES: [[&str; 2]; 12] = [
    ["force forward / weight", "force_forward_over_weight"],
    ["force right / weight", "force_right_over_weight"],
    ["force down / weight", "force_down_over_weight"],
    [
        "roll moment / (weight R)",
        "roll_moment_over_weight_and_length",
    ],
    [
        "pitch moment / (weight R)",
        "pitch_moment_over_weight_and_length",
    ],
    [
        "yaw moment / (weight R)",
        "yaw_moment_over_weight_and_length",
    ],
    ["roll per beat [rad]", "roll_per_beat_rad"],
    ["pitch per beat [rad]", "pitch_per_beat_rad"],
    ["heading per beat [rad]", "heading_per_beat_rad"],
    [
        "drift forward / R per beat",
        "drift_forward_over_length_per_beat",
    ],
    [
        "drift right / R per beat",
        "drift_right_over_length_per_beat",
    ],
    ["drift down / R per beat", "drift_down_over_length_per_beat"],
];

impl Residuals {
    /// Those that a trim by `unknowns` of the flight that `problem` wants has.
    pub fn of(problem: &TrimProblem) -> Self {
        let apart = problem.velocity.y != 0.0 || problem.turn_rate != 0.0;
        let given = problem.given.iter().map(|g| &g.0);
        match apart || problem.unknowns.iter().chain(given).any(|u| u.is_lateral()) {
            true => Self::All,
            false => Self::Symmetric,
        }
    }

    /// How many there are.
    pub fn count(self) -> usize {
        match self {
            Self::Symmetric => 6,
            Self::All => 12,
        }
    }

    /// How many controls they determine: the other half is velocity and angular velocity.
    pub fn controls(self) -> usize {
        self.count() / 2
    }

    /// Their names in order: in words, and for programs.
    pub fn names(self) -> Vec<[&'static str; 2]> {
        match self {
            Self::Symmetric => SYMMETRIC.map(|k| NAMES[k]).to_vec(),
            Self::All => NAMES.to_vec(),
        }
    }

    /// Velocity over R / T and angular velocity times T as the first numbers of a point.
    pub(crate) fn point(self, velocity: DVec3, rate: DVec3) -> Vec<f64> {
        match self {
            Self::Symmetric => vec![velocity.x, velocity.z, rate.y],
            Self::All => [velocity.to_array(), rate.to_array()].concat(),
        }
    }

    /// The same back from a point.
    pub(crate) fn motion(self, x: &[f64]) -> [DVec3; 2] {
        match self {
            Self::Symmetric => [DVec3::new(x[0], 0.0, x[1]), DVec3::new(0.0, x[2], 0.0)],
            Self::All => [DVec3::from_slice(x), DVec3::from_slice(&x[3..])],
        }
    }

    /// The residuals of a flyer that is towed steadily, by the force over its weight and the moment about its mass centre
    /// over weight and wing length, N components, that it lacks: the first half of all, the others being the motion that is
    /// prescribed. And the largest of those that are not asked.
    pub(crate) fn of_tow(self, [force, moment]: [DVec3; 2]) -> (Vec<f64>, f64) {
        let all = [force.to_array(), moment.to_array()].concat();
        match self {
            Self::All => (all, 0.0),
            Self::Symmetric => parted(&all),
        }
    }

    /// The residuals of a wingbeat from one motion to another; the largest of those that are not asked.
    pub(crate) fn between(
        self,
        problem: &TrimProblem,
        size: &Measures,
        [before, after]: &[FlyerMotion; 2],
    ) -> (Vec<f64>, f64) {
        let turned = problem.turn_rate * size.period;
        let back = r3(turned).transpose();
        let force = (back * after.momentum - before.momentum) / (size.weight * size.period);
        let moment = (back * after.spin - before.spin) / (size.weight * size.length * size.period);
        let rotation = before.rotation.transpose() * back * after.rotation;
        let [roll, pitch, heading] = match self {
            Self::Symmetric => angles_about_symmetry(rotation),
            Self::All => angles(rotation),
        };
        let way = after.centre - before.centre;
        let drift = (way - wanted_way(problem, size.period)) / size.length;
        let all = [
            force.to_array(),
            moment.to_array(),
            [roll, pitch, heading],
            drift.to_array(),
        ]
        .concat();
        match self {
            Self::All => (all, 0.0),
            Self::Symmetric => parted(&all),
        }
    }
}

/// Of residuals of any flight those of the plane of symmetry, and the largest of the others.
fn parted(all: &[f64]) -> (Vec<f64>, f64) {
    let is_asked = |k: &usize| SYMMETRIC.contains(k);
    let lateral = (0..all.len()).filter(|k| !is_asked(k)).map(|k| all[k]);
    let largest = lateral.fold(0.0, |m, r| larger(m, r.abs()));
    let asked = (0..all.len()).filter(is_asked).map(|k| all[k]);
    (asked.collect(), largest)
}

/// Small rotations about the three axes \[rad\].
fn angles(turned: DMat3) -> [f64; 3] {
    let m = turned;
    [
        m.y_axis.z.atan2(m.z_axis.z),
        m.z_axis.x.atan2(m.x_axis.x),
        m.x_axis.y.atan2(m.x_axis.x),
    ]
}

/// The same of rotations by any pitch: roll and heading are the tilt of the axis to the right, 0 in the plane
/// of symmetry \[rad\].
fn angles_about_symmetry(turned: DMat3) -> [f64; 3] {
    let right = turned.y_axis;
    let [_, pitch, _] = angles(turned);
    [right.z.atan2(right.y), pitch, (-right.x).atan2(right.y)]
}

/// Where the mass centre is to go in a beat of `period` [s]: along a straight line, or an arc about the vertical.
fn wanted_way(problem: &TrimProblem, period: f64) -> DVec3 {
    let (v, turned) = (problem.velocity, problem.turn_rate * period);
    if turned == 0.0 {
        return v * period;
    }
    // The chord of the arc: half the turn ahead.
    let chord = r3(0.5 * turned) * v * ((0.5 * turned).sin() / (0.5 * turned));
    DVec3::new(chord.x, chord.y, v.z) * period
}

/// The body's angular velocity in a steady turn, root components [rad/s].
pub(crate) fn turning(problem: &TrimProblem, [pitch, roll]: [f64; 2]) -> DVec3 {
    attitude([pitch, roll]).transpose() * DVec3::new(0.0, 0.0, problem.turn_rate)
}

/// Attitude of a body that heads along n1 (root to N).
pub(crate) fn attitude([pitch, roll]: [f64; 2]) -> DMat3 {
    EulerSequence::BODY_231.rotation(DVec3::new(pitch, 0.0, roll))
}
