//! One Gaussian on its mesh: filaments spread their strengths, the mesh is convolved, targets read it.

use crate::cores::exp2::exp_minus;
use crate::multilevel::convolution::{Both, Convolution, Node, Room};
use crate::multilevel::spline::{ORDER, Stencil, weights};
use fearless_simd::{Level, Simd, dispatch, f32x8, prelude::*};
use rayon::prelude::*;

/// Exponents beyond which a Gaussian is no part of the kernel: 3 in a thousand of it where all of it is
/// softening, nothing elsewhere.
const LARGEST: f64 = 9.0;

/// Planes of nodes that a task takes.
const SLAB: usize = 8;

/// Gauss-Legendre points along a filament by the largest `t l^2`: errors of some 1e-3 of one Gaussian, which
/// many filaments share out.
const POINTS: [f64; 7] = [0.01, 0.6, 2.5, 6.0, 10.0, 15.0, 20.0];

/// The most of them.
pub(super) const MOST_POINTS: usize = POINTS.len() + 1;

/// Sides of a mesh, in nodes: whole vectors of every processor.
const NODES_AT_ONCE: usize = 4;

/// A filament.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    /// Where it begins, and the way to its end \[m\].
    pub from: [f64; 3],
    pub along: [f64; 3],
    /// Half the squared core radius where it begins, and how much more there is at its end \[m2\].
    pub softening: [f64; 2],
    /// Gamma / (4 pi) times that way \[m3/s\].
    pub strength: [f64; 3],
    /// Its number in the network.
    pub index: u32,
}

impl Source {
    /// The larger softening of both ends \[m2\].
    pub fn most(&self) -> f64 {
        self.softening[0] + self.softening[1].max(0.0)
    }

    /// The smaller softening of both ends \[m2\].
    pub fn least(&self) -> f64 {
        self.softening[0] + self.softening[1].min(0.0)
    }

    /// The squared length, or what the change of softening counts for if that is more \[m2\].
    fn extent(&self) -> f64 {
        let square: f64 = self.along.iter().map(|l| l * l).sum();
        square.max(3.0 * self.softening[1].abs())
    }
}

/// How filaments spread.
#[derive(Clone, Copy)]
pub(super) struct Spreading<'a> {
    /// Corner of the box \[m\].
    pub origin: [f64; 3],
    /// Gauss-Legendre abscissas and weights on (0, 1), of one point, two and so on.
    pub quadrature: &'a [Vec<(f64, f64)>],
}

/// A Gaussian, its mesh and its sums.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    /// t \[1/m2\], and the weight in the kernel \[1/m3\].
    pub exponent: f64,
    pub weight: f64,
    pub stencil: Stencil,
    /// Distance of the nodes \[m\].
    pub spacing: f64,
    /// Nodes along each axis.
    pub size: [usize; 3],
    strengths: Vec<Node>,
    /// Of wide sources, and of all where narrow ones have a part.
    sums: [Vec<Both>; 2],
    has_narrow: bool,
    rooms: Vec<Room>,
}

/// Nodes along an axis of this many metres.
pub(super) fn nodes_along(extent: f64, spacing: f64) -> f64 {
    (extent / spacing).ceil() + ORDER as f64
}

impl Mesh {
    pub fn new(stencil: Stencil) -> Self {
        Self {
            exponent: 0.0,
            weight: 0.0,
            stencil,
            spacing: 0.0,
            size: [0; 3],
            strengths: vec![],
            sums: [vec![], vec![]],
            has_narrow: false,
            rooms: vec![],
        }
    }

    /// Makes it this Gaussian on nodes so far apart in a box of these sides \[m\].
    pub fn fit(&mut self, [exponent, weight]: [f64; 2], spacing: f64, sides: [f64; 3]) {
        (self.exponent, self.weight, self.spacing) = (exponent, weight, spacing);
        self.size = sides.map(|side| nodes_along(side, spacing) as usize);
        self.size[0] = self.size[0].next_multiple_of(NODES_AT_ONCE);
    }

    /// Sums wide sources, and all of them.
    pub fn sum(&mut self, level: Level, [wide, narrow]: [&[Source]; 2], how: Spreading<'_>) {
        let mut sums = std::mem::take(&mut self.sums);
        let [of_wide, of_all] = &mut sums;
        of_wide.clear();
        of_wide.resize(self.size.iter().product(), [0.0; 8]);
        if self.spread(level, wide, how) {
            self.convolve(level, of_wide);
        }
        self.has_narrow = !narrow.is_empty() && self.spread(level, narrow, how);
        if self.has_narrow {
            of_all.clone_from(of_wide);
            self.convolve(level, of_all);
        }
        self.sums = sums;
    }

