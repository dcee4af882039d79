//! Forces and couples on bodies beside those of joints and air: loads fixed in a body or in space,
//! Fourier-modulated, and springs between points of two bodies.

use wingbeat_dynamics::{BodyMotion, Wrench};
use wingbeat_math::DVec3;

use crate::prescribed::DriftingFourier;

/// Frame in which an applied load keeps its direction.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum LoadFrame {
    /// Fixed in the body.
    Body,
    /// Fixed in the inertial frame N.
    Inertial,
}

/// A spring and a damper along the line between two points of two bodies:
/// tension = stiffness (length - rest length) + damping x rate of the length.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSpring {
    /// Name, unique in the flight.
    pub name: String,
    /// Indices of the bodies: 0 the root, then wings and segments in their order.
    pub bodies: [usize; 2],
    /// Its ends, each in the axes of its body from the body's origin \[m\].
    pub points: [DVec3; 2],
    /// Stiffness \[N/m\].
    pub stiffness: f64,
    /// Length without tension \[m\].
    pub rest: f64,
    /// Damping \[N s/m\].
    pub damping: f64,
}

/// A force and a couple on one body.
#[derive(Clone, Debug, PartialEq)]
pub struct AppliedLoad {
    /// Index of the body: 0 the root, then the wings in their order.
    pub body: usize,
    /// Frame that carries the directions of force and couple.
    pub frame: LoadFrame,
    /// Point of application, body components [m].
    pub point: DVec3,
    /// Force components [N] as functions of time.
    pub force: [DriftingFourier; 3],
    /// Couple components [N m] as functions of time.
    pub couple: [DriftingFourier; 3],
}

impl AppliedLoad {
    /// The wrench of this load at time `t` [s] about the origin of its body, N components.
    pub fn wrench(&self, t: f64, body: &BodyMotion) -> Wrench {
        let to_n = |v: DVec3| match self.frame {
            LoadFrame::Body => body.r * v,
            LoadFrame::Inertial => v,
        };
        let force = to_n(vector(&self.force, t));
        let arm = body.r * self.point;
        Wrench {
            force,
            moment: to_n(vector(&self.couple, t)) + arm.cross(force),
        }
    }
}

impl PointSpring {
    /// The wrenches on its two bodies, moving so, about their origins, N components: equal and opposite
    /// forces. Nothing where its ends meet, for it has no direction there.
    pub fn wrenches(&self, motions: [&BodyMotion; 2]) -> [Wrench; 2] {
        let arms = [0, 1].map(|k| motions[k].r * self.points[k]);
        let velocity = |k: usize| {
            let m = motions[k];
            m.v + m.r * m.w.cross(self.points[k])
        };
        let apart = motions[1].p + arms[1] - (motions[0].p + arms[0]);
        let length = apart.length();
        let tension = match length > 0.0 {
            true => {
                let rate = apart.dot(velocity(1) - velocity(0)) / length;
                self.stiffness * (length - self.rest) + self.damping * rate
            }
            false => 0.0,
        };
        let force = tension * apart.normalize_or_zero();
        let on = |arm: DVec3, force: DVec3| Wrench {
            force,
            moment: arm.cross(force),
        };
        [on(arms[0], force), on(arms[1], -force)]
    }
}

/// Values of three series at `t`.
fn vector(x: &[DriftingFourier; 3], t: f64) -> DVec3 {
    DVec3::new(x[0].at(t)[0], x[1].at(t)[0], x[2].at(t)[0])
}
