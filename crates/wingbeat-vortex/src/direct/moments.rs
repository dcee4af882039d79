//! Filaments of algebraic cores in single precision, by their moments: velocity and vorticity in one sum.
//!
//! A filament from a to b makes the velocity `k l x (p - a)` at p, `l = b - a`, with a number k that holds all that
//! depends on the distances. Summed from the middle o of some sixteen that are neighbours,
//!
//! `u = W x (p - o) - M`, `W = sum k l`, `M = sum k l x (a - o)`,
//!
//! where l and `l x (a - o)` are known before a target is: what is left for each pair of filament and target is
//! k and six products and sums. The vector product of both distances that other cores need for the distance
//! from the line is not taken, so of a node only its distance is kept, and W is the vorticity of
//! [`crate::FastSum::add_velocity_and_vorticity`] at no cost.
//!
//! `W x (p - o)` and M are larger than their difference where the target is much nearer to a filament than to
//! o. A digit or so is lost there; with more neighbours to one o it would be two.

use crate::cores::vector::square;
use crate::direct::block::{Block, Targets, load, load_softening, store};
use crate::direct::packed::WINDOW;
use crate::direct::single::{MomentEdge, Single};
use fearless_simd::{Level, dispatch, prelude::*};
use std::ops::Range;

/// Vectors of targets taken side by side: an edge is fetched once for all of them, and the quotient of one
/// fills the time of the other's.
const SIDE: usize = 2;

/// Targets as the loop takes them, lengths in the unit of [`Single`].
#[derive(Clone, Copy)]
struct Lanes<V> {
    /// Places, from the centre of a cluster.
    place: [[V; 3]; SIDE],
    /// Half the squared core radii.
    softening: [V; SIDE],
}

/// Softened distances of the nodes in sight.
type Window<V> = [[V; SIDE]; WINDOW];

/// Adds to the first of `sums` the velocities [m/s] of the clusters with these numbers at the targets, and to a
/// second one the sum [1/s] of Gamma / (4 pi) times the integral of dl over the cube of the softened distance.
pub(crate) fn add_clusters<const K: usize>(
    level: Level,
    single: &Single,
    clusters: impl Iterator<Item = usize> + Clone,
    targets: Targets<'_>,
    sums: [&mut Block; K],
) {
    dispatch!(level, simd => run(simd, single, clusters, targets, sums));
}

#[inline(always)]
fn run<S: Simd, const K: usize>(
    simd: S,
    single: &Single,
    clusters: impl Iterator<Item = usize> + Clone,
    targets: Targets<'_>,
    sums: [&mut Block; K],
) {
    let zero = S::f32s::splat(simd, 0.0);
    let mut window = [[zero; SIDE]; WINDOW];
    let mut lanes = Lanes {
        place: [[zero; 3]; SIDE],
        softening: [zero; SIDE],
    };
    for first in (0..targets.count).step_by(SIDE * S::f32s::LEN) {
        soften(simd, single, targets.block, first, &mut lanes.softening);
        for cluster in clusters.clone() {
            let centre = single.centres[cluster];
            let block = targets.block;
            place(
                simd,
                (centre, single.per_unit),
                block,
                first,
                &mut lanes.place,
            );
            let patches = single.clusters[cluster].clone();
            let [u, w] = velocity_and_vorticity(simd, single, patches, &lanes, &mut window);
            for s in 0..SIDE {
                let lane = first + s * S::f32s::LEN;
                add(simd, u[s], 1.0, sums[0], lane);
                if K > 1 {
                    add(simd, w[s], single.per_unit, sums[K - 1], lane);
                }
            }
        }
    }
}

/// What softens the targets in the lanes from `first` on.
#[inline(always)]
fn soften<S: Simd>(
    simd: S,
    single: &Single,
    block: &Block,
    first: usize,
    softening: &mut [S::f32s; SIDE],
) {
    let per_unit2 = single.per_unit * single.per_unit;
    for s in 0..SIDE {
        let lane = first + s * S::f32s::LEN;
        let low = load_softening(simd, block, lane);
        let high = load_softening(simd, block, lane + S::f64s::LEN);
        softening[s] = (low * per_unit2).narrow(high * per_unit2);
    }
}

/// Places of the targets in the lanes from `first` on, from a centre [m] and in units of length, so many to the metre.
#[inline(always)]
fn place<S: Simd>(
    simd: S,
    (centre, per_unit): ([f64; 3], f64),
    block: &Block,
    first: usize,
    place: &mut [[S::f32s; 3]; SIDE],
) {
    for s in 0..SIDE {
        let lane = first + s * S::f32s::LEN;
        let low = load(simd, block, lane);
        let high = load(simd, block, lane + S::f64s::LEN);
        for i in 0..3 {
            place[s][i] =
                ((low[i] - centre[i]) * per_unit).narrow((high[i] - centre[i]) * per_unit);
        }
    }
}

