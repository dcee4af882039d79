//! One wake sheet.

use crate::images::Mirror;
use crate::state::particles::Particles;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// The free rows of one wake sheet, **oldest row first**. The newest row of nodes, on the
/// shedding edge itself, is not stored: it follows the surface.
///
/// Ring (r, c) lies between node rows r and r + 1 (the shedding edge being the row after the
/// last) and node columns c and c + 1. Its circulation is positive if it runs its newer edge
/// from column c + 1 to column c.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct WakeSheet {
    /// Rings per row; a row has one node more.
    pub columns: usize,
    /// Whether it leaves its surface all around, so that its last line of nodes is its first.
    pub is_closed: bool,
    /// Free nodes [m], N, row by row.
    pub nodes: Points,
    /// Circulation of the rings [m2/s], row by row.
    pub gamma: Vec<f64>,
    /// Time at which each row of rings left the edge [s].
    pub shed_time: Vec<f64>,
    /// Velocity with which the nodes came here [m/s], N components; empty unless convection looks back.
    pub velocity: Points,
    /// Oldest rows of each column whose rings have become particles. Their circulations are kept
    /// while a neighbour is still a ring.
    pub converted: Vec<usize>,
    /// Particles that were rings.
    pub particles: Particles,
}

impl WakeSheet {
    /// Number of rows of rings, which is the number of free rows of nodes.
    pub fn rows(&self) -> usize {
        self.shed_time.len()
    }

    /// Node `column` of free row `row`, counted from the oldest [m], N components.
    pub fn node(&self, row: usize, column: usize) -> DVec3 {
        let k = row * (self.columns + 1) + column;
        DVec3::new(self.nodes.x[k], self.nodes.y[k], self.nodes.z[k])
    }

    /// Whether ring (`row`, `column`) is still there, not particles.
    pub fn is_ring(&self, row: usize, column: usize) -> bool {
        row >= self.converted[column]
    }

    /// Circulation of ring (`row`, `column`) [m2/s].
    pub fn ring(&self, row: usize, column: usize) -> f64 {
        self.gamma[row * self.columns + column]
    }

    /// The same, to be changed.
    pub(crate) fn ring_mut(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.gamma[row * self.columns + column]
    }

    /// Rings that are still there.
    pub fn ring_count(&self) -> usize {
        self.gamma.len() - self.converted.iter().sum::<usize>()
    }

    /// Whether the nodes of a row, counted from the oldest, lie on a ring with circulation; those on the shedding edge
    /// before a row leaves it lie on the newest one.
    pub(crate) fn has_strength(&self, row: usize) -> bool {
        let rings = row.saturating_sub(1)..(row + 1).min(self.rows());
        let of_row = |r: usize| &self.gamma[r * self.columns..(r + 1) * self.columns];
        rings.flat_map(of_row).any(|gamma| *gamma != 0.0)
    }

    /// Circulation of the newest ring of a column, zero while there is none [m2/s].
    pub(crate) fn newest(&self, column: usize) -> f64 {
        self.back_from_newest(0, column)
    }

    /// The same of the ring shed before it.
    pub(crate) fn before_newest(&self, column: usize) -> f64 {
        self.back_from_newest(1, column)
    }

    fn back_from_newest(&self, back: usize, column: usize) -> f64 {
        let row = self.rows().checked_sub(back + 1);
        row.map_or(0.0, |row| self.ring(row, column))
    }

    /// Circulation of the edge that lies between the columns `c - 1` and `c` of row `r` [m2/s].
    pub(crate) fn between_columns(&self, r: usize, c: usize) -> f64 {
        let left = if c > 0 { self.ring(r, c - 1) } else { 0.0 };
        let right = if c < self.columns {
            self.ring(r, c)
        } else {
            0.0
        };
        left - right
    }

    /// Circulation of the edge of column `c` that lies between the rows `r - 1` and `r` [m2/s].
    pub(crate) fn between_rows(&self, r: usize, c: usize) -> f64 {
        self.ring(r, c) - if r > 0 { self.ring(r - 1, c) } else { 0.0 }
    }

    /// Impulse per density [m4/s], N, of the rings of the oldest `rows` rows with the nodes `at` (row, column).
    pub(crate) fn impulse_with(&self, rows: usize, at: impl Fn(usize, usize) -> DVec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for r in 0..rows {
            for c in (0..self.columns).filter(|&c| self.is_ring(r, c)) {
                let ring = [at(r + 1, c + 1), at(r + 1, c), at(r, c), at(r, c + 1)];
                let area = (ring[2] - ring[0]).cross(ring[3] - ring[1]);
                sum += 0.5 * self.ring(r, c) * area;
            }
        }
        sum
    }

    /// Drops the oldest rows until at most `rows` are left. Whole rings go, so every filament
    /// that is left is still part of closed rings.
    pub(crate) fn keep(&mut self, rows: usize) {
        let drop = self.rows().saturating_sub(rows);
        let nodes = drop * (self.columns + 1);
        drop_first(&mut self.nodes, nodes);
        drop_first(&mut self.velocity, nodes);
        self.gamma.drain(..drop * self.columns);
        self.shed_time.drain(..drop);
        self.converted
            .iter_mut()
            .for_each(|s| *s = s.saturating_sub(drop));
    }

    /// Takes the nodes of the mirror image `source`, which has been moved and truncated already, after
    /// a row was shed here; returns how many rows were dropped.
    pub(crate) fn reflect(&mut self, source: &WakeSheet, mirror: Mirror) -> u64 {
        self.nodes.clear();
        let nodes = source.nodes.iter().map(|x| mirror.point(x));
        nodes.for_each(|x| self.nodes.push(x));
        self.velocity.clear();
        let velocities = source.velocity.iter().map(|v| mirror.vector(v));
        velocities.for_each(|v| self.velocity.push(v));
        let drop = self.rows() - source.rows();
        self.gamma.drain(..drop * self.columns);
        self.shed_time.drain(..drop);
        self.converted.clone_from(&source.converted);
        self.particles.reflect(&source.particles, mirror);
        drop as u64
    }
}

fn drop_first(points: &mut Points, n: usize) {
    let n = n.min(points.len());
    for c in [&mut points.x, &mut points.y, &mut points.z] {
        c.drain(..n);
    }
}
