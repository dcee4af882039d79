//! The sum over far filaments of algebraic cores: cells of sources act on cells of targets by interpolation of
//! the kernel.
//!
//! The kernel `1 / D^3`, `D^2 = r^2 + q + e` with half the squared core radii q of the target and e of the
//! source, is a smooth function of four variables of the source, its place and e, and likewise of the target.
//! Where a cell is small beside D, a polynomial between Chebyshev points stands for the function in it [Wang,
//! Krasny & Tlupova 2020, Commun. Comput. Phys. 28:1415; of targets as well: Wilson, Vaughn & Krasny 2021,
//! Comput. Phys. Commun. 265:108017]. Filaments of a cell become sources at its points, velocities at the
//! points of a cell become those at its targets.
//!
//! It converges as powers of (size of the cell) / D, not / r: wide cores make a kernel smoother, and a cell
//! smaller than its cores is far even from what is inside it. That is what expansions of the bare kernel
//! ([`crate::tree`]) cannot know.
//!
//! Steps: sort sources and targets into boxes of place and softening ([`boxes`]), spread the filaments over the
//! points of their cells ([`grid`]), find which cells act on each other how ([`pairs`]), sum from grid to grid
//! ([`translate`], by Gaussians, [`gaussians`]) and what is near one by one, and read the velocities at the
//! targets.

mod boxes;
mod gaussians;
mod grid;
mod pairs;
#[cfg(test)]
mod tests;
mod translate;

use crate::cores::{CoreModel, INV_4PI};
use crate::direct::block::{BLOCK, Block, Targets};
use crate::direct::moments;
use crate::direct::packed::Packed;
use crate::direct::single::Single;
use crate::quadrature::gauss_legendre;
use crate::sources::{Network, Points};
use crate::work::Work;
use boxes::{Boxes, Item, Shape};
use fearless_simd::Level;
use glam::DVec3;
use grid::{Grid, Place, Room, VALUES, place};
use pairs::Pairs;
use rayon::prelude::*;
use translate::{Received, Sums};

/// Filaments of a leaf: neighbours enough for the direct sum to find its nodes in sight.
const SOURCE_LEAF: usize = 192;

/// Targets of a leaf.
const TARGET_LEAF: usize = BLOCK;

const _: () = assert!(SOURCE_LEAF * TARGET_LEAF <= pairs::FEW);

/// How fine the interpolation is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fineness {
    /// Points along each direction of space, and along that of softening.
    pub points: [usize; 2],
    /// Half the diagonals of two cells over their softened distance, at most.
    pub ratio: f64,
    /// Half the extents in softening over the square of that distance, at most.
    pub softening_ratio: f64,
}

impl Fineness {
    /// What leaves errors of a half of the tolerance in wakes of hovering flies; measured.
    pub fn for_tolerance(tolerance: f64) -> Self {
        let is_lax = tolerance >= 2.5e-3;
        Self {
            points: if is_lax { [4, 3] } else { [5, 3] },
            ratio: 0.8,
            softening_ratio: if is_lax { 0.4 } else { 0.35 },
        }
    }

    fn shape(&self, leaf: usize) -> Shape {
        Shape {
            leaf,
            per_softening: self.ratio * self.ratio / self.softening_ratio,
        }
    }
}

/// Sources and targets in cells.
#[derive(Clone, Debug)]
pub(crate) struct Interpolation {
    fineness: Fineness,
    grid: Grid,
    level: Level,
    model: CoreModel,
    /// Abscissas and weights on (0, 1) along a filament.
    quadrature: Vec<(f64, f64)>,
    sources: Boxes,
    packed: Packed,
    single: Single,
    /// Strengths at the points of the cells of sources \[m3/s\], and as the sums take them.
    strengths: Vec<[f64; 3]>,
    packed_strengths: Vec<Sums>,
    targets: Boxes,
    pairs: Pairs,
    /// Velocity and vorticity at the points of the cells of targets.
    values: Vec<[f64; VALUES]>,
    /// The same at the targets, in the order of the items and in their own.
    sorted: Vec<[f64; VALUES]>,
    sums: Vec<[f64; VALUES]>,
    gather_room: Room<3>,
    refine_room: Room<VALUES>,
}

impl Interpolation {
    /// No sources and no targets yet.
    pub fn new(model: CoreModel, level: Level, fineness: Fineness) -> Self {
        Self {
            fineness,
            grid: Grid::new(fineness.points),
            level,
            model,
            quadrature: gauss_legendre(fineness.points[0] / 2 + 1),
            sources: Boxes::default(),
            packed: Packed::default(),
            single: Single::default(),
            strengths: vec![],
            packed_strengths: vec![],
            targets: Boxes::default(),
            pairs: Pairs::default(),
            values: vec![],
            sorted: vec![],
            sums: vec![],
            gather_room: Room::default(),
            refine_room: Room::default(),
        }
    }

