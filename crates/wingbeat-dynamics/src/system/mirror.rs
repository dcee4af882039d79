//! Motions that are their own mirror image, and keep to it.
//!
//! In a flow of which one half is computed, bodies that are mirror images of each other feel loads that are:
//! neither answers to what parts it from the other, and where the air weighs more than they do, roundings that
//! part them grow without bound. So the rates of the state are those of a motion that is its own image: of each
//! pair one body leads, and of what is alone only what the mirror leaves as it is counts.
//!
//! With the normal n of the plane in N and e the axis 2 of the bodies, as quaternions without real part, the
//! image of the attitude q is `n q e`, up to its sign.

use wingbeat_math::{DQuat, DVec3, mirrored, mirrored_axial};

use crate::system::System;
use crate::system::joint::Joint;
use crate::system::joint_model::JointType;

/// Axis 2 of a body.
const ACROSS: DQuat = DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0);

/// A mirror plane, and who is whose image in it.
#[derive(Clone, Debug, PartialEq)]
pub struct MirrorSymmetry {
    /// Normal of the plane, a unit vector, N components \[1\]; axis 2 of the root.
    pub normal: DVec3,
    /// Pairs of bodies, the first of which leads.
    pub pairs: Vec<[usize; 2]>,
}

impl MirrorSymmetry {
    /// Of bodies of `system` that are images of each other, `pairs`, and of what carries these.
    pub fn new(system: &System, normal: DVec3, mut pairs: Vec<[usize; 2]>) -> Self {
        let parent = |body: usize| {
            let hinge = system.hinges().iter().find(|h| h.child == body);
            hinge.and_then(|h| h.parent)
        };
        let mut k = 0;
        while let Some(&[a, b]) = pairs.get(k) {
            if let (Some(a), Some(b)) = (parent(a), parent(b)) {
                let is_new = a != b && !pairs.contains(&[a, b]);
                pairs.extend(is_new.then_some([a, b]));
            }
            k += 1;
        }
        Self { normal, pairs }
    }

    /// What the mirror leaves of a vector.
    pub(crate) fn kept(&self, v: DVec3) -> DVec3 {
        v - self.normal.dot(v) * self.normal
    }

    /// What it leaves of an angular velocity or moment.
    pub(crate) fn kept_axial(&self, v: DVec3) -> DVec3 {
        self.normal.dot(v) * self.normal
    }

    /// The image of an attitude or of its rate, up to its sign.
    pub(crate) fn attitude(&self, q: DQuat) -> DQuat {
        let n = self.normal;
        DQuat::from_xyzw(n.x, n.y, n.z, 0.0) * q * ACROSS
    }

    /// What the mirror leaves of an attitude of the root or of its rate.
    pub(crate) fn kept_attitude(&self, q: DQuat) -> DQuat {
        (q - self.attitude(q)) * 0.5
    }

    /// Rates of the free coordinates and speeds of `system` of which the joints of each pair have the same, but
    /// for signs.
    pub(crate) fn lead_joints(&self, system: &System, dq: &mut [f64], du: &mut [f64]) {
        let joint = |body: usize| system.hinges().iter().position(|h| h.child == body);
        for &[a, b] in &self.pairs {
            let (Some(a), Some(b)) = (joint(a), joint(b)) else {
                continue;
            };
            let Some(signs) = signs(&system.hinges()[a], &system.hinges()[b]) else {
                continue;
            };
            let (from, to) = (system.offsets()[a], system.offsets()[b]);
            (0..from.coordinates).for_each(|k| dq[to.q + k] = signs[k] * dq[from.q + k]);
            (0..from.speeds).for_each(|k| du[to.u + k] = signs[k] * du[from.u + k]);
        }
    }
}

/// By what the coordinates and speeds of a joint become those of its image; none where the axes of both are no
/// images of each other.
fn signs(joint: &Joint, image: &Joint) -> Option<[f64; 4]> {
    let sign = |a: DVec3, b: DVec3| {
        let along = a.dot(b);
        (along.abs() > 1.0 - 1e-9).then_some(along.signum())
    };
    match (joint.model.kind, image.model.kind) {
        (JointType::Revolute { axis: a }, JointType::Revolute { axis: b }) => {
            Some([sign(mirrored_axial(a), b)?, 1.0, 1.0, 1.0])
        }
        (JointType::Universal { axes: a }, JointType::Universal { axes: b }) => {
            let [first, second] = [0, 1].map(|k| sign(mirrored_axial(a[k]), b[k]));
            Some([first?, second?, 1.0, 1.0])
        }
        (JointType::Prismatic { axis: a }, JointType::Prismatic { axis: b }) => {
            Some([sign(mirrored(a), b)?, 1.0, 1.0, 1.0])
        }
        (JointType::Spherical, JointType::Spherical) => Some([-1.0, 1.0, -1.0, 1.0]),
        _ => None,
    }
}
