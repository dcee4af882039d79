//! Generalized forces from virtual work (seed eq. 6-10).

use wingbeat_math::{DVec3, Wrench};

use super::coordinates::BodyKinematics;

/// Generalized force of a wrench about the body's origin: `(F, G^T R^T M)`, the sum of seed eq. 9 over all its
/// forces, each `(F, H^T F)` at a point r of the body with the derivative of `R r` by the angles, `H = -R tilde(r) G`.
pub fn generalized_wrench(k: &BodyKinematics, load: &Wrench) -> [DVec3; 2] {
    [
        load.force,
        k.g.transpose() * (k.motion.r.transpose() * load.moment),
    ]
}
