//! Sources in a binary tree of cells, each with the expansion of its far field.

use crate::cores::CoreModel;
use crate::cores::INV_4PI;
use crate::direct::packed::Packed;
use crate::direct::single::Single;
use crate::preorder::children;
use crate::sources::Network;
use crate::tree::harmonics::{Coefficient, Harmonics};
use fearless_simd::{Level, dispatch};
use glam::DVec3;
use std::ops::Range;

/// Edges of a leaf; all but the last are full.
pub(crate) const LEAF: usize = 32;

/// Leaves of a subtree that is worth a task of its own.
const TASK_LEAVES: usize = 32;

/// How much more than estimated the change of the far velocity by cores counts.
const WEIGHT: f64 = 10.0;

/// The same of cores whose function fades with the fourth power of the distance or faster.
const WEIGHT_OF_COMPACT: f64 = 40.0;

/// Something with a place, to be sorted in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item {
    /// Where it is [m].
    pub place: DVec3,
    /// Its number in the caller's order.
    pub index: u32,
}

/// A cluster of edges.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cell {
    /// Corners of the box around its edges [m].
    low: DVec3,
    high: DVec3,
    /// Centre of the box and of the expansion [m].
    pub centre: DVec3,
    /// No point of its edges is farther from the centre [m].
    pub radius: f64,
    /// The part of the velocity left out is about reach / D^(P + 2) at distance D.
    pub reach: f64,
    /// The core changes the velocity by about smear / D^4 (cut-off: D^6).
    pub smear: f64,
    /// Its leaves; one if it is a leaf.
    pub leaves: Range<u32>,
}

/// Cells in pre-order: a cell, its first child's subtree, its second child's.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    pub model: CoreModel,
    pub level: Level,
    pub harmonics: Harmonics,
    pub packed: Packed,
    /// The near field in single precision, if it is summed so.
    pub single: Option<Single>,
    pub cells: Vec<Cell>,
    /// Patches of each leaf.
    pub leaf_patches: Vec<Range<usize>>,
    /// [`Harmonics::len`] for each cell.
    coefficients: Vec<Coefficient>,
    items: Vec<Item>,
}

impl Cells {
    /// No sources yet.
    pub fn new(model: CoreModel, level: Level, order: usize, is_single: bool) -> Self {
        Self {
            model,
            level,
            harmonics: Harmonics::new(order),
            packed: Packed::default(),
            single: is_single.then(Single::default),
            cells: vec![],
            leaf_patches: vec![],
            coefficients: vec![],
            items: vec![],
        }
    }

    /// Replaces the sources; at least one edge.
    pub fn load(&mut self, network: &Network) {
        let middle = |e: usize| {
            let (a, b) = network.ends(e);
            0.5 * (a + b)
        };
        self.items.clear();
        self.items.extend((0..network.len()).map(|e| Item {
            place: middle(e),
            index: e as u32,
        }));
        let (leaves, len) = (network.len().div_ceil(LEAF), self.harmonics.len());
        self.cells.clear();
        self.cells.resize(2 * leaves - 1, Cell::default());
        self.coefficients.clear();
        self.coefficients.resize(self.cells.len() * len, [0.0; 6]);
        let grower = Grower {
            model: self.model,
            level: self.level,
            harmonics: &self.harmonics,
            network,
        };
        grower.grow(&mut self.items, &mut self.cells, &mut self.coefficients, 0);
        self.coefficients
            .chunks_mut(len)
            .for_each(|c| self.harmonics.finish(c));
        self.pack(network);
    }

    /// The near field's form of the sources, leaf by leaf.
    fn pack(&mut self, network: &Network) {
        self.packed.clear(network.nodes.len());
        self.leaf_patches.clear();
        for leaf in self.items.chunks(LEAF) {
            let edges = leaf.iter().map(|item| item.index);
            let patches = self.packed.load_group(self.model, network, edges);
            self.leaf_patches.push(patches);
        }
        if let Some(single) = &mut self.single {
            let leaves = self.leaf_patches.iter().cloned();
            single.load(self.model, &self.packed, leaves);
        }
    }

    /// Finished coefficients of cell `c`.
    pub fn coefficients(&self, c: usize) -> &[Coefficient] {
        let len = self.harmonics.len();
        &self.coefficients[c * len..(c + 1) * len]
    }

    /// The children of cell `c`, None if it is a leaf.
    pub fn children(&self, c: usize) -> Option<[usize; 2]> {
        children(c, self.cells[c].leaves.len())
    }
}

/// What the growing of a tree looks at.
struct Grower<'a> {
    model: CoreModel,
    level: Level,
    harmonics: &'a Harmonics,
    network: &'a Network,
}

