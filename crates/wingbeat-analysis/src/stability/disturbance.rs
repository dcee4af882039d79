//! A steady flight that is disturbed: what begins beside a trimmed flight, to see whether it comes back or is held.
//!
//! The whole flyer is turned by the rotation T of [`Perturbation::tilt`], which is seen in the level frame F of
//! the steady attitude; then velocities are added:
//!
//! | quantity | steady | disturbed |
//! |---|---|---|
//! | attitude, root to N | `r` | `turn r`, with `turn = R_NF T R_NF^T` |
//! | velocity of the mass centre, N components | `v` | modes: `U + turn (v - U) + R_NF T velocity` |
//! | | | flights that begin: `V + turn (v - V) + R_NF velocity` |
//! | angular velocity, root components | `w` | `w + R_BF rate` |
//!
//! Modes of flight have velocities along axes that turn with the flyer, that through the air among them
//! ([`Disturbance`]); its stream U does not turn, so that disturbances are the same in still air and in a stream. Episodes
//! and flights under feedback begin ([`disturbed`]) with the mean velocity V of the flight as it was, so that they are the
//! same in both, too; what the mass centre sways about it within a beat turns with the wings that make it sway.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::StartState;
use wingbeat_math::{DMat3, DQuat, DVec3, EulerSequence};

use crate::beat::level::{Level, Perturbation};
use crate::beat::{JOINTS, State};
use crate::trim::Trim;

/// What a disturbance changes, N and root components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disturbance {
    /// Level frame of the disturbed attitude to N: `R_NF T`.
    turned: DMat3,
    /// Rotation of the steady attitude to the disturbed one, N to N.
    turn: DMat3,
    /// Velocity that does not turn, N components [m/s].
    kept: DVec3,
    /// Velocity added, N components [m/s].
    push: DVec3,
    /// Angular velocity added, root components [rad/s].
    rate: DVec3,
}

impl Disturbance {
    /// By `by`, its velocity along axes that turn with the flyer, as all velocity does beside that which is `kept`
    /// \[m/s\], N components.
    pub fn new(level: &Level, by: &Perturbation, kept: DVec3) -> Self {
        let turned = level.to_n * DMat3::from_quat(DQuat::from_scaled_axis(by.tilt));
        Self {
            turned,
            turn: turned * level.to_n.transpose(),
            kept,
            push: turned * by.velocity,
            rate: level.to_root * by.rate,
        }
    }

    /// The steady velocity `v` of a flyer that is turned, N components [m/s].
    fn turned_velocity(&self, v: DVec3) -> DVec3 {
        self.kept + self.turn * (v - self.kept)
    }

    /// The start of a flight, turned and pushed at the origin of its root.
    pub fn start(&self, steady: &StartState) -> StartState {
        StartState {
            angles: EulerSequence::BODY_231.angles(self.turn * steady.rotation()),
            velocity: self.turned_velocity(steady.velocity) + self.push,
            angular_velocity: steady.angular_velocity + self.rate,
            ..steady.clone()
        }
    }

    /// The motion of the root of a flyer that is turned and pushed at its mass centre `centre`, N components [m].
    pub fn root(&self, steady: &BodyMotion, centre: DVec3) -> BodyMotion {
        let (arm, r) = (self.turn * (steady.p - centre), self.turn * steady.r);
        BodyMotion {
            p: centre + arm,
            r,
            v: self.turned_velocity(steady.v) + self.push + (r * self.rate).cross(arm),
            w: steady.w + self.rate,
        }
    }
}

/// The state of the trimmed flight at the start of a beat, disturbed by `by`: turned about its mass centre while the
/// mean velocity of the flight stays, then pushed along axes that stay level.
pub fn disturbed(trim: &Trim, by: &Perturbation) -> State {
    let root = trim.beat.root(&trim.state);
    let level = Level::new(root.r, trim.beat.gravity());
    let with = Disturbance::new(&level, by, trim.velocity);
    let v = trim.beat.velocity(&trim.state);
    let centre = BodyMotion {
        p: DVec3::ZERO,
        r: with.turned * level.to_root.transpose(),
        v: with.turned_velocity(v) + level.to_n * by.velocity,
        w: root.w + with.rate,
    };
    trim.beat.state_at(0.0, &centre, &trim.state[JOINTS..])
}
