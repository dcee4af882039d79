//! Derivatives of the strain energy by the six numbers of each corner.
//!
//! With an axis `d` in node components, `v = R exp(theta) d`: `dv = R (theta x d)`, so a force p on v is the
//! moment `d x R^T p` in node components, and the derivative of that moment by a further turn is `q d^T - (d .
//! q) I`, q = R^T p, for a force that stays (the tangent of moments in node components is not symmetric away
//! from equilibrium).

use wingbeat_math::{DMat3, DVec3, tilde};

use super::strain::{BLOCKS, STRAINS, Stiffness, Term, Vectors};
use crate::nodes::configuration::NODE;

/// Numbers of four corners.
const SIZE: usize = 4 * NODE;

/// Derivatives of the strains by the numbers of the corners.
pub(super) struct Gradient([[f64; SIZE]; STRAINS]);

impl Gradient {
    /// Of the strains with these products, for places and axes, rotations of the nodes and axes in node components.
    pub fn new(
        terms: &[Term],
        vectors: &Vectors,
        rotations: &[DMat3; 4],
        axes: &[DMat3; 4],
    ) -> Self {
        let mut rows = [[0.0; SIZE]; STRAINS];
        for term in terms {
            let row = &mut rows[term.strain];
            let [left, right] = term.vectors(vectors);
            for i in 0..4 {
                add(row, NODE * i, term.left[i] * right);
                if term.quadratic() {
                    add(row, NODE * i, term.right[i] * left);
                } else if term.right[i] != 0.0 {
                    let axis = axes[i].col(term.family - 1);
                    let force = rotations[i].transpose() * left;
                    add(row, NODE * i + 3, term.right[i] * axis.cross(force));
                }
            }
        }
        Self(rows)
    }

    /// Adds what the strains change by with the six numbers of the nodes, to first order.
    pub fn add_strains(
        &self,
        increment: &[f64],
        corner: &[usize; 4],
        strains: &mut [f64; STRAINS],
    ) {
        for (row, strain) in self.0.iter().zip(strains) {
            let part = |(k, g): (usize, &f64)| g * increment[NODE * corner[k / NODE] + k % NODE];
            *strain += row.iter().enumerate().map(part).sum::<f64>();
        }
    }

    /// Derivatives by the numbers of the corners of what the strains change by per second under `rates`, six
    /// numbers of each corner that are held.
    pub fn of_rates(
        terms: &[Term],
        vectors: &Vectors,
        rotations: &[DMat3; 4],
        axes: &[DMat3; 4],
        rates: &[[DVec3; 2]; 4],
    ) -> Self {
        let mut rows = [[0.0; SIZE]; STRAINS];
        let moving = |w: &[f64; 4]| (0..4).map(|i| w[i] * rates[i][0]).sum::<DVec3>();
        for term in terms {
            let row = &mut rows[term.strain];
            let ([left, _], left_rate) = (term.vectors(vectors), moving(&term.left));
            let turning = |i: usize| rates[i][1].cross(axes[i].col(term.family.max(1) - 1));
            let right_rate = if term.quadratic() {
                moving(&term.right)
            } else {
                (0..4)
                    .map(|i| term.right[i] * (rotations[i] * turning(i)))
                    .sum()
            };
            for i in 0..4 {
                add(row, NODE * i, term.left[i] * right_rate);
                if term.quadratic() {
                    add(row, NODE * i, term.right[i] * left_rate);
                } else if term.right[i] != 0.0 {
                    let back = rotations[i].transpose();
                    let axis = axes[i].col(term.family - 1);
                    let moment = axis.cross(back * left_rate) + turning(i).cross(back * left);
                    add(row, NODE * i + 3, term.right[i] * moment);
                }
            }
        }
        Self(rows)
    }

    /// Adds the derivative of the energy, by nodes.
    pub fn force(&self, stress: &[f64; STRAINS], corner: &[usize; 4], out: &mut [f64]) {
        for (row, stress) in self.0.iter().zip(stress) {
            for (k, g) in row.iter().enumerate() {
                out[NODE * corner[k / NODE] + k % NODE] += stress * g;
            }
        }
    }
}

