//! Velocity of the undisturbed air past a wing in its prescribed motion, and the strips that meet it.

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
        let turning = motion.at(t);
        let in_body = BodyMotion {
            p: wing.hinge_b,
            r: turning.c,
            v: DVec3::ZERO,
            w: turning.w,
        };
        self.air_past_moving(in_body, t)
    }

    /// The same of a wing that moves so in the body ([`Self::prescribed_in_body`]).
    pub(crate) fn air_past_moving(
        &self,
        wing: BodyMotion,
        t: f64,
    ) -> impl Fn(DVec3) -> DVec3 + use<> {
        let root = self.root_at(t);
        let stream = root.r.transpose() * (self.air_at_start() - root.v);
        move |x| {
            let of_body = root.w.cross(wing.p + wing.r * x);
            wing.r.transpose() * (stream - of_body - wing.v) - wing.w.cross(x)
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

/// Middle of the leading and of the trailing edge of every strip, and its way along the leading edge.
pub fn strips(wing: &Wing) -> impl Iterator<Item = [DVec3; 3]> {
    let mesh = &wing.mesh;
    let at = |i: usize, j: usize| mesh.nodes[mesh.node(i, j)];
    (0..mesh.cols).map(move |j| {
        let [front, rear] = [0, mesh.rows].map(|i| at(i, j).midpoint(at(i, j + 1)));
        [front, rear, at(0, j + 1) - at(0, j)]
    })
}
