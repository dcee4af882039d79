//! The velocity of many blobs by convolution on meshes: particle-mesh, one mesh to a level of widths.
//!
//! 1. Each blob spreads its strength over the nodes around it by splines, on the mesh of its level, whose spacing
//!    is a part of the level's width.
//! 2. On each mesh the strengths are convolved with the velocity of one blob, by fast Fourier transforms on
//!    twice as many nodes: so the air is unbounded \[Hockney & Eastwood 1988, Computer Simulation Using
//!    Particles, sec. 6-5\]. A blob is smooth on the scale of the spacing, so this leaves out little; the
//!    splines' own smoothing is divided out.
//! 3. From the widest level on, values are carried to the next finer mesh, which splines do exactly, and added up.
//! 4. Splines give the velocity at the targets.
//!
//! The cost is that of blobs, targets and nodes, each taken once. Same bits for any number of threads and any
//! instructions: every node and every target adds up in a fixed order.

use crate::cores::INV_4PI;
use crate::direct::gaussian::{WidthLevel, swirl_of};
use crate::particle_mesh::spline::{ORDER, REFINE, transfer, weights};
use crate::particle_mesh::transform::{LANES, Lines, Pair, Transform, good_length};
use crate::sources::Blob;
use glam::DVec3;
use rayon::prelude::*;
use rustfft::num_complex::Complex32;
use std::array::from_fn;

/// Distances of the nodes over the width of the blobs: an error of some 2e-5 of the velocity (three times that at 0.6),
/// and of some 2e-6.
pub(crate) const SPACINGS: [f64; 2] = [0.55, 0.42];

/// Nodes around the box that splines at its border reach.
const MARGIN: usize = 4;

/// Cells of the finest mesh come in multiples of this, so that its size seldom changes as a wake grows.
const QUANTUM: usize = 8;

/// Planes of nodes that a task takes.
const SLAB: usize = 4;

/// Three components, and one that makes them a vector of the processor.
type Node = [f32; 4];

/// Velocities on meshes, ready to be read at targets.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    /// Corner of the box \[m\].
    origin: DVec3,
    layers: Vec<Layer>,
}

impl Mesh {
    /// Nodes of the finest mesh for blobs of this width \[m\] at least, in a box between two corners \[m\].
    pub fn nodes(width: f64, [low, high]: [DVec3; 2]) -> usize {
        let size =
            cells(SPACINGS[0] * width, [low, high]).map(|c| c.saturating_add(1 + 2 * MARGIN));
        size.into_iter().fold(1, usize::saturating_mul)
    }

    /// Convolves the levels, the first of them the narrowest, on a box from `low` to `high` \[m\] that holds them all;
    /// `spacing` is the distance of the nodes over the width of the blobs.
    pub fn load(&mut self, widths: &[WidthLevel], [low, high]: [DVec3; 2], spacing: f64) {
        self.origin = low;
        let mut cells = cells(spacing * widths[0].width, [low, high]);
        self.layers.truncate(widths.len());
        self.layers.resize_with(widths.len(), Layer::default);
        for (layer, WidthLevel { width, blobs }) in self.layers.iter_mut().zip(widths) {
            layer.fit(spacing, *width, cells);
            layer.spread(blobs, low);
            layer.convolve(!blobs.is_empty());
            cells = cells.map(|c| c.div_ceil(2));
        }
        for k in (1..self.layers.len()).rev() {
            let (fine, coarse) = self.layers.split_at_mut(k);
            fine[k - 1].add_coarse(&coarse[0]);
        }
    }

    /// Velocity \[m/s\] at a place inside the box \[m\].
    pub fn velocity(&self, x: DVec3) -> DVec3 {
        let layer = &self.layers[0];
        let (base, w) = layer.place(x - self.origin);
        let mut sum = [0.0; 4];
        for (k, wz) in w[2].iter().enumerate() {
            for (j, wy) in w[1].iter().enumerate() {
                let row = layer.index([base[0], base[1] + j, base[2] + k]);
                let row = &layer.nodes[row..row + ORDER];
                let across = wz * wy;
                for (node, wx) in row.iter().zip(w[0]) {
                    let w = across * wx;
                    for c in 0..4 {
                        sum[c] += w * node[c];
                    }
                }
            }
        }
        DVec3::new(f64::from(sum[0]), f64::from(sum[1]), f64::from(sum[2]))
    }
}

