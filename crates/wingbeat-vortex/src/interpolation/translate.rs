//! What sources at the points of a grid do at the points of another one, in single precision.
//!
//! A source of strength w at y makes `w x (p - y) / D^3` at p. As for filaments ([`crate::direct::moments`]) `W =
//! sum k w` and `M = sum k w x (y - o)` are summed, `k = 1 / D^3`, and `W x (p - o) - M` is taken last. k is a
//! sum of products of Gaussians ([`super::gaussians`]), so a sum over a grid is done direction by direction.

use crate::cores::exp2::exp_minus;
use crate::interpolation::gaussians::{GAUSSIANS, RANGE};
use crate::interpolation::grid::{Frame, Grid, MOST};
use fearless_simd::{Level, Simd, dispatch, f32x8, prelude::*};
use glam::DVec3;

/// W and M at a point, and two numbers that make a vector full.
pub(crate) type Sums = [f32; 8];

/// Places and softenings of a grid, at most.
const PLACES: usize = 5 * 5 * 5;
const SOFTENINGS: usize = 3;

/// W and M at the points of a grid of targets; lengths in m, strengths in the unit given.
#[derive(Clone, Debug)]
pub(crate) struct Received(pub [Sums; PLACES * SOFTENINGS]);

impl Received {
    pub const NONE: Self = Self([[0.0; 8]; PLACES * SOFTENINGS]);
}

/// The strengths at the points of a grid as the sums take them: w and `w x (y - o)`, o the middle of the box, from
/// `Gamma / (4 pi)` times lengths [m3/s]; `unit` is the inverse of the unit of length [1/m].
pub(crate) fn pack(
    grid: &Grid,
    frame: &Frame,
    strengths: &[[f64; 3]],
    unit: f64,
    out: &mut [Sums],
) {
    for (i, (w, out)) in strengths.iter().zip(out).enumerate() {
        let (w, y) = (DVec3::from(*w) * unit * unit, grid.offset(frame, i));
        let m = w.cross(y) * unit;
        *out = [w.x, w.y, w.z, 0.0, m.x, m.y, m.z, 0.0].map(|v| v as f32);
    }
}

/// Least and largest softened distance of two boxes, squared \[m2\].
pub(crate) fn distances([one, two]: [&Frame; 2]) -> [f64; 2] {
    let [mut least, mut most] = [one.middle[3] + two.middle[3]; 2];
    let soft = one.half[3] + two.half[3];
    (least, most) = (least - soft, most + soft);
    for d in 0..3 {
        let (apart, half) = (
            (one.middle[d] - two.middle[d]).abs(),
            one.half[d] + two.half[d],
        );
        least += (apart - half).max(0.0).powi(2);
        most += (apart + half).powi(2);
    }
    [least, most]
}

/// Whether the Gaussians hold between two boxes.
pub(crate) fn is_in_range(frames: [&Frame; 2]) -> bool {
    let [least, most] = distances(frames);
    most <= RANGE * least
}

/// Adds what the sources of one box do at the points of another one.
pub(crate) fn add(
    level: Level,
    grid: &Grid,
    [target, source]: [&Frame; 2],
    (strengths, unit): (&[Sums], f64),
    out: &mut Received,
) {
    let job = Job {
        grid,
        target,
        source,
        strengths,
        unit,
    };
    match [grid.along(0), grid.along(3)] {
        [4, 3] => dispatch!(level, simd => job.run::<_, 4, 3>(simd, out)),
        [5, 3] => dispatch!(level, simd => job.run::<_, 5, 3>(simd, out)),
        other => unreachable!("{other:?} points are not offered"),
    }
}

struct Job<'a> {
    grid: &'a Grid,
    target: &'a Frame,
    source: &'a Frame,
    strengths: &'a [Sums],
    unit: f64,
}

/// Gaussians of the differences along each direction of space \[from\]\[to\].
type Matrices<const N: usize> = [[[f32; N]; N]; 3];

