//! Added masses in the momentum form: they join the inertia of the whole,
//! `(diag(m, I) + sum J^T A J) (a_c, alpha) = (F, M - g) - sum J^T A s0`.
//!
//! a_c is the acceleration of the mass centre, alpha the angular acceleration of the root, s0 what a
//! body's origin and axes accelerate at while both are zero, `g = I' w + h' + w x (I w + h)` the rate
//! of the angular momentum meanwhile. All in root components, J to body components.

use wingbeat_math::six_by_six::{Ldlt, from_quarters};
use wingbeat_math::{DMat3, DVec3, Six, SixBySix, Wrench, six};

use super::whole::whole_load;
use crate::added_mass::{AddedMass, wrench};
use crate::configuration::Composite;
use crate::formulation::workspace::Workspace;
use crate::prescribed::Carried;
use crate::system::System;
use crate::system::placement::Placement;

/// How the whole accelerates, root components.
pub(super) struct Moving {
    /// a_c and alpha.
    x: Six,
    /// Angular velocity of the root [rad/s].
    w: DVec3,
    /// Acceleration of the mass centre while root's origin and axes do not accelerate [m/s2].
    rest: DVec3,
    /// g [N m].
    gyroscopic: DVec3,
}

impl Moving {
    /// Rates of linear momentum and of angular momentum about the mass centre, N components.
    pub fn momentum_rates(&self, ws: &Workspace) -> Wrench {
        let (r, turn) = (ws.motions[0].r, DVec3::from_slice(&self.x[3..]));
        Wrench {
            force: r * (ws.whole.mass * DVec3::from_slice(&self.x)),
            moment: r * (ws.whole.inertia * turn + self.gyroscopic),
        }
    }

    /// s0 of a body, body components.
    fn at_rest(&self, at: &Placement) -> Six {
        let back = at.c.transpose();
        let linear = apparent(self.w, at.d, at.d_dot, at.d_ddot) - self.rest;
        six(back * linear, at.w_dot - at.w.cross(back * self.w))
    }
}

/// Acceleration of a point that moves in a frame which turns at the constant `w`.
fn apparent(w: DVec3, x: DVec3, x_dot: DVec3, x_ddot: DVec3) -> DVec3 {
    w.cross(w.cross(x) + 2.0 * x_dot) + x_ddot
}

/// Accelerations under `loads`, weight and added masses at time `t` \[s\]. Motions, placements and whole in `ws` are
/// those of the state; no joint is free.
pub(super) fn accelerate(
    system: &System,
    (t, added): (f64, &[AddedMass]),
    loads: &[Wrench],
    ws: &mut Workspace,
) -> Moving {
    if ws.carried.at != Some(t) || ws.carried.added != added {
        carry(
            (t, added),
            ws.configuration.placements(),
            &ws.whole,
            &mut ws.carried,
        );
    }
    let (root, whole, rates) = (&ws.motions[0], &ws.whole, &ws.whole_rates);
    let load = whole_load(system, loads, &ws.configuration, root.r, whole.c);
    let (back, w) = (root.r.transpose(), root.w);
    let spin = whole.inertia * w + whole.h;
    let gyroscopic = rates.inertia * w + rates.h + w.cross(spin);
    let mut moving = Moving {
        x: six(back * load.force, back * load.moment - gyroscopic),
        w,
        rest: apparent(w, whole.c, whole.c_dot, rates.c_ddot),
        gyroscopic,
    };
    let carried = &mut ws.carried;
    for (k, a) in carried.added.iter().enumerate() {
        let at_rest = moving.at_rest(&ws.configuration.placements()[a.body()]);
        let load = a.load(&at_rest);
        for &d in a.directions() {
            (0..6).for_each(|i| moving.x[i] += carried.rows[k][d][i] * load[d]);
        }
        carried.at_rest[k] = at_rest;
    }
    carried.inertia.solve(&mut moving.x);
    moving
}

/// Adds to `loads` what the added masses exert while the whole accelerates as [`accelerate`] just said.
pub(super) fn add(moving: &Moving, ws: &Workspace, loads: &mut [Wrench]) {
    let carried = &ws.carried;
    for (k, a) in carried.added.iter().enumerate() {
        let mut s = carried.at_rest[k];
        for &d in a.directions() {
            s[d] += dot(&carried.rows[k][d], &moving.x);
        }
        loads[a.body()] += wrench(ws.motions[a.body()].r, &a.load(&s));
    }
}

/// The added masses in a configuration, with the whole.
fn carry(
    (t, added): (f64, &[AddedMass]),
    placements: &[Placement],
    whole: &Composite,
    out: &mut Carried,
) {
    out.at = Some(t);
    out.added.clear();
    out.added.extend_from_slice(added);
    out.at_rest.resize(added.len(), [0.0; 6]);
    out.rows.clear();
    let mut matrix = inertia_of_whole(whole);
    for a in added {
        let (at, mut rows) = (&placements[a.body()], [[0.0; 6]; 6]);
        (a.directions().iter()).for_each(|&k| rows[k] = row(at, whole.c, k));
        put_added(a, &rows, &mut matrix);
        out.rows.push(rows);
    }
    out.inertia = Ldlt::new(matrix);
}

/// `diag(m, I)`, root components.
fn inertia_of_whole(whole: &Composite) -> SixBySix {
    let mass = DMat3::from_diagonal(DVec3::splat(whole.mass));
    from_quarters([[mass, DMat3::ZERO], [DMat3::ZERO, whole.inertia]])
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

/// Adds `J^T A J` to the lower half of the matrix.
fn put_added(a: &AddedMass, rows: &SixBySix, matrix: &mut SixBySix) {
    for &k in a.directions() {
        let mut carried = [0.0; 6];
        for &l in a.directions() {
            let factor = a.matrix()[k][l];
            (0..6).for_each(|j| carried[j] += factor * rows[l][j]);
        }
        for i in 0..6 {
            (0..=i).for_each(|j| matrix[i][j] += rows[k][i] * carried[j]);
        }
    }
}

fn dot(a: &Six, b: &Six) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
