//! The state vector of the momentum form, taken apart.

use wingbeat_math::{BodyMotion, DMat3, DQuat, DVec3, Wrench};

use crate::configuration::Composite;
use crate::error::DynamicsError;
use crate::formulation::workspace::MOMENTUM_STATE;
use crate::system::check::check_state;

/// The state vector, taken apart.
pub(super) struct State {
    pub centre: DVec3,
    pub attitude: DQuat,
    pub momentum: DVec3,
    pub angular: DVec3,
}

impl State {
    /// Of the `whole` whose root moves like `root`.
    pub fn moving_like(root: &BodyMotion, whole: &Composite) -> Self {
        Self {
            centre: root.p + root.r * whole.c,
            attitude: DQuat::from_mat3(&root.r).normalize(),
            momentum: whole.mass * (root.v + root.r * (root.w.cross(whole.c) + whole.c_dot)),
            angular: root.r * (whole.inertia * root.w + whole.h),
        }
    }

    /// Of the state vector `y` at time `t` \[s\].
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn read(t: f64, y: &[f64]) -> Result<Self, DynamicsError> {
        check_state(t, y, component)?;
        Ok(Self::of(y))
    }

    /// Of a state vector whose numbers are known to be finite.
    pub fn of(y: &[f64]) -> Self {
        let v = |i: usize| DVec3::new(y[i], y[i + 1], y[i + 2]);
        Self {
            centre: v(0),
            attitude: DQuat::from_xyzw(y[3], y[4], y[5], y[6]),
            momentum: v(7),
            angular: v(10),
        }
    }

    pub fn write(&self, y: &mut [f64]) {
        self.centre.write_to_slice(&mut y[0..]);
        self.attitude.write_to_slice(&mut y[3..]);
        self.momentum.write_to_slice(&mut y[7..]);
        self.angular.write_to_slice(&mut y[10..]);
    }

    /// Rates of the state when the root turns at `w` under the total `load`.
    pub fn rates(&self, whole: &Composite, w: DVec3, load: &Wrench) -> Self {
        Self {
            centre: self.momentum / whole.mass,
            attitude: self.attitude * DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * 0.5,
            momentum: load.force,
            angular: load.moment,
        }
    }

    /// Rotation of the root; the length of the quaternion does not matter.
    pub fn rotation(&self) -> DMat3 {
        DMat3::from_quat(self.attitude.normalize())
    }
}

/// What component `k` of a state is.
pub(super) fn component(k: usize, _of: usize) -> &'static str {
    match k {
        0..3 => "position of the mass centre",
        3..7 => "attitude",
        7..10 => "momentum",
        10..MOMENTUM_STATE => "angular momentum",
        _ => "coordinate or rate of a free joint",
    }
}
