//! Joints of a flight: who hangs on whom, what is prescribed there, what is free; and the laws
//! that prescribe it.

use std::sync::Arc;

use wingbeat_dynamics::{Joint, TravelLaw};
use wingbeat_math::{DMat3, DVec3, DriftingFourier, MovingRotation, RotationLaw};

use crate::prescribed::PrescribedMotion;

/// A joint between two bodies. Bodies are counted as in the system: 0 the central body, then the
/// wings, then the segments. The first joint that has a body as its child carries it; others
/// close loops. A wing without a joint hangs on the central body with its whole motion
/// prescribed.
#[derive(Clone, Debug)]
pub struct JointSetup {
    /// Name, unique in the flight.
    pub name: String,
    /// Index of the parent body.
    pub parent: usize,
    /// Index of the child body.
    pub child: usize,
    /// Joint point in the parent's frame [m].
    pub anchor_parent: DVec3,
    /// Joint point in the child's frame [m].
    pub anchor_child: DVec3,
    /// Prescribed rotation; none: a wing's motion, or no rotation for a segment.
    pub law: Option<Arc<dyn RotationLaw>>,
    /// What is free there, prescribed travel, springs, dampers, stops, actuators.
    pub joint: Joint,
}

/// Rotation about a fixed axis by an angle that is a Fourier series.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTurn {
    /// The axis, a unit vector.
    pub axis: DVec3,
    /// The angle [rad].
    pub angle: DriftingFourier,
}

impl RotationLaw for AxisTurn {
    fn at(&self, t: f64) -> MovingRotation {
        let (s, u) = self.axis.any_orthonormal_pair();
        let frame = DMat3::from_cols(self.axis, s, u);
        MovingRotation::fixed(frame)
            .then(&MovingRotation::about(0, self.angle.at(t)))
            .then(&MovingRotation::fixed(frame.transpose()))
    }
}

/// Displacement along three axes by Fourier series [m].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path(pub [DriftingFourier; 3]);

impl TravelLaw for Path {
    fn at(&self, t: f64) -> [DVec3; 3] {
        let x: [[f64; 3]; 3] = std::array::from_fn(|i| self.0[i].at(t));
        [0, 1, 2].map(|k| DVec3::new(x[0][k], x[1][k], x[2][k]))
    }
}

/// The rotation of a prescribed root against N.
impl RotationLaw for PrescribedMotion {
    fn at(&self, t: f64) -> MovingRotation {
        self.turning(t)
    }
}