    /// Replaces the sources.
    pub fn load(&mut self, network: &Network) {
        let moves = |&e: &usize| network.gamma[e] != 0.0;
        let edges = (0..network.len()).filter(moves);
        self.sources.items.clear();
        self.sources.items.extend(edges.map(|e| {
            let [a, b] = ends(network, e);
            Item {
                place: std::array::from_fn(|d| 0.5 * (a[d] + b[d])),
                low: std::array::from_fn(|d| a[d].min(b[d])),
                high: std::array::from_fn(|d| a[d].max(b[d])),
                index: e as u32,
            }
        }));
        self.sources.sort(self.fineness.shape(SOURCE_LEAF));
        self.pack(network);
        self.spread(network);
    }

    /// The near field's form of the sources, leaf by leaf.
    fn pack(&mut self, network: &Network) {
        let (packed, sources) = (&mut self.packed, &self.sources);
        packed.clear(network.nodes.len());
        self.single.clusters.clear();
        for leaf in sources.leaves() {
            let edges = sources.items_of(leaf).iter().map(|item| item.index);
            let patches = packed.load_group(self.model, network, edges);
            self.single.clusters.push(patches);
        }
        self.single.load_clusters(self.model, packed);
    }

    /// Replaces the filaments of each cell by sources at the points of its grid: those of leaves one by one,
    /// those of others by the points of their children, who come after their parents.
    fn spread(&mut self, network: &Network) {
        let (sources, grid, len) = (&self.sources, &self.grid, self.grid.len());
        let quadrature = &self.quadrature;
        self.strengths.clear();
        self.strengths.resize(sources.cells.len() * len, [0.0; 3]);
        let each = self.strengths.par_chunks_mut(len).zip(&sources.cells);
        each.filter(|(_, cell)| cell.leaves.len() == 1)
            .for_each(|(out, cell)| {
                for item in sources.items_of(cell) {
                    let e = item.index as usize;
                    let [a, b] = ends(network, e);
                    let (from, to) = network.ends(e);
                    let strength = INV_4PI * network.gamma[e] * (to - from);
                    for &(s, weight) in quadrature {
                        let at = std::array::from_fn(|d| a[d] + s * (b[d] - a[d]));
                        grid.spread(&cell.frame, at, weight * strength, out);
                    }
                }
            });
        for (c, cell) in sources.cells.iter().enumerate().rev() {
            for k in sources.children(c).into_iter().flatten() {
                let (own, theirs) = self.strengths.split_at_mut(k * len);
                let (own, theirs) = (&mut own[c * len..][..len], &theirs[..len]);
                let frames = [&sources.cells[k].frame, &cell.frame];
                grid.gather(frames, theirs, &mut self.gather_room, own);
            }
        }
        let per_unit = self.single.per_unit;
        self.packed_strengths.resize(self.strengths.len(), [0.0; 8]);
        let packed = self.packed_strengths.par_chunks_mut(len);
        let each = packed
            .zip(self.strengths.par_chunks(len))
            .zip(&sources.cells);
        each.for_each(|((out, strengths), cell)| {
            translate::pack(grid, &cell.frame, strengths, per_unit, out);
        });
    }

    /// Replaces the targets.
    pub fn aim(&mut self, targets: &Points) {
        self.targets.items.clear();
        let items = targets.iter().enumerate().map(|(i, p)| {
            let at = place(p, targets.softening(i));
            Item {
                place: at,
                low: at,
                high: at,
                index: i as u32,
            }
        });
        self.targets.items.extend(items);
        self.targets.sort(self.fineness.shape(TARGET_LEAF));
    }

    /// Finds which cells act on each other, of cells as large as they may be times `part`; returns what their
    /// sum costs.
    pub fn pair(&mut self, part: f64) -> Work {
        if self.sources.cells.is_empty() || self.targets.cells.is_empty() {
            return Work::default();
        }
        let ratio = part * self.fineness.ratio;
        self.pairs.find(&self.targets, &self.sources, ratio);
        Work {
            far: self.pairs.far.len() as u64,
            near: self.pairs.near_pairs,
        }
    }

    /// Points of the grid of a cell.
    pub fn points(&self) -> usize {
        self.grid.len()
    }

