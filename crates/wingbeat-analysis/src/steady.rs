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

use wingbeat_flight::FlightSetup;
use wingbeat_math::{DMat3, DVec3, EulerSequence, larger, r3};

use crate::AnalysisError;
use crate::unknown::{Bound, Unknown, check_unknowns};

/// Steps per wingbeat at least and at most: in fewer the loads of a beat are off by more than a trim is, and with the
/// most a method of order four is at the last bits.
pub const TRIM_STEPS: [usize; 2] = [20, 2_000];

/// The air is incompressible: speeds are below that of sound [m/s].
pub const SPEED_OF_SOUND: f64 = 340.0;

/// What to trim.
#[derive(Clone, Debug, PartialEq)]
pub struct TrimProblem {
    /// What may be chosen: three of the plane of symmetry; six, three of them lateral, where the flight turns, slips
    /// sideways or has wings that differ.
    pub unknowns: Vec<Unknown>,
    /// Values of further unknowns, which are kept.
    pub given: Vec<(Unknown, f64)>,
    /// Between what unknowns must lie; others within [`Bound::default_of`] where there is a choice.
    pub bounds: Vec<Bound>,
    /// Mean velocity wanted: along the heading, to the right of it, down [m/s]. Heading along n1: N components.
    pub velocity: DVec3,
    /// Turn of the heading about the vertical, positive to the right [rad/s].
    pub turn_rate: f64,
    /// Body pitch at the start of the iteration (kept if not an unknown) \[rad\].
    pub body_pitch: f64,
    /// Body roll, as the pitch \[rad\].
    pub body_roll: f64,
    /// Iteration.
    pub settings: TrimSettings,
}

impl TrimProblem {
    /// Straight flight with `velocity` [m/s], N components, in the plane n1-n3: body pitch, stroke amplitude and mean
    /// stroke angle are found, from the pitch `body_pitch` \[rad\].
    pub fn straight(velocity: DVec3, body_pitch: f64) -> Self {
        Self {
            unknowns: vec![
                Unknown::BodyPitch,
                Unknown::StrokeAmplitude,
                Unknown::StrokeOffset,
            ],
            given: vec![],
            bounds: vec![],
            velocity,
            turn_rate: 0.0,
            body_pitch,
            body_roll: 0.0,
            settings: TrimSettings::default(),
        }
    }

    /// Between what `unknown` must lie.
    pub fn bound(&self, unknown: Unknown) -> Bound {
        let own = self.bounds.iter().find(|b| b.unknown == unknown);
        own.copied().unwrap_or_else(|| Bound::default_of(unknown))
    }

    /// The unknowns whose values are outside the given bounds or turn strokes inside out, and those at a bound, both
    /// to rounding: a confined search that a bound stops ends on it.
    pub(crate) fn beyond(&self, unknowns: &[Unknown], values: &[f64]) -> [Vec<Unknown>; 2] {
        let given = |u: &Unknown| self.given.iter().any(|g| g.0 == *u);
        let bounded = |u: &Unknown| given(u) || self.bounds.iter().any(|b| b.unknown == *u);
        let pairs = || unknowns.iter().zip(values).filter(|(u, _)| bounded(u));
        let outside = pairs().filter(|(u, x)| self.bound(**u).excludes(**x));
        let at = pairs().filter(|(u, x)| self.bound(**u).is_reached(**x, 0.0));
        let (mut outside, at): (Vec<_>, _) =
            (outside.map(|p| *p.0).collect(), at.map(|p| *p.0).collect());
        let turned = turned_inside_out(unknowns, values);
        outside.extend(turned.filter(|u| !outside.contains(u)));
        [outside, at]
    }

    /// Moves values of the chosen unknowns into the bounds that were given.
    pub(crate) fn confine(&self, values: &mut [f64]) {
        for (u, x) in self.unknowns.iter().zip(values) {
            if let Some(b) = self.bounds.iter().find(|b| b.unknown == *u) {
                *x = x.clamp(b.from, b.to);
            }
        }
    }

