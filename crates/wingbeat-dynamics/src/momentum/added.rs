//! Added masses in the momentum form: they join the inertia of the whole,
//! `(diag(m, I) + sum J^T A J) (a_c, alpha) = loads - sum J^T A s0`.
//!
//! a_c is the acceleration of the mass centre, alpha the angular acceleration of the root, s0 what a
//! body's origin and axes accelerate at while both are zero.

use wingbeat_math::DVec3;

use crate::added_mass::{AddedMass, Six, seen, six, solve_symmetric, wrench};
use crate::motion::Wrench;
use crate::placement::Placement;
use crate::posture::Composite;
use crate::workspace::Workspace;

/// Solves for (a_c, alpha), root components; `x` is the right-hand side without the added masses.
/// Motions, placements and `ws.bias`, the accelerations s0, are those of the state.
pub(super) fn accelerate(added: &[AddedMass], whole: &Composite, ws: &Workspace, x: &mut Six) {
    let mut matrix = inertia_of_whole(whole);
    for a in added {
        let at = &ws.posture.placements()[a.body()];
        let load = a.load(&seen(&ws.motions[a.body()], &ws.bias[a.body()]));
        put_added(a, at, whole.c, &load, &mut matrix, x);
    }
    solve_symmetric(&mut matrix, x);
}

/// Adds to `loads` what the added masses exert under the accelerations `x` of [`accelerate`].
pub(super) fn add(
    added: &[AddedMass],
    x: &Six,
    whole: &Composite,
    ws: &Workspace,
    loads: &mut [Wrench],
) {
    for a in added {
        let mut s = seen(&ws.motions[a.body()], &ws.bias[a.body()]);
        for &k in a.directions() {
            s[k] += dot(&row(&ws.posture.placements()[a.body()], whole.c, k), x);
        }
        loads[a.body()] += wrench(ws.motions[a.body()].r, &a.load(&s));
    }
}

/// `diag(m, I)`, root components.
fn inertia_of_whole(whole: &Composite) -> [Six; 6] {
    let mut matrix = [[0.0; 6]; 6];
    for i in 0..3 {
        matrix[i][i] = whole.mass;
        for j in 0..3 {
            matrix[3 + i][3 + j] = whole.inertia.col(j)[i];
        }
    }
    matrix
}

/// Row k of J: component k of the acceleration of a body (origin, angular; body components) by the
/// acceleration of the mass centre at `c` and the root's angular acceleration, root components.
fn row(at: &Placement, c: DVec3, k: usize) -> Six {
    let axis = at.c.col(k % 3);
    match k < 3 {
        true => six(axis, (at.d - c).cross(axis)),
        false => six(DVec3::ZERO, axis),
    }
}

/// Adds `J^T A J` to the lower half of the matrix and `J^T load` to the right-hand side.
fn put_added(
    a: &AddedMass,
    at: &Placement,
    c: DVec3,
    load: &Six,
    matrix: &mut [Six; 6],
    x: &mut Six,
) {
    let mut rows = [[0.0; 6]; 6];
    a.directions().iter().for_each(|&k| rows[k] = row(at, c, k));
    for &k in a.directions() {
        let mut carried = [0.0; 6];
        for &l in a.directions() {
            let factor = a.matrix()[k][l];
            (0..6).for_each(|j| carried[j] += factor * rows[l][j]);
        }
        for i in 0..6 {
            x[i] += rows[k][i] * load[k];
            (0..=i).for_each(|j| matrix[i][j] += rows[k][i] * carried[j]);
        }
    }
}

fn dot(a: &Six, b: &Six) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
