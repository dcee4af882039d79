//! The vector loop: lanes are targets, sources come in fixed order, nothing is fused.
//!
//! Every operation is an IEEE sum, product, quotient or square root of one lane, in the order of
//! [`crate::direct::reference`], so that a target's bits depend neither on the vector width nor on its lane.
//!
//! The loop is written once for both precisions ([`Precision`]).

use crate::cores::CoreModel;
use crate::cores::INV_4PI;
use crate::cores::vector::{
    Algebraic, Core, CutOff, Double, Float, LambOseen, Precision, Scully, Vatistas, square,
};
use crate::direct::block::{BLOCK, Block, Targets, load, load_softening, store};
use crate::direct::moments;
use crate::direct::packed::{Packed, PackedEdge, Patch, Sources, WINDOW};
use crate::direct::single::Single;
use fearless_simd::{Level, SimdFloatElement, dispatch, prelude::*};
use std::ops::Range;

/// Runs `$run` with the instructions of `$level`, `$C` the core model and `$N` the edges to take side by side: as
/// many as registers and the length of the core's function want, measured.
macro_rules! for_core {
    ($level:expr, $model:expr, $simd:ident, $C:ident, $N:ident => $run:expr) => {
        match $model {
            CoreModel::CutOff { .. } => for_core!(@ $level, $simd, $C = CutOff, $N = 2, $run),
            CoreModel::Vatistas { .. } => for_core!(@ $level, $simd, $C = Vatistas, $N = 2, $run),
            CoreModel::Scully { .. } => for_core!(@ $level, $simd, $C = Scully, $N = 2, $run),
            CoreModel::LambOseen { .. } => for_core!(@ $level, $simd, $C = LambOseen, $N = 4, $run),
            CoreModel::Algebraic { .. } => for_core!(@ $level, $simd, $C = Algebraic, $N = 2, $run),
        }
    };
    (@ $level:expr, $simd:ident, $C:ident = $core:ty, $N:ident = $edges:literal, $run:expr) => {{
        type $C = $core;
        #[allow(dead_code, reason = "not all take edges side by side")]
        const $N: usize = $edges;
        dispatch!($level, $simd => $run)
    }};
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
    for_core!(level, model, simd, C, N => job.run::<_, C, N, 1>(simd, ranges, [sum]));
}

/// The same of algebraic cores, and to `vorticity` the sum [1/s] of Gamma / (4 pi) times the integral of dl over the
/// cube of the softened distance.
pub(crate) fn add_patches_with_vorticity(
    level: Level,
    packed: &Packed,
    ranges: impl Iterator<Item = Range<usize>> + Clone,
    targets: Targets<'_>,
    sums: [&mut Block; 2],
) {
    let job = Job {
        sources: packed.sources(),
        targets,
    };
    dispatch!(level, simd => job.run::<_, Algebraic, 2, 2>(simd, ranges, sums));
}

/// The same in single precision, of the clusters with these numbers; of algebraic cores by moments.
pub(crate) fn add_clusters(
    level: Level,
    model: CoreModel,
    single: &Single,
    clusters: impl Iterator<Item = usize> + Clone,
    targets: Targets<'_>,
    sum: &mut Block,
) {
    if matches!(model, CoreModel::Algebraic { .. }) {
        return moments::add_clusters(level, single, clusters, targets, [sum]);
    }
    let job = Job {
        sources: single.sources(),
        targets,
    };
    for_core!(level, model, simd, C, N => job.run_single::<_, C, N>(simd, single, clusters, sum));
}

/// Normal velocity [m/s] of every edge of these patches by itself, with unit circulation, at the targets:
/// `out[e * BLOCK + lane]`.
pub(crate) fn edge_normal_velocities(
    level: Level,
    model: CoreModel,
    packed: &Packed,
    patches: Range<usize>,
    targets: Targets<'_>,
    normals: &Block,
    out: &mut [f64],
) {
    let job = Job {
        sources: packed.sources(),
        targets,
    };
    for_core!(level, model, simd, C, N => job.each::<_, C>(simd, patches, normals, out));
}

/// What to sum, and where.
struct Job<'a, E> {
    sources: Sources<'a, E>,
    targets: Targets<'a>,
}

