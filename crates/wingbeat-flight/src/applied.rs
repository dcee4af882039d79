//! Extra forces and couples on bodies, fixed in the body or in space, Fourier-modulated.

use wingbeat_dynamics::{BodyMotion, Wrench};
use wingbeat_math::DVec3;

use crate::setup::{AppliedLoad, DriftingFourier, LoadFrame};

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

/// Values of three series at `t`.
fn vector(x: &[DriftingFourier; 3], t: f64) -> DVec3 {
    DVec3::new(x[0].at(t)[0], x[1].at(t)[0], x[2].at(t)[0])
}
