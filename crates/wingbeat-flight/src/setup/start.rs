//! How the root body moves, and how it starts.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::{DMat3, DVec3, DriftingFourier, EulerSequence};
use wingbeat_model::Start;

use crate::setup::prescribed::PrescribedMotion;

/// How the root body moves.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there is one per flight")]
pub enum MotionMode {
    /// Free flight from a start state.
    Free(StartState),
    /// Tethered: the root follows a prescribed motion.
    Tethered(PrescribedMotion),
}

impl MotionMode {
    /// Whether a support has the root at this step: a tether, or the hold before a release.
    pub fn is_supported_at(&self, step: usize) -> bool {
        match self {
            Self::Free(start) => step < start.held_steps,
            Self::Tethered(_) => true,
        }
    }

    /// Whether a root that is to be released is held for all of so many steps.
    pub fn is_held_throughout(&self, steps: usize) -> bool {
        matches!(self, Self::Free(start) if start.held_steps >= steps)
    }
}

/// Position, attitude and velocities of the root body at time zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StartState {
    /// Origin of the root frame, N components [m].
    pub position: DVec3,
    /// 2-3-1 Euler angles phi (pitch), theta (yaw), psi (roll) [rad].
    pub angles: DVec3,
    /// Velocity of the root origin, N components [m/s].
    pub velocity: DVec3,
    /// Angular velocity at the release, beside that of [`Self::held_motion`], root components [rad/s].
    pub angular_velocity: DVec3,
    /// Number of first steps during which the root is held: it keeps this attitude and moves
    /// with this constant velocity (but for [`Self::held_motion`]) while the wings beat and the wake
    /// grows, then it is released. 0 releases at once.
    pub held_steps: usize,
    /// How it moves about that attitude and path while it is held; none is still. It is released with the
    /// velocities that it has then, and with [`Self::angular_velocity`] besides.
    pub held_motion: Option<Box<PrescribedMotion>>,
}

impl StartState {
    /// Rotation R_NB of the start attitude.
    pub fn rotation(&self) -> DMat3 {
        EulerSequence::BODY_231.rotation(self.angles)
    }

    /// The motion of the hold before the release.
    pub fn hold(&self) -> PrescribedMotion {
        let (x, v) = (self.position.to_array(), self.velocity.to_array());
        let (angles, more) = (self.angles.to_array(), self.held_motion.as_deref());
        let about = |constant: f64, rate: f64, more: Option<&DriftingFourier>| {
            let more = more.cloned().unwrap_or_default();
            DriftingFourier {
                constant: constant + more.constant,
                rate: rate + more.rate,
                ..more
            }
        };
        PrescribedMotion {
            position: std::array::from_fn(|i| about(x[i], v[i], more.map(|m| &m.position[i]))),
            angles: std::array::from_fn(|i| about(angles[i], 0.0, more.map(|m| &m.angles[i]))),
            start: more.map_or(Start::Impulsive, |m| m.start),
        }
    }
    /// Motion of the root that is released at `time` \[s\].
    pub fn released(&self, time: f64) -> BodyMotion {
        let mut root = self.hold().at(time).motion;
        root.w += self.angular_velocity;
        root
    }
}
