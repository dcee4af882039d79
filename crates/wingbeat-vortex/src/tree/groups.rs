//! Targets in groups of neighbours, and the walk of a group through the cells.

use crate::direct::block::{Block, Targets, load, store};
use crate::direct::lanes::{add_clusters, add_patches};
use crate::sources::Points;
use crate::tree::cells::{Cells, Item, half_fade, split};
use crate::work::Work;
use fearless_simd::{Simd, dispatch, prelude::*};
use glam::DVec3;
use rayon::prelude::*;

/// Targets of a group; fewer see fewer cells near, more share the walk.
const GROUP: usize = 32;

/// Groups of a part that is worth a task of its own.
const TASK_GROUPS: usize = 32;

/// Cells or leaves noted before they are summed.
const NOTES: usize = 128;

/// A far cell is at least this many radii away: the expansions converge as its inverse powers.
const FAREST: f64 = 1.5;

/// Targets sorted in space, [`GROUP`] to a group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups {
    items: Vec<Item>,
    /// Velocities in the order of the items.
    sums: Points,
    /// Place of a target among the items.
    place: Vec<u32>,
    /// Half the squared core radius of each target \[m2\]; empty: all are points.
    softening: Vec<f64>,
}

impl Groups {
    /// Replaces the targets.
    pub fn load(&mut self, targets: &Points) {
        self.items.clear();
        let item = |(i, place)| Item {
            place,
            index: i as u32,
        };
        self.items.extend(targets.iter().enumerate().map(item));
        gather(&mut self.items);
        self.softening.clear();
        self.softening.extend(targets.core.iter().map(|c| 0.5 * c));
        self.place.clear();
        self.place.resize(targets.len(), 0);
        for (k, item) in self.items.iter().enumerate() {
            self.place[item.index as usize] = k as u32;
        }
    }

    /// Velocities of all sources at all targets, with a part of about `allowed` \[m/s\] left out for
    /// every far cell.
    pub fn evaluate(&mut self, cells: &Cells, allowed: f64) -> Work {
        self.sums.reset(self.items.len());
        let softening = &self.softening;
        let Points { x, y, z, .. } = &mut self.sums;
        x.par_chunks_mut(GROUP)
            .zip(y.par_chunks_mut(GROUP))
            .zip(z.par_chunks_mut(GROUP))
            .zip(self.items.par_chunks(GROUP))
            .map(|(((x, y), z), items)| {
                let (sum, work) = Walk::of(cells, items, items, (allowed, softening)).done();
                let n = items.len();
                x.copy_from_slice(&sum.x[..n]);
                y.copy_from_slice(&sum.y[..n]);
                z.copy_from_slice(&sum.z[..n]);
                work
            })
            .reduce(Work::default, |a, b| a + b)
    }

    /// What [`Self::evaluate`] would give at the targets with these numbers, and at no other.
    pub fn sample(
        &self,
        cells: &Cells,
        allowed: f64,
        targets: &[usize],
        out: &mut [DVec3],
    ) -> Work {
        (targets.par_iter().zip(out))
            .map(|(&i, v)| {
                let place = self.place[i] as usize;
                let first = place / GROUP * GROUP;
                let group = &self.items[first..self.items.len().min(first + GROUP)];
                let walk = Walk::of(
                    cells,
                    group,
                    &self.items[place..=place],
                    (allowed, &self.softening),
                );
                let (sum, work) = walk.done();
                *v = DVec3::new(sum.x[0], sum.y[0], sum.z[0]);
                work
            })
            .reduce(Work::default, |a, b| a + b)
    }

    /// Whether all velocities are numbers.
    pub fn is_finite(&self) -> bool {
        self.sums.iter().all(|v| v.is_finite())
    }

    /// Adds the velocities to `out`.
    pub fn add_to(&self, out: &mut Points) {
        for (item, v) in self.items.iter().zip(self.sums.iter()) {
            let i = item.index as usize;
            out.add(i, v);
        }
    }
}

/// Sorts the items so that every [`GROUP`] of them are neighbours.
fn gather(items: &mut [Item]) {
    let groups = items.len().div_ceil(GROUP);
    if groups < 2 {
        return;
    }
    let first = groups / 2 * GROUP;
    split(items, first);
    let (one, two) = items.split_at_mut(first);
    if groups > TASK_GROUPS {
        rayon::join(|| gather(one), || gather(two));
    } else {
        gather(one);
        gather(two);
    }
}

/// A group on its way through the cells.
struct Walk<'a> {
    cells: &'a Cells,
    allowed: f64,
    low: DVec3,
    high: DVec3,
    targets: Block,
    count: usize,
    sum: Block,
    far: Notes<usize>,
    near: Notes<usize>,
    work: Work,
}

/// A short list without a heap.
struct Notes<T> {
    list: [T; NOTES],
    len: usize,
}

