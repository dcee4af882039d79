//! Consistent coordinates and rates by coordinate partitioning (seed sec. 4): the root's six are
//! independent, all others follow from the constraints by Newton-Raphson.

use wingbeat_math::newton::{NewtonError, NewtonSettings, newton};
use wingbeat_math::{DMat3, largest, solve_small};

use super::constraint::HingeKinematics;
use super::coordinates::{BodyKinematics, COORDINATES};
use crate::{DynamicsError, System};

/// Largest angle \[rad\] of the relative rotation taken for a fulfilled orientation. The wrong
/// branches are at 90 deg or more; round-off and drift stay below a degree.
const BRANCH_LIMIT: f64 = 0.1;

/// Bodies and hinges for coordinates `q` and rates `qd` at time `t`.
pub fn kinematics(
    system: &System,
    t: f64,
    q: &[f64],
    qd: &[f64],
) -> (Vec<BodyKinematics>, Vec<HingeKinematics>) {
    let bodies: Vec<_> = (system.bodies().iter().enumerate())
        .map(|(i, b)| {
            let range = COORDINATES * i..COORDINATES * (i + 1);
            BodyKinematics::new(b, &q[range.clone()], &qd[range])
        })
        .collect();
    let hinges = (system.hinges().iter())
        .map(|h| {
            HingeKinematics::new(
                h,
                &h.rotation(t),
                &bodies[h.tree_parent()],
                &bodies[h.child],
            )
        })
        .collect();
    (bodies, hinges)
}

/// Finds the coordinates of all bodies but the root in `q`, starting from their values there.
///
/// # Errors
/// No convergence, or a solution on a wrong branch of the orientation constraints.
pub fn consistent_coordinates(system: &System, t: f64, q: &mut [f64]) -> Result<(), DynamicsError> {
    let length = system.units().length;
    let zero = vec![0.0; q.len()];
    let (root, dependent) = q.split_at_mut(COORDINATES);
    let far = largest(root[..3].iter().map(|x| x.abs())) / length;
    let settings = NewtonSettings {
        tolerance: 1e-12 + 4.0 * f64::EPSILON * far, // round-off of the positions
        max_iterations: 30,
    };
    let mut x = scaled(dependent, 1.0 / length);
    let mut all = root.to_vec();
    newton(&mut x, settings, |x, residual, jacobian| {
        all.truncate(COORDINATES);
        all.extend(scaled(x, length));
        let (_, hinges) = kinematics(system, t, &all, &zero);
        fill_jacobian(system, &hinges, jacobian);
        for (k, h) in hinges.iter().enumerate() {
            (h.connection() / length).write_to_slice(&mut residual[6 * k..]);
            h.orientation().write_to_slice(&mut residual[6 * k + 3..]);
        }
    })
    .map_err(|e| assembly_error(t, settings, e))?;
    dependent.copy_from_slice(&scaled(&x, length));
    check_branch(system, t, q)
}

/// Finds the rates of all bodies but the root in `qd` for consistent coordinates `q`: one linear
/// solve of `B_q q' + dPhi/dt = 0`.
///
/// # Errors
/// The Jacobian is singular.
pub fn consistent_rates(
    system: &System,
    t: f64,
    q: &[f64],
    qd: &mut [f64],
) -> Result<(), DynamicsError> {
    let length = system.units().length;
    qd[COORDINATES..].fill(0.0);
    let (_, hinges) = kinematics(system, t, q, qd);
    let n = qd.len() - COORDINATES;
    let (mut jacobian, mut rhs) = (vec![0.0; n * n], vec![0.0; n]);
    fill_jacobian(system, &hinges, &mut jacobian);
    for (k, h) in hinges.iter().enumerate() {
        (-h.connection_rate() / length).write_to_slice(&mut rhs[6 * k..]);
        (-h.orientation_rate()).write_to_slice(&mut rhs[6 * k + 3..]);
    }
    solve_small(&mut jacobian, &mut rhs).map_err(|_| DynamicsError::SingularSaddle { time: t })?;
    qd[COORDINATES..].copy_from_slice(&scaled(&rhs, length));
    Ok(())
}

/// The coordinates `x` with the positions multiplied by `factor`.
fn scaled(x: &[f64], factor: f64) -> Vec<f64> {
    (x.iter().enumerate())
        .map(|(i, x)| if i % COORDINATES < 3 { x * factor } else { *x })
        .collect()
}

/// Columns of B_q that belong to the dependent coordinates; positions and connection constraints
/// in natural lengths.
fn fill_jacobian(system: &System, hinges: &[HingeKinematics], jacobian: &mut [f64]) {
    let (n, length) = (6 * hinges.len(), system.units().length);
    let mut put = |row: usize, body: usize, part: usize, block: DMat3| {
        if body > 0 {
            for i in 0..3 {
                let at = (row + i) * n + COORDINATES * (body - 1) + 3 * part;
                block.row(i).write_to_slice(&mut jacobian[at..at + 3]);
            }
        }
    };
    for (k, (hinge, h)) in system.hinges().iter().zip(hinges).enumerate() {
        let (connection, orientation) = (h.connection_jacobian(), h.orientation_jacobian());
        put(6 * k, hinge.tree_parent(), 0, -DMat3::IDENTITY);
        put(6 * k, hinge.child, 0, DMat3::IDENTITY);
        put(
            6 * k,
            hinge.tree_parent(),
            1,
            connection.parent * (1.0 / length),
        );
        put(6 * k, hinge.child, 1, connection.child * (1.0 / length));
        put(6 * k + 3, hinge.tree_parent(), 1, orientation.parent);
        put(6 * k + 3, hinge.child, 1, orientation.child);
    }
}

fn assembly_error(time: f64, settings: NewtonSettings, e: NewtonError) -> DynamicsError {
    match e {
        NewtonError::NotConverged {
            residual,
            iterations,
            tolerance,
        } => DynamicsError::Assembly {
            time,
            residual,
            tolerance,
            iterations,
        },
        NewtonError::Singular(_) => DynamicsError::Assembly {
            time,
            residual: f64::NAN,
            tolerance: settings.tolerance,
            iterations: 0,
        },
    }
}

/// The orientation constraints vanish at the identity and at seven other rotations: only the
/// identity is meant.
fn check_branch(system: &System, time: f64, q: &[f64]) -> Result<(), DynamicsError> {
    let (_, hinges) = kinematics(system, time, q, &vec![0.0; q.len()]);
    for (hinge, h) in system.hinges().iter().zip(&hinges) {
        if h.angle() > BRANCH_LIMIT {
            return Err(DynamicsError::WrongBranch {
                hinge: hinge.name.clone(),
                time,
                angle_deg: h.angle().to_degrees(),
            });
        }
    }
    Ok(())
}
