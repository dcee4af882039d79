//! The level frame of a reference attitude, and small departures from it.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::{DMat3, DQuat, DVec3, rotation_vector};

use crate::beat::{Beat, State};

/// Forward, right and down at a reference attitude: down along gravity, forward the horizontal
/// part of b1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Level frame to N.
    pub to_n: DMat3,
    /// Level frame to root, at the reference attitude.
    pub to_root: DMat3,
}

impl Level {
    /// The level frame of the attitude `r` (root to N) under `gravity` (N components).
    pub fn new(r: DMat3, gravity: DVec3) -> Self {
        let down = gravity.try_normalize().unwrap_or(DVec3::Z);
        let ahead = r.x_axis - r.x_axis.dot(down) * down;
        // A body that points straight down or up: its belly shows forward.
        let ahead = ahead
            .try_normalize()
            .unwrap_or_else(|| -r.z_axis.reject_from(down).normalize());
        let to_n = DMat3::from_cols(ahead, down.cross(ahead), down);
        Self {
            to_n,
            to_root: r.transpose() * to_n,
        }
    }

    /// That of the attitude in the state `y` at the start of a beat.
    pub fn of(beat: &Beat, y: &[f64]) -> Self {
        Self::new(beat.root(y).r, beat.gravity())
    }

    /// The level frame of the attitude turned to the right by `heading` \[rad\].
    pub fn turned(&self, heading: f64) -> Self {
        if heading == 0.0 {
            return *self; // to the bit
        }
        let down = self.to_n.z_axis;
        Self {
            to_n: DMat3::from_axis_angle(down, heading) * self.to_n,
            ..*self
        }
    }
}

/// Names of the nine state components.
pub const STATE: [&str; 9] = ["u", "v", "w", "p", "q", "r", "phi", "theta", "psi"];

/// A state of flight seen from a level frame that turns with the body: nine numbers, position
/// left out (the air is the same everywhere).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Perturbation {
    /// Velocity of the mass centre u, v, w [m/s].
    pub velocity: DVec3,
    /// Angular velocity of the root p, q, r [rad/s].
    pub rate: DVec3,
    /// Rotation vector roll, pitch, heading from the reference attitude [rad].
    pub tilt: DVec3,
}

impl Perturbation {
    /// As u, v, w, p, q, r, phi, theta, psi.
    pub fn to_array(self) -> [f64; 9] {
        let (v, w, d) = (self.velocity, self.rate, self.tilt);
        [v.x, v.y, v.z, w.x, w.y, w.z, d.x, d.y, d.z]
    }

    /// From u, v, w, p, q, r, phi, theta, psi.
    pub fn from_array(x: [f64; 9]) -> Self {
        Self {
            velocity: DVec3::from_slice(&x),
            rate: DVec3::from_slice(&x[3..]),
            tilt: DVec3::from_slice(&x[6..]),
        }
    }

    /// Component number `k` alone.
    pub fn component(k: usize, x: f64) -> Self {
        Self::from_array(std::array::from_fn(|i| if i == k { x } else { 0.0 }))
    }

    /// The same with its velocity less `flight` [m/s], N components: as seen from axes that move with a flight.
    pub(crate) fn relative_to(self, level: &Level, flight: DVec3) -> Self {
        self.moved(level, -flight)
    }

    /// The same with its velocity and `flight` [m/s], N components: the other way round.
    pub(crate) fn moved(self, level: &Level, flight: DVec3) -> Self {
        if flight == DVec3::ZERO {
            return self; // to the bit
        }
        let turned = level.to_n * DMat3::from_quat(DQuat::from_scaled_axis(self.tilt));
        Self {
            velocity: self.velocity + turned.transpose() * flight,
            ..self
        }
    }

    /// The state at the start of a beat, mass centre at the origin, free joints at `joints`.
    pub fn state(&self, beat: &Beat, level: &Level, joints: &[f64]) -> State {
        self.state_at(beat, 0.0, level, joints)
    }

    /// The same at `time` [s] within the beat.
    pub fn state_at(&self, beat: &Beat, time: f64, level: &Level, joints: &[f64]) -> State {
        let turned = level.to_n * DMat3::from_quat(DQuat::from_scaled_axis(self.tilt));
        let centre = BodyMotion {
            p: DVec3::ZERO,
            r: turned * level.to_root.transpose(),
            v: turned * self.velocity,
            w: level.to_root * self.rate,
        };
        beat.state_at(time, &centre, joints)
    }

    /// What the state at the start of a beat looks like.
    pub fn of(beat: &Beat, level: &Level, y: &[f64]) -> Self {
        Self::at(beat, 0.0, level, y)
    }

    /// What the state at `time` [s] within a beat looks like.
    pub fn at(beat: &Beat, time: f64, level: &Level, y: &[f64]) -> Self {
        let root = beat.root_at(time, y);
        let velocity = DVec3::from_slice(&y[7..]) / beat.mass();
        Self::seen(level, root.r, velocity, root.w)
    }

    /// What an attitude (root to N), a velocity of the mass centre (N components) and an angular
    /// velocity (root components) look like.
    pub fn seen(level: &Level, rotation: DMat3, velocity: DVec3, rate: DVec3) -> Self {
        let turned = rotation * level.to_root;
        Self {
            velocity: turned.transpose() * velocity,
            rate: level.to_root.transpose() * rate,
            tilt: rotation_vector(DQuat::from_mat3(&(level.to_n.transpose() * turned))),
        }
    }
}
