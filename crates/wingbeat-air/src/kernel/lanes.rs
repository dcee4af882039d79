//! The vector loop: lanes are targets, sources come in fixed order, nothing is fused.
//!
//! Every operation is an IEEE sum, product, quotient or square root of one lane, in the order of
//! [`super::reference`], so that a target's bits depend neither on the vector width nor on its lane.
//!
//! The loop is written once for both precisions ([`Precision`]).

use super::model::CoreModel;
use super::packed::{Packed, PackedEdge, Patch, WINDOW};
use super::reference::{EXP2_POLYNOMIAL, EXPONENT, FULL, NEAREST, ONE, STRENGTH};
use super::single::Single;
use fearless_simd::{Level, SimdFloatElement, dispatch, prelude::*};
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

/// The first `count` places of a block; lanes beyond may hold anything finite.
#[derive(Clone, Copy)]
pub(crate) struct Targets<'a> {
    pub block: &'a Block,
    pub count: usize,
}

/// Adds to `sum` the velocities [m/s] of the patches in `ranges` at the targets.
pub(crate) fn add_patches(
    level: Level,
    model: CoreModel,
    packed: &Packed,
    ranges: impl Iterator<Item = Range<usize>> + Clone,
    targets: Targets<'_>,
    sum: &mut Block,
) {
    let job = Job {
        sources: packed.sources(),
        targets,
    };
    match model {
        CoreModel::CutOff { .. } => {
            dispatch!(level, simd => job.run::<_, CutOff, 2>(simd, ranges, sum));
        }
        CoreModel::Vatistas { .. } => {
            dispatch!(level, simd => job.run::<_, Vatistas, 2>(simd, ranges, sum));
        }
        CoreModel::Scully { .. } => {
            dispatch!(level, simd => job.run::<_, Scully, 2>(simd, ranges, sum));
        }
        CoreModel::LambOseen { .. } => {
            dispatch!(level, simd => job.run::<_, LambOseen, 4>(simd, ranges, sum));
        }
    }
}

/// The same in single precision, of the clusters with these numbers.
pub(crate) fn add_clusters(
    level: Level,
    model: CoreModel,
    single: &Single,
    clusters: impl Iterator<Item = usize> + Clone,
    targets: Targets<'_>,
    sum: &mut Block,
) {
    let job = Job {
        sources: single.sources(),
        targets,
    };
    match model {
        CoreModel::CutOff { .. } => {
            dispatch!(level, simd => job.run_single::<_, CutOff, 2>(simd, single, clusters, sum));
        }
        CoreModel::Vatistas { .. } => {
            dispatch!(level, simd => job.run_single::<_, Vatistas, 2>(simd, single, clusters, sum));
        }
        CoreModel::Scully { .. } => {
            dispatch!(level, simd => job.run_single::<_, Scully, 2>(simd, single, clusters, sum));
        }
        CoreModel::LambOseen { .. } => {
            dispatch!(level, simd => job.run_single::<_, LambOseen, 4>(simd, single, clusters, sum));
        }
    }
}

/// Normal velocity [m/s] of every edge by itself, with unit circulation, at the targets:
/// `out[e * BLOCK + lane]`. Patches must be those of one network, in its order.
pub(crate) fn edge_normal_velocities(
    level: Level,
    model: CoreModel,
    packed: &Packed,
    targets: Targets<'_>,
    normals: &Block,
    out: &mut [f64],
) {
    let job = Job {
        sources: packed.sources(),
        targets,
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

/// Nodes, edges between them, and the order to take them in.
#[derive(Clone, Copy)]
pub(crate) struct Sources<'a, E> {
    pub nodes: &'a [[E; 3]],
    pub edges: &'a [PackedEdge<E>],
    pub patches: &'a [Patch],
}

/// What to sum, and where.
struct Job<'a, E> {
    sources: Sources<'a, E>,
    targets: Targets<'a>,
}