/// Cells of the finest mesh along each axis.
fn cells(spacing: f64, [low, high]: [DVec3; 2]) -> [usize; 3] {
    let cells = (high - low) / spacing;
    let up = |c: f64| (c.ceil() as usize).clamp(1, usize::MAX / 2);
    cells.to_array().map(|c| up(c).next_multiple_of(QUANTUM))
}

/// One mesh.
#[derive(Clone, Debug, Default)]
struct Layer {
    /// Distance of the nodes \[m\].
    spacing: f64,
    /// Nodes along each axis.
    size: [usize; 3],
    /// Strengths \[m3/s\], then the splines' coefficients of the velocity \[m/s\]; x runs fastest.
    nodes: Vec<Node>,
    kernel: Kernel,
    /// Spectra along x and y of two complex fields, w_x + i w_y and w_z: plane by plane of z, in it y runs fastest.
    planes: Vec<Pair>,
    /// The same turned round: plane by plane of the wave number along x.
    columns: Vec<Pair>,
    /// Scratch of each plane, and of each plane of a finer mesh.
    lines: Vec<Lines>,
    carried: Vec<Node>,
}

impl Layer {
    fn fit(&mut self, spacing: f64, width: f64, cells: [usize; 3]) {
        self.spacing = spacing * width;
        self.size = cells.map(|c| c + 1 + 2 * MARGIN);
        self.kernel.fit(self.size, 1.0 / spacing);
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.size[0] * (j + self.size[1] * k)
    }

    /// First node that reaches a place, measured from the corner of the box, and the weights along each axis.
    fn place(&self, x: DVec3) -> ([usize; 3], [[f32; ORDER]; 3]) {
        let u = (x / self.spacing).to_array();
        let base = u.map(|u| (u.floor() as isize + MARGIN as isize - 2) as usize);
        (base, u.map(|u| weights(u - u.floor())))
    }

    fn spread(&mut self, blobs: &[Blob], origin: DVec3) {
        let mut nodes = std::mem::take(&mut self.nodes);
        nodes.clear();
        nodes.resize(self.size.iter().product(), Node::default());
        let plane = self.size[0] * self.size[1];
        let slabs = nodes.par_chunks_mut(SLAB * plane).enumerate();
        slabs.for_each(|(slab, nodes)| {
            let first = slab * SLAB;
            let own = first..first + nodes.len() / plane;
            for &Blob {
                position: x,
                strength,
                ..
            } in blobs
            {
                let u = (x.z - origin.z) / self.spacing;
                let lowest = (u.floor() as isize + MARGIN as isize - 2) as usize;
                if lowest >= own.end || lowest + ORDER <= own.start {
                    continue;
                }
                let (base, w) = self.place(x - origin);
                let a = (INV_4PI * strength).to_array();
                let a: Node = [a[0] as f32, a[1] as f32, a[2] as f32, 0.0];
                let planes = (lowest..lowest + ORDER).zip(w[2]);
                for (k, wz) in planes.filter(|(k, _)| own.contains(k)) {
                    for (j, wy) in w[1].iter().enumerate() {
                        let row = self.index([base[0], base[1] + j, k - first]);
                        let across = wz * wy;
                        for (node, wx) in nodes[row..row + ORDER].iter_mut().zip(w[0]) {
                            let w = across * wx;
                            for c in 0..4 {
                                node[c] += w * a[c];
                            }
                        }
                    }
                }
            }
        });
        self.nodes = nodes;
    }

