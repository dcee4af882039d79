//! Targets in blocks of lanes.

use crate::sources::Points;
use fearless_simd::prelude::*;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Targets worked on together; a multiple of every vector width.
pub const BLOCK: usize = 64;

/// Components of up to [`BLOCK`] vectors.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub x: [f64; BLOCK],
    pub y: [f64; BLOCK],
    pub z: [f64; BLOCK],
    /// Half the squared core radius \[m2\] of targets that have one.
    pub softening: [f64; BLOCK],
}

impl Block {
    /// All zero.
    pub const ZERO: Self = Self {
        x: [0.0; BLOCK],
        y: [0.0; BLOCK],
        z: [0.0; BLOCK],
        softening: [0.0; BLOCK],
    };

    /// Vector number `lane`.
    pub fn get(&self, lane: usize) -> DVec3 {
        DVec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    /// Overwrites vector number `lane`.
    pub fn set(&mut self, lane: usize, v: DVec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = v.into();
    }
}

/// The first `count` places of a block; lanes beyond may hold anything finite.
#[derive(Clone, Copy)]
pub(crate) struct Targets<'a> {
    pub block: &'a Block,
    pub count: usize,
}

/// Points in a range of at most [`BLOCK`].
pub(crate) fn block_at(points: &Points, range: Range<usize>) -> Block {
    let (mut block, count) = (Block::ZERO, range.len());
    block.x[..count].copy_from_slice(&points.x[range.clone()]);
    block.y[..count].copy_from_slice(&points.y[range.clone()]);
    block.z[..count].copy_from_slice(&points.z[range.clone()]);
    if let Some(core) = points.core.get(range) {
        for (soft, core) in block.softening.iter_mut().zip(core) {
            *soft = 0.5 * core;
        }
    }
    block
}

/// The components of up to [`BLOCK`] points.
pub(crate) type Chunk<'a> = [&'a mut [f64]; 3];

/// Pieces of [`BLOCK`] points with their numbers, over threads.
pub(crate) fn par_blocks(
    points: &mut Points,
) -> impl IndexedParallelIterator<Item = (usize, Chunk<'_>)> {
    let Points { x, y, z, .. } = points;
    x.par_chunks_mut(BLOCK)
        .zip(y.par_chunks_mut(BLOCK))
        .zip(z.par_chunks_mut(BLOCK))
        .map(|((x, y), z)| [x, y, z])
        .enumerate()
}

/// Adds the first vectors of a block to points.
pub(crate) fn add_block(sum: &Block, out: Chunk<'_>) {
    for (out, sum) in out.into_iter().zip([&sum.x, &sum.y, &sum.z]) {
        out.iter_mut().zip(sum).for_each(|(o, s)| *o += s);
    }
}

/// The vectors in the lanes from `lane` on.
#[inline(always)]
pub(crate) fn load<S: Simd>(simd: S, block: &Block, lane: usize) -> [S::f64s; 3] {
    let lanes = lane..lane + S::f64s::LEN;
    [
        S::f64s::from_slice(simd, &block.x[lanes.clone()]),
        S::f64s::from_slice(simd, &block.y[lanes.clone()]),
        S::f64s::from_slice(simd, &block.z[lanes]),
    ]
}

/// What softens the targets in the lanes from `lane` on.
#[inline(always)]
pub(crate) fn load_softening<S: Simd>(simd: S, block: &Block, lane: usize) -> S::f64s {
    S::f64s::from_slice(simd, &block.softening[lane..lane + S::f64s::LEN])
}

/// Puts vectors into the lanes from `lane` on.
#[inline(always)]
pub(crate) fn store<S: Simd>([x, y, z]: [S::f64s; 3], block: &mut Block, lane: usize) {
    x.store_slice(&mut block.x[lane..lane + S::f64s::LEN]);
    y.store_slice(&mut block.y[lane..lane + S::f64s::LEN]);
    z.store_slice(&mut block.z[lane..lane + S::f64s::LEN]);
}