impl<T> Notes<T> {
    fn push(&mut self, item: T) -> bool {
        self.list[self.len] = item;
        self.len += 1;
        self.len == NOTES
    }
}

impl<'a> Walk<'a> {
    /// For some or all `items` of a group.
    fn of(
        cells: &'a Cells,
        group: &[Item],
        items: &[Item],
        (allowed, softening): (f64, &[f64]),
    ) -> Self {
        let mut targets = Block::ZERO;
        for (i, item) in items.iter().enumerate() {
            targets.set(i, item.place);
            targets.softening[i] = softening.get(item.index as usize).copied().unwrap_or(0.0);
        }
        let places = || group.iter().map(|item| item.place);
        Self {
            cells,
            allowed,
            low: places().fold(DVec3::INFINITY, DVec3::min),
            high: places().fold(DVec3::NEG_INFINITY, DVec3::max),
            targets,
            count: items.len(),
            sum: Block::ZERO,
            far: Notes {
                list: [0; NOTES],
                len: 0,
            },
            near: Notes {
                list: [0; NOTES],
                len: 0,
            },
            work: Work::default(),
        }
    }

    /// Walks the whole tree and gives the sum.
    fn done(mut self) -> (Block, Work) {
        self.visit(0);
        self.sum_far();
        self.sum_near();
        (self.sum, self.work)
    }

    /// Cell by cell: far enough, a leaf, or its children.
    fn visit(&mut self, c: usize) {
        if self.is_far(c) {
            if self.far.push(c) {
                self.sum_far();
            }
        } else if let Some([one, two]) = self.cells.children(c) {
            self.visit(one);
            self.visit(two);
        } else {
            let leaf = self.cells.cells[c].leaves.start as usize;
            if self.near.push(leaf) {
                self.sum_near();
            }
        }
    }

    /// Whether the expansion of cell `c` leaves out little enough at all targets of the group.
    fn is_far(&self, c: usize) -> bool {
        let cell = &self.cells.cells[c];
        let d2 = cell
            .centre
            .distance_squared(cell.centre.clamp(self.low, self.high));
        let power = |half: usize| (0..half).fold(1.0, |p, _| p * d2);
        let half_order = self.cells.harmonics.order / 2;
        d2 > (FAREST * cell.radius).powi(2)
            && cell.reach <= self.allowed * power(half_order + 1)
            && cell.smear <= self.allowed * power(half_fade(self.cells.model))
    }

    fn sum_near(&mut self) {
        let leaves = &self.near.list[..self.near.len];
        let cells = self.cells;
        let patches_of = |&leaf: &usize| cells.leaf_patches[leaf].clone();
        let (level, model) = (cells.level, cells.model);
        let targets = Targets {
            block: &self.targets,
            count: self.count,
        };
        match &cells.single {
            Some(single) => {
                let clusters = leaves.iter().copied();
                add_clusters(level, model, single, clusters, targets, &mut self.sum);
            }
            None => {
                let ranges = leaves.iter().map(patches_of);
                add_patches(level, model, &cells.packed, ranges, targets, &mut self.sum);
            }
        }
        let patches = leaves.iter().flat_map(patches_of);
        let edges: usize = patches.map(|p| cells.packed.patches[p].edges.len()).sum();
        self.work.near += (edges * self.count) as u64;
        self.near.len = 0;
    }

    fn sum_far(&mut self) {
        let level = self.cells.level;
        match self.cells.harmonics.order {
            4 => dispatch!(level, simd => self.sum_expansions::<_, 4>(simd)),
            6 => dispatch!(level, simd => self.sum_expansions::<_, 6>(simd)),
            8 => dispatch!(level, simd => self.sum_expansions::<_, 8>(simd)),
            10 => dispatch!(level, simd => self.sum_expansions::<_, 10>(simd)),
            12 => dispatch!(level, simd => self.sum_expansions::<_, 12>(simd)),
            order => unreachable!("order {order} is not offered"),
        }
        self.work.far += (self.far.len * self.count) as u64;
        self.far.len = 0;
    }

    #[inline(always)]
    fn sum_expansions<S: Simd, const P: usize>(&mut self, simd: S) {
        for &c in &self.far.list[..self.far.len] {
            let centre = self.cells.cells[c].centre;
            let coefficients = self.cells.coefficients(c);
            for lane in (0..self.count).step_by(S::f64s::LEN) {
                let [x, y, z] = load(simd, &self.targets, lane);
                let r = [x - centre.x, y - centre.y, z - centre.z];
                let v = self.cells.harmonics.velocity::<S, P>(simd, r, coefficients);
                let sum = load(simd, &self.sum, lane);
                store::<S>(
                    [sum[0] + v[0], sum[1] + v[1], sum[2] + v[2]],
                    &mut self.sum,
                    lane,
                );
            }
        }
    }
}
