//! How strain-rate damping of a beam changes as it turns.

use super::{Beam, ENDS, Turning, add, ends, screw_between};
use crate::nodes::configuration::{Configuration, NODE};
use crate::nodes::screw::Screw;
use wingbeat_math::six_by_six::{ZERO, product, times, transpose};

impl Beam {
    /// Adds `factor` times the derivative of the damping force `B^T K B v` by the numbers of the nodes, v held:
    /// `B^T K` by the turning of the force, `B v` by that of the rates.
    pub(super) fn turning_of_damping(
        &self,
        (at, before): (&Configuration, &Configuration),
        velocity: &[f64],
        factor: f64,
        tangent: &mut [f64],
    ) {
        let (rotations, screw) = screw_between(at, self.nodes, &self.offsets);
        let maps = self.node_to_end(&rotations);
        let by_nodes = self.screw_by_nodes(&screw, &maps);
        let turning = |force: &Screw, out: &mut [f64]| {
            let turning = Turning {
                screw: &screw,
                force,
                rotations: &rotations,
                ends: &ends(&screw, force),
                maps: &maps,
                by_nodes: &by_nodes,
            };
            self.geometric(&turning, out);
        };
        let six = |e: usize| std::array::from_fn(|k| velocity[NODE * e + k]);
        let (attitudes, foreseen) = screw_between(before, self.nodes, &self.offsets);
        let foreseen = self.screw_by_nodes(&foreseen, &self.node_to_end(&attitudes));
        let [a, b] = [0, 1].map(|e| times(&foreseen[e], &six(e)));
        let rate = std::array::from_fn(|k| factor * (a[k] + b[k]));
        let force = Screw::from_numbers(&times(&self.stiffness, &rate));
        turning(&force, tangent);
        // Rates of the screw by the numbers of the nodes: forces of a unit of each, their turning times the velocities.
        let mut rows = [ZERO; 2];
        for k in 0..6 {
            let mut unit = [0.0; 6];
            unit[k] = factor;
            let mut turned = [0.0; ENDS * ENDS];
            turning(&Screw::from_numbers(&unit), &mut turned);
            for (row, v) in turned.chunks_exact(ENDS).zip(velocity) {
                (0..ENDS).for_each(|j| rows[j / NODE][k][j % NODE] += v * row[j]);
            }
        }
        for (e, f) in (0..4).map(|k| (k / 2, k % 2)) {
            let part = product(&self.stiffness, &rows[f]);
            add(tangent, [e, f], &product(&transpose(&by_nodes[e]), &part));
        }
    }
}