impl Job<'_, f64> {
    #[inline(always)]
    fn run<S: Simd, C: Core, const N: usize>(
        &self,
        simd: S,
        ranges: impl Iterator<Item = Range<usize>> + Clone,
        sum: &mut Block,
    ) {
        let mut window = [[S::f64s::splat(simd, 0.0); 4]; WINDOW];
        for lane in (0..self.targets.count).step_by(S::f64s::LEN) {
            let p = load(simd, self.targets.block, lane);
            let mut v = load(simd, sum, lane);
            for range in ranges.clone() {
                let patches = &self.sources.patches[range];
                self.sources
                    .add::<S, Double, C, N>(simd, patches, p, &mut window, &mut v);
            }
            store::<S>(v, sum, lane);
        }
    }

    #[inline(always)]
    fn each<S: Simd, C: Core>(&self, simd: S, normals: &Block, out: &mut [f64]) {
        let zero = S::f64s::splat(simd, 0.0);
        let (mut window, mut room) = ([[zero; 4]; WINDOW], zero);
        for lane in (0..self.targets.count).step_by(S::f64s::LEN) {
            let p = load(simd, self.targets.block, lane);
            let n = load(simd, normals, lane);
            for patch in self.sources.patches {
                let nodes = patch.nodes.clone();
                self.sources.look_at::<S, Double>(p, nodes, &mut window);
                for e in patch.edges.clone() {
                    let mut edge = self.sources.edges[e];
                    edge.strength = 2.0 * STRENGTH;
                    let [(c, k)] =
                        induced::<S, Double, C, 1, true>(simd, &[edge], &window, &mut room);
                    let v = c[0] * k * n[0] + c[1] * k * n[1] + c[2] * k * n[2];
                    v.store_slice(&mut out[e * BLOCK + lane..][..S::f64s::LEN]);
                }
            }
        }
    }
}

impl Job<'_, f32> {
    /// Places are taken from the centre of each cluster before they lose digits; the sum of a cluster
    /// gets them back before it joins the others.
    #[inline(always)]
    fn run_single<S: Simd, C: Core, const N: usize>(
        &self,
        simd: S,
        single: &Single,
        clusters: impl Iterator<Item = usize> + Clone,
        sum: &mut Block,
    ) {
        let zero = S::f32s::splat(simd, 0.0);
        let mut window = [[zero; 4]; WINDOW];
        for lane in (0..self.targets.count).step_by(S::f32s::LEN) {
            let next = lane + S::f64s::LEN;
            let low = load(simd, self.targets.block, lane);
            let high = load(simd, self.targets.block, next);
            let mut sum_low = load(simd, sum, lane);
            let mut sum_high = load(simd, sum, next);
            for cluster in clusters.clone() {
                let (mut p, mut v) = ([zero; 3], [zero; 3]);
                let centre = single.centres[cluster];
                for i in 0..3 {
                    p[i] = ((low[i] - centre[i]) * single.per_unit)
                        .narrow((high[i] - centre[i]) * single.per_unit);
                }
                let patches = &self.sources.patches[single.clusters[cluster].clone()];
                self.sources
                    .add::<S, Float, C, N>(simd, patches, p, &mut window, &mut v);
                for i in 0..3 {
                    let (low, high) = v[i].widen();
                    sum_low[i] += low;
                    sum_high[i] += high;
                }
            }
            store::<S>(sum_low, sum, lane);
            store::<S>(sum_high, sum, next);
        }
    }
}

impl<E: SimdFloatElement + From<f32>> Sources<'_, E> {
    /// Adds the edges of patches that follow each other. The nodes of the next patch are looked at
    /// between the edges of this one: while the processor takes their roots, it sums. `N` edges go side
    /// by side: as many as registers and the length of the core's function want, measured.
    #[inline(always)]
    fn add<S: Simd, P: Precision<S, Element = E>, C: Core, const N: usize>(
        &self,
        simd: S,
        patches: &[Patch],
        p: [P::Lanes; 3],
        window: &mut Window<P::Lanes>,
        v: &mut [P::Lanes; 3],
    ) {
        let nodes_of = |i: usize| match patches.get(i) {
            Some(patch) => patch.nodes.clone(),
            None => 0..0,
        };
        self.look_at::<S, P>(p, nodes_of(0), window);
        for (i, patch) in patches.iter().enumerate() {
            let (before, mut next) = (*v, nodes_of(i + 1));
            let zero = P::Lanes::splat(simd, 0.0_f32.into());
            let mut room = zero;
            let edges = &self.edges[patch.edges.clone()];
            let (groups, rest) = edges.as_chunks::<N>();
            for edges in groups {
                let later = (next.start + N / 2).min(next.end);
                self.look_at::<S, P>(p, next.start..later, window);
                next.start = later;
                add_group::<S, P, C, N, false>(simd, edges, window, v, &mut room);
            }
            for edge in rest.as_chunks::<1>().0 {
                add_group::<S, P, C, 1, false>(simd, edge, window, v, &mut room);
            }
            self.look_at::<S, P>(p, next, window);
            if room.simd_lt(zero).any_true() {
                *v = before;
                for edge in edges.as_chunks::<1>().0 {
                    add_group::<S, P, C, 1, true>(simd, edge, window, v, &mut room);
                }
            }
        }
    }

    /// r = p - node and abs(r) of these nodes.
    #[inline(always)]
    fn look_at<S: Simd, P: Precision<S, Element = E>>(
        &self,
        p: [P::Lanes; 3],
        nodes: Range<usize>,
        window: &mut Window<P::Lanes>,
    ) {
        for (k, node) in nodes.clone().zip(&self.nodes[nodes]) {
            let r = [p[0] - node[0], p[1] - node[1], p[2] - node[2]];
            window[k % WINDOW] = [r[0], r[1], r[2], square::<S, _>(r).sqrt()];
        }
    }
}

