//! The vector loop: lanes are targets, sources come in fixed order, nothing is fused.
//!
//! Every operation is an IEEE sum, product, quotient or square root of one lane, in the order of
//! [`super::reference`], so that a target's bits depend neither on the vector width nor on its lane.

use super::model::CoreModel;
use super::packed::{Packed, PackedEdge, Patch, WINDOW};
use super::reference::{EXP2_POLYNOMIAL, EXPONENT, FULL, NEAREST, ONE, STRENGTH};
use fearless_simd::{Level, dispatch, prelude::*};
use std::ops::Range;

/// Targets worked on together; a multiple of every vector width.
pub(crate) const BLOCK: usize = 64;

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

/// Adds to `sum` the velocities [m/s] of the patches in `ranges` at the first `count` of `targets`
/// (lanes beyond may hold anything finite).
pub(crate) fn add_patches(
    level: Level,
    model: CoreModel,
    packed: &Packed,
    ranges: &[Range<usize>],
    targets: &Block,
    count: usize,
    sum: &mut Block,
) {
    let job = Job {
        packed,
        ranges,
        targets,
        count,
    };
    match model {
        CoreModel::CutOff { .. } => dispatch!(level, simd => job.run::<_, CutOff, 2>(simd, sum)),
        CoreModel::Vatistas { .. } => {
            dispatch!(level, simd => job.run::<_, Vatistas, 2>(simd, sum))
        }
        CoreModel::Scully { .. } => dispatch!(level, simd => job.run::<_, Scully, 2>(simd, sum)),
        CoreModel::LambOseen { .. } => {
            dispatch!(level, simd => job.run::<_, LambOseen, 4>(simd, sum))
        }
    }
}

/// Normal velocity [m/s] of every edge by itself, with unit circulation, at the first `count` of
/// `targets`: `out[e * BLOCK + lane]`. Patches must be those of one network, in its order.
pub(crate) fn edge_normal_velocities(
    level: Level,
    model: CoreModel,
    packed: &Packed,
    targets: &Block,
    normals: &Block,
    count: usize,
    out: &mut [f64],
) {
    let all = 0..packed.patches.len();
    let job = Job {
        packed,
        ranges: std::slice::from_ref(&all),
        targets,
        count,
    };
    match model {
        CoreModel::CutOff { .. } => {
            dispatch!(level, simd => job.each::<_, CutOff>(simd, normals, out));
        }
        CoreModel::Vatistas { .. } => {
            dispatch!(level, simd => job.each::<_, Vatistas>(simd, normals, out));
        }
        CoreModel::Scully { .. } => {
            dispatch!(level, simd => job.each::<_, Scully>(simd, normals, out));
        }
        CoreModel::LambOseen { .. } => {
            dispatch!(level, simd => job.each::<_, LambOseen>(simd, normals, out));
        }
    }
}

/// What to sum, and where.
struct Job<'a> {
    packed: &'a Packed,
    ranges: &'a [Range<usize>],
    targets: &'a Block,
    count: usize,
}

