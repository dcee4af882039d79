//! The equations of a mechanism at one instant: matrix and right-hand side, scaled and solved.

use wingbeat_math::{
    BodyAcceleration, BodyMotion, DMat3, DVec3, Wrench, solve_small, tilde, trace,
};

use super::joint::{JointKinematics, Row};
use super::structure::Mechanism;
use crate::error::DynamicsError;
use crate::solution::HingeReaction;
use crate::system::joint::Joint;

/// Intermediate results, and what was solved for last.
#[derive(Clone, Debug)]
pub struct AbsoluteScratch {
    /// Motions of the bodies.
    pub motions: Vec<BodyMotion>,
    /// Accelerations of the bodies.
    pub accelerations: Vec<BodyAcceleration>,
    /// Load of every joint on its child at its anchor, efforts included.
    pub reactions: Vec<HingeReaction>,
    /// Largest constraint values: lengths \[m\], angles \[rad\].
    pub violation: [f64; 2],
    pub(super) joints: Vec<JointKinematics>,
    pub(super) rows: Vec<(usize, Row)>,
    pub(super) matrix: Vec<f64>,
    pub(super) rhs: Vec<f64>,
    pub(super) scale: Vec<f64>,
    pub(super) loads: Vec<Wrench>,
}

/// Adds the efforts of springs, dampers, stops and actuators to the loads.
pub(super) fn put_efforts(mechanism: &Mechanism, t: f64, s: &mut AbsoluteScratch) {
    for (joint, l) in mechanism.joints().iter().zip(&s.joints) {
        let [force, moment] = effort(joint, l, t);
        if joint.model.elements.is_empty() {
            continue;
        }
        let child = &s.motions[joint.child];
        let (anchor, moment) = (child.r * joint.anchor_child, child.r * moment);
        s.loads[joint.child] += Wrench {
            force,
            moment: moment + anchor.cross(force),
        };
        if let Some(p) = joint.parent {
            let arm = child.p + anchor - s.motions[p].p;
            s.loads[p] += Wrench {
                force: -force,
                moment: -moment - arm.cross(force),
            };
        }
    }
}

/// Mass matrix and forces of all bodies; clears the matrix.
pub(super) fn put_bodies(mechanism: &Mechanism, s: &mut AbsoluteScratch) {
    s.matrix.fill(0.0);
    let (n, gravity) = (s.rhs.len(), mechanism.gravity());
    let length = mechanism.units().length;
    let total: f64 = mechanism.bodies().iter().map(|b| b.mass.mass).sum();
    for (i, body) in mechanism.bodies().iter().enumerate() {
        let (m, load) = (&s.motions[i], &s.loads[i]);
        let (mass, first, j) = (body.mass.mass, body.mass.first_moment, body.mass.inertia);
        let lever = -(m.r * tilde(first));
        let at = 6 * i;
        let diagonal = DMat3::from_diagonal(DVec3::splat(mass));
        put(&mut s.matrix, n, at, at, diagonal);
        put(&mut s.matrix, n, at, at + 3, lever);
        put(&mut s.matrix, n, at + 3, at, lever.transpose());
        put(&mut s.matrix, n, at + 3, at + 3, j);
        let spun = m.r * m.w.cross(m.w.cross(first));
        let back = m.r.transpose();
        let force = load.force + mass * gravity - spun;
        let moment = back * load.moment + first.cross(back * gravity) - m.w.cross(j * m.w);
        force.write_to_slice(&mut s.rhs[at..]);
        moment.write_to_slice(&mut s.rhs[at + 3..]);
        let floor = 1e-6 * total;
        let spin = trace(j) / 3.0;
        s.scale[at..at + 3].fill(1.0 / mass.max(floor).sqrt());
        s.scale[at + 3..at + 6].fill(1.0 / spin.max(floor * length * length).sqrt());
    }
}

