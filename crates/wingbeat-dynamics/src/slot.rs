//! Where the free coordinates and speeds of joints lie, and where they start.

use wingbeat_math::{DQuat, DVec3};

use crate::joint::{Freedom, Joint};

/// Where a hinge's coordinates and speeds lie among those of all hinges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slot {
    /// First coordinate.
    pub q: usize,
    /// Number of coordinates: 4 (a quaternion) for a spherical joint.
    pub coordinates: usize,
    /// First speed.
    pub u: usize,
    /// Number of speeds.
    pub speeds: usize,
}

impl Slot {
    /// The slot of a joint behind `before`.
    pub(crate) fn after(before: &Self, freedom: Freedom) -> Self {
        let (coordinates, speeds) = match freedom {
            Freedom::Weld | Freedom::PointOnLine { .. } => (0, 0),
            Freedom::Revolute { .. } | Freedom::Prismatic { .. } => (1, 1),
            Freedom::Universal { .. } => (2, 2),
            Freedom::Spherical => (4, 3),
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
pub(crate) fn start(joint: &Joint, slot: &Slot, q: &mut [f64], u: &mut [f64]) {
    let get = |x: &[f64], k: usize| x.get(k).copied().unwrap_or(0.0);
    if joint.freedom == Freedom::Spherical {
        let turn = DVec3::from_array([0, 1, 2].map(|k| get(&joint.coordinates, k)));
        DQuat::from_scaled_axis(turn).write_to_slice(&mut q[slot.q..]);
    } else {
        (0..slot.coordinates).for_each(|k| q[slot.q + k] = get(&joint.coordinates, k));
    }
    (0..slot.speeds).for_each(|k| u[slot.u + k] = get(&joint.rates, k));
}
