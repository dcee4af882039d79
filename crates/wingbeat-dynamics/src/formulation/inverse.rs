//! Inverse dynamics: what the hinges (and a support of the root) must do so that the bodies
//! accelerate as they do. Newton and Euler for every body, summed from the tips to the root.

use wingbeat_math::{BodyAcceleration, BodyMotion, Wrench};

use crate::System;
use crate::formulation::workspace::Workspace;
use crate::solution::{HingeReaction, Solution};
use crate::system::body::inertia_wrench;
use crate::system::body::weight_wrench;

/// Reactions of all hinges and of the support of the root, from the motions in `ws` and the
/// accelerations in `out`.
pub(crate) fn reactions(system: &System, loads: &[Wrench], ws: &mut Workspace, out: &mut Solution) {
    bias_force(system, loads, &ws.motions, &out.bodies, &mut ws.bias_force);
    for &k in system.outward().iter().rev() {
        let h = &system.hinges()[k];
        let (parent, child) = (&ws.motions[h.tree_parent()], &ws.motions[h.child]);
        let arm_child = child.r * h.anchor_child;
        let arm_parent = child.p + arm_child - parent.p;
        let at_origin = ws.bias_force[h.child];
        let at_hinge = at_origin.moment - arm_child.cross(at_origin.force);
        ws.bias_force[h.tree_parent()] += Wrench {
            force: at_origin.force,
            moment: at_hinge + arm_parent.cross(at_origin.force),
        };
        let moment = child.r.transpose() * at_hinge;
        let relative = child.w - child.r.transpose() * (parent.r * parent.w);
        let slide = child.point_velocity(h.anchor_child)
            - parent.v
            - (parent.r * parent.w).cross(arm_parent);
        out.hinges[k] = HingeReaction {
            force: at_origin.force,
            moment,
            power: moment.dot(relative) + at_origin.force.dot(slide),
        };
    }
    out.tether = ws.bias_force[0];
}

/// What every body still needs beside loads and weight, about its own origin.
pub(crate) fn bias_force(
    system: &System,
    loads: &[Wrench],
    motions: &[BodyMotion],
    accelerations: &[BodyAcceleration],
    out: &mut [Wrench],
) {
    for (i, body) in system.bodies().iter().enumerate() {
        let m = &motions[i];
        let inertia = inertia_wrench(&body.mass, m, &accelerations[i]);
        out[i] = inertia - loads[i] - weight_wrench(body, m, system.gravity());
    }
}

/// The seed's multipliers that belong to given reactions, at constraints fulfilled: force on the
/// child = -(lambda_1, lambda_2, lambda_3), moment on the child in child components =
/// -(lambda_8, lambda_9, lambda_7); connection of all hinges first, then orientation.
pub(crate) fn multipliers(hinges: &[HingeReaction], out: &mut [f64]) {
    let (connection, orientation) = out.split_at_mut(3 * hinges.len());
    for (k, h) in hinges.iter().enumerate() {
        let (f, m) = (-h.force, -h.moment);
        connection[3 * k..3 * k + 3].copy_from_slice(&[f.x, f.y, f.z]);
        orientation[3 * k..3 * k + 3].copy_from_slice(&[m.z, m.x, m.y]);
    }
}
