//! The vector loop: lanes are targets, sources come in fixed order, nothing is fused.
//!
//! Every operation is an IEEE sum, product, quotient or square root of one lane, in the order of
//! [`super::reference`], so that a target's bits depend neither on the vector width nor on its lane.

use super::model::CoreModel;
use super::packed::{Packed, PackedEdge, Patch, WINDOW};
use super::reference::{EXP_POLYNOMIAL, STRENGTH};
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
        CoreModel::CutOff { .. } => dispatch!(level, simd => job.run::<_, CutOff>(simd, sum)),
        CoreModel::Vatistas { .. } => dispatch!(level, simd => job.run::<_, Vatistas>(simd, sum)),
        CoreModel::Scully { .. } => dispatch!(level, simd => job.run::<_, Scully>(simd, sum)),
        CoreModel::LambOseen { .. } => dispatch!(level, simd => job.run::<_, LambOseen>(simd, sum)),
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
    fn run<S: Simd, C: Core>(&self, simd: S, sum: &mut Block) {
        let mut window = [[S::f64s::splat(simd, 0.0); 4]; WINDOW];
        for lane in (0..self.count).step_by(S::f64s::LEN) {
            let p = load(simd, self.targets, lane);
            let mut v = load(simd, sum, lane);
            for patch in self
                .ranges
                .iter()
                .flat_map(|r| &self.packed.patches[r.clone()])
            {
                self.look_at_nodes::<S>(p, patch, &mut window);
                self.add_edges::<S, C>(simd, patch, &window, &mut v);
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
                self.look_at_nodes::<S>(p, patch, &mut window);
                for e in patch.edges.clone() {
                    let edge = &self.packed.edges[e];
                    let [(c, k)] = induced::<S, C, 1>(simd, [edge], [STRENGTH], &window);
                    let v = c[0] * k * n[0] + c[1] * k * n[1] + c[2] * k * n[2];
                    v.store_slice(&mut out[e * BLOCK + lane..][..S::f64s::LEN]);
                }
            }
        }
    }

    /// r = p - node and abs(r) for the new nodes of the patch.
    #[inline(always)]
    fn look_at_nodes<S: Simd>(&self, p: [S::f64s; 3], patch: &Patch, window: &mut Window<S>) {
        for (k, node) in patch
            .nodes
            .clone()
            .zip(&self.packed.nodes[patch.nodes.clone()])
        {
            let (x, y, z) = (p[0] - node.x, p[1] - node.y, p[2] - node.z);
            window[k % WINDOW] = [x, y, z, (x * x + y * y + z * z).sqrt()];
        }
    }

    /// Sums the edges of the patch.
    #[inline(always)]
    fn add_edges<S: Simd, C: Core>(
        &self,
        simd: S,
        patch: &Patch,
        window: &Window<S>,
        v: &mut [S::f64s; 3],
    ) {
        let (groups, rest) = self.packed.edges[patch.edges.clone()].as_chunks::<SIDE_BY_SIDE>();
        for edges in groups {
            add_group::<S, C, SIDE_BY_SIDE>(simd, edges, window, v);
        }
        for edge in rest.as_chunks::<1>().0 {
            add_group::<S, C, 1>(simd, edge, window, v);
        }
    }
}

/// Edges whose operations are interleaved: those of one edge wait for each other, and a processor does
/// not look far enough ahead to fill the time with the next edges.
const SIDE_BY_SIDE: usize = 4;

/// Sums edges side by side; their order and bits are those of one after the other.
#[inline(always)]
fn add_group<S: Simd, C: Core, const N: usize>(
    simd: S,
    edges: &[PackedEdge; N],
    window: &Window<S>,
    v: &mut [S::f64s; 3],
) {
    for (c, k) in induced::<S, C, N>(
        simd,
        edges.each_ref(),
        edges.each_ref().map(|e| e.strength),
        window,
    ) {
        v[0] += c[0] * k;
        v[1] += c[1] * k;
        v[2] += c[2] * k;
    }
}

/// The velocities of edges as c k, with c = r1 x r2 and k the rest.
#[inline(always)]
fn induced<S: Simd, C: Core, const N: usize>(
    simd: S,
    edges: [&PackedEdge; N],
    strengths: [f64; N],
    window: &Window<S>,
) -> [([S::f64s; 3], S::f64s); N] {
    let zero = S::f64s::splat(simd, 0.0);
    let (mut c, mut num, mut den, mut x) = ([[zero; 3]; N], [zero; N], [zero; N], [zero; N]);
    // Loops, not closures: those would leave the vector instructions of the caller.
    for i in 0..N {
        let [x1, y1, z1, n1] = window[edges[i].from as usize % WINDOW];
        let [x2, y2, z2, n2] = window[edges[i].to as usize % WINDOW];
        c[i] = [y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2];
        let d = x1 * x2 + y1 * y2 + z1 * z2;
        [num[i], den[i], x[i]] = C::fraction(simd, n1 + n2, n1 * n2, d, c[i], edges[i].term);
    }
    C::regularise(simd, &mut num, &mut x);
    let mut out = [(c[0], zero); N];
    for i in 0..N {
        let k = num[i] * strengths[i] / den[i];
        out[i] = (c[i], den[i].simd_gt(zero).select(k, zero));
    }
    out
}

