//! Rates of the free joint coordinates and speeds in the momentum form.

use crate::error::DynamicsError;
use crate::formulation::inverse::bias_force;
use crate::formulation::workspace::Workspace;
use crate::free::coordinate_rates;
use crate::system::System;
use wingbeat_math::{BodyAcceleration, Wrench};

/// Accelerations of the free joint speeds into `ws.free` and into the placements; motions and
/// placements are those of the state.
pub(super) fn move_joints(
    system: &System,
    (t, q, u): (f64, &[f64], &[f64]),
    loads: &[Wrench],
    ws: &mut Workspace,
) -> Result<(), DynamicsError> {
    let root = ws.motions[0];
    let still = BodyAcceleration::default();
    ws.configuration.accelerations(&root, &still, &mut ws.bias);
    bias_force(system, loads, &ws.motions, &ws.bias, &mut ws.bias_force);
    let configuration = (ws.configuration.placements(), &ws.whole, root.r);
    (ws.free)
        .solve(system, (t, q, u), configuration, &ws.bias_force)
        .map_err(|e| DynamicsError::SingularMechanism {
            time: t,
            what: format!("hinge `{}`", ws.free.hinge(system, e.column)),
        })?;
    ws.free
        .accelerate(system, ws.configuration.placements_mut());
    Ok(())
}

/// Rates of the free joint coordinates and speeds.
pub(super) fn write_joint_rates(
    system: &System,
    (q, u): (&[f64], &[f64]),
    ws: &Workspace,
    dy: &mut [f64],
) {
    let (dq, du) = dy.split_at_mut(q.len());
    for (joint, s) in system.joints().zip(system.offsets()) {
        let (q, u) = (&q[s.q..s.q + s.coordinates], &u[s.u..s.u + s.speeds]);
        coordinate_rates(joint.kind, q, u, &mut dq[s.q..s.q + s.coordinates]);
    }
    du.copy_from_slice(&ws.free.u_dot);
}
