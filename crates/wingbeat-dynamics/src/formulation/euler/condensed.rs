//! The equations of seed eq. 30 solved through their tree structure.
//!
//! The six constraints of a hinge, differentiated twice, give the child's accelerations from the
//! parent's, `x_c = T x_p + b`, because their Jacobian by the child's coordinates is regular away
//! from the singularity of the Euler angles. Put into the equations of motion from the tips inward
//! this leaves six equations for the root; the multipliers follow outward from
//! `B_c^T lambda = F_c - M_c x_c`. The unknowns are those of the saddle-point matrix,
//! at a tenth of its cost; a child without mass is as good as any.

use wingbeat_math::{DMat3, DVec3, Wrench, trace};

use super::constraint::HingeKinematics;
use super::coordinates::{BodyKinematics, COORDINATES, write};
use super::inertia::{MassBlocks, equations};
use crate::System;
use crate::mechanism::baumgarte::Baumgarte;

/// Position part and angle part of six numbers that belong to a body.
type Pair = [DVec3; 2];

/// A hinge's constraints solved for the child: `T = [[I, p], [0, a]]` and b.
#[derive(Clone, Copy, Debug, Default)]
struct Transfer {
    p: DMat3,
    a: DMat3,
    b: Pair,
    /// Inverse of the orientation's Jacobian by the child's angles.
    inverse: DMat3,
    /// Jacobian of the connection by the child's angles.
    connection: DMat3,
}

/// Equations of motion of every body with all that hangs on it, and their solution.
#[derive(Clone, Debug)]
pub struct Condensed {
    mass: Vec<MassBlocks>,
    force: Vec<Pair>,
    transfer: Vec<Transfer>,
    accelerations: Vec<f64>,
    multipliers: Vec<f64>,
}

impl Condensed {
    /// Room for `system`.
    pub fn new(system: &System) -> Self {
        let (bodies, hinges) = (system.bodies().len(), system.hinges().len());
        Self {
            mass: vec![MassBlocks::default(); bodies],
            force: vec![[DVec3::ZERO; 2]; bodies],
            transfer: vec![Transfer::default(); hinges],
            accelerations: vec![0.0; COORDINATES * bodies],
            multipliers: vec![0.0; 6 * hinges],
        }
    }

    /// Solves seed eq. 30; `None` if the root's six equations are singular.
    pub fn solve(
        &mut self,
        system: &System,
        bodies: &[BodyKinematics],
        hinges: &[HingeKinematics],
        loads: &[Wrench],
        baumgarte: Baumgarte,
    ) -> Option<()> {
        for (i, k) in bodies.iter().enumerate() {
            (self.mass[i], self.force[i]) =
                equations(&system.bodies()[i], k, &loads[i], system.gravity());
        }
        for &k in system.outward().iter().rev() {
            let h = &system.hinges()[k];
            self.transfer[k] = Transfer::new(&hinges[k], baumgarte);
            self.condense(k, h.tree_parent(), h.child);
        }
        self.solve_root()?;
        for &k in system.outward() {
            let h = &system.hinges()[k];
            self.expand(k, h.tree_parent(), h.child);
        }
        Some(())
    }

    /// Adds the child's equations to the parent's.
    fn condense(&mut self, k: usize, parent: usize, child: usize) {
        let (t, m) = (&self.transfer[k], self.mass[child]);
        let coupled = t.p * m.rr + m.r_eta * t.a;
        let turned = m.r_eta.transpose() * t.p + m.eta_eta * t.a;
        let sum = &mut self.mass[parent];
        sum.rr += m.rr;
        sum.r_eta += coupled;
        sum.eta_eta += t.p.transpose() * coupled + t.a.transpose() * turned;
        let [f, g] = minus(self.force[child], m.times(t.b[0], t.b[1]));
        self.force[parent][0] += f;
        self.force[parent][1] += t.p.transpose() * f + t.a.transpose() * g;
    }

    /// The root's six equations, the mass centre's acceleration eliminated.
    fn solve_root(&mut self) -> Option<()> {
        let (m, [f, g]) = (self.mass[0], self.force[0]);
        let (lever, lever_t) = (m.r_eta * (1.0 / m.rr), m.r_eta.transpose());
        let inertia = m.eta_eta - lever_t * lever;
        let scale = trace(inertia) / 3.0;
        // As for the momentum form: a rod a million times longer than thick, at |cos theta| > 0.05.
        let singular = inertia.determinant() <= 1e-15 * scale.powi(3);
        if singular || !inertia.is_finite() {
            return None;
        }
        let angles = inertia.inverse() * (g - lever.transpose() * f);
        write(
            &mut self.accelerations,
            0,
            f / m.rr - lever * angles,
            angles,
        );
        Some(())
    }

    /// The child's accelerations and the hinge's multipliers.
    fn expand(&mut self, k: usize, parent: usize, child: usize) {
        let t = &self.transfer[k];
        let at = |i: usize| DVec3::from_slice(&self.accelerations[COORDINATES * parent + i..]);
        let (x, angles) = (at(0), at(3));
        let child_x = x + t.p * angles + t.b[0];
        let child_angles = t.a * angles + t.b[1];
        let [f, g] = minus(
            self.force[child],
            self.mass[child].times(child_x, child_angles),
        );
        let orientation = t.inverse.transpose() * (g - t.connection.transpose() * f);
        write(&mut self.accelerations, child, child_x, child_angles);
        f.write_to_slice(&mut self.multipliers[3 * k..]);
        let first = 3 * self.transfer.len();
        orientation.write_to_slice(&mut self.multipliers[first + 3 * k..]);
    }

    /// q'' after [`Condensed::solve`].
    pub fn accelerations(&self) -> &[f64] {
        &self.accelerations
    }

    /// lambda after [`Condensed::solve`].
    pub fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }
}

impl Transfer {
    fn new(h: &HingeKinematics, baumgarte: Baumgarte) -> Self {
        let (c, o) = (h.connection_jacobian(), h.orientation_jacobian());
        let s = baumgarte.right_side(h.connection_bias(), h.connection_rate(), h.connection());
        let turn =
            baumgarte.right_side(h.orientation_bias(), h.orientation_rate(), h.orientation());
        let inverse = o.child.inverse();
        let a = -(inverse * o.parent);
        let angles = inverse * turn;
        Self {
            p: -c.parent - c.child * a,
            a,
            b: [s - c.child * angles, angles],
            inverse,
            connection: c.child,
        }
    }
}

fn minus([a, b]: Pair, [c, d]: Pair) -> Pair {
    [a - c, b - d]
}