    /// Chosen unknowns with `values`, then those that are given.
    pub(crate) fn with_given(&self, values: &[f64]) -> (Vec<Unknown>, Vec<f64>) {
        let (given, kept): (Vec<_>, Vec<_>) = self.given.iter().copied().unzip();
        (
            [&self.unknowns[..], &given].concat(),
            [values, &kept].concat(),
        )
    }

    /// Pitch and roll at the start of the iteration.
    pub(crate) fn angles(&self) -> [f64; 2] {
        [self.body_pitch, self.body_roll]
    }
}

/// The unknown by which wings stroke the other way round, with an amplitude below nothing: another motion in
/// antiphase, not a smaller stroke.
pub fn turned_inside_out(unknowns: &[Unknown], values: &[f64]) -> Option<Unknown> {
    let value = |u: Unknown| {
        let at = unknowns.iter().position(|k| *k == u);
        at.map_or(0.0, |k| values[k])
    };
    let both = 1.0 + value(Unknown::StrokeAmplitude);
    let apart = value(Unknown::StrokeAmplitudeDifference);
    match () {
        () if both < 0.0 => Some(Unknown::StrokeAmplitude),
        () if both < 0.5 * apart.abs() => Some(Unknown::StrokeAmplitudeDifference),
        () => None,
    }
}

/// How the iteration runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrimSettings {
    /// Steps per wingbeat.
    pub steps: usize,
    /// Largest residual that counts as trimmed \[1\].
    pub tolerance: f64,
    /// Most Newton steps.
    pub iterations: usize,
}

impl Default for TrimSettings {
    fn default() -> Self {
        Self {
            steps: 100,
            tolerance: 1e-9,
            iterations: 40,
        }
    }
}

/// The flyer at an instant: mass centre and momentum, angular momentum about the mass centre (N components),
/// attitude of the root (root to N).
pub(crate) struct Snapshot {
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

    /// The residuals of a wingbeat from one snapshot to another; the largest of those that are not asked.
    pub(crate) fn between(
        self,
        problem: &TrimProblem,
        size: &Measures,
        [before, after]: &[Snapshot; 2],
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
            Self::Symmetric => {
                let lateral = (0..12).filter(|k| !SYMMETRIC.contains(k)).map(|k| all[k]);
                let largest = lateral.fold(0.0, |m, r| larger(m, r.abs()));
                (SYMMETRIC.map(|k| all[k]).to_vec(), largest)
            }
        }
    }
}

/// How many times more than at its end right and left may part by rounding where a search begins, in flight
/// that is not steady.
pub(crate) const AT_START: f64 = 10.0;

