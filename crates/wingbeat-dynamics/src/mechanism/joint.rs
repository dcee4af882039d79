//! What a joint asks of the two bodies it joins: constraints on velocities and accelerations, and
//! the coordinates along its free directions.
//!
//! With K the joint's frame on the parent (turned by C(t)) and L the child's frame,
//! `D = R_L^T R_K` and `w = w_L - D w_K` is the relative angular velocity in child components;
//! `D' = -tilde(w) D`. delta is the way from K's origin to the child's anchor. Constraints are
//! written for velocities, `J v + ... = 0`, whose derivative is exact; the position value beside
//! each is one whose rate is the velocity constraint where the constraint holds.

use wingbeat_math::{BodyMotion, DMat3, DVec3, rotation_vector_of_matrix};

use crate::system::joint::Joint;
use crate::system::joint_model::JointType;

/// One scalar constraint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// Factors of the parent's velocity (N components) and angular velocity (body components) [1 and m].
    pub parent: [DVec3; 2],
    /// Factors of the child's velocity (N components) and angular velocity (body components) [1 and m].
    pub child: [DVec3; 2],
    /// Value of the position constraint [m or rad].
    pub value: f64,
    /// Its rate [m/s or rad/s].
    pub rate: f64,
    /// Its second derivative for zero accelerations [m/s2 or rad/s2].
    pub bias: f64,
    /// Whether it is a length; otherwise an angle.
    pub is_length: bool,
}

/// A joint with its bodies at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointKinematics {
    kind: JointType,
    parent: BodyMotion,
    child: BodyMotion,
    law: DMat3,
    /// Parent's angular velocity in K, that of K relative to the parent and its derivative.
    seen: DVec3,
    turning: DVec3,
    turning_rate: DVec3,
    lever: DVec3,
    anchor_child: DVec3,
    /// R_K: K components to N components.
    frame: DMat3,
    d: DMat3,
    w: DVec3,
    w_bias: DVec3,
    delta: DVec3,
    delta_rate: DVec3,
    delta_bias: DVec3,
}

impl JointKinematics {
    /// `parent` is [`BodyMotion::REST`] for the ground.
    pub fn new(joint: &Joint, t: f64, parent: &BodyMotion, child: &BodyMotion) -> Self {
        let law = joint.rotation(t);
        let [travel, travel_rate, travel_bias] =
            (joint.model.travel.as_ref()).map_or([DVec3::ZERO; 3], |s| s.at(t));
        let (a, c) = (parent, child);
        let frame = a.r * law.c;
        let d = c.r.transpose() * frame;
        let (turning, turning_rate) = (law.w, law.w_dot);
        let seen = law.c.transpose() * a.w;
        let carried = d * (seen + turning);
        let lever = joint.anchor_parent + travel;
        let spin = a.w.cross(lever);
        let (child_spin, anchor) = (c.w.cross(joint.anchor_child), joint.anchor_child);
        Self {
            kind: joint.model.kind,
            parent: *a,
            child: *c,
            law: law.c,
            seen,
            turning,
            turning_rate,
            lever,
            anchor_child: anchor,
            frame,
            d,
            w: c.w - carried,
            w_bias: c.w.cross(carried) - d * (turning_rate - turning.cross(seen)),
            delta: c.p + c.r * anchor - a.p - a.r * lever,
            delta_rate: c.v + c.r * child_spin - a.v - a.r * (spin + travel_rate),
            delta_bias: c.r * c.w.cross(child_spin)
                - a.r * (a.w.cross(spin) + 2.0 * a.w.cross(travel_rate) + travel_bias),
        }
    }

    /// The joint's constraints, in order: position, then orientation.
    pub fn rows(&self, mut put: impl FnMut(Row)) {
        match self.kind {
            JointType::Prismatic { axis } | JointType::PointOnLine { axis } => {
                let [s, t] = across(axis);
                put(self.beside(s));
                put(self.beside(t));
            }
            _ => DVec3::AXES.iter().for_each(|&n| put(self.together(n))),
        }
        match self.kind {
            JointType::Weld | JointType::Prismatic { .. } => {
                let turned = rotation_vector_of_matrix(self.d.transpose());
                for n in DVec3::AXES {
                    put(self.turned(n, DVec3::ZERO, turned.dot(n)));
                }
            }
            JointType::Revolute { axis } => {
                let tilt = (self.d * axis).cross(axis);
                for n in across(axis) {
                    put(self.turned(n, DVec3::ZERO, tilt.dot(n)));
                }
            }
            JointType::Universal { axes: [a, b] } => {
                let seen = self.d * a;
                let n_rate = -self.w.cross(seen).cross(b);
                put(self.turned(seen.cross(b), n_rate, -seen.dot(b)));
            }
            JointType::Spherical | JointType::PointOnLine { .. } => {}
        }
    }

    /// The two joint points have the same coordinate along `n` (N components, constant).
    fn together(&self, n: DVec3) -> Row {
        let (a, c) = (&self.parent, &self.child);
        Row {
            parent: [-n, -self.lever.cross(a.r.transpose() * n)],
            child: [n, self.anchor_child.cross(c.r.transpose() * n)],
            value: n.dot(self.delta),
            rate: n.dot(self.delta_rate),
            bias: n.dot(self.delta_bias),
            is_length: true,
        }
    }

