//! Velocity of the undisturbed air past a wing in its prescribed motion.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::{DVec3, RotationLaw};
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
        let stream = root.r.transpose() * (stream - root.v);
        let hinge = wing.hinge_b;
        move |x| {
            let of_body = root.w.cross(hinge + turning.c * x);
            turning.c.transpose() * (stream - of_body) - turning.w.cross(x)
        }
    }

    /// Motion of the root of a flight that goes on as it starts.
    fn root_at(&self, t: f64) -> BodyMotion {
        match &self.mode {
            MotionMode::Free(start) => BodyMotion {
                p: start.position,
                r: start.rotation(),
                v: start.velocity,
                w: DVec3::ZERO,
            },
            MotionMode::Tethered(motion) => motion.impulsive().at(t).motion,
        }
    }
}
