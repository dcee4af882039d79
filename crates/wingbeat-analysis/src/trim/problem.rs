//! What to trim: the steady flight that is wanted, and what may be chosen for it.

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::trim::unknown::{Bound, Unknown, UnknownKind};

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
    /// Mean velocity wanted: along the heading, to the right of it, down [m/s]. Heading along n1: N components. Where
    /// [`Unknown::Forward`] or [`Unknown::Climb`] is chosen, the search begins with it.
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

    /// Moves the chosen unknowns, as they stand in a point, into the bounds that were given.
    pub(crate) fn confine(&self, setup: &FlightSetup, numbers: &mut [f64]) {
        for (u, x) in self.unknowns.iter().zip(numbers) {
            if let Some(b) = self.bounds.iter().find(|b| b.unknown == *u) {
                let size = size_in_point(*u, setup);
                *x = x.clamp(b.from / size, b.to / size);
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

    /// The values of the chosen unknowns where they stand as `numbers` in a point.
    pub(crate) fn values(&self, setup: &FlightSetup, numbers: &[f64]) -> Vec<f64> {
        let unknowns = self.unknowns.iter().zip(numbers);
        unknowns
            .map(|(u, x)| x * size_in_point(*u, setup))
            .collect()
    }

    /// The same flight with the speeds among these `values` of `unknowns`.
    pub(crate) fn at_speeds(&self, unknowns: &[Unknown], values: &[f64]) -> Self {
        let mut at = self.clone();
        for (unknown, x) in unknowns.iter().zip(values) {
            match unknown {
                Unknown::Forward => at.velocity.x = *x,
                Unknown::Climb => at.velocity.z = -x,
                _ => {}
            }
        }
        at
    }

    /// The value of `unknown` at the start of the iteration.
    pub(crate) fn first(&self, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::BodyPitch => self.body_pitch,
            Unknown::BodyRoll => self.body_roll,
            Unknown::Forward => self.velocity.x,
            Unknown::Climb => -self.velocity.z,
            _ => 0.0,
        }
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
        () if value(Unknown::DriveAmplitude) < -1.0 => Some(Unknown::DriveAmplitude),
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

/// The unknowns in the point at which a search begins.
pub(crate) fn first_unknowns(
    setup: &FlightSetup,
    problem: &TrimProblem,
) -> impl Iterator<Item = f64> {
    let unknowns = problem.unknowns.iter();
    unknowns.map(|u| problem.first(*u) / size_in_point(*u, setup))
}

/// The unit in which an unknown stands in a point: of speeds sqrt(g R) [m/s], of others that of its value.
fn size_in_point(unknown: Unknown, setup: &FlightSetup) -> f64 {
    match unknown.kind() {
        UnknownKind::Speed => (setup.gravity.length() * setup.animal.wing_length()).sqrt(),
        _ => 1.0,
    }
}
