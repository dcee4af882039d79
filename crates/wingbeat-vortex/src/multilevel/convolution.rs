//! A mesh of strengths convolved with a Gaussian, axis after axis: velocity and vorticity at its nodes.
//!
//! With S the strengths and g the Gaussian, the vorticity is `W = g * S` and the velocity `U = sum S x r g(r)`,
//! r from the source to the node. Along an axis g is an even stencil, `x g` an odd one. So along z: A = even S,
//! B = odd S; along y: even A, odd A and even B; along x: W = even A, and U the even stencil of (B_y - A'_z, -B_x,
//! A'_x), A' = odd A, with the odd one of (0, A_z, -A_y).

use crate::multilevel::spline::{FARTHEST, Stencil};
use fearless_simd::prelude::*;

/// Strength or vorticity of a node, three components and one that makes them a vector of the processor.
pub(super) type Node = [f32; 4];

/// Vorticity and velocity of a node, each as above; velocities in units of a spacing.
pub(super) type Both = [f32; 8];

/// Memory for a plane of nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Room {
    size: [usize; 2],
    zero: Vec<Node>,
    planes: [Vec<Node>; 2],
    /// A, (B_y - A'_z, -B_x, A'_x) and (0, A_z, -A_y) along x, with zeros at both ends.
    lines: [Vec<Node>; 3],
}

impl Room {
    /// Planes and the middles of lines are overwritten, the rest stays zero.
    fn fit(&mut self, size: [usize; 2]) {
        if self.size == size {
            return;
        }
        self.size = size;
        let [nx, ny] = size;
        for plane in self.planes.iter_mut().chain([&mut self.zero]) {
            plane.clear();
            plane.resize(nx * ny, [0.0; 4]);
        }
        for line in &mut self.lines {
            line.clear();
            line.resize(nx + 2 * FARTHEST, [0.0; 4]);
        }
    }
}

/// Numbers beside each other, and their neighbours on both sides along an axis.
struct Lines<'a, const J: usize> {
    middle: &'a [f32],
    low: [&'a [f32]; J],
    high: [&'a [f32]; J],
}

impl<'a, const J: usize> Lines<'a, J> {
    /// `line` gives the one so many places further on.
    #[inline(always)]
    fn new(line: impl Fn(isize) -> &'a [f32]) -> Self {
        let middle = line(0);
        let cut = |j: isize| &line(j)[..middle.len()];
        Self {
            middle,
            low: std::array::from_fn(|j| cut(-1 - j as isize)),
            high: std::array::from_fn(|j| cut(1 + j as isize)),
        }
    }

    /// Even and odd stencil of the numbers from `i` on.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, stencil: &Stencil, i: usize) -> [S::f32s; 2] {
        let some = i..i + S::f32s::LEN;
        let load = |line: &[f32]| S::f32s::from_slice(simd, &line[some.clone()]);
        let mut even = load(self.middle) * stencil.even[0];
        let mut odd = S::f32s::splat(simd, 0.0);
        for j in 0..J {
            let (low, high) = (load(self.low[j]), load(self.high[j]));
            even += (low + high) * stencil.even[j + 1];
            odd += (low - high) * stencil.odd[j + 1];
        }
        [even, odd]
    }
}

/// Nodes of a mesh along each axis, its strengths, and its stencil.
#[derive(Clone, Copy)]
pub(super) struct Convolution<'a> {
    pub size: [usize; 3],
    pub strengths: &'a [Node],
    pub stencil: &'a Stencil,
}

