//! Targets in blocks of lanes.

use crate::sources::Points;
use fearless_simd::prelude::*;

/// Targets worked on together; a multiple of every vector width.
pub const BLOCK: usize = 64;

/// Components of up to [`BLOCK`] vectors.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub x: [f64; BLOCK],
    pub y: [f64; BLOCK],
    pub z: [f64; BLOCK],
}

impl Block {
    /// All zero.
    pub const ZERO: Self = Self {
        x: [0.0; BLOCK],
        y: [0.0; BLOCK],
        z: [0.0; BLOCK],
    };
}

/// The first `count` places of a block; lanes beyond may hold anything finite.
#[derive(Clone, Copy)]
pub(crate) struct Targets<'a> {
    pub block: &'a Block,
    pub count: usize,
}

/// `count` targets from `first` on.
pub(crate) fn block_at(targets: &Points, first: usize, count: usize) -> Block {
    let mut block = Block::ZERO;
    let own = first..first + count;
    block.x[..count].copy_from_slice(&targets.x[own.clone()]);
    block.y[..count].copy_from_slice(&targets.y[own.clone()]);
    block.z[..count].copy_from_slice(&targets.z[own]);
    block
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

/// Puts vectors into the lanes from `lane` on.
#[inline(always)]
pub(crate) fn store<S: Simd>([x, y, z]: [S::f64s; 3], block: &mut Block, lane: usize) {
    x.store_slice(&mut block.x[lane..lane + S::f64s::LEN]);
    y.store_slice(&mut block.y[lane..lane + S::f64s::LEN]);
    z.store_slice(&mut block.z[lane..lane + S::f64s::LEN]);
}