/// Sums edges side by side, for the operations of one wait for each other and a processor does not look far
/// enough ahead to fill the time with the next edges. Order and bits are those of one after the other. As
/// [`induced`] otherwise.
#[inline(always)]
fn add_group<S: Simd, P: Precision<S>, C: Core, const N: usize, const CLOSE: bool>(
    simd: S,
    edges: &[PackedEdge<P::Element>; N],
    window: &Window<P::Lanes>,
    v: &mut [P::Lanes; 3],
    room: &mut P::Lanes,
) {
    for (c, k) in induced::<S, P, C, N, CLOSE>(simd, edges, window, room) {
        v[0] += c[0] * k;
        v[1] += c[1] * k;
        v[2] += c[2] * k;
    }
}

/// The velocities of edges as c k, with c = r1 x r2: right where no target is close to a filament, if `CLOSE`
/// everywhere. In lanes where one is, `room` becomes negative.
///
/// Beside the filament b = t^2 - l^2 is a small difference of large numbers. There it is taken from
/// b a = 4 c^2, a = 4 n1 n2 - b: numerator and denominator are both multiplied by a.
#[inline(always)]
fn induced<S: Simd, P: Precision<S>, C: Core, const N: usize, const CLOSE: bool>(
    simd: S,
    edges: &[PackedEdge<P::Element>; N],
    window: &Window<P::Lanes>,
    room: &mut P::Lanes,
) -> [([P::Lanes; 3], P::Lanes); N] {
    let zero = P::Lanes::splat(simd, 0.0_f32.into());
    let one = P::Lanes::splat(simd, 1.0_f32.into());
    let four: P::Element = 4.0_f32.into();
    let (mut c, mut num, mut den, mut z) = ([[zero; 3]; N], [zero; N], [zero; N], [zero; N]);
    // Loops, not closures: those would leave the vector instructions of the caller.
    for i in 0..N {
        let edge = &edges[i];
        let [x1, y1, z1, n1] = window[edge.from as usize % WINDOW];
        let [x2, y2, z2, n2] = window[edge.to as usize % WINDOW];
        c[i] = [y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2];
        let (sum, nn) = (n1 + n2, n1 * n2);
        let b = sum * sum - edge.l2;
        let close = P::Lanes::splat(simd, edge.close);
        let (mut bare, mut scale) = (nn * b, one);
        if CLOSE && (P::IS_ROUGH || C::IS_EXACT) {
            let a = nn * four - b;
            let is_beside = close.simd_gt(b) & a.simd_gt(b);
            bare = is_beside.select(nn * (square::<S, _>(c[i]) * four), bare);
            scale = is_beside.select(a, scale);
        }
        if P::IS_ROUGH || C::IS_EXACT {
            *room = room.min(b - close);
        }
        let top = sum * edge.strength * scale;
        [num[i], den[i], z[i]] = C::fraction::<S, _>(top, bare, c[i], scale, edge.term);
    }
    C::regularise::<S, P, N>(simd, &mut num, &mut z);
    let mut out = [(c[0], zero); N];
    for i in 0..N {
        let k = num[i] / den[i];
        out[i] = (c[i], den[i].simd_gt(zero).select(k, zero));
    }
    out
}

/// r and abs(r) of the nodes in sight, for the targets in the lanes.
type Window<V> = [[V; 4]; WINDOW];

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

/// Squared length.
#[inline(always)]
fn square<S: Simd, V: SimdFloat<S>>([x, y, z]: [V; 3]) -> V {
    x * x + y * y + z * z
}