impl Convolution<'_> {
    /// Adds plane number `z`.
    pub fn plane(&self, level: fearless_simd::Level, z: usize, room: &mut Room, out: &mut [Both]) {
        use fearless_simd::dispatch;
        room.fit([self.size[0], self.size[1]]);
        match self.stencil.reach {
            4 => dispatch!(level, simd => self.run::<_, 4>(simd, z, room, out)),
            6 => dispatch!(level, simd => self.run::<_, 6>(simd, z, room, out)),
            8 => dispatch!(level, simd => self.run::<_, 8>(simd, z, room, out)),
            reach => unreachable!("stencils of reach {reach} are not offered"),
        }
    }

    #[inline(always)]
    fn run<S: Simd, const J: usize>(&self, simd: S, z: usize, room: &mut Room, out: &mut [Both]) {
        let [nx, ny, nz] = self.size;
        let zero = room.zero.as_flattened();
        let [one, two] = &mut room.planes;
        let (plane, row) = (4 * nx * ny, 4 * nx);
        let strengths = self.strengths.as_flattened();
        let lines = Lines::<J>::new(|j| match z.checked_add_signed(j) {
            Some(k) if k < nz => &strengths[k * plane..][..plane],
            _ => zero,
        });
        let [a, b] = [one.as_flattened_mut(), two.as_flattened_mut()];
        for i in (0..plane).step_by(S::f32s::LEN) {
            let [even, odd] = lines.at(simd, self.stencil, i);
            even.store_slice(&mut a[i..i + S::f32s::LEN]);
            odd.store_slice(&mut b[i..i + S::f32s::LEN]);
        }
        for (y, out) in out.chunks_exact_mut(nx).enumerate() {
            let [a, b] = [&*a, &*b].map(|plane| {
                Lines::<J>::new(|j| match y.checked_add_signed(j) {
                    Some(k) if k < ny => &plane[k * row..][..row],
                    _ => &zero[..row],
                })
            });
            self.along_y(simd, [&a, &b], &mut room.lines);
            self.along_x::<S, J>(simd, &room.lines, out);
        }
    }

    #[inline(always)]
    fn along_y<S: Simd, const J: usize>(
        &self,
        simd: S,
        [a, b]: [&Lines<'_, J>; 2],
        lines: &mut [Vec<Node>; 3],
    ) {
        let [all, first, second] = lines.each_mut().map(|line| &mut line[FARTHEST..]);
        let (mut odd_of_a, mut even_of_b) = ([0.0; 16], [0.0; 16]);
        for start in (0..a.middle.len()).step_by(16) {
            let nodes = start / 4..start / 4 + 4;
            let all = all[nodes.clone()].as_flattened_mut();
            for i in (0..16).step_by(S::f32s::LEN) {
                let own = i..i + S::f32s::LEN;
                let [even, odd] = a.at(simd, self.stencil, start + i);
                even.store_slice(&mut all[own.clone()]);
                odd.store_slice(&mut odd_of_a[own.clone()]);
                let [even, _] = b.at(simd, self.stencil, start + i);
                even.store_slice(&mut even_of_b[own]);
            }
            for (i, n) in nodes.enumerate() {
                let own = 4 * i..4 * i + 4;
                let (a, odd, even) = (&all[own.clone()], &odd_of_a[own.clone()], &even_of_b[own]);
                first[n] = [even[1] - odd[2], -even[0], odd[0], 0.0];
                second[n] = [0.0, a[2], -a[1], 0.0];
            }
        }
    }

    #[inline(always)]
    fn along_x<S: Simd, const J: usize>(&self, simd: S, lines: &[Vec<Node>; 3], out: &mut [Both]) {
        let length = 4 * out.len();
        let [all, first, second] = lines.each_ref().map(|line| {
            let line = line.as_flattened();
            Lines::<J>::new(|j| &line[(4 * (FARTHEST as isize + j)) as usize..][..length])
        });
        let (mut w, mut u) = ([0.0; 16], [0.0; 16]);
        for (i, out) in (0..length).step_by(16).zip(out.chunks_exact_mut(4)) {
            for k in (0..16).step_by(S::f32s::LEN) {
                let own = k..k + S::f32s::LEN;
                let [even, _] = all.at(simd, self.stencil, i + k);
                even.store_slice(&mut w[own.clone()]);
                let [even, _] = first.at(simd, self.stencil, i + k);
                let [_, odd] = second.at(simd, self.stencil, i + k);
                (even + odd).store_slice(&mut u[own]);
            }
            let nodes = w.as_chunks::<4>().0.iter().zip(u.as_chunks::<4>().0);
            for (out, (w, u)) in out.iter_mut().zip(nodes) {
                for c in 0..4 {
                    out[c] += w[c];
                    out[4 + c] += u[c];
                }
            }
        }
    }
}