impl Job<'_> {
    #[inline(always)]
    fn run<S: Simd, C: Core, const N: usize>(&self, simd: S, sum: &mut Block) {
        let mut window = [[S::f64s::splat(simd, 0.0); 4]; WINDOW];
        for lane in (0..self.count).step_by(S::f64s::LEN) {
            let p = load(simd, self.targets, lane);
            let mut v = load(simd, sum, lane);
            for range in self.ranges {
                self.sum_patches::<S, C, N>(
                    simd,
                    &self.packed.patches[range.clone()],
                    p,
                    &mut window,
                    &mut v,
                );
            }
            store::<S>(v, sum, lane);
        }
    }

    #[inline(always)]
    fn each<S: Simd, C: Core>(&self, simd: S, normals: &Block, out: &mut [f64]) {
        let mut window = [[S::f64s::splat(simd, 0.0); 4]; WINDOW];
        for lane in (0..self.count).step_by(S::f64s::LEN) {
            let (p, n) = (load(simd, self.targets, lane), load(simd, normals, lane));
            for patch in &self.packed.patches {
                self.look_at::<S>(p, patch.nodes.clone(), &mut window);
                for e in patch.edges.clone() {
                    let mut edge = self.packed.edges[e];
                    edge.strength = 2.0 * STRENGTH;
                    let [(c, k)] = induced::<S, C, 1>(simd, &[edge], &window);
                    let v = c[0] * k * n[0] + c[1] * k * n[1] + c[2] * k * n[2];
                    v.store_slice(&mut out[e * BLOCK + lane..][..S::f64s::LEN]);
                }
            }
        }
    }

    /// Sums the edges of patches that follow each other. The nodes of the next patch are looked at between the
    /// edges of this one: while the processor takes their roots, it sums. `N` edges go side by side: as many as
    /// registers and the length of the core's function want, measured.
    #[inline(always)]
    fn sum_patches<S: Simd, C: Core, const N: usize>(
        &self,
        simd: S,
        patches: &[Patch],
        p: [S::f64s; 3],
        window: &mut Window<S>,
        v: &mut [S::f64s; 3],
    ) {
        let nodes_of = |i: usize| {
            patches
                .get(i)
                .map_or(0..0, |patch: &Patch| patch.nodes.clone())
        };
        self.look_at::<S>(p, nodes_of(0), window);
        for (i, patch) in patches.iter().enumerate() {
            let mut next = nodes_of(i + 1);
            let (groups, rest) = self.packed.edges[patch.edges.clone()].as_chunks::<N>();
            for edges in groups {
                let later = (next.start + N / 2).min(next.end);
                self.look_at::<S>(p, next.start..later, window);
                next.start = later;
                add_group::<S, C, N>(simd, edges, window, v);
            }
            for edge in rest.as_chunks::<1>().0 {
                add_group::<S, C, 1>(simd, edge, window, v);
            }
            self.look_at::<S>(p, next, window);
        }
    }

    /// r = p - node and abs(r) of these nodes.
    #[inline(always)]
    fn look_at<S: Simd>(&self, p: [S::f64s; 3], nodes: Range<usize>, window: &mut Window<S>) {
        for (k, node) in nodes.clone().zip(&self.packed.nodes[nodes]) {
            let (x, y, z) = (p[0] - node.x, p[1] - node.y, p[2] - node.z);
            window[k % WINDOW] = [x, y, z, (x * x + y * y + z * z).sqrt()];
        }
    }
}

/// Sums edges side by side, for the operations of one wait for each other and a processor does not look far
/// enough ahead to fill the time with the next edges. Order and bits are those of one after the other.
#[inline(always)]
fn add_group<S: Simd, C: Core, const N: usize>(
    simd: S,
    edges: &[PackedEdge; N],
    window: &Window<S>,
    v: &mut [S::f64s; 3],
) {
    for (c, k) in induced::<S, C, N>(simd, edges, window) {
        v[0] += c[0] * k;
        v[1] += c[1] * k;
        v[2] += c[2] * k;
    }
}

/// The velocities of edges as c k, with c = r1 x r2 and k the rest.
#[inline(always)]
fn induced<S: Simd, C: Core, const N: usize>(
    simd: S,
    edges: &[PackedEdge; N],
    window: &Window<S>,
) -> [([S::f64s; 3], S::f64s); N] {
    let zero = S::f64s::splat(simd, 0.0);
    let (mut c, mut num, mut den, mut z) = ([[zero; 3]; N], [zero; N], [zero; N], [zero; N]);
    // Loops, not closures: those would leave the vector instructions of the caller.
    for i in 0..N {
        let [x1, y1, z1, n1] = window[edges[i].from as usize % WINDOW];
        let [x2, y2, z2, n2] = window[edges[i].to as usize % WINDOW];
        c[i] = [y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2];
        let sum = n1 + n2;
        let bare = n1 * n2 * (sum * sum - edges[i].l2);
        [num[i], den[i], z[i]] =
            C::fraction::<S>(sum * edges[i].strength, bare, c[i], edges[i].term);
    }
    C::regularise(simd, &mut num, &mut z);
    let mut out = [(c[0], zero); N];
    for i in 0..N {
        let k = num[i] / den[i];
        out[i] = (c[i], den[i].simd_gt(zero).select(k, zero));
    }
    out
}