/// The numbers that the loop works with.
trait Precision<S: Simd> {
    type Element: SimdFloatElement + From<f32>;
    type Lanes: SimdFloat<S, Element = Self::Element>;

    /// Whether every core model looks after targets close to a filament.
    const IS_ROUGH: bool;

    /// [`super::reference::one_minus_exp2`] in place, side by side, to a few units in the last place of
    /// this precision.
    fn one_minus_exp2<const N: usize>(simd: S, z: &mut [Self::Lanes; N]);
}

/// 53 bits.
struct Double;

/// 24 bits.
struct Float;

impl<S: Simd> Precision<S> for Double {
    type Element = f64;
    type Lanes = S::f64s;
    const IS_ROUGH: bool = false;

    #[inline(always)]
    fn one_minus_exp2<const N: usize>(simd: S, z: &mut [S::f64s; N]) {
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
}

impl<S: Simd> Precision<S> for Float {
    type Element = f32;
    type Lanes = S::f32s;
    const IS_ROUGH: bool = true;

    #[inline(always)]
    fn one_minus_exp2<const N: usize>(simd: S, z: &mut [S::f32s; N]) {
        // As in double precision: 1.5 2^23, an interpolant at six points, good to 1.2e-8.
        const NEAREST: f32 = 12_582_912.0;
        const A: [f32; 6] = [
            std::f32::consts::LN_2,
            -0.240_226_5,
            0.055_503_57,
            -0.009_618_083,
            0.001_339_086_3,
            -0.000_154_531_63,
        ];
        let (full, one) = (S::f32s::splat(simd, 30.0), S::f32s::splat(simd, 1.0));
        let ones = S::u32s::splat(simd, 1.0_f32.to_bits());
        for u in z.iter_mut() {
            let z = u.min(full);
            let shifted = z + NEAREST;
            let f = z - (shifted - NEAREST);
            let f2 = f * f;
            let even = (f2 * A[4] + A[2]) * f2 + A[0];
            let odd = (f2 * A[5] + A[3]) * f2 + A[1];
            let scale: S::f32s = (ones - (shifted.bitcast::<S::u32s>() << 23)).bitcast();
            *u = (one - scale) + (odd * f + even) * f * scale;
        }
    }
}

/// A core model, as in [`super::reference`].
trait Core {
    /// Whether targets close to a filament are looked after in double precision: the cut-off has no h.
    const IS_EXACT: bool = true;

    /// Numerator and denominator of K from those of the bare filament, both multiplied by `scale`, and what
    /// the core's function, if it has one, is a function of.
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        scale: V,
        term: V::Element,
    ) -> [V; 3];

    /// Multiplies the numerators by the core's function of `z`, which is used up.
    #[inline(always)]
    fn regularise<S: Simd, P: Precision<S>, const N: usize>(
        _: S,
        _: &mut [P::Lanes; N],
        _: &mut [P::Lanes; N],
    ) {
    }
}

struct CutOff;
struct Scully;
struct Vatistas;
struct LambOseen;

impl Core for CutOff {
    const IS_EXACT: bool = false;

    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        _: [V; 3],
        scale: V,
        term: V::Element,
    ) -> [V; 3] {
        [num, bare + scale * term, num]
    }
}

impl Core for Scully {
    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        _: V,
        term: V::Element,
    ) -> [V; 3] {
        let c2 = square::<S, V>(c);
        [num * c2, bare * (c2 + term), c2]
    }
}

impl Core for Vatistas {
    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        _: V,
        term: V::Element,
    ) -> [V; 3] {
        let c2 = square::<S, V>(c);
        [num * c2, bare * (c2 * c2 + term).sqrt(), c2]
    }
}

impl Core for LambOseen {
    #[inline(always)]
    fn fraction<S: Simd, V: SimdFloat<S>>(
        num: V,
        bare: V,
        c: [V; 3],
        _: V,
        term: V::Element,
    ) -> [V; 3] {
        [num, bare, square::<S, V>(c) * term]
    }

    #[inline(always)]
    fn regularise<S: Simd, P: Precision<S>, const N: usize>(
        simd: S,
        num: &mut [P::Lanes; N],
        z: &mut [P::Lanes; N],
    ) {
        P::one_minus_exp2(simd, z);
        for i in 0..N {
            num[i] *= z[i];
        }
    }
}
