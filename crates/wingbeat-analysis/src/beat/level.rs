//! The level frame of a reference attitude, and small departures from it.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::{DMat3, DQuat, DVec3, facing, heading, rotation_vector};

use crate::beat::{Beat, State};

/// Forward, right and down at a reference attitude: down along gravity, forward the way the nose points ([`facing`]).
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
        let ahead = facing(r, down);
        let to_n = DMat3::from_cols(ahead, down.cross(ahead), down);
        Self {
            to_n,
            to_root: r.transpose() * to_n,
        }
    }

    /// How far it is turned to the right about `down` from the level frame of a body that has the axes of N \[rad\]: its
    /// heading, from n1 where gravity is along n3.
    pub fn heading(&self) -> f64 {
        heading(self.to_n.x_axis, self.to_n.z_axis)
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

/// Their units.
pub const STATE_UNITS: [&str; 9] = [
    "m s-1", "m s-1", "m s-1", "rad s-1", "rad s-1", "rad s-1", "rad", "rad", "rad",
];

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
        Self::seen(level, root.r, beat.velocity(y), root.w)
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

impl std::ops::Sub for Perturbation {
    type Output = Self;

    /// Number by number.
    fn sub(self, o: Self) -> Self {
        Self {
            velocity: self.velocity - o.velocity,
            rate: self.rate - o.rate,
            tilt: self.tilt - o.tilt,
        }
    }
}

#[cfg(test)]
mod tests {
    use wingbeat_math::EulerSequence;

    use super::*;

    fn facing(pitch: f64, yaw: f64, roll: f64) -> DVec3 {
        let angles = DVec3::new(pitch, yaw, roll).map(f64::to_radians);
        Level::new(EulerSequence::BODY_231.rotation(angles), 9.81 * DVec3::Z)
            .to_n
            .x_axis
    }

    #[test]
    fn exact_a_flyer_at_any_pitch_faces_along_n1() {
        for pitch in [
            -120.0, -90.0, -89.0, 0.0, 60.0, 85.0, 89.9, 90.0, 90.1, 95.0, 120.0, 170.0,
        ] {
            // Rounding of sine and cosine.
            assert!(
                (facing(pitch, 0.0, 0.0) - DVec3::X).length() < 1e-15,
                "{pitch}"
            );
        }
        // That of attitudes with a bank, too, as a trim has them.
        for roll in [-60.0, 10.0, 80.0] {
            assert!(
                (facing(40.0, 0.0, roll) - DVec3::X).length() < 1e-15,
                "{roll}"
            );
        }
        assert!((facing(0.0, 0.0, 90.0) - DVec3::X).length() < 1e-15);
    }

    #[test]
    fn behaves_forward_changes_by_as_little_as_the_attitude() {
        // In steps of a tenth of a degree across the vertical; banked by 20 degrees forward turns by as much there.
        for [yaw, roll] in [[0.0, 20.0], [5.0, 0.0], [-3.0, -10.0], [0.5, 0.5]] {
            let all: Vec<DVec3> = (0..=600)
                .map(|k| facing(60.0 + 0.1 * f64::from(k), yaw, roll))
                .collect();
            for pair in all.windows(2) {
                // Blended within 6 degrees of the vertical: up to ten times the step of 0.1 degrees, 0.0175.
                assert!((pair[1] - pair[0]).length() < 0.02, "{yaw} {roll}");
            }
        }
    }

    #[test]
    fn exact_headings_are_counted_from_n1_to_the_right() {
        for degrees in [-170.0, -60.0, 0.0, 73.0, 90.0, 180.0_f64] {
            let turn = DMat3::from_axis_angle(DVec3::Z, degrees.to_radians());
            let r = turn * EulerSequence::BODY_231.rotation(DVec3::new(1.7, 0.0, 0.0));
            let heading = Level::new(r, DVec3::Z).heading();
            assert!(
                (heading.to_degrees() - degrees).sin().abs() < 1e-9,
                "{degrees}"
            );
            assert!((heading - degrees.to_radians()).cos() > 0.999_999);
        }
    }
}
