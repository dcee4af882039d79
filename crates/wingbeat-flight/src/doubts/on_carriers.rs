//! Motion of wings in the body with that of the wings and segments that carry them.

use wingbeat_dynamics::{BodyMotion, JointType};
use wingbeat_math::{DVec3, RotationLaw};

use crate::setup::FlightSetup;

impl FlightSetup {
    /// Motion of wing `w` relative to the root frame at time `t` \[s\], all strokes at full rate from the first
    /// instant: place \[m\] and velocity [m/s] of its origin in root components, its attitude, its angular
    /// velocity in wing components [rad/s]. None where a joint between it and the body leaves anything free, so
    /// that it is not known beforehand.
    pub fn prescribed_in_body(&self, w: usize, t: f64) -> Option<BodyMotion> {
        self.prescribed_body(w + 1, t)
    }

    /// The same of any body, counted as in the system.
    pub(super) fn prescribed_body(&self, body: usize, t: f64) -> Option<BodyMotion> {
        self.in_root(body, t, self.joints.len())
    }

    /// The same of a body that hangs on at most `left` joints: no chain is longer than there are joints.
    fn in_root(&self, body: usize, t: f64, left: usize) -> Option<BodyMotion> {
        if body == 0 {
            return Some(BodyMotion::REST);
        }
        let wing = self.animal.wings.get(body - 1);
        let own = wing.map(|w| w.motion.impulsive());
        let Some(joint) = self.joints.iter().find(|j| j.child == body) else {
            let turning = own?.at(t);
            return Some(BodyMotion {
                p: wing?.hinge_b,
                r: turning.c,
                v: DVec3::ZERO,
                w: turning.w,
            });
        };
        if joint.model.kind != JointType::Weld {
            return None;
        }
        let by = self.in_root(joint.parent?, t, left.checked_sub(1)?)?;
        let turning = match (&joint.law, own) {
            (None, Some(own)) => own.at(t),
            _ => joint.rotation(t),
        };
        let travel = joint.model.travel.as_ref();
        let [way, along, _] = travel.map_or([DVec3::ZERO; 3], |law| law.at(t));
        let there = joint.anchor_parent + way;
        let r = by.r * turning.c;
        let w = turning.c.transpose() * by.w + turning.w;
        let back = joint.anchor_child;
        Some(BodyMotion {
            p: by.p + by.r * there - r * back,
            r,
            v: by.v + by.r * (by.w.cross(there) + along) - r * w.cross(back),
            w,
        })
    }
}
