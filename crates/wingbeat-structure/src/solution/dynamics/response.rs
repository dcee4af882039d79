//! How the body answers to accelerations of the frame that carries it.

use wingbeat_math::six_by_six::{ZERO, from_quarters, product, scaled, sum};
use wingbeat_math::{DMat3, DVec3, SixBySix, tilde};

use super::generalized_alpha::Trial;
use super::solver::{LoadTangent, Solver, combined};
use crate::nodes::block::pair;
use crate::nodes::configuration::NODE;
use crate::nodes::frame::FrameMotion;
use crate::nodes::inertia::{self, NodeMotion};
use crate::nodes::screw::right_jacobian;
use crate::structure::Structure;

impl Solver {
    /// Derivative of what the body exerts on the one that carries it, all loads less all inertial forces
    /// (force, moment about the origin of W), by the acceleration and angular acceleration of W over the step
    /// just solved, six by six by rows: the body's effective mass in this step, less than nothing. What follows
    /// elastically is condensed by the factors of the step's tangent, of which `loads` has to be the same; the
    /// last residual has to be that of the trial.
    pub fn frame_response(
        &mut self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        loads: &LoadTangent<'_>,
    ) -> SixBySix {
        let rigid = self.set_blocks(structure, trial, frame);
        if !loads.is_none() {
            self.take_off_loads(structure, trial, loads);
        }
        let mut response = rigid.map(|row| row.map(|v| -v));
        for j in 0..NODE {
            let by_frame = |k: usize| self.response.by_frame[k / NODE][k % NODE][j];
            let free = self.change.iter_mut().zip(&structure.number);
            free.for_each(|(x, &k)| *x = by_frame(k));
            if let Some(by) = loads.acceleration {
                let carried = &mut self.response.carried;
                let sum = carried.follow(&trial.configuration, by, j);
                (0..NODE).for_each(|i| response[i][j] += sum[i]);
                let free = self.change.iter_mut().zip(&structure.number);
                free.for_each(|(x, &k)| *x -= carried.loads[k]);
            }
            self.assembly.matrix.solve(&mut self.change);
            for (i, row) in response.iter_mut().enumerate() {
                let by_increment = |k: usize| self.response.rows[k / NODE][i][k % NODE];
                let free = self.change.iter().zip(&structure.number);
                row[j] += free.map(|(x, &k)| by_increment(k) * x).sum::<f64>();
            }
        }
        response
    }

    /// Fills the blocks of all nodes under loads that stay; returns the derivative of the resultant of inertial
    /// forces by the acceleration of W, the shape kept.
    fn set_blocks(
        &mut self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
    ) -> SixBySix {
        let (motion, s) = (trial.motion(), &mut self.response);
        s.to_root.clear();
        s.by_frame.clear();
        s.rows.clear();
        let mut rigid = ZERO;
        for (n, m) in structure.masses.iter().enumerate() {
            let (node, turn) = (motion.node(n), trial.turn(n));
            let (to_root, by_frame) = (to_root(&node), inertia::by_frame_acceleration(m, &node));
            rigid = sum(&rigid, &product(&to_root, &by_frame));
            let tangents = inertia::tangents(m, frame, &node);
            let local = combined(&tangents, trial.weights(), turn, 0.0);
            let [force, moment] = inertia::force(m, frame, &node);
            let [load, turning] = pair(&self.loads, n);
            let moved = moved(&node, [force - load, moment - turning], turn);
            s.rows.push(sum(&product(&to_root, &local), &moved));
            s.to_root.push(to_root);
            s.by_frame.push(by_frame);
        }
        for m in &structure.between {
            let (node, point) = (motion.middle(m.nodes), m.point());
            let (to_root, by_frame) = (
                to_root(&node),
                inertia::by_frame_acceleration(&point, &node),
            );
            rigid = sum(&rigid, &product(&to_root, &by_frame));
            let tangents = inertia::tangents(&point, frame, &node);
            let local = combined(&tangents, trial.weights(), DVec3::ZERO, 0.0);
            let [force, _] = inertia::force(&point, frame, &node);
            let moved = moved(&node, [force, DVec3::ZERO], DVec3::ZERO);
            let row = sum(&product(&to_root, &local), &moved);
            for n in m.nodes {
                s.rows[n] = sum(&s.rows[n], &scaled(&row, 0.5));
                s.by_frame[n] = sum(&s.by_frame[n], &scaled(&by_frame, 0.5));
            }
        }
        rigid
    }

    /// Takes the derivatives of the loads off those of the resultant.
    fn take_off_loads(&mut self, structure: &Structure, trial: &Trial, loads: &LoadTangent<'_>) {
        let s = &mut self.response;
        for (column, rows) in s.rows.iter_mut().enumerate() {
            let turn = right_jacobian(trial.turn(column));
            for n in 0..structure.nodes() {
                let row = |i: usize| loads.row(NODE * n + i, column, trial, &turn);
                let load = product(&s.to_root[n], &std::array::from_fn(row));
                let both = rows.as_flattened_mut().iter_mut().zip(load.as_flattened());
                both.for_each(|(r, l)| *r -= l);
            }
        }
    }
}

/// Map of a node's force (W) and moment (node components) to the origin.
fn to_root(node: &NodeMotion) -> SixBySix {
    from_quarters([[DMat3::IDENTITY, DMat3::ZERO], [tilde(node.u), node.r]])
}

/// Change of the resultant as a node moves with its force and moment.
fn moved(node: &NodeMotion, [force, moment]: [DVec3; 2], turn: DVec3) -> SixBySix {
    let zero = DMat3::ZERO;
    let turned = node.r * tilde(-moment) * right_jacobian(turn);
    from_quarters([[zero, zero], [tilde(-force), turned]])
}
