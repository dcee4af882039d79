//! The state vector of the momentum form, taken apart.

use wingbeat_math::{BodyMotion, DMat3, DQuat, DVec3, Wrench};

use crate::configuration::Composite;
use crate::error::DynamicsError;
use crate::formulation::workspace::MOMENTUM_STATE;
use crate::system::check::check_state;

/// The first numbers of the state vector of the momentum form, taken apart; free joints follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumState {
    /// Mass centre, N components \[m\].
    pub centre: DVec3,
    /// Attitude of the root, root to N, of unit length but for rounding \[1\].
    pub attitude: DQuat,
    /// Linear momentum, N components \[kg m/s\].
    pub momentum: DVec3,
    /// Angular momentum about the mass centre, N components \[kg m2/s\].
    pub angular: DVec3,
}

impl MomentumState {
    /// As many numbers.
    pub const NUMBERS: usize = MOMENTUM_STATE;

    /// Of the `whole` whose root moves like `root`.
    pub(super) fn moving_like(root: &BodyMotion, whole: &Composite) -> Self {
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
    pub(super) fn read(t: f64, y: &[f64]) -> Result<Self, DynamicsError> {
        check_state(t, y, component)?;
        Ok(Self::of(y))
    }

    /// Of a state vector whose numbers are known to be finite.
    ///
    /// # Panics
    /// If there are fewer than [`Self::NUMBERS`].
    pub fn of(y: &[f64]) -> Self {
        let v = |i: usize| DVec3::new(y[i], y[i + 1], y[i + 2]);
        Self {
            centre: v(0),
            attitude: DQuat::from_xyzw(y[3], y[4], y[5], y[6]),
            momentum: v(7),
            angular: v(10),
        }
    }

    /// Into the first numbers of a state vector.
    ///
    /// # Panics
    /// If there are fewer than [`Self::NUMBERS`].
    pub fn write(&self, y: &mut [f64]) {
        self.centre.write_to_slice(&mut y[0..]);
        self.attitude.write_to_slice(&mut y[3..]);
        self.momentum.write_to_slice(&mut y[7..]);
        self.angular.write_to_slice(&mut y[10..]);
    }

    /// Rates of the state when the root turns at `w` under the total `load`.
    pub(super) fn rates(&self, whole: &Composite, w: DVec3, load: &Wrench) -> Self {
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
