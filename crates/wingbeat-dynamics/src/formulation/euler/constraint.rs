//! The six constraints of a hinge, their Jacobian, and their rates (seed eq. 4, 5, 27).
//!
//! D = T_child^T T_parent C is the prescribed orientation seen from the child; it is the identity
//! when the constraint holds. Its rate is `D' = tilde(e) D` with `e = D (C^T w_parent + W) -
//! w_child`, W the angular velocity of C. Entry (i, j) of D is the constraint, so its rate is
//! `n . e` with `n = d_j x e_i`, d_j column j of D. From this form all derivatives follow without
//! third-order tensors.

use wingbeat_math::{DMat3, DVec3, MovingRotation, tilde, trace};

use super::coordinates::BodyKinematics;
use crate::system::joint::Joint;

/// Entries (1,2), (2,3), (3,1) of the relative rotation are constrained (seed eq. 4).
const ENTRIES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

/// One hinge with the bodies it joins, at one instant.
#[derive(Clone, Copy, Debug)]
pub struct HingeKinematics {
    parent: BodyKinematics,
    child: BodyKinematics,
    anchor_parent: DVec3,
    anchor_child: DVec3,
    /// Relative rotation D; the identity when the constraint holds.
    pub d: DMat3,
    c: DMat3,
    rate: DVec3,
    acceleration: DVec3,
    /// Rows n of the orientation constraints.
    normals: DMat3,
}

/// Derivatives of three constraints by the angles of parent and child.
#[derive(Clone, Copy, Debug)]
pub struct AngleJacobian {
    /// By the parent's angles.
    pub parent: DMat3,
    /// By the child's angles.
    pub child: DMat3,
}

impl HingeKinematics {
    /// `law` is the hinge's law at the instant.
    pub fn new(
        hinge: &Joint,
        law: &MovingRotation,
        parent: &BodyKinematics,
        child: &BodyKinematics,
    ) -> Self {
        let d = child.motion.r.transpose() * parent.motion.r * law.c;
        let row = |k: usize| d.col(ENTRIES[k].1).cross(DVec3::AXES[ENTRIES[k].0]);
        Self {
            parent: *parent,
            child: *child,
            anchor_parent: hinge.anchor_parent,
            anchor_child: hinge.anchor_child,
            d,
            c: law.c,
            rate: law.w,
            acceleration: law.w_dot,
            normals: DMat3::from_cols(row(0), row(1), row(2)).transpose(),
        }
    }

    /// phi_1 to phi_3: distance of the two hinge points \[m\], N components (seed eq. 4).
    pub fn connection(&self) -> DVec3 {
        let (a, b) = (&self.parent.motion, &self.child.motion);
        b.p - a.p + b.r * self.anchor_child - a.r * self.anchor_parent
    }

    /// phi_7 to phi_9: entries (1,2), (2,3), (3,1) of D (seed eq. 4).
    pub fn orientation(&self) -> DVec3 {
        let entry = |k: usize| self.d.col(ENTRIES[k].1)[ENTRIES[k].0];
        DVec3::new(entry(0), entry(1), entry(2))
    }

    /// B_q of the connection: +-I by the positions (plus for the child), and by the angles
    /// `T tilde(r) G` of the parent, minus that of the child.
    pub fn connection_jacobian(&self) -> AngleJacobian {
        let (a, b) = (&self.parent, &self.child);
        AngleJacobian {
            parent: a.motion.r * tilde(self.anchor_parent) * a.g,
            child: -(b.motion.r * tilde(self.anchor_child) * b.g),
        }
    }

    /// B_q of the orientation: `n . D C^T G` by the parent's angles, `-n . G` by the child's.
    pub fn orientation_jacobian(&self) -> AngleJacobian {
        AngleJacobian {
            parent: self.normals * self.d * self.c.transpose() * self.parent.g,
            child: -(self.normals * self.child.g),
        }
    }

    /// Rate of the connection constraints [m/s], `B_q q' + dPhi/dt`.
    pub fn connection_rate(&self) -> DVec3 {
        let (a, b) = (&self.parent.motion, &self.child.motion);
        b.point_velocity(self.anchor_child) - a.point_velocity(self.anchor_parent)
    }

    /// Rate of the orientation constraints [1/s], `B_q q' + dPhi/dt`.
    pub fn orientation_rate(&self) -> DVec3 {
        self.normals * self.rotation_rate()
    }

    /// Angular velocity at which D turns, child components [rad/s].
    fn rotation_rate(&self) -> DVec3 {
        let seen = self.c.transpose() * self.parent.motion.w;
        self.d * (seen + self.rate) - self.child.motion.w
    }

    /// Second time derivative of the connection constraints for q'' = 0 (seed eq. 27 without its
    /// first term) [m/s2].
    pub fn connection_bias(&self) -> DVec3 {
        let part = |k: &BodyKinematics, r: DVec3| {
            let w = k.motion.w;
            k.motion.r * (w.cross(w.cross(r)) + (k.g_dot * k.eta_dot).cross(r))
        };
        part(&self.child, self.anchor_child) - part(&self.parent, self.anchor_parent)
    }

    /// Second time derivative of the orientation constraints for q'' = 0 (seed eq. 27 without its
    /// first term) [1/s2]: `n . e' + e_i . (e x (e x d_j))`.
    pub fn orientation_bias(&self) -> DVec3 {
        let (a, b) = (&self.parent, &self.child);
        let e = self.rotation_rate();
        let seen = self.c.transpose() * a.motion.w;
        let seen_rate =
            self.c.transpose() * (a.g_dot * a.eta_dot) - self.rate.cross(seen) + self.acceleration;
        let e_rate =
            e.cross(self.d * (seen + self.rate)) + self.d * seen_rate - b.g_dot * b.eta_dot;
        let bent = |k: usize| e.cross(e.cross(self.d.col(ENTRIES[k].1)))[ENTRIES[k].0];
        self.normals * e_rate + DVec3::new(bent(0), bent(1), bent(2))
    }

    /// Force on the child \[N\] of the connection multipliers, N components: `-lambda`.
    pub fn reaction_force(&self, multipliers: DVec3) -> DVec3 {
        -multipliers
    }

    /// Moment on the child about the hinge [N m] of the orientation multipliers, child
    /// components: the moment whose generalized force is `-B_q^T lambda`. Where the constraint
    /// holds it is `-(lambda_8, lambda_9, lambda_7)`.
    pub fn reaction_moment(&self, multipliers: DVec3) -> DVec3 {
        self.normals.transpose() * multipliers
    }

    /// Prescribed relative angular velocity in child components [rad/s].
    pub fn prescribed_rate(&self) -> DVec3 {
        self.d * self.rate
    }

    /// Angle of the relative rotation D \[rad\].
    pub fn angle(&self) -> f64 {
        (0.5 * (trace(self.d) - 1.0)).clamp(-1.0, 1.0).acos()
    }
}