impl Grower<'_> {
    /// Makes the subtree of `items`, whose first leaf has this number; threads share it by halves.
    fn grow(&self, items: &mut [Item], cells: &mut [Cell], far: &mut [Coefficient], leaf: u32) {
        let leaves = items.len().div_ceil(LEAF);
        if leaves == 1 {
            return self.make_leaf(items, &mut cells[0], far, leaf);
        }
        let first = leaves / 2;
        split(items, first * LEAF);
        let len = self.harmonics.len();
        let (items1, items2) = items.split_at_mut(first * LEAF);
        let (cell, rest) = cells.split_first_mut().expect("a cell for the root");
        let (cells1, cells2) = rest.split_at_mut(2 * first - 1);
        let (own, rest) = far.split_at_mut(len);
        let (far1, far2) = rest.split_at_mut((2 * first - 1) * len);
        let second = leaf + first as u32;
        if leaves > TASK_LEAVES {
            rayon::join(
                || self.grow(items1, cells1, far1, leaf),
                || self.grow(items2, cells2, far2, second),
            );
        } else {
            self.grow(items1, cells1, far1, leaf);
            self.grow(items2, cells2, far2, second);
        }
        self.merge(
            cell,
            own,
            [(&cells1[0], &far1[..len]), (&cells2[0], &far2[..len])],
        );
    }

    fn make_leaf(&self, items: &mut [Item], cell: &mut Cell, far: &mut [Coefficient], leaf: u32) {
        items.sort_unstable_by_key(|item| item.index);
        let edges = || items.iter().map(|item| item.index);
        let ends = || edges().map(|e| self.network.ends(e as usize));
        cell.leaves = leaf..leaf + 1;
        cell.low = ends().fold(DVec3::INFINITY, |low, (a, b)| low.min(a).min(b));
        cell.high = ends().fold(DVec3::NEG_INFINITY, |high, (a, b)| high.max(a).max(b));
        cell.centre = 0.5 * (cell.low + cell.high);
        let c = cell.centre;
        cell.radius = ends().fold(0.0, |r: f64, (a, b)| {
            r.max(a.distance(c)).max(b.distance(c))
        });
        cell.smear = edges().map(|e| self.smear(e as usize)).sum();
        dispatch!(self.level, simd => self.harmonics.expand(simd, self.network, edges(), c, far));
        cell.reach = self.reach(cell.radius, far);
    }

    fn merge(
        &self,
        cell: &mut Cell,
        far: &mut [Coefficient],
        children: [(&Cell, &[Coefficient]); 2],
    ) {
        let [(one, _), (two, _)] = children;
        cell.leaves = one.leaves.start..two.leaves.end;
        cell.low = one.low.min(two.low);
        cell.high = one.high.max(two.high);
        cell.centre = 0.5 * (cell.low + cell.high);
        cell.smear = one.smear + two.smear;
        let around = |c: &Cell| c.radius + c.centre.distance(cell.centre);
        let diagonal = 0.5 * cell.low.distance(cell.high);
        cell.radius = diagonal.min(around(one).max(around(two)));
        for (child, coefficients) in children {
            self.harmonics
                .shift(coefficients, child.centre - cell.centre, far);
        }
        cell.reach = self.reach(cell.radius, far);
    }

    /// The first part left out, judged by the last two kept (odd or even ones may vanish by symmetry).
    fn reach(&self, radius: f64, far: &[Coefficient]) -> f64 {
        let strength = |n: usize| self.harmonics.strength(n, far);
        let order = self.harmonics.order;
        (strength(order) * radius).max(strength(order - 1) * radius * radius)
    }

    /// Change of the far velocity by the core, times D^4 (cut-off: D^6).
    ///
    /// The cut-off divides it by 1 + core / (2 D^4), a change of c = 0.5 times core / D^4. The others multiply it by
    /// 1 - f(h), h = D sin a the distance from the **line** of the segment, which may be short at any D. The root mean
    /// square over all directions of sin a f is 3 c (r_c / D)^2 with c = 0.1 (Vatistas, Lamb-Oseen) and c = 0.5 at D =
    /// 20 r_c (Scully); a third of it, for the segments of a cell add with either sign. Algebraic cores count as
    /// Scully's, those at nodes and at targets not at all.
    ///
    /// [`WEIGHT`] and [`WEIGHT_OF_COMPACT`] are what that counts for beside what the expansion leaves out: the share of
    /// the tolerance that a cell may leave out is laxer than either estimate. Measured on sheets, and checked at every
    /// sum.
    fn smear(&self, e: usize) -> f64 {
        let (a, b) = self.network.ends(e);
        let strength = (self.network.gamma[e] * INV_4PI).abs() * a.distance(b);
        let change = match self.model {
            CoreModel::CutOff { .. } => 0.5 * WEIGHT,
            CoreModel::Vatistas { .. } | CoreModel::LambOseen { .. } => 0.1 * WEIGHT_OF_COMPACT,
            CoreModel::Scully { .. } | CoreModel::Algebraic { .. } => 0.5 * WEIGHT,
        };
        strength * self.network.core[e] * change
    }
}

/// Half the power of D by which the change due to the core fades.
pub(crate) fn half_fade(model: CoreModel) -> usize {
    if matches!(model, CoreModel::CutOff { .. }) {
        3
    } else {
        2
    }
}

/// Puts the `n` items that are lowest along the longest side of their box first. Equal places are
/// told apart by number, so the two halves are the same sets on every machine.
pub(crate) fn split(items: &mut [Item], n: usize) {
    let low = items
        .iter()
        .fold(DVec3::INFINITY, |low, item| low.min(item.place));
    let high = items
        .iter()
        .fold(DVec3::NEG_INFINITY, |high, item| high.max(item.place));
    let axis = (high - low).max_position();
    items.select_nth_unstable_by(n, |a, b| {
        a.place[axis]
            .total_cmp(&b.place[axis])
            .then(a.index.cmp(&b.index))
    });
}