fn add(row: &mut [f64; SIZE], at: usize, v: DVec3) {
    for k in 0..3 {
        row[at + k] += v[k];
    }
}

/// The tangent matrix while it is summed up.
pub(super) struct Tangent<'a> {
    corner: &'a [usize; 4],
    size: usize,
    out: &'a mut [f64],
}

impl<'a> Tangent<'a> {
    /// Adds to `out`, `size` numbers a row.
    pub fn new(corner: &'a [usize; 4], size: usize, out: &'a mut [f64]) -> Self {
        Self { corner, size, out }
    }

    /// `J^T C J`.
    pub fn material(&mut self, gradient: &Gradient, stiffness: &Stiffness) {
        self.between([gradient, gradient], stiffness, 1.0, &BLOCKS);
    }

    /// `factor J^T C D` of two gradients J and D, for strains in these blocks.
    pub fn between(
        &mut self,
        [j, d]: [&Gradient; 2],
        stiffness: &Stiffness,
        factor: f64,
        blocks: &[[usize; 2]],
    ) {
        for &[first, count] in blocks {
            for a in first..first + count {
                let mut stressed = [0.0; SIZE];
                for b in first..first + count {
                    let c = factor * stiffness[a][b];
                    stressed
                        .iter_mut()
                        .zip(&d.0[b])
                        .for_each(|(s, g)| *s += c * g);
                }
                self.outer(&j.0[a], &stressed);
            }
        }
    }

    /// Adds `u v^T`.
    fn outer(&mut self, u: &[f64; SIZE], v: &[f64; SIZE]) {
        for (r, u) in u.iter().enumerate() {
            let row = self.size * (NODE * self.corner[r / NODE] + r % NODE);
            for (node, v) in self.corner.iter().zip(v.chunks_exact(NODE)) {
                let out = &mut self.out[row + NODE * node..][..NODE];
                out.iter_mut().zip(v).for_each(|(o, v)| *o += u * v);
            }
        }
    }

    /// Forces of the strains times the second derivatives of the strains.
    pub fn geometric(
        &mut self,
        terms: &[Term],
        stress: &[f64; STRAINS],
        vectors: &Vectors,
        rotations: &[DMat3; 4],
        axes: &[DMat3; 4],
    ) {
        for term in terms {
            let stress = stress[term.strain];
            if term.quadratic() {
                self.places(term, stress);
                continue;
            }
            let [left, _] = term.vectors(vectors);
            for j in (0..4).filter(|&j| term.right[j] != 0.0) {
                let axis = axes[j].col(term.family - 1);
                let weight = stress * term.right[j];
                let q = weight * (rotations[j].transpose() * left);
                self.block([j, j], [3, 3], turned(q, axis));
                let coupling = rotations[j] * tilde(axis) * -weight;
                for i in 0..4 {
                    let block = coupling * term.left[i];
                    self.block([i, j], [0, 3], block);
                    self.block([j, i], [3, 0], block.transpose());
                }
            }
        }
    }

    /// Second derivatives of a product of places.
    fn places(&mut self, term: &Term, stress: f64) {
        for i in 0..4 {
            for j in 0..4 {
                let w = term.left[i] * term.right[j] + term.left[j] * term.right[i];
                self.block([i, j], [0, 0], DMat3::IDENTITY * (stress * w));
            }
        }
    }

    /// Adds a block of corners i and j, at `offset` within their six numbers.
    fn block(&mut self, [i, j]: [usize; 2], offset: [usize; 2], m: DMat3) {
        let row = NODE * self.corner[i] + offset[0];
        let column = NODE * self.corner[j] + offset[1];
        for a in 0..3 {
            for b in 0..3 {
                self.out[self.size * (row + a) + column + b] += m.col(b)[a];
            }
        }
    }
}

/// Derivative of the moment `d x q` by a turn of the node, the force being fixed in space: `q d^T - (d . q) I`.
fn turned(q: DVec3, d: DVec3) -> DMat3 {
    DMat3::from_cols(d.x * q, d.y * q, d.z * q) - DMat3::IDENTITY * d.dot(q)
}
