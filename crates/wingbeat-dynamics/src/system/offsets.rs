//! Where the free coordinates and speeds of joints lie, and where they start.

use wingbeat_math::{DQuat, DVec3};

use crate::system::joint_model::{JointModel, JointType};

/// Where a hinge's coordinates and speeds lie among those of all hinges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct JointOffsets {
    /// First coordinate.
    pub q: usize,
    /// Number of coordinates: 4 (a quaternion) for a spherical joint.
    pub coordinates: usize,
    /// First speed.
    pub u: usize,
    /// Number of speeds.
    pub speeds: usize,
}

impl JointOffsets {
    /// The offsets of a joint behind `before`.
    pub(crate) fn after(before: &Self, kind: JointType) -> Self {
        let (coordinates, speeds) = match kind {
            JointType::Weld | JointType::PointOnLine { .. } => (0, 0),
            JointType::Revolute { .. } | JointType::Prismatic { .. } => (1, 1),
            JointType::Universal { .. } => (2, 2),
            JointType::Spherical => (4, 3),
        };
        Self {
            q: before.q + before.coordinates,
            coordinates,
            u: before.u + before.speeds,
            speeds,
        }
    }
}

/// Start of a joint's coordinates and speeds.
pub(crate) fn start(joint: &JointModel, offsets: &JointOffsets, q: &mut [f64], u: &mut [f64]) {
    let get = |x: &[f64], k: usize| x.get(k).copied().unwrap_or(0.0);
    if joint.kind == JointType::Spherical {
        let turn = DVec3::from_array([0, 1, 2].map(|k| get(&joint.coordinates, k)));
        DQuat::from_scaled_axis(turn).write_to_slice(&mut q[offsets.q..]);
    } else {
        (0..offsets.coordinates).for_each(|k| q[offsets.q + k] = get(&joint.coordinates, k));
    }
    (0..offsets.speeds).for_each(|k| u[offsets.u + k] = get(&joint.rates, k));
}
