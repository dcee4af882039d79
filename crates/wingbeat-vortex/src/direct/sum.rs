//! The direct sum: every segment at every target, in blocks over threads.

use crate::cores::CoreModel;
use crate::direct::block::{BLOCK, Block, Targets, add_block, block_at, par_blocks};
use crate::direct::lanes::{add_patches, edge_normal_velocities};
use crate::direct::packed::Packed;
use crate::instruction_set::InstructionSet;
use crate::sources::{Network, Points};
use fearless_simd::Level;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Pairs of a task below which threads cost more than they give (some 30 microseconds of work).
const TASK_PAIRS: usize = 10_000;

/// Adds to `out` what `add` adds at all targets, block by block over threads; it sums so many `sources`.
pub(crate) fn sum_all(
    sources: usize,
    targets: &Points,
    out: &mut Points,
    add: impl Fn(Targets<'_>, &mut Block) + Sync,
) {
    assert_eq!(targets.len(), out.len(), "as many velocities as targets");
    let blocks = TASK_PAIRS.div_ceil((BLOCK * sources).max(1));
    par_blocks(out).with_min_len(blocks).for_each(|(b, out)| {
        let (first, count) = (b * BLOCK, out[0].len());
        let (block, mut sum) = (block_at(targets, first..first + count), Block::ZERO);
        let block = &block;
        add(Targets { block, count }, &mut sum);
        add_block(&sum, out);
    });
}

/// [`sum_all`] of two quantities at once.
pub(crate) fn sum_both(
    sources: usize,
    targets: &Points,
    [one, two]: [&mut Points; 2],
    add: impl Fn(Targets<'_>, [&mut Block; 2]) + Sync,
) {
    let is_long = [&*one, &*two].iter().all(|out| out.len() == targets.len());
    assert!(is_long, "as many sums as targets");
    let blocks = TASK_PAIRS.div_ceil((BLOCK * sources).max(1));
    let both = par_blocks(one).zip(par_blocks(two)).with_min_len(blocks);
    both.for_each(|((b, one), (_, two))| {
        let (first, count) = (b * BLOCK, one[0].len());
        let block = &block_at(targets, first..first + count);
        let (mut sum_one, mut sum_two) = (Block::ZERO, Block::ZERO);
        add(Targets { block, count }, [&mut sum_one, &mut sum_two]);
        add_block(&sum_one, one);
        add_block(&sum_two, two);
    });
}

/// Adds the velocities of all of `packed` at all targets.
pub(crate) fn sum_packed(
    level: Level,
    model: CoreModel,
    packed: &Packed,
    targets: &Points,
    out: &mut Points,
) {
    let all = || std::iter::once(0..packed.patches.len());
    sum_all(packed.edges.len(), targets, out, |targets, sum| {
        add_patches(level, model, packed, all(), targets, sum);
    });
}

/// The edges of a network one by one, each with unit circulation, in groups.
#[derive(Clone, Debug)]
pub struct UnitEdges {
    level: Level,
    /// Regularisation of the edges that were loaded.
    model: Option<CoreModel>,
    packed: Packed,
    /// Patches of each group.
    groups: Vec<Range<usize>>,
}

impl Default for UnitEdges {
    fn default() -> Self {
        Self {
            level: InstructionSet::best(),
            model: None,
            packed: Packed::default(),
            groups: Vec::new(),
        }
    }
}

impl UnitEdges {
    /// Replaces the edges by these of the network, group by group.
    pub fn load(
        &mut self,
        model: CoreModel,
        network: &Network,
        groups: impl IntoIterator<Item = impl IntoIterator<Item = usize>>,
    ) {
        self.model = Some(model);
        self.packed.clear(network.nodes.len());
        self.groups.clear();
        for edges in groups {
            let edges = edges.into_iter().map(|e| e as u32);
            let patches = self.packed.load_group(model, network, edges);
            self.groups.push(patches);
        }
    }

    /// Number of edges.
    pub fn len(&self) -> usize {
        self.packed.edges.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Velocity of every edge of a group at up to [`BLOCK`] `points` along the normals given with them [m/s]:
    /// `out[edge * BLOCK + point]`.
    pub fn normal_velocities(
        &self,
        group: usize,
        points: impl Iterator<Item = [DVec3; 2]>,
        out: &mut [f64],
    ) {
        let model = self.model.expect("edges are loaded");
        let (mut block, mut normals, mut count) = (Block::ZERO, Block::ZERO, 0);
        for (k, [x, n]) in points.enumerate() {
            block.set(k, x);
            normals.set(k, n);
            count = k + 1;
        }
        edge_normal_velocities(
            self.level,
            model,
            &self.packed,
            self.groups[group].clone(),
            Targets {
                block: &block,
                count,
            },
            &normals,
            out,
        );
    }
}

/// Adds to `out` \[m/s\] the velocity of all edges at the `targets` \[m\], in double precision: a direct
/// [`crate::FastSum`] in one call, for where its memory need not be kept.
///
/// ```
/// use wingbeat_vortex::{CoreModel, Network, Points};
/// use wingbeat_vortex::DVec3;
/// let model = CoreModel::Scully { radius: 0.0 };
/// let mut net = Network::default();
/// net.push_segment(-DVec3::X, DVec3::X, 1.0, model.core(2.0, 0.0));
/// let mut v = Points::zeros(1);
/// wingbeat_vortex::add_velocity(model, &net, &Points::from_iter([DVec3::Z]), &mut v);
/// assert!((v.y[0] + 2f64.sqrt() / (4.0 * std::f64::consts::PI)).abs() < 1e-16);
/// ```
pub fn add_velocity(model: CoreModel, network: &Network, targets: &Points, out: &mut Points) {
    let mut packed = Packed::default();
    packed.load_moving(model, network);
    sum_packed(InstructionSet::best(), model, &packed, targets, out);
}