    /// Strengths to velocities. With a = w_x + i w_y and b = w_z, the kernel's K_x, K_y, K_z real and odd, the
    /// components of w x K are u_x + i u_y = -i K_z * a + i (K_x + i K_y) * b, and u_z the imaginary part of -(K_x -
    /// i K_y) * a; the spectra of K are -i times real numbers. Lines that hold zeros only are not transformed.
    fn convolve(&mut self, has_any: bool) {
        if !has_any {
            return; // the nodes are zero
        }
        let ([_, _, nz], [mx, my, _]) = (self.size, self.kernel.padded);
        for buffer in [&mut self.planes, &mut self.columns] {
            buffer.resize(nz * mx * my, NOTHING);
        }
        self.lines.resize_with(nz.max(mx), Lines::default);
        self.forward_in_planes();
        self.multiply_in_columns();
        self.backward_in_planes();
    }

    /// Transforms of the strengths along x and y, plane after plane.
    fn forward_in_planes(&mut self) {
        let ([nx, ny, _], [mx, my, _]) = (self.size, self.kernel.padded);
        let kernel = &self.kernel;
        let plane = nx * ny;
        let planes = self.planes.par_chunks_mut(mx * my).zip(&mut self.lines);
        planes
            .zip(self.nodes.par_chunks(plane))
            .for_each(|((out, lines), nodes)| {
                for (group, rows) in nodes.chunks(LANES * nx).enumerate() {
                    let at = |i: usize, l: usize| rows.get(l * nx + i).map_or(NOTHING, fields);
                    lines.fill(mx, nx, at);
                    lines.transform(&*kernel.transforms[0].forward);
                    for (l, j) in (group * LANES..ny).take(LANES).enumerate() {
                        (0..mx).for_each(|i| out[i * my + j] = lines.at(i, l));
                    }
                }
                for group in out.chunks_mut(LANES * my) {
                    lines.fill(my, ny, |j, l| {
                        group.get(l * my + j).copied().unwrap_or(NOTHING)
                    });
                    lines.transform(&*kernel.transforms[1].forward);
                    for (l, line) in group.chunks_mut(my).enumerate() {
                        (0..my).for_each(|j| line[j] = lines.at(j, l));
                    }
                }
            });
    }

    /// Along z, column after column: transformed, multiplied by the kernel, transformed back.
    fn multiply_in_columns(&mut self) {
        let ([_, _, nz], [mx, my, mz]) = (self.size, self.kernel.padded);
        let kernel = &self.kernel;
        let (planes, columns) = (&self.planes, self.columns.par_chunks_mut(nz * my));
        columns
            .zip(&mut self.lines)
            .enumerate()
            .for_each(|(i, (column, lines))| {
                for (k, line) in column.chunks_mut(my).enumerate() {
                    let from = (k * mx + i) * my;
                    line.copy_from_slice(&planes[from..from + my]);
                }
                for first in (0..my).step_by(LANES) {
                    let own = |l: usize| (first + l).min(my - 1);
                    lines.fill(mz, nz, |k, l| column[k * my + own(l)]);
                    lines.transform(&*kernel.transforms[2].forward);
                    kernel.multiply([i, first], lines);
                    lines.transform(&*kernel.transforms[2].backward);
                    for (l, j) in (first..my).take(LANES).enumerate() {
                        (0..nz).for_each(|k| column[k * my + j] = lines.at(k, l));
                    }
                }
            });
    }

