//! A steady flight that is disturbed: what begins beside a trimmed flight, to see whether it comes back or is held.
//!
//! The whole flyer is turned by the rotation T of [`Perturbation::tilt`], which is seen in the level frame F of
//! the steady attitude, and its velocities with it; then velocities are added:
//!
//! | quantity | steady | disturbed |
//! |---|---|---|
//! | attitude, root to N | `r` | `turn r`, with `turn = R_NF T R_NF^T` |
//! | velocity, N components | `v` | `turn v + push` |
//! | angular velocity, root components | `w` | `w + R_BF rate` |
//!
//! `push` is `R_NF T velocity` where the velocity is along axes that turn with the flyer, as modes of flight
//! have it; along axes that stay level it is `R_NF velocity`, as where episodes and flights under feedback
//! begin ([`disturbed`]).

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::StartState;
use wingbeat_math::{DMat3, DQuat, DVec3, EulerSequence};

use crate::beat::{JOINTS, State};
use crate::level::{Level, Perturbation};
use crate::trim::Trim;

/// What a disturbance changes, N and root components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disturbance {
    /// Level frame of the disturbed attitude to N: `R_NF T`.
    turned: DMat3,
    /// Rotation of the steady attitude to the disturbed one, N to N.
    turn: DMat3,
    /// Velocity added, N components [m/s].
    push: DVec3,
    /// Angular velocity added, root components [rad/s].
    rate: DVec3,
}

impl Disturbance {
    /// By `by`, its velocity along axes that turn with the flyer.
    pub fn new(level: &Level, by: &Perturbation) -> Self {
        let turned = level.to_n * DMat3::from_quat(DQuat::from_scaled_axis(by.tilt));
        Self {
            turned,
            turn: turned * level.to_n.transpose(),
            push: turned * by.velocity,
            rate: level.to_root * by.rate,
        }
    }

    /// The start of a flight, turned and pushed at the origin of its root.
    pub fn start(&self, steady: &StartState) -> StartState {
        StartState {
            angles: EulerSequence::BODY_231.angles(self.turn * steady.rotation()),
            velocity: self.turn * steady.velocity + self.push,
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
            v: self.turn * steady.v + self.push + (r * self.rate).cross(arm),
            w: steady.w + self.rate,
        }
    }
}

/// The state of the trimmed flight at the start of a beat, disturbed by `by`, its velocity along axes that stay level.
pub fn disturbed(trim: &Trim, by: &Perturbation) -> State {
    let root = trim.beat.root(&trim.state);
    let level = Level::new(root.r, trim.beat.gravity());
    let with = Disturbance::new(&level, by);
    let v = DVec3::from_slice(&trim.state[7..]) / trim.beat.mass();
    trim.beat.state_with(
        DVec3::ZERO,
        with.turned * level.to_root.transpose(),
        with.turn * v + level.to_n * by.velocity,
        root.w + with.rate,
        &trim.state[JOINTS..],
    )
}