impl Job<'_, f64> {
    #[inline(always)]
    fn run<S: Simd, C: Core, const N: usize, const K: usize>(
        &self,
        simd: S,
        ranges: impl Iterator<Item = Range<usize>> + Clone,
        sums: [&mut Block; K],
    ) {
        let mut window = [[S::f64s::splat(simd, 0.0); 4]; WINDOW];
        for lane in (0..self.targets.count).step_by(S::f64s::LEN) {
            let p = place::<S, C>(simd, self.targets.block, lane);
            let mut v = [[S::f64s::splat(simd, 0.0); 3]; K];
            for i in 0..K {
                v[i] = load(simd, sums[i], lane);
            }
            for range in ranges.clone() {
                let patches = &self.sources.patches[range];
                self.sources
                    .add::<S, Double, C, N, K>(simd, patches, p, &mut window, &mut v);
            }
            for i in 0..K {
                store::<S>(v[i], sums[i], lane);
            }
        }
    }

    #[inline(always)]
    fn each<S: Simd, C: Core>(
        &self,
        simd: S,
        patches: Range<usize>,
        normals: &Block,
        out: &mut [f64],
    ) {
        let zero = S::f64s::splat(simd, 0.0);
        let (mut window, mut room) = ([[zero; 4]; WINDOW], zero);
        for lane in (0..self.targets.count).step_by(S::f64s::LEN) {
            let p = place::<S, C>(simd, self.targets.block, lane);
            let n = load(simd, normals, lane);
            for patch in &self.sources.patches[patches.clone()] {
                let nodes = patch.nodes.clone();
                self.sources.look_at::<S, Double>(p, nodes, &mut window);
                for e in patch.edges.clone() {
                    let mut edge = self.sources.edges[e];
                    edge.strength = 2.0 * INV_4PI;
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
            let mut total = [load(simd, sum, lane), load(simd, sum, next)];
            for cluster in clusters.clone() {
                let (mut p, mut v) = ([zero; 4], [[zero; 3]]);
                let centre = single.centres[cluster];
                for i in 0..3 {
                    p[i] = ((low[i] - centre[i]) * single.per_unit)
                        .narrow((high[i] - centre[i]) * single.per_unit);
                }
                let patches = &self.sources.patches[single.clusters[cluster].clone()];
                self.sources
                    .add::<S, Float, C, N, 1>(simd, patches, p, &mut window, &mut v);
                for i in 0..3 {
                    let (low, high) = v[0][i].widen();
                    total[0][i] += low;
                    total[1][i] += high;
                }
            }
            store::<S>(total[0], sum, lane);
            store::<S>(total[1], sum, next);
        }
    }
}

impl<E: SimdFloatElement + From<f32>> Sources<'_, E> {
    /// Adds the edges of patches that follow each other. The nodes of the next patch are looked at
    /// between the edges of this one: while the processor takes their roots, it sums. `N` edges go side
    /// by side.
    #[inline(always)]
    fn add<S: Simd, P: Precision<S, Element = E>, C: Core, const N: usize, const K: usize>(
        &self,
        simd: S,
        patches: &[Patch],
        p: [P::Lanes; 4],
        window: &mut Window<P::Lanes>,
        v: &mut [[P::Lanes; 3]; K],
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
                add_group::<S, P, C, N, K, false>(simd, edges, window, v, &mut room);
            }
            for edge in rest.as_chunks::<1>().0 {
                add_group::<S, P, C, 1, K, false>(simd, edge, window, v, &mut room);
            }
            self.look_at::<S, P>(p, next, window);
            if room.simd_lt(zero).any_true() {
                *v = before;
                for edge in edges.as_chunks::<1>().0 {
                    add_group::<S, P, C, 1, K, true>(simd, edge, window, v, &mut room);
                }
            }
        }
    }

    /// r = p - node and abs(r), softened, of these nodes.
    #[inline(always)]
    fn look_at<S: Simd, P: Precision<S, Element = E>>(
        &self,
        p: [P::Lanes; 4],
        nodes: Range<usize>,
        window: &mut Window<P::Lanes>,
    ) {
        for (k, node) in nodes.clone().zip(&self.nodes[nodes]) {
            let r = [p[0] - node[0], p[1] - node[1], p[2] - node[2]];
            let r2 = square::<S, _>(r) + (p[3] + node[3]);
            window[k % WINDOW] = [r[0], r[1], r[2], r2.sqrt()];
        }
    }
}

/// Sums edges side by side, for the operations of one wait for each other and a processor does not look far
/// enough ahead to fill the time with the next edges. Order and bits are those of one after the other. As
/// [`induced`] otherwise.
#[inline(always)]
fn add_group<
    S: Simd,
    P: Precision<S>,
    C: Core,
    const N: usize,
    const K: usize,
    const CLOSE: bool,
>(
    simd: S,
    edges: &[PackedEdge<P::Element>; N],
    window: &Window<P::Lanes>,
    v: &mut [[P::Lanes; 3]; K],
    room: &mut P::Lanes,
) {
    let factors = induced::<S, P, C, N, CLOSE>(simd, edges, window, room);
    for (edge, (c, k)) in edges.iter().zip(factors) {
        for i in 0..3 {
            v[0][i] += c[i] * k;
        }
        if K > 1 {
            let (a, b) = (
                &window[edge.from as usize % WINDOW],
                &window[edge.to as usize % WINDOW],
            );
            for i in 0..3 {
                v[K - 1][i] += (a[i] - b[i]) * k; // r1 - r2 is the filament
            }
        }
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
        let is_bare = (P::IS_ROUGH || C::IS_EXACT) && !C::IS_SOFT;
        if CLOSE && is_bare {
            let a = nn * four - b;
            let is_beside = close.simd_gt(b) & a.simd_gt(b);
            bare = is_beside.select(nn * (square::<S, _>(c[i]) * four), bare);
            scale = is_beside.select(a, scale);
        }
        if is_bare {
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

/// Targets in the lanes from `lane` on: places, and what softens them, nothing but in a core model that does.
#[inline(always)]
fn place<S: Simd, C: Core>(simd: S, block: &Block, lane: usize) -> [S::f64s; 4] {
    let [x, y, z] = load(simd, block, lane);
    let softening = match C::IS_SOFT {
        true => load_softening(simd, block, lane),
        false => S::f64s::splat(simd, 0.0),
    };
    [x, y, z, softening]
}

/// r and abs(r) of the nodes in sight, for the targets in the lanes.
type Window<V> = [[V; 4]; WINDOW];
