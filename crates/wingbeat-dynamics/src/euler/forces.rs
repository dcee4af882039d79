//! Generalized forces from virtual work (seed eq. 6-10).

use wingbeat_math::{DMat3, DVec3, tilde};

use super::coordinates::BodyKinematics;
use crate::Wrench;

/// H of seed eq. 9, the derivative of `R r` by the angles: `H = -R tilde(r) G`, the same form for
/// every Euler sequence; `r` \[m\] is the point in body components.
pub fn point_jacobian(k: &BodyKinematics, r: DVec3) -> DMat3 {
    -(k.motion.r * tilde(r) * k.g)
}

/// Generalized force of a force [N, N components] at the point `r` \[m\] of the body (seed eq. 8,
/// 9): `(F, H^T F)`.
pub fn point_force(k: &BodyKinematics, r: DVec3, force: DVec3) -> [DVec3; 2] {
    [force, point_jacobian(k, r).transpose() * force]
}

/// Generalized force of a wrench about the body's origin: `(F, G^T R^T M)`, the sum of seed eq. 9
/// over all its forces.
pub fn generalized_wrench(k: &BodyKinematics, load: &Wrench) -> [DVec3; 2] {
    [
        load.force,
        k.g.transpose() * (k.motion.r.transpose() * load.moment),
    ]
}
