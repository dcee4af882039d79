//! The saddle-point system of seed eq. 30 as printed: assembled, scaled and solved as a whole.
//!
//! In SI units its condition number for an insect is 1e14. Coordinates are scaled by
//! `1/sqrt(M_ii)` and multipliers by `1/sqrt((B M^-1 B^T)_kk)`, which makes it of order ten. A body
//! without mass has `M_ii = 0`; there the scale is that of a millionth of the total mass. The
//! matrix as a whole stays regular, because elimination exchanges rows between M and B_q.

use wingbeat_dynamics::euler::{
    AngleJacobian, BodyKinematics, COORDINATES, HingeKinematics, equations,
};
use wingbeat_dynamics::{Baumgarte, System, Wrench};
use wingbeat_math::{DMat3, DVec3, SingularMatrix, solve_small};

/// Share of the total mass that sets the scale of a body without mass.
const LIGHTEST: f64 = 1e-6;

/// The matrix of seed eq. 30 (row-major) and its right-hand side; after solving, accelerations
/// and multipliers.
#[derive(Clone, Debug)]
pub struct Saddle {
    coordinates: usize,
    matrix: Vec<f64>,
    rhs: Vec<f64>,
    scale: Vec<f64>,
}

impl Saddle {
    /// Room for the saddle-point system of `system`.
    pub fn new(system: &System) -> Self {
        let coordinates = COORDINATES * system.bodies().len();
        let n = coordinates + 6 * system.hinges().len();
        Self {
            coordinates,
            matrix: vec![0.0; n * n],
            rhs: vec![0.0; n],
            scale: vec![0.0; n],
        }
    }

    /// Fills matrix and right-hand side of seed eq. 30.
    pub fn assemble(
        &mut self,
        system: &System,
        bodies: &[BodyKinematics],
        hinges: &[HingeKinematics],
        loads: &[Wrench],
        baumgarte: Baumgarte,
    ) {
        self.matrix.fill(0.0);
        for i in 0..bodies.len() {
            self.put_body(system, i, &bodies[i], &loads[i]);
        }
        for (k, h) in hinges.iter().enumerate() {
            self.put_hinge(system, k, h, baumgarte);
        }
    }

    /// The matrix, row-major, as last assembled (before [`Saddle::solve`]).
    pub fn matrix(&self) -> &[f64] {
        &self.matrix
    }

    /// The right-hand side `(Q^v + Q, S)`, as last assembled (before [`Saddle::solve`]).
    pub fn right_side(&self) -> &[f64] {
        &self.rhs
    }

    /// Mass matrix and generalized forces of one body (seed eq. 21).
    fn put_body(&mut self, system: &System, i: usize, k: &BodyKinematics, load: &Wrench) {
        let (body, at) = (&system.bodies()[i], COORDINATES * i);
        let (m, force) = equations(body, k, load, system.gravity());
        self.put(at, at, DMat3::from_diagonal(DVec3::splat(m.rr)));
        self.put(at, at + 3, m.r_eta);
        self.put(at + 3, at, m.r_eta.transpose());
        self.put(at + 3, at + 3, m.eta_eta);
        for part in 0..2 {
            force[part].write_to_slice(&mut self.rhs[at + 3 * part..]);
        }
        self.scale_body(system, at);
    }

    /// Jacobian and right-hand side S of one hinge: connection of all hinges first, then
    /// orientation, as in the seed.
    fn put_hinge(&mut self, system: &System, k: usize, h: &HingeKinematics, b: Baumgarte) {
        let hinge = &system.hinges()[k];
        let connection = self.coordinates + 3 * k;
        let orientation = connection + 3 * system.hinges().len();
        let (a, c) = (
            COORDINATES * hinge.parent.expect("a tree"),
            COORDINATES * hinge.child,
        );
        self.put_twice(connection, a, -DMat3::IDENTITY);
        self.put_twice(connection, c, DMat3::IDENTITY);
        self.put_angles(connection, a, c, &h.connection_jacobian());
        self.put_angles(orientation, a, c, &h.orientation_jacobian());
        let s = b.right_side(h.connection_bias(), h.connection_rate(), h.connection());
        s.write_to_slice(&mut self.rhs[connection..]);
        let s = b.right_side(h.orientation_bias(), h.orientation_rate(), h.orientation());
        s.write_to_slice(&mut self.rhs[orientation..]);
    }

    fn put_angles(&mut self, row: usize, parent: usize, child: usize, j: &AngleJacobian) {
        self.put_twice(row, parent + 3, j.parent);
        self.put_twice(row, child + 3, j.child);
    }

    /// A block of B_q and its transpose.
    fn put_twice(&mut self, row: usize, col: usize, block: DMat3) {
        self.put(row, col, block);
        self.put(col, row, block.transpose());
    }

    fn put(&mut self, row: usize, col: usize, block: DMat3) {
        let n = self.rhs.len();
        for i in 0..3 {
            let at = (row + i) * n + col;
            block.row(i).write_to_slice(&mut self.matrix[at..at + 3]);
        }
    }

    /// Scales of a body's coordinates.
    fn scale_body(&mut self, system: &System, at: usize) {
        let (n, length) = (self.rhs.len(), system.units().length);
        let least = LIGHTEST * system.total_mass();
        for c in 0..COORDINATES {
            let floor = if c < 3 {
                least
            } else {
                least * length * length
            };
            let diagonal = self.matrix[(at + c) * (n + 1)];
            self.scale[at + c] = 1.0 / diagonal.max(floor).sqrt();
        }
    }

    /// Scales of the multipliers, from those of the coordinates.
    fn scale_multipliers(&mut self) {
        let (n, m) = (self.rhs.len(), self.coordinates);
        for k in m..n {
            let row = &self.matrix[k * n..k * n + m];
            let sum: f64 = row
                .iter()
                .zip(&self.scale)
                .map(|(b, s)| (b * s) * (b * s))
                .sum();
            self.scale[k] = 1.0 / sum.sqrt();
        }
    }

    /// Scales matrix and right-hand side.
    pub fn equilibrate(&mut self) {
        self.scale_multipliers();
        let n = self.rhs.len();
        for (i, row) in self.matrix.chunks_exact_mut(n).enumerate() {
            let si = self.scale[i];
            for (x, sj) in row.iter_mut().zip(&self.scale) {
                *x *= si * sj;
            }
            self.rhs[i] *= si;
        }
    }

    /// Solves; [`Saddle::accelerations`] and [`Saddle::multipliers`] hold the result.
    ///
    /// # Errors
    /// The matrix is singular.
    pub fn solve(&mut self) -> Result<(), SingularMatrix> {
        self.equilibrate();
        solve_small(&mut self.matrix, &mut self.rhs)?;
        for (x, s) in self.rhs.iter_mut().zip(&self.scale) {
            *x *= s;
        }
        Ok(())
    }

    /// q'' after [`Saddle::solve`].
    pub fn accelerations(&self) -> &[f64] {
        &self.rhs[..self.coordinates]
    }

    /// lambda after [`Saddle::solve`].
    pub fn multipliers(&self) -> &[f64] {
        &self.rhs[self.coordinates..]
    }
}
