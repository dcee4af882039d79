//! What is to be done in an episode: where it begins, where the target is, what is rewarded.

use std::f64::consts::TAU;

use wingbeat_air::{Gust, GustShape};
use wingbeat_math::{DVec3, SplitMix64};

use crate::beat::Beat;
use crate::beat::level::Perturbation;
use crate::control::departure::{CONTROLS, Departure};

/// A task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Holds the place after a small disturbance.
    Hover,
    /// Comes back from a tumble.
    Recover,
    /// Follows a target that goes round a horizontal circle.
    Path,
    /// Holds the place when a gust comes.
    Gust,
}

impl Task {
    /// All tasks with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("hover", Self::Hover),
        ("recover", Self::Recover),
        ("path", Self::Path),
        ("gust", Self::Gust),
    ];

    /// Tilt [rad] and angular velocity [1/T] at most at the start.
    fn disturbance(self) -> [f64; 2] {
        match self {
            Self::Hover | Self::Path | Self::Gust => [0.1, 0.02],
            Self::Recover => [1.2, 0.2],
        }
    }

    /// Place and velocity of the target, level axes [m, m/s]: at rest, or on a circle of radius 4 R, once in
    /// 100 wingbeats.
    pub fn target(self, beat: &Beat, time: f64) -> (DVec3, DVec3) {
        const RADIUS: f64 = 4.0;
        const BEATS: f64 = 100.0;
        if self != Self::Path {
            return (DVec3::ZERO, DVec3::ZERO);
        }
        let (radius, rate) = (RADIUS * beat.wing_length(), TAU / (BEATS * beat.period()));
        let (sin, cos) = (rate * time).sin_cos();
        (
            radius * DVec3::new(sin, 1.0 - cos, 0.0),
            radius * rate * DVec3::new(cos, sin, 0.0),
        )
    }

    /// Whether the flyer is lost: 20 wing lengths from the target, or turned by more than 2.5 rad.
    pub fn is_lost(self, beat: &Beat, d: &Departure) -> bool {
        d.position.length() > 20.0 * beat.wing_length() || d.state.tilt.length() > 2.5
    }

    /// Reward of a wingbeat, in (0, 1]: `exp(-cost)`, the cost quadratic in distance [R], velocity [R/T], tilt
    /// [rad] and controls.
    pub fn reward(self, beat: &Beat, d: &Departure, controls: &[f64; CONTROLS]) -> f64 {
        let length = beat.wing_length();
        let speed = d.state.velocity * beat.period() / length;
        let effort: f64 = controls.iter().map(|x| x.clamp(-1.0, 1.0).powi(2)).sum();
        let cost = 0.2 * (d.position / length).length_squared()
            + 1.0 * d.state.tilt.length_squared()
            + 1.0 * speed.length_squared()
            + 0.02 * effort;
        (-cost).exp()
    }
}

/// Numbers that follow from seed and episode alone.
pub struct Draw(SplitMix64);

impl Draw {
    /// Those of an episode of `seed`.
    pub fn new(seed: u64, episode: u64) -> Self {
        let mut numbers = SplitMix64::new(SplitMix64::mixed_with(seed, &[episode]));
        numbers.bits(); // the first is passed over: episodes stay what they were
        Self(numbers)
    }

    /// Between -1 and 1.
    pub fn number(&mut self) -> f64 {
        2.0 * self.0.unit() - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

/// How an episode begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// What the trimmed flight is disturbed by, its velocity along axes that stay level.
    pub by: Perturbation,
    /// A gust on the way.
    pub gust: Option<Gust>,
}

impl Start {
    /// As the task says.
    pub fn drawn(task: Task, beat: &Beat, draw: &mut Draw) -> Self {
        let [tilt, rate] = task.disturbance();
        let speed = beat.wing_length() / beat.period();
        Self {
            by: Perturbation {
                tilt: tilt * draw.vector(),
                velocity: 0.05 * speed * draw.vector(),
                rate: rate / beat.period() * draw.vector(),
            },
            gust: (task == Task::Gust).then(|| gust(speed, beat.period(), draw)),
        }
    }
}

/// A horizontal gust of up to half a wing length a beat, over four wingbeats, that begins within the first twenty.
fn gust(speed: f64, period: f64, draw: &mut Draw) -> Gust {
    let (sin, cos) = (0.5 * TAU * draw.number()).sin_cos();
    let size = (0.35 + 0.15 * draw.number()) * speed;
    Gust {
        amplitude: size * DVec3::new(cos, sin, 0.0),
        start: (11.0 + 9.0 * draw.number()) * period,
        slowness: DVec3::ZERO,
        shape: GustShape::OneMinusCosine {
            duration: 4.0 * period,
        },
    }
}