    /// Strengths at the nodes; says whether there are any.
    fn spread(&mut self, level: Level, sources: &[Source], how: Spreading<'_>) -> bool {
        let mut strengths = std::mem::take(&mut self.strengths);
        strengths.clear();
        strengths.resize(self.size.iter().product(), [0.0; 4]);
        let mut has_any = false;
        dispatch!(level, simd => {
            for source in sources {
                if self.exponent * source.least() <= LARGEST {
                    has_any = true;
                    self.spread_one(simd, source, how, &mut strengths);
                }
            }
        });
        self.strengths = strengths;
        has_any
    }

    #[inline(always)]
    fn spread_one<S: Simd>(
        &self,
        simd: S,
        source: &Source,
        Spreading { origin, quadrature }: Spreading<'_>,
        strengths: &mut [Node],
    ) {
        let extent = self.exponent * source.extent();
        let more = POINTS.iter().take_while(|most| extent > **most).count();
        for &(s, part) in &quadrature[more] {
            let x = std::array::from_fn(|d| source.from[d] + s * source.along[d] - origin[d]);
            let soft = (source.softening[0] + s * source.softening[1]).max(0.0);
            let factor = self.weight * part * f64::from(exp_minus((self.exponent * soft) as f32));
            let [a, b, c] = source.strength.map(|w| (factor * w) as f32);
            let strength = [a, b, c, 0.0];
            let (first, [wx, wy, wz]) = self.place(x);
            let row: [f32; 4 * ORDER] = std::array::from_fn(|i| wx[i / 4] * strength[i % 4]);
            let [low, high] = [0, 8].map(|i| f32x8::from_slice(simd, &row[i..i + 8]));
            for (k, wz) in wz.iter().enumerate() {
                for (j, wy) in wy.iter().enumerate() {
                    let at = first + self.size[0] * (j + self.size[1] * k);
                    let nodes = strengths[at..at + ORDER].as_flattened_mut();
                    let (one, two) = nodes.split_at_mut(8);
                    let across = wz * wy;
                    (f32x8::from_slice(simd, one) + low * across).store_slice(one);
                    (f32x8::from_slice(simd, two) + high * across).store_slice(two);
                }
            }
        }
    }

    /// The first node that reaches a place, measured from the corner of the box \[m\], and the weights along each axis.
    #[inline(always)]
    fn place(&self, x: [f64; 3]) -> (usize, [[f32; ORDER]; 3]) {
        let mut first = [0; 3];
        let mut all = [[0.0; ORDER]; 3];
        for d in 0..3 {
            let u = x[d] / self.spacing;
            first[d] = u as usize;
            all[d] = weights((u - first[d] as f64) as f32);
        }
        let [i, j, k] = first;
        (i + self.size[0] * (j + self.size[1] * k), all)
    }

    fn convolve(&mut self, level: Level, sums: &mut [Both]) {
        let plane = self.size[0] * self.size[1];
        let convolution = Convolution {
            size: self.size,
            strengths: &self.strengths,
            stencil: &self.stencil,
        };
        let slabs = self.size[2].div_ceil(SLAB);
        if self.rooms.len() < slabs {
            self.rooms.resize_with(slabs, Room::default);
        }
        let slabs = sums.par_chunks_mut(SLAB * plane).zip(&mut self.rooms);
        slabs.enumerate().for_each(|(slab, (sums, room))| {
            for (k, sums) in sums.chunks_exact_mut(plane).enumerate() {
                convolution.plane(level, slab * SLAB + k, room, sums);
            }
        });
    }

    /// Whether a target of this softening \[m2\] hears of a Gaussian of sources with this one at least.
    pub fn is_heard(&self, softening: f64) -> bool {
        self.exponent * softening <= LARGEST
    }

    /// Velocity \[m/s\] and vorticity \[1/s\] of wide sources only, or of all, at a place from the corner of
    /// the box \[m\] with this softening \[m2\].
    #[inline(always)]
    pub fn read<S: Simd>(
        &self,
        simd: S,
        (x, softening): ([f64; 3], f64),
        wide_only: bool,
    ) -> [f64; 6] {
        let sums = &self.sums[usize::from(self.has_narrow && !wide_only)];
        let (first, [wx, wy, wz]) = self.place(x);
        let mut sum = f32x8::splat(simd, 0.0);
        for (k, wz) in wz.iter().enumerate() {
            for (j, wy) in wy.iter().enumerate() {
                let at = first + self.size[0] * (j + self.size[1] * k);
                let nodes = &sums[at..at + ORDER];
                let [a, b, c, d] =
                    std::array::from_fn(|i| f32x8::from_slice(simd, &nodes[i]) * wx[i]);
                sum += ((a + b) + (c + d)) * (wz * wy);
            }
        }
        let mut both = [0.0; 8];
        sum.store_slice(&mut both);
        let factor = f64::from(exp_minus((self.exponent * softening) as f32));
        let [wx, wy, wz, _, ux, uy, uz, _] = both.map(|v| factor * f64::from(v));
        let h = self.spacing;
        [h * ux, h * uy, h * uz, wx, wy, wz]
    }
}