/// An error if right and left part by more than `rounding` where only the plane of symmetry was asked.
pub(crate) fn check_symmetric(lateral: f64, rounding: f64) -> Result<(), AnalysisError> {
    match lateral <= rounding {
        true => Ok(()),
        false => Err(AnalysisError::Asymmetric {
            lateral,
            remedy: "name six unknowns, three of them lateral, e.g. body_pitch stroke_amplitude stroke_offset body_roll stroke_amplitude_difference stroke_plane_difference; or make right and left wings alike and let the wind blow along the plane of symmetry",
        }),
    }
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

/// An error if the problem cannot be posed for `setup`.
pub(crate) fn check(setup: &FlightSetup, problem: &TrimProblem) -> Result<(), AnalysisError> {
    if setup.gravity == DVec3::ZERO {
        return Err(AnalysisError::not_covered(
            "there is no gravity (gravity_m_s2), and a trim balances the weight",
            "leave gravity_m_s2 out, or give the animal a weight to carry",
        ));
    }
    check_numbers(setup, problem)?;
    let all = problem.with_given(&[]).0;
    check_unknowns(setup, &all)?;
    let (residuals, named) = (Residuals::of(problem), problem.unknowns.len());
    let needed = residuals.controls();
    if named < needed {
        let which = match residuals {
            Residuals::Symmetric => "straight flight",
            Residuals::All => "flight with a turn, a sideslip or lateral unknowns",
        };
        return Err(AnalysisError::not_covered(
            format!("{which} determines {needed} unknowns, and {named} are named"),
            "name as many: three of them lateral (body_roll, stroke_amplitude_difference, ...) where there are six",
        ));
    }
    if let Some(k) = (1..all.len()).find(|&k| all[..k].contains(&all[k])) {
        return Err(AnalysisError::not_covered(
            format!("the unknown {} is named twice", all[k].name()),
            "name unknowns that differ",
        ));
    }
    match problem.turn_rate {
        0.0 => Ok(()),
        _ => check_turn(setup),
    }
}

/// An error if speeds, turn or steps are out of range.
fn check_numbers(setup: &FlightSetup, problem: &TrimProblem) -> Result<(), AnalysisError> {
    let speeds = problem.velocity.to_array();
    if let Some(speed) = speeds
        .iter()
        .find(|v| v.is_nan() || v.abs() >= SPEED_OF_SOUND)
    {
        return Err(AnalysisError::not_covered(
            format!("{speed} m/s is no speed below that of sound ({SPEED_OF_SOUND} m/s)"),
            "the air is incompressible: choose a lower speed",
        ));
    }
    if !problem.turn_rate.is_finite() {
        return Err(AnalysisError::not_covered(
            format!("a turn by {} rad/s", problem.turn_rate),
            "give a finite number",
        ));
    }
    // Of more than half a turn in a wingbeat nobody can tell which way it went round.
    let rate = problem.turn_rate;
    let turned = rate * setup.time.period.unwrap_or(0.0);
    if turned.abs() > std::f64::consts::PI {
        return Err(AnalysisError::not_covered(
            format!(
                "a turn by {:.3} deg/s is {:.3} whole turns in a wingbeat",
                rate.to_degrees(),
                turned.abs() / std::f64::consts::TAU
            ),
            "a steady turn has at most half a turn in a wingbeat: choose a lower turn rate",
        ));
    }
    let ([least, most], steps) = (TRIM_STEPS, problem.settings.steps);
    match (least..=most).contains(&steps) {
        true => Ok(()),
        false => Err(AnalysisError::not_covered(
            format!("a trim in {steps} steps per wingbeat"),
            "take 20 to 2000; 100 is the default",
        )),
    }
}

/// The same where no more may be named than is determined.
pub(crate) fn check_determined(
    setup: &FlightSetup,
    problem: &TrimProblem,
) -> Result<(), AnalysisError> {
    check(setup, problem)?;
    let (named, needed) = (problem.unknowns.len(), Residuals::of(problem).controls());
    match named > needed {
        false => Ok(()),
        true => Err(AnalysisError::not_covered(
            format!("{named} unknowns are named, and only {needed} are determined here"),
            "name as many; the others can be chosen for least power in one trim in air without memory",
        )),
    }
}

/// An error if what surrounds the flight does not look the same from all headings.
fn check_turn(setup: &FlightSetup) -> Result<(), AnalysisError> {
    let horizontal = |v: DVec3| v.x != 0.0 || v.y != 0.0;
    let refused = |key: &str, v: DVec3, what: &str, remedy: &'static str| {
        let [x, y, z] = v.to_array();
        let why = format!(
            "a steady turn is about the vertical along n3, and {what} ({key} = [{x}, {y}, {z}])"
        );
        Err(AnalysisError::not_covered(why, remedy))
    };
    let gravity = setup.gravity;
    if horizontal(gravity) {
        let remedy = "take inertial axes of which n3 is along gravity: gravity_m_s2 = [0, 0, 9.81]";
        return refused("gravity_m_s2", gravity, "gravity is not along it", remedy);
    }
    match setup.air.stream().filter(|s| horizontal(*s)) {
        None => Ok(()),
        Some(stream) => refused(
            "air.stream_m_s",
            stream,
            "the air streams across it",
            "leave air.stream_m_s out: velocities are relative to the air then",
        ),
    }
}

/// The controls of the point at which a search begins.
pub(crate) fn first_controls(problem: &TrimProblem) -> impl Iterator<Item = f64> {
    problem.unknowns.iter().map(|u| match u {
        Unknown::BodyPitch => problem.body_pitch,
        Unknown::BodyRoll => problem.body_roll,
        _ => 0.0,
    })
}
