//! Strokes that are steered: amplitude, mean angle and plane go over from one command to the next, on top of a
//! steady beat whose angles are known beforehand at the half steps of the integration.
//!
//! As adjustments go over linearly ([`MotionBlend`](wingbeat_flight::MotionBlend)), the stroke angle is `mean + (1 +
//! a(t)) (phi - mean) + s o(t)` with the commanded relative amplitude a and offset o, s = 1 on the right and -1
//! on the left.

use std::sync::{Arc, RwLock};

use wingbeat_math::{MovingRotation, RotationLaw, smoothstep7};
use wingbeat_model::Wing;
use wingbeat_model::motion::{Adjustment, wing_rotation};

/// The angles of a wing over a steady beat.
#[derive(Debug)]
pub struct SteadyStroke {
    /// phi, theta, psi at the half steps, each value, rate, acceleration [rad].
    angles: Vec<[[f64; 3]; 3]>,
    /// Half a step [s].
    half: f64,
    /// Mean stroke angle [rad].
    mean: f64,
    /// Pitch of the stroke plane [rad].
    plane: f64,
    /// Right +1, left -1.
    side: f64,
}

impl SteadyStroke {
    /// Of a wing, beating from the first instant, in `steps` steps a beat of `period` [s].
    pub fn new(wing: &Wing, period: f64, steps: usize) -> Self {
        let motion = wing.motion.impulsive();
        let half = period / (2 * steps) as f64;
        Self {
            angles: (0..2 * steps)
                .map(|k| motion.angles(k as f64 * half))
                .collect(),
            half,
            mean: motion.angles.phi.mean(),
            plane: motion.stroke_plane_pitch,
            side: wing.side.sign(),
        }
    }
}

/// A command in force: relative amplitude, offset [rad], plane [rad].
type Command = [f64; 3];

/// From one command to another.
#[derive(Clone, Copy, Debug)]
pub struct Transition {
    from: Command,
    to: Command,
    start: f64,
    duration: f64,
}

impl Default for Transition {
    /// No command.
    fn default() -> Self {
        Self {
            from: [0.0; 3],
            to: [0.0; 3],
            start: 0.0,
            duration: 1.0,
        }
    }
}

impl Transition {
    /// All numbers of it: commands before and after, start and duration [s].
    pub(super) fn numbers(&self) -> [f64; 8] {
        let ([a, b, c], [d, e, f]) = (self.from, self.to);
        [a, b, c, d, e, f, self.start, self.duration]
    }

    /// The one of these numbers.
    pub(super) fn of_numbers([a, b, c, d, e, f, start, duration]: [f64; 8]) -> Self {
        Self {
            from: [a, b, c],
            to: [d, e, f],
            start,
            duration,
        }
    }

    /// What comes after this one: from `start` [s] on the stroke goes over to a command within `duration` [s].
    pub fn then(&self, to: &Adjustment, start: f64, duration: f64) -> Self {
        Self {
            from: self.to,
            to: [to.stroke_amplitude, to.stroke_offset, to.stroke_plane],
            start,
            duration,
        }
    }
}

/// The stroke of a wing under commands, to be asked at multiples of half a step.
#[derive(Debug)]
pub struct SteeredStroke {
    steady: Arc<SteadyStroke>,
    transition: RwLock<Transition>,
}

impl SteeredStroke {
    /// Without a command.
    pub fn new(steady: Arc<SteadyStroke>) -> Self {
        Self {
            steady,
            transition: RwLock::default(),
        }
    }

    /// Follows these commands from now on.
    pub fn follow(&self, transition: Transition) {
        *self.transition.write().expect("no writer panicked") = transition;
    }
}

impl RotationLaw for SteeredStroke {
    fn at(&self, t: f64) -> MovingRotation {
        let steady = &*self.steady;
        let k = (t / steady.half).round() as usize % steady.angles.len();
        let [phi, theta, psi] = steady.angles[k];
        let transition = *self.transition.read().expect("no writer panicked");
        let s = smoothstep7(t, transition.start, transition.duration);
        let now = |i: usize| {
            let change = transition.to[i] - transition.from[i];
            [
                transition.from[i] + s[0] * change,
                s[1] * change,
                s[2] * change,
            ]
        };
        let (a, o, plane) = (now(0), now(1), now(2));
        let swing = phi[0] - steady.mean;
        let phi = [
            steady.mean + (1.0 + a[0]) * swing + steady.side * o[0],
            (1.0 + a[0]) * phi[1] + a[1] * swing + steady.side * o[1],
            (1.0 + a[0]) * phi[2] + 2.0 * a[1] * phi[1] + a[2] * swing + steady.side * o[2],
        ];
        wing_rotation(
            [steady.plane + plane[0], plane[1], plane[2]],
            [phi, theta, psi],
        )
    }
}
