//! Motion of the frame W that carries an elastic body.

use wingbeat_math::{DMat3, DVec3};

/// Motion of the frame W at an instant, as far as inertial forces know of it; all in W components.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct FrameMotion {
    /// Acceleration of the origin less the acceleration of gravity [m/s2].
    pub acceleration: DVec3,
    /// Angular velocity relative to N [rad/s].
    pub w: DVec3,
    /// Angular acceleration [rad/s2].
    pub w_dot: DVec3,
}

impl FrameMotion {
    /// A frame at rest without gravity.
    pub const REST: Self = Self {
        acceleration: DVec3::ZERO,
        w: DVec3::ZERO,
        w_dot: DVec3::ZERO,
    };

    /// From the attitude `r_nw` (W components to N components), acceleration of the origin and gravity in N components
    /// [m/s2], and angular velocity and acceleration in W components.
    pub fn from_inertial(
        r_nw: DMat3,
        [acceleration, gravity]: [DVec3; 2],
        [w, w_dot]: [DVec3; 2],
    ) -> Self {
        Self {
            acceleration: r_nw.transpose() * (acceleration - gravity),
            w,
            w_dot,
        }
    }

    /// Acceleration less gravity of the point u \[m\] that moves relative to W with velocity v [m/s] and acceleration
    /// `v_dot` [m/s2].
    pub fn point(&self, u: DVec3, v: DVec3, v_dot: DVec3) -> DVec3 {
        let w = self.w;
        self.acceleration + self.w_dot.cross(u) + w.cross(w.cross(u)) + 2.0 * w.cross(v) + v_dot
    }
}
