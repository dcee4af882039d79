//! How readily joints give way: accelerations along free directions per effort along them, all that is free moving.

use crate::mechanism::joint::{JointKinematics, kinematics};
use crate::{DynamicsError, Formulation, Solution};
use wingbeat_math::{BodyMotion, Wrench};

/// Accelerations along `directions` (number of a hinge of the system, free direction of it) in the state `y` of
/// a `form` at time `t` \[s\], per effort along each of them, effort by effort \[1/(kg m2), 1/(kg m) or 1/kg\]:
/// along that direction itself one over the inertia that the effort moves, on both sides of the joint. A
/// symmetric matrix.
///
/// # Errors
/// As [`Formulation::solve`].
pub fn mobilities(
    form: &dyn Formulation,
    (t, y): (f64, &[f64]),
    directions: &[(usize, usize)],
) -> Result<Vec<Vec<f64>>, DynamicsError> {
    let system = form.system();
    let (mut ws, mut solution) = (form.workspace(), Solution::new(system));
    let mut motions = vec![BodyMotion::REST; system.bodies().len()];
    form.motions(t, y, &mut ws, &mut motions)?;
    let still = vec![Wrench::default(); motions.len()];
    form.solve(t, y, &still, &mut ws, &mut solution)?;
    let rest = solution.bodies.clone();
    let one = |&(hinge, k): &(usize, usize)| {
        let joint = &system.hinges()[hinge];
        let at = kinematics(joint, t, &motions);
        let [force, moment] = at.direction(k);
        let child = &motions[joint.child];
        let arm = child.r * joint.anchor_child;
        let mut loads = still.clone();
        let turned = child.r * moment;
        loads[joint.child] = Wrench::at(force, arm);
        loads[joint.child].moment += turned;
        if let Some(parent) = joint.parent {
            loads[parent] = Wrench::at(-force, child.p + arm - motions[parent].p);
            loads[parent].moment -= turned;
        }
        form.solve(t, y, &loads, &mut ws, &mut solution)?;
        // What the effort adds to the accelerations, as if they were velocities, has the power of its answer.
        let gained = |body: usize| {
            let [with, without] = [&solution.bodies[body], &rest[body]];
            BodyMotion {
                v: with.linear - without.linear,
                w: with.angular - without.angular,
                ..motions[body]
            }
        };
        let along = |&(hinge, k): &(usize, usize)| {
            let joint = &system.hinges()[hinge];
            let [force, moment] = kinematics(joint, t, &motions).direction(k);
            let parent = joint.parent.map_or(BodyMotion::REST, gained);
            JointKinematics::new(joint, t, &parent, &gained(joint.child)).power(force, moment)
        };
        Ok(directions.iter().map(along).collect())
    };
    directions.iter().map(one).collect()
}
