//! Motions prescribed as Fourier series in time.

use wingbeat_math::{DMat3, DVec3, MovingRotation};

/// A truncated Fourier series with a drift:
/// `x(t) = x0 + rate t + sum_k a_k cos(2 pi k f t) + b_k sin(2 pi k f t)`, k = 1, 2, ...
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriftingFourier {
    /// Value without the oscillation at t = 0.
    pub constant: f64,
    /// Steady rate of change [1/s].
    pub rate: f64,
    /// Fundamental frequency f [Hz].
    pub frequency: f64,
    /// Cosine coefficients a_1, a_2, ...
    pub cosine: Vec<f64>,
    /// Sine coefficients b_1, b_2, ...
    pub sine: Vec<f64>,
}

impl DriftingFourier {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Self {
            constant: value,
            ..Self::default()
        }
    }

    /// Value and first two time derivatives at `t` [s].
    pub fn at(&self, t: f64) -> [f64; 3] {
        let mut x = [self.constant + self.rate * t, self.rate, 0.0];
        let base = 2.0 * std::f64::consts::PI * self.frequency;
        for k in 1..=self.cosine.len().max(self.sine.len()) {
            let a = self.cosine.get(k - 1).copied().unwrap_or(0.0);
            let b = self.sine.get(k - 1).copied().unwrap_or(0.0);
            let w = base * k as f64;
            let (s, c) = (w * t).sin_cos();
            x[0] += a * c + b * s;
            x[1] += w * (b * c - a * s);
            x[2] -= w * w * (a * c + b * s);
        }
        x
    }
}

/// A prescribed motion of the root body.
#[derive(Clone, Debug, PartialEq)]
pub struct PrescribedMotion {
    /// Origin of the root frame, three N components [m].
    pub position: [DriftingFourier; 3],
    /// 2-3-1 Euler angles phi, theta, psi [rad].
    pub angles: [DriftingFourier; 3],
}

/// Pose, velocities and accelerations of a prescribed root at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrescribedRoot {
    /// Origin, N components [m].
    pub position: DVec3,
    /// Velocity of the origin, N components [m/s].
    pub velocity: DVec3,
    /// Acceleration of the origin, N components [m/s2].
    pub acceleration: DVec3,
    /// Rotation R_NB.
    pub rotation: DMat3,
    /// Angular velocity, root components [rad/s].
    pub angular_velocity: DVec3,
    /// Angular acceleration, root components [rad/s2].
    pub angular_acceleration: DVec3,
}

impl PrescribedMotion {
    /// At rest at `position` [m] with 2-3-1 `angles` [rad].
    pub fn at_rest(position: DVec3, angles: DVec3) -> Self {
        let fixed = |v: DVec3| v.to_array().map(DriftingFourier::constant);
        Self {
            position: fixed(position),
            angles: fixed(angles),
        }
    }

    /// Rotation R_NB of the root at time `t` [s] with its derivatives.
    pub(crate) fn turning(&self, t: f64) -> MovingRotation {
        let about = |axis: usize, i: usize| MovingRotation::about(axis, self.angles[i].at(t));
        about(1, 0).then(&about(2, 1)).then(&about(0, 2))
    }

    /// The root at time `t` [s].
    pub fn at(&self, t: f64) -> PrescribedRoot {
        let x: [[f64; 3]; 3] = std::array::from_fn(|i| self.position[i].at(t));
        let derivative = |k: usize| DVec3::new(x[0][k], x[1][k], x[2][k]);
        let r = self.turning(t);
        PrescribedRoot {
            position: derivative(0),
            velocity: derivative(1),
            acceleration: derivative(2),
            rotation: r.c,
            angular_velocity: r.w,
            angular_acceleration: r.w_dot,
        }
    }
}