    /// Transforms back along y and x, plane after plane: velocities at the nodes.
    fn backward_in_planes(&mut self) {
        let ([nx, ny, nz], [mx, my, mz]) = (self.size, self.kernel.padded);
        let (kernel, scale) = (&self.kernel, 1.0 / (self.spacing * self.spacing));
        let plane = nx * ny;
        let columns = &self.columns;
        let scale = scale as f32 / (mx * my * mz) as f32;
        let planes = self.planes.par_chunks_mut(mx * my).zip(&mut self.lines);
        planes
            .zip(self.nodes.par_chunks_mut(plane))
            .enumerate()
            .for_each(|(k, ((rows, lines), nodes))| {
                for first in (0..mx).step_by(LANES) {
                    let own = |l: usize| ((first + l).min(mx - 1) * nz + k) * my;
                    lines.fill(my, my, |j, l| columns[own(l) + j]);
                    lines.transform(&*kernel.transforms[1].backward);
                    for (l, i) in (first..mx).take(LANES).enumerate() {
                        (0..ny).for_each(|j| rows[j * mx + i] = lines.at(j, l));
                    }
                }
                let rows = rows[..ny * mx].chunks(LANES * mx);
                for (rows, nodes) in rows.zip(nodes.chunks_mut(LANES * nx)) {
                    lines.fill(mx, mx, |i, l| {
                        rows.get(l * mx + i).copied().unwrap_or(NOTHING)
                    });
                    lines.transform(&*kernel.transforms[0].backward);
                    for (l, line) in nodes.chunks_mut(nx).enumerate() {
                        for (i, node) in line.iter_mut().enumerate() {
                            let [u, w] = lines.at(i, l);
                            *node = [scale * u.re, scale * u.im, scale * w.im, 0.0];
                        }
                    }
                }
            });
    }

    /// Adds the velocities of a mesh of twice the spacing and the same corner.
    fn add_coarse(&mut self, coarse: &Self) {
        let [nx, ny, nz] = coarse.size;
        let [fx, fy, _] = self.size;
        // Fine node 2 (i - MARGIN) + k - 3 + MARGIN hears of coarse node i.
        let reach = |fine: usize, count: usize| {
            (0..=ORDER).filter_map(move |k| {
                let twice = fine + 3 + MARGIN;
                let i = twice.checked_sub(k).filter(|d| d % 2 == 0)? / 2;
                (i < count).then_some((i, REFINE[k]))
            })
        };
        let plane = fx * fy;
        let room = nx * ny + nx;
        self.carried
            .resize(self.nodes.len() / plane * room, Node::default());
        let planes = self
            .nodes
            .par_chunks_mut(plane)
            .zip(self.carried.par_chunks_mut(room));
        planes.enumerate().for_each(|(z, (nodes, scratch))| {
            let (sheet, line) = scratch.split_at_mut(nx * ny);
            let line = &mut line[..nx];
            sheet.fill(Node::default());
            for (k, w) in reach(z, nz) {
                let from = &coarse.nodes[k * nx * ny..(k + 1) * nx * ny];
                sheet.iter_mut().zip(from).for_each(|(s, n)| add(s, w, n));
            }
            for (y, row) in nodes.chunks_mut(fx).enumerate() {
                line.fill(Node::default());
                for (j, w) in reach(y, ny) {
                    let from = &sheet[j * nx..(j + 1) * nx];
                    line.iter_mut().zip(from).for_each(|(s, n)| add(s, w, n));
                }
                for (x, node) in row.iter_mut().enumerate() {
                    for (i, w) in reach(x, nx) {
                        add(node, w, &line[i]);
                    }
                }
            }
        });
    }
}

const NOTHING: Pair = [Complex32::new(0.0, 0.0); 2];

/// The two complex fields of a node's strength.
fn fields(node: &Node) -> Pair {
    [
        Complex32::new(node[0], node[1]),
        Complex32::new(node[2], 0.0),
    ]
}

fn add(sum: &mut Node, weight: f32, node: &Node) {
    for c in 0..4 {
        sum[c] += weight * node[c];
    }
}

/// Spectrum of the velocity of one blob, on nodes of unit distance.
#[derive(Clone, Default)]
struct Kernel {
    size: [usize; 3],
    /// Width of the blob, in nodes.
    width: f64,
    /// Nodes of the transforms.
    padded: [usize; 3],
    transforms: Vec<Transform>,
    /// i times the spectra of K_x, K_y, K_z on the wave numbers 0 to padded / 2 along each axis, z fastest: the others
    /// follow by symmetry.
    octant: Vec<[f32; 3]>,
}