/// r and abs(r) of the nodes in sight, for the targets in the lanes.
type Window<S> = [[<S as Simd>::f64s; 4]; WINDOW];

/// The vectors in the lanes from `lane` on.
#[inline(always)]
pub(crate) fn load<S: Simd>(simd: S, block: &Block, lane: usize) -> [S::f64s; 3] {
    [&block.x, &block.y, &block.z].map(|c| S::f64s::from_slice(simd, &c[lane..lane + S::f64s::LEN]))
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
    /// Numerator and denominator of K without the circulation, and what the core's function, if it has one,
    /// is a function of.
    fn fraction<S: Simd>(
        simd: S,
        sum: S::f64s,
        nn: S::f64s,
        d: S::f64s,
        c: [S::f64s; 3],
        term: f64,
    ) -> [S::f64s; 3];

    /// Multiplies the numerators by the core's function of `x`, which is used up.
    #[inline(always)]
    fn regularise<S: Simd, const N: usize>(_: S, _: &mut [S::f64s; N], _: &mut [S::f64s; N]) {}
}

struct CutOff;
struct Scully;
struct Vatistas;
struct LambOseen;

impl Core for CutOff {
    #[inline(always)]
    fn fraction<S: Simd>(
        _: S,
        sum: S::f64s,
        nn: S::f64s,
        d: S::f64s,
        _: [S::f64s; 3],
        term: f64,
    ) -> [S::f64s; 3] {
        [sum, nn * (nn + d) + term, d]
    }
}

impl Core for Scully {
    #[inline(always)]
    fn fraction<S: Simd>(
        simd: S,
        sum: S::f64s,
        nn: S::f64s,
        d: S::f64s,
        c: [S::f64s; 3],
        term: f64,
    ) -> [S::f64s; 3] {
        let (c2, s, num) = bare(simd, sum, nn, d, c);
        [num, nn * s * (c2 + term), c2]
    }
}

impl Core for Vatistas {
    #[inline(always)]
    fn fraction<S: Simd>(
        simd: S,
        sum: S::f64s,
        nn: S::f64s,
        d: S::f64s,
        c: [S::f64s; 3],
        term: f64,
    ) -> [S::f64s; 3] {
        let (c2, s, num) = bare(simd, sum, nn, d, c);
        [num, nn * s * (c2 * c2 + term * term).sqrt(), c2]
    }
}

impl Core for LambOseen {
    #[inline(always)]
    fn fraction<S: Simd>(
        simd: S,
        sum: S::f64s,
        nn: S::f64s,
        d: S::f64s,
        c: [S::f64s; 3],
        term: f64,
    ) -> [S::f64s; 3] {
        let (c2, s, num) = bare(simd, sum, nn, d, c);
        [num, nn * s * c2, c2 * term]
    }

    #[inline(always)]
    fn regularise<S: Simd, const N: usize>(simd: S, num: &mut [S::f64s; N], x: &mut [S::f64s; N]) {
        one_minus_exp(simd, x);
        for i in 0..N {
            num[i] *= x[i];
        }
    }
}

/// c^2, s = n1 n2 + abs(d), and the numerator of the bare filament over n1 n2 s c^2.
#[inline(always)]
fn bare<S: Simd>(
    simd: S,
    sum: S::f64s,
    nn: S::f64s,
    d: S::f64s,
    c: [S::f64s; 3],
) -> (S::f64s, S::f64s, S::f64s) {
    let c2 = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    let s = nn + d.abs();
    let ahead = d.simd_gt(S::f64s::splat(simd, 0.0));
    (c2, s, sum * ahead.select(c2, s * s))
}

/// [`super::reference::one_minus_exp`] in place, side by side.
#[inline(always)]
fn one_minus_exp<S: Simd, const N: usize>(simd: S, x: &mut [S::f64s; N]) {
    let a = EXP_POLYNOMIAL;
    let (top, two) = (S::f64s::splat(simd, 40.0), S::f64s::splat(simd, 2.0));
    for u in x.iter_mut() {
        let y = u.simd_lt(top).select(*u, top) * (1.0 / 64.0);
        let y2 = y * y;
        let y4 = y2 * y2;
        let low = (y * a[1] + a[0]) + (y * a[3] + a[2]) * y2;
        let middle = (y * a[5] + a[4]) + (y * a[7] + a[6]) * y2;
        *u = ((low + middle * y4) + (y * a[9] + a[8]) * (y4 * y4)) * y;
    }
    for _ in 0..6 {
        for u in x.iter_mut() {
            *u *= two - *u;
        }
    }
}