impl Job<'_> {
    #[inline(always)]
    fn run<S: Simd, const N: usize, const M: usize>(&self, simd: S, out: &mut Received) {
        let scale = 1.0 / distances([self.target, self.source])[0]; // of squares
        let strength = scale * scale.sqrt() / self.unit.powi(3);
        let places = N * N * N;
        let zero = f32x8::splat(simd, 0.0);
        let (mut one, mut two) = ([zero; PLACES], [zero; PLACES]);
        let (one, two) = (&mut one[..places], &mut two[..places]);
        let mut moved = [[0.0; 8]; PLACES * SOFTENINGS];
        self.shift(&mut moved[..places * M]);
        let (squares, [soft_to, soft_from]) = self.squares::<N, M>(scale);
        for (t, w) in GAUSSIANS {
            let t = t as f32;
            let e = soft_from.map(|e| exp_minus(t * e) * (w * strength) as f32);
            let q = soft_to.map(|q| exp_minus(t * q));
            let [x, y, z]: Matrices<N> = squares.map(|d| d.map(|d| d.map(|d| exp_minus(t * d))));
            for i in 0..places {
                let mut sum = zero;
                for l in 0..M {
                    sum += f32x8::from_slice(simd, &moved[l * places + i]) * e[l];
                }
                one[i] = sum;
            }
            along::<S, N>(simd, &x, 1, one, two);
            along::<S, N>(simd, &y, N, two, one);
            along::<S, N>(simd, &z, N * N, one, two);
            for l in 0..M {
                for i in 0..places {
                    let sum = &mut out.0[l * places + i];
                    (f32x8::from_slice(simd, sum) + two[i] * q[l]).store_slice(sum);
                }
            }
        }
    }

    /// The sources, their `w x (y - o)` from the middle of the targets instead of their own.
    #[inline(always)]
    fn shift(&self, moved: &mut [Sums]) {
        let [x, y, z]: [f32; 3] = std::array::from_fn(|d| {
            ((self.source.middle[d] - self.target.middle[d]) * self.unit) as f32
        });
        for (to, v) in moved.iter_mut().zip(self.strengths) {
            let m = [
                v[4] + (v[1] * z - v[2] * y),
                v[5] + (v[2] * x - v[0] * z),
                v[6] + (v[0] * y - v[1] * x),
            ];
            *to = [v[0], v[1], v[2], 0.0, m[0], m[1], m[2], 0.0];
        }
    }

    /// Squared differences along each direction of space and softenings (here, there), times `scale`.
    #[inline(always)]
    fn squares<const N: usize, const M: usize>(&self, scale: f64) -> (Matrices<N>, [[f32; M]; 2]) {
        let grid = self.grid;
        let squares = std::array::from_fn(|d| {
            let apart = self.target.middle[d] - self.source.middle[d];
            let [to, from] = [self.target, self.source]
                .map(|frame| std::array::from_fn::<_, N, _>(|i| grid.root(d, i) * frame.half[d]));
            from.map(|from| to.map(|to| (scale * (apart + to - from).powi(2)) as f32))
        });
        let soft = [self.target, self.source].map(|frame| {
            let soft = |l| scale * (frame.middle[3] + grid.root(3, l) * frame.half[3]);
            std::array::from_fn(|l| soft(l).max(0.0) as f32)
        });
        (squares, soft)
    }
}

/// Sums along a direction whose neighbours are so many places apart.
#[inline(always)]
fn along<S: Simd, const N: usize>(
    simd: S,
    matrix: &[[f32; N]; N],
    stride: usize,
    from: &[f32x8<S>],
    to: &mut [f32x8<S>],
) {
    for first in (0..from.len()).step_by(N * stride) {
        for place in first..first + stride {
            let mut sums = [f32x8::splat(simd, 0.0); N];
            for k in 0..N {
                let from = from[place + k * stride];
                for i in 0..N {
                    sums[i] += from * matrix[k][i];
                }
            }
            for i in 0..N {
                to[place + i * stride] = sums[i];
            }
        }
    }
}

const _: () = assert!(PLACES <= MOST * MOST * MOST);