impl std::fmt::Debug for Kernel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Kernel of {:?}", self.size)
    }
}

impl Kernel {
    /// Makes it the one for meshes of this size, if it is not.
    fn fit(&mut self, size: [usize; 3], width: f64) {
        if self.size == size && self.width == width {
            return;
        }
        (self.size, self.width) = (size, width);
        // Twice the nodes, and room for what the splines' inverse smears.
        self.padded = size.map(|n| good_length(2 * n + QUANTUM));
        self.transforms = self.padded.map(Transform::new).into();
        self.tabulate();
    }

    fn tabulate(&mut self) {
        let half = self.padded.map(|m| m / 2 + 1);
        let count: usize = half.iter().product();
        let width = self.width;
        let mut table = vec![[0.0; 3]; count];
        table
            .par_chunks_mut(half[1] * half[2])
            .enumerate()
            .for_each(|(i, plane)| {
                for (at, value) in plane.iter_mut().enumerate() {
                    let r = [i, at / half[2], at % half[2]].map(|n| n as f64);
                    let z = r.iter().map(|r| r * r).sum::<f64>() / (width * width);
                    let g = swirl_of(z) / width.powi(3);
                    *value = r.map(|r| g * r);
                }
            });
        // One axis after the other: sines for the component along it, cosines for the others.
        for axis in 0..3 {
            let (m, n) = (self.padded[axis], half[axis]);
            let waves = |q: usize, r: usize| {
                let phase = std::f64::consts::TAU * ((q * r) % m) as f64 / m as f64;
                let ends = r == 0 || r == n - 1;
                [
                    2.0 * phase.sin(),
                    if ends { 1.0 } else { 2.0 } * phase.cos(),
                ]
            };
            let waves: Vec<[f64; 2]> = (0..n * n).map(|k| waves(k / n, k % n)).collect();
            let inner: usize = half[axis + 1..].iter().product();
            let mut next = vec![[0.0; 3]; count];
            let lines = next.par_chunks_mut(inner).enumerate();
            lines.for_each(|(line, sums)| {
                let (outer, q) = (line / n, line % n);
                let inverse = 1.0 / transfer(std::f64::consts::TAU * q as f64 / m as f64);
                let from = table[outer * n * inner..].chunks_exact(inner);
                for (from, [sine, cosine]) in from.zip(&waves[q * n..(q + 1) * n]) {
                    let wave: [_; 3] = from_fn(|c| if c == axis { sine } else { cosine });
                    for (sum, x) in sums.iter_mut().zip(from) {
                        for c in 0..3 {
                            sum[c] += x[c] * wave[c];
                        }
                    }
                }
                sums.iter_mut()
                    .for_each(|sum| *sum = sum.map(|s| s * inverse));
            });
            table = next;
        }
        self.octant.clear();
        self.octant
            .extend(table.iter().map(|t| t.map(|t| t as f32)));
    }

    /// Multiplies the spectra on the lines along z from the one at (i, j) on by the kernel's.
    fn multiply(&self, [i, j]: [usize; 2], lines: &mut Lines) {
        let [mx, my, mz] = self.padded;
        let fold = |i: usize, m: usize| {
            if i <= m / 2 {
                (i, 1.0_f32)
            } else {
                (m - i, -1.0)
            }
        };
        let (i, sx) = fold(i, mx);
        let half = [my / 2 + 1, mz / 2 + 1];
        let rows: [_; LANES] = from_fn(|l| {
            let (j, sy) = fold((j + l).min(my - 1), my);
            (half[1] * (j + half[0] * i), sy)
        });
        lines.multiply(|k| {
            let (k, sz) = fold(k, mz);
            let mut out = [[0.0; LANES]; 3];
            for (l, (row, sy)) in rows.iter().enumerate() {
                let [x, y, z] = self.octant[row + k];
                (out[0][l], out[1][l], out[2][l]) = (sx * x, sy * y, sz * z);
            }
            out
        });
    }
}