    /// The child's joint point has coordinate zero along `n` (K components, turning with K).
    fn beside(&self, n: DVec3) -> Row {
        let back = self.frame.transpose();
        let w = self.seen + self.turning;
        let w_bias = self.turning_rate - self.turning.cross(self.seen);
        let delta = back * self.delta;
        let rate = back * self.delta_rate - w.cross(delta);
        let bias = back * self.delta_bias
            - 2.0 * w.cross(rate)
            - w_bias.cross(delta)
            - w.cross(w.cross(delta));
        let mut row = self.together(self.frame * n);
        row.parent[1] -= self.law * delta.cross(n);
        Row {
            value: n.dot(delta),
            rate: n.dot(rate),
            bias: n.dot(bias),
            ..row
        }
    }

    /// The relative angular velocity has no component along `n` (child components), whose
    /// derivative is `n_rate`.
    fn turned(&self, n: DVec3, n_rate: DVec3, value: f64) -> Row {
        Row {
            parent: [DVec3::ZERO, -(self.law * (self.d.transpose() * n))],
            child: [DVec3::ZERO, n],
            value,
            rate: n.dot(self.w),
            bias: n.dot(self.w_bias) + n_rate.dot(self.w),
            is_length: false,
        }
    }

    /// Coordinates and rates along the free directions that elements act along: angles in
    /// (-pi, pi], rotation vector for a spherical joint.
    pub fn coordinates(&self) -> [[f64; 2]; 3] {
        let mut out = [[0.0; 2]; 3];
        let e = self.d.transpose();
        match self.kind {
            JointType::Weld => {}
            JointType::Revolute { axis } => out[0] = [angle(axis, e), axis.dot(self.w)],
            JointType::Universal { axes: [a, b] } => {
                let image = e * b;
                let first = a.cross(b).dot(image).atan2(b.dot(image));
                let seen = self.d * a;
                let second = (-b.cross(a).dot(seen)).atan2(a.dot(seen));
                out[0] = [first, seen.dot(self.w)];
                out[1] = [second, b.dot(self.w)];
            }
            JointType::Spherical | JointType::PointOnLine { .. } => {
                let turned = rotation_vector_of_matrix(e);
                (0..3).for_each(|k| out[k] = [turned[k], self.w[k]]);
            }
            JointType::Prismatic { axis } => {
                let delta = self.frame.transpose() * self.delta;
                let w = self.seen + self.turning;
                let rate = self.frame.transpose() * self.delta_rate - w.cross(delta);
                out[0] = [axis.dot(delta), axis.dot(rate)];
            }
        }
        out
    }

    /// Force \[N\] (N components) and moment [N m] (child components) on the child at its anchor of
    /// an effort along a free direction.
    pub fn direction(&self, k: usize) -> [DVec3; 2] {
        match self.kind {
            JointType::Weld => [DVec3::ZERO; 2],
            JointType::Revolute { axis } => [DVec3::ZERO, axis],
            JointType::Universal { axes: [a, b] } => {
                [DVec3::ZERO, if k == 0 { self.d * a } else { b }]
            }
            JointType::Spherical | JointType::PointOnLine { .. } => [DVec3::ZERO, DVec3::AXES[k]],
            JointType::Prismatic { axis } => [self.frame * axis, DVec3::ZERO],
        }
    }

    /// Power of a force (N components) and a moment (child components) on the child at its anchor
    /// and the opposite on the parent \[W\].
    pub fn power(&self, force: DVec3, moment: DVec3) -> f64 {
        let (a, c) = (&self.parent, &self.child);
        let arm = c.p + c.r * self.anchor_child - a.p;
        let parent_speed = a.v + (a.r * a.w).cross(arm);
        let speed = c.point_velocity(self.anchor_child) - parent_speed;
        force.dot(speed) + moment.dot(c.w - c.r.transpose() * (a.r * a.w))
    }

    /// Whether an axis that should point with its partner points against it: a wrong branch.
    pub fn is_reversed(&self) -> bool {
        match self.kind {
            JointType::Revolute { axis } => (self.d * axis).dot(axis) < 0.0,
            _ => false,
        }
    }
}

/// A joint with its bodies.
pub(crate) fn kinematics(joint: &Joint, t: f64, motions: &[BodyMotion]) -> JointKinematics {
    let parent = joint.parent.map_or(&BodyMotion::REST, |p| &motions[p]);
    JointKinematics::new(joint, t, parent, &motions[joint.child])
}

/// Two unit vectors that make a right-handed frame with the unit vector `axis`.
pub(crate) fn across(axis: DVec3) -> [DVec3; 2] {
    let s = axis.any_orthonormal_vector();
    [s, axis.cross(s)]
}

/// Angle \[rad\] by which the rotation `e` about `axis` turns.
fn angle(axis: DVec3, e: DMat3) -> f64 {
    let [s, t] = across(axis);
    t.dot(e * s).atan2(s.dot(e * s))
}