/// Adds vectors in single precision, times a factor, to those in the lanes from `lane` on.
#[inline(always)]
fn add<S: Simd>(simd: S, more: [S::f32s; 3], factor: f64, sum: &mut Block, lane: usize) {
    let next = lane + S::f64s::LEN;
    let mut low = load(simd, sum, lane);
    let mut high = load(simd, sum, next);
    for i in 0..3 {
        let (more_low, more_high) = more[i].widen();
        low[i] += more_low * factor;
        high[i] += more_high * factor;
    }
    store::<S>(low, sum, lane);
    store::<S>(high, sum, next);
}

/// u and the sum of W of patches that follow each other. The nodes of the next patch are looked at between the edges of
/// this one: while the processor takes their roots, it sums.
#[inline(always)]
fn velocity_and_vorticity<S: Simd>(
    simd: S,
    single: &Single,
    patches: Range<usize>,
    lanes: &Lanes<S::f32s>,
    window: &mut Window<S::f32s>,
) -> [[[S::f32s; 3]; SIDE]; 2] {
    let zero = S::f32s::splat(simd, 0.0);
    let (mut velocity, mut vorticity) = ([[zero; 3]; SIDE], [[zero; 3]; SIDE]);
    let nodes_of = |i: usize| match i < patches.end {
        true => single.patches[i].nodes.clone(),
        false => 0..0,
    };
    look_at::<S>(single, nodes_of(patches.start), lanes, window);
    for i in patches.clone() {
        let mut next = nodes_of(i + 1);
        let (mut w, mut m) = ([[zero; 3]; SIDE], [[zero; 3]; SIDE]);
        let edges = &single.moment_edges[single.patches[i].edges.clone()];
        let (pairs, rest) = edges.as_chunks::<2>();
        for pair in pairs {
            let later = (next.start + 1).min(next.end);
            look_at::<S>(single, next.start..later, lanes, window);
            next.start = later;
            add_edge::<S>(simd, &pair[0], window, [&mut w, &mut m]);
            add_edge::<S>(simd, &pair[1], window, [&mut w, &mut m]);
        }
        for edge in rest {
            add_edge::<S>(simd, edge, window, [&mut w, &mut m]);
        }
        look_at::<S>(single, next, lanes, window);
        let o = single.middles[i];
        for s in 0..SIDE {
            let (w, m, p) = (w[s], m[s], lanes.place[s]);
            let r = [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
            velocity[s][0] += (w[1] * r[2] - w[2] * r[1]) - m[0];
            velocity[s][1] += (w[2] * r[0] - w[0] * r[2]) - m[1];
            velocity[s][2] += (w[0] * r[1] - w[1] * r[0]) - m[2];
            for k in 0..3 {
                vorticity[s][k] += w[k];
            }
        }
    }
    [velocity, vorticity]
}

/// Softened distances of these nodes.
#[inline(always)]
fn look_at<S: Simd>(
    single: &Single,
    nodes: Range<usize>,
    lanes: &Lanes<S::f32s>,
    window: &mut Window<S::f32s>,
) {
    for (k, node) in nodes.clone().zip(&single.nodes[nodes]) {
        for s in 0..SIDE {
            let p = lanes.place[s];
            let r = [p[0] - node[0], p[1] - node[1], p[2] - node[2]];
            window[k % WINDOW][s] = (square::<S, _>(r) + (lanes.softening[s] + node[3])).sqrt();
        }
    }
}

/// Adds an edge to W and M; nothing in lanes on its line, where the denominator may round to nothing.
#[inline(always)]
fn add_edge<S: Simd>(
    simd: S,
    edge: &MomentEdge,
    window: &Window<S::f32s>,
    [w, m]: [&mut [[S::f32s; 3]; SIDE]; 2],
) {
    let zero = S::f32s::splat(simd, 0.0);
    let [from, to] = edge.ends.map(|place| place as usize % WINDOW);
    for s in 0..SIDE {
        let (n1, n2) = (window[from][s], window[to][s]);
        let sum = n1 + n2;
        let den = (n1 * n2) * (sum * sum - edge.l2);
        let k = den.simd_gt(zero).select(sum / den, zero);
        for i in 0..3 {
            w[s][i] += k * edge.vorticity[i];
            m[s][i] += k * edge.moment[i];
        }
    }
}