    /// Velocity and vorticity at all targets.
    pub fn evaluate(&mut self) {
        let (len, count) = (self.grid.len(), self.targets.items.len());
        for (sums, count) in [
            (&mut self.sums, count),
            (&mut self.sorted, count),
            (&mut self.values, self.targets.cells.len() * len),
        ] {
            sums.clear();
            sums.resize(count, [0.0; VALUES]);
        }
        if self.sources.cells.is_empty() || count == 0 {
            return;
        }
        self.sum_at_grids();
        self.refine();
        self.sum_at_targets();
        for (item, sum) in self.targets.items.iter().zip(&self.sorted) {
            self.sums[item.index as usize] = *sum;
        }
    }

    /// What was evaluated last: velocity \[m/s\] and vorticity \[1/s\] at each target.
    pub fn sums(&self) -> &[[f64; VALUES]] {
        &self.sums
    }

    /// Sums at the points of the grids of targets.
    fn sum_at_grids(&mut self) {
        let (grid, len, per_unit) = (&self.grid, self.grid.len(), self.single.per_unit);
        let (targets, sources, pairs) = (&self.targets, &self.sources, &self.pairs);
        let strengths = &self.packed_strengths;
        let all = self.values.par_chunks_mut(len).zip(&targets.cells);
        all.enumerate().for_each(|(t, (values, cell))| {
            if pairs.far.of(t).is_empty() {
                return;
            }
            let mut received = Received::NONE;
            for s in pairs.far.of(t).iter().map(|&s| s as usize) {
                let frames = [&cell.frame, &sources.cells[s].frame];
                let from = &strengths[s * len..][..len];
                translate::add(self.level, grid, frames, (from, per_unit), &mut received);
            }
            for (i, value) in values.iter_mut().enumerate() {
                let [w, m] = [0, 4].map(|k| {
                    let [x, y, z] = [0, 1, 2].map(|d| f64::from(received.0[i][k + d]));
                    DVec3::new(x, y, z)
                });
                let u = w.cross(grid.offset(&cell.frame, i) * per_unit) - m;
                let w = w * per_unit;
                *value = [u.x, u.y, u.z, w.x, w.y, w.z];
            }
        });
    }

    /// Hands the values of grids on to those of their children.
    fn refine(&mut self) {
        let (targets, grid, len) = (&self.targets, &self.grid, self.grid.len());
        for (c, cell) in targets.cells.iter().enumerate() {
            for k in targets.children(c).into_iter().flatten() {
                let (own, theirs) = self.values.split_at_mut(k * len);
                let (own, theirs) = (&own[c * len..][..len], &mut theirs[..len]);
                let frames = [&targets.cells[k].frame, &cell.frame];
                grid.refine(frames, own, &mut self.refine_room, theirs);
            }
        }
    }

    /// Reads what the grids of leaves have at the targets, and sums there what is near.
    fn sum_at_targets(&mut self) {
        let (targets, grid, len) = (&self.targets, &self.grid, self.grid.len());
        let (pairs, single, level) = (&self.pairs, &self.single, self.level);
        let (cells, values) = (&targets.cells, &self.values);
        // Leaves stand in the order of their items, all but the last full.
        let items = targets.items.par_chunks(TARGET_LEAF);
        let all = self.sorted.par_chunks_mut(TARGET_LEAF).zip(items);
        all.enumerate().for_each(|(leaf, (sums, items))| {
            let c = targets.cell_of_leaf(leaf);
            let (mut block, count) = (Block::ZERO, items.len());
            for (k, (item, sum)) in items.iter().zip(sums.iter_mut()).enumerate() {
                *sum = grid.read(&cells[c].frame, item.place, &values[c * len..][..len]);
                block.set(k, DVec3::from_slice(&item.place[..3]));
                block.softening[k] = item.place[3];
            }
            let block = &block;
            let (mut velocity, mut vorticity) = (Block::ZERO, Block::ZERO);
            let near = pairs.near.of(leaf).iter().map(|&leaf| leaf as usize);
            let both = [&mut velocity, &mut vorticity];
            moments::add_clusters(level, single, near, Targets { block, count }, both);
            for (k, sum) in sums.iter_mut().enumerate() {
                let (u, w) = (velocity.get(k), vorticity.get(k));
                for (sum, value) in sum.iter_mut().zip([u.x, u.y, u.z, w.x, w.y, w.z]) {
                    *sum += value;
                }
            }
        });
    }
}

/// Both ends of an edge, with what softens them.
fn ends(network: &Network, e: usize) -> [Place; 2] {
    network.edges[e].map(|n| {
        let n = n as usize;
        place(network.nodes.get(n), 0.5 * network.core_at(e, n))
    })
}