/// Jacobian of all constraints, and scales of the multipliers.
pub(super) fn put_constraints(mechanism: &Mechanism, s: &mut AbsoluteScratch) {
    let (n, first) = (s.rhs.len(), 6 * s.motions.len());
    for (k, (joint, r)) in s.rows.iter().enumerate() {
        let joint = &mechanism.joints()[*joint];
        let (at, mut size) = (first + k, 0.0);
        let ends = [(joint.parent, &r.parent), (Some(joint.child), &r.child)];
        for (body, factors) in ends {
            let Some(body) = body else { continue };
            for (part, v) in factors.iter().enumerate() {
                for c in 0..3 {
                    let col = 6 * body + 3 * part + c;
                    s.matrix[at * n + col] += v[c];
                    s.matrix[col * n + at] += v[c];
                    size += (v[c] * s.scale[col]).powi(2);
                }
            }
        }
        s.scale[at] = 1.0 / size.sqrt();
    }
}

/// Scales, solves, scales back.
pub(super) fn eliminate(
    mechanism: &Mechanism,
    t: f64,
    s: &mut AbsoluteScratch,
) -> Result<(), DynamicsError> {
    let n = s.rhs.len();
    for (i, row) in s.matrix.chunks_exact_mut(n).enumerate() {
        let si = s.scale[i];
        row.iter_mut()
            .zip(&s.scale)
            .for_each(|(x, sj)| *x *= si * sj);
        s.rhs[i] *= si;
    }
    solve_small(&mut s.matrix, &mut s.rhs).map_err(|e| singular(mechanism, t, e.column, s))?;
    s.rhs.iter_mut().zip(&s.scale).for_each(|(x, s)| *x *= s);
    Ok(())
}

/// What a vanishing pivot means.
fn singular(mechanism: &Mechanism, time: f64, column: usize, s: &AbsoluteScratch) -> DynamicsError {
    let first = 6 * s.motions.len();
    let what = match column.checked_sub(first) {
        Some(k) => format!("joint `{}`", mechanism.joints()[s.rows[k].0].name),
        None => format!("body `{}`", mechanism.bodies()[column / 6].name),
    };
    DynamicsError::SingularMechanism { time, what }
}

/// Accelerations and reactions from the solution.
pub(super) fn read(mechanism: &Mechanism, t: f64, s: &mut AbsoluteScratch) {
    for i in 0..s.motions.len() {
        let [linear, angular] = step(&s.rhs, i);
        s.accelerations[i] = BodyAcceleration { linear, angular };
    }
    for (k, joint) in mechanism.joints().iter().enumerate() {
        let [force, moment] = effort(joint, &s.joints[k], t);
        s.reactions[k] = HingeReaction {
            force,
            moment,
            power: 0.0,
        };
    }
    let first = 6 * s.motions.len();
    for (k, (joint, r)) in s.rows.iter().enumerate() {
        let (l, at) = (&mechanism.joints()[*joint], s.rhs[first + k]);
        let back = s.motions[l.child].r.transpose();
        let out = &mut s.reactions[*joint];
        let force = -at * r.child[0];
        out.force += force;
        out.moment += -at * r.child[1] - l.anchor_child.cross(back * force);
    }
    for (out, l) in s.reactions.iter_mut().zip(&s.joints) {
        out.power = l.power(out.force, out.moment);
    }
}

/// Force (N components) and moment (child components) of all elements on the child at its anchor.
fn effort(joint: &Joint, l: &JointKinematics, t: f64) -> [DVec3; 2] {
    let mut sum = [DVec3::ZERO; 2];
    if joint.model.elements.is_empty() {
        return sum;
    }
    let efforts = joint.model.efforts(t, &l.coordinates(), |_| true);
    for (k, size) in efforts
        .iter()
        .enumerate()
        .take(joint.model.kind.directions())
    {
        let d = l.direction(k);
        (0..2).for_each(|part| sum[part] += *size * d[part]);
    }
    sum
}

/// The six numbers of body `i`.
pub(super) fn step(x: &[f64], i: usize) -> [DVec3; 2] {
    [0, 3].map(|part| DVec3::from_slice(&x[6 * i + part..]))
}

fn put(matrix: &mut [f64], n: usize, row: usize, col: usize, block: DMat3) {
    for i in 0..3 {
        let at = (row + i) * n + col;
        block.row(i).write_to_slice(&mut matrix[at..at + 3]);
    }
}
