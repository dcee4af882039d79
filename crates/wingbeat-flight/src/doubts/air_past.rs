//! Velocity of the undisturbed air past a wing in its prescribed motion.

use wingbeat_math::{DMat3, DVec3, RotationLaw};
use wingbeat_model::{Wing, WingMotion};

use crate::setup::{FlightSetup, MotionMode};

impl FlightSetup {
    /// Velocity of the undisturbed air past a place of the wing at time `t` [s], in wing components [m/s].
    pub(crate) fn air_past(
        &self,
        wing: &Wing,
        motion: &WingMotion,
        t: f64,
    ) -> impl Fn(DVec3) -> DVec3 + use<> {
        let root = self.root_at(t);
        let turning = motion.at(t);
        let stream = self.air.stream().unwrap_or_default();
        let stream = root.rotation.transpose() * (stream - root.velocity);
        let hinge = wing.hinge_b;
        move |x| {
            let of_body = root.turning.cross(hinge + turning.c * x);
            turning.c.transpose() * (stream - of_body) - turning.w.cross(x)
        }
    }

    /// The root of a flight that goes on as it starts.
    fn root_at(&self, t: f64) -> Root {
        match &self.mode {
            MotionMode::Free(start) => Root {
                rotation: start.rotation(),
                velocity: start.velocity,
                turning: DVec3::ZERO,
            },
            MotionMode::Tethered(motion) => {
                let root = motion.impulsive().at(t);
                Root {
                    rotation: root.rotation,
                    velocity: root.velocity,
                    turning: root.angular_velocity,
                }
            }
        }
    }
}

/// How the root moves: rotation R_NB, velocity of its origin [m/s], N, and angular velocity [rad/s], root components.
struct Root {
    rotation: DMat3,
    velocity: DVec3,
    turning: DVec3,
}
