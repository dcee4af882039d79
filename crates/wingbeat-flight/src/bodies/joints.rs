//! Joints of a flight: who hangs on whom, what is prescribed there, what is free; and the laws
//! that prescribe it.

use std::sync::Arc;

use wingbeat_dynamics::{ElementLaw, Joint, TravelLaw};
use wingbeat_math::{DMat3, DVec3, DriftingFourier, MovingRotation, RotationLaw};

use crate::setup::prescribed::PrescribedMotion;

/// Whether joint `k` closes a loop: its child is the central body or hangs on an earlier joint.
pub fn closes_loop(joints: &[Joint], k: usize) -> bool {
    let child = joints[k].child;
    child == 0 || joints[..k].iter().any(|j| j.child == child)
}

/// The same joint with everything that is prescribed there `factor` times as fast: rotation, travel and
/// actuators.
pub fn faster(joint: &Joint, factor: f64) -> Joint {
    let mut faster = joint.clone();
    if let Some(law) = faster.law.take() {
        faster.law = Some(Arc::new(Faster { law, factor }));
    }
    if let Some(law) = faster.model.travel.take() {
        faster.model.travel = Some(Arc::new(Faster { law, factor }));
    }
    for element in &mut faster.model.elements {
        if let ElementLaw::Effort(series) | ElementLaw::Follow { target: series, .. } =
            &mut element.law
        {
            series.frequency *= factor;
            series.rate *= factor;
        }
    }
    faster
}

/// A law whose time runs `factor` times as fast.
#[derive(Clone, Debug)]
struct Faster<L> {
    law: L,
    factor: f64,
}

impl RotationLaw for Faster<Arc<dyn RotationLaw>> {
    fn at(&self, t: f64) -> MovingRotation {
        let (k, m) = (self.factor, self.law.at(self.factor * t));
        MovingRotation {
            c: m.c,
            w: k * m.w,
            w_dot: k * k * m.w_dot,
        }
    }
}

impl TravelLaw for Faster<Arc<dyn TravelLaw>> {
    fn at(&self, t: f64) -> [DVec3; 3] {
        let (k, [x, v, a]) = (self.factor, self.law.at(self.factor * t));
        [x, k * v, k * k * a]
    }
}

/// Rotation about a fixed axis by an angle that is a Fourier series.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTurn {
    /// The axis, a unit vector \[1\].
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

/// Its place in N.
impl TravelLaw for PrescribedMotion {
    fn at(&self, t: f64) -> [DVec3; 3] {
        let root = PrescribedMotion::at(self, t);
        [root.motion.p, root.motion.v, root.acceleration.linear]
    }
}
