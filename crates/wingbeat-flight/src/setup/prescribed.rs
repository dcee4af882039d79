//! Motions prescribed as Fourier series in time, from rest on or at once.

use wingbeat_dynamics::{BodyAcceleration, BodyMotion, RootMotion};
use wingbeat_math::{DVec3, DriftingFourier, MovingRotation};
use wingbeat_model::Start;

/// A prescribed motion of the root body.
#[derive(Clone, Debug, PartialEq)]
pub struct PrescribedMotion {
    /// Origin of the root frame, three N components [m].
    pub position: [DriftingFourier; 3],
    /// 2-3-1 Euler angles phi, theta, psi [rad].
    pub angles: [DriftingFourier; 3],
    /// How all of it starts.
    pub start: Start,
}

impl PrescribedMotion {
    /// Period of the slowest of its oscillations [s]; none where nothing oscillates.
    pub fn period(&self) -> Option<f64> {
        let all = self.position.iter().chain(&self.angles);
        let oscillating = all.filter(|q| q.oscillates());
        let periods = oscillating.map(|q| 1.0 / q.frequency.abs());
        periods.reduce(f64::max)
    }

    /// At rest at `position` [m] with 2-3-1 `angles` [rad].
    pub fn at_rest(position: DVec3, angles: DVec3) -> Self {
        let fixed = |v: DVec3| v.to_array().map(DriftingFourier::constant);
        Self {
            position: fixed(position),
            angles: fixed(angles),
            start: Start::Impulsive,
        }
    }

    /// From `position` \[m\] on with `velocity` \[m/s\], N components, at constant 2-3-1 `angles` \[rad\].
    pub fn straight(position: DVec3, velocity: DVec3, angles: DVec3) -> Self {
        let mut motion = Self::at_rest(position, angles);
        let along = motion.position.iter_mut().zip(velocity.to_array());
        along.for_each(|(x, v)| x.rate = v);
        motion
    }

    /// The motion without its start: at full rate from the first instant.
    pub fn impulsive(&self) -> Self {
        Self {
            start: Start::Impulsive,
            ..self.clone()
        }
    }

    /// Whether nothing moves.
    pub fn rests(&self) -> bool {
        let mut all = self.position.iter().chain(&self.angles);
        all.all(DriftingFourier::is_constant)
    }

    /// A coordinate at time `t` [s] with its first two derivatives.
    fn value(&self, law: &DriftingFourier, t: f64) -> [f64; 3] {
        if self.start == Start::Impulsive {
            return law.at(t);
        }
        let [tau, rate, change] = self.start.warp(t);
        let [x, v, a] = law.at(tau);
        [x, v * rate, a * rate * rate + v * change]
    }

    /// Rotation R_NB of the root at time `t` [s] with its derivatives.
    pub(crate) fn turning(&self, t: f64) -> MovingRotation {
        let about =
            |axis: usize, i: usize| MovingRotation::about(axis, self.value(&self.angles[i], t));
        about(1, 0).then(&about(2, 1)).then(&about(0, 2))
    }

    /// The root at time `t` [s].
    pub fn at(&self, t: f64) -> RootMotion {
        let x: [[f64; 3]; 3] = std::array::from_fn(|i| self.value(&self.position[i], t));
        let derivative = |k: usize| DVec3::new(x[0][k], x[1][k], x[2][k]);
        let r = self.turning(t);
        RootMotion {
            motion: BodyMotion {
                p: derivative(0),
                r: r.c,
                v: derivative(1),
                w: r.w,
            },
            acceleration: BodyAcceleration {
                linear: derivative(2),
                angular: r.w_dot,
            },
        }
    }
}