/// r and abs(r) of the nodes in sight, for the targets in the lanes.
type Window<S> = [[<S as Simd>::f64s; 4]; WINDOW];

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

/// A core model, as in [`super::reference`].
trait Core {
    /// Numerator and denominator of K from those of the bare filament, and what the core's function, if it has
    /// one, is a function of.
    fn fraction<S: Simd>(num: S::f64s, bare: S::f64s, c: [S::f64s; 3], term: f64) -> [S::f64s; 3];

    /// Multiplies the numerators by the core's function of `z`, which is used up.
    #[inline(always)]
    fn regularise<S: Simd, const N: usize>(_: S, _: &mut [S::f64s; N], _: &mut [S::f64s; N]) {}
}

struct CutOff;
struct Scully;
struct Vatistas;
struct LambOseen;

impl Core for CutOff {
    #[inline(always)]
    fn fraction<S: Simd>(num: S::f64s, bare: S::f64s, _: [S::f64s; 3], term: f64) -> [S::f64s; 3] {
        [num, bare + term, num]
    }
}

impl Core for Scully {
    #[inline(always)]
    fn fraction<S: Simd>(num: S::f64s, bare: S::f64s, c: [S::f64s; 3], term: f64) -> [S::f64s; 3] {
        let c2 = square::<S>(c);
        [num * c2, bare * (c2 + term), c2]
    }
}

impl Core for Vatistas {
    #[inline(always)]
    fn fraction<S: Simd>(num: S::f64s, bare: S::f64s, c: [S::f64s; 3], term: f64) -> [S::f64s; 3] {
        let c2 = square::<S>(c);
        [num * c2, bare * (c2 * c2 + term * term).sqrt(), c2]
    }
}

impl Core for LambOseen {
    #[inline(always)]
    fn fraction<S: Simd>(num: S::f64s, bare: S::f64s, c: [S::f64s; 3], term: f64) -> [S::f64s; 3] {
        [num, bare, square::<S>(c) * term]
    }

    #[inline(always)]
    fn regularise<S: Simd, const N: usize>(simd: S, num: &mut [S::f64s; N], z: &mut [S::f64s; N]) {
        one_minus_exp2(simd, z);
        for i in 0..N {
            num[i] *= z[i];
        }
    }
}

/// Squared length.
#[inline(always)]
fn square<S: Simd>([x, y, z]: [S::f64s; 3]) -> S::f64s {
    x * x + y * y + z * z
}

/// [`super::reference::one_minus_exp2`] in place, side by side.
#[inline(always)]
fn one_minus_exp2<S: Simd, const N: usize>(simd: S, z: &mut [S::f64s; N]) {
    let a = EXP2_POLYNOMIAL;
    let (full, one) = (S::f64s::splat(simd, FULL), S::f64s::splat(simd, 1.0));
    let ones = S::u64s::splat(simd, ONE);
    for u in z.iter_mut() {
        let z = u.min(full);
        let shifted = z + NEAREST;
        let f = z - (shifted - NEAREST);
        let f2 = f * f;
        let even = (((f2 * a[8] + a[6]) * f2 + a[4]) * f2 + a[2]) * f2 + a[0];
        let odd = (((f2 * a[9] + a[7]) * f2 + a[5]) * f2 + a[3]) * f2 + a[1];
        let scale: S::f64s = (ones - (shifted.bitcast::<S::u64s>() << EXPONENT)).bitcast();
        *u = (one - scale) + (odd * f + even) * f * scale;
    }
}
