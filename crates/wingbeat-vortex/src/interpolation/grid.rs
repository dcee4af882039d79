//! Interpolation between Chebyshev points in a box of four dimensions: place and softening.
//!
//! A function of place p and softening q is replaced by the polynomial that has its values at the points of a grid,
//! `f(p, q) = sum L_i(x) L_j(y) L_k(z) L_l(q) f_ijkl`, L the polynomials of Lagrange. Read the other way
//! round, the same sum replaces a source by sources at the points of the grid.

use glam::DVec3;

/// Points along a direction, at most.
pub(crate) const MOST: usize = 8;

/// Numbers at each point of a grid, at most: two vectors.
pub(crate) const VALUES: usize = 6;

/// A place [m] and half a squared core radius [m2].
pub(crate) type Place = [f64; 4];

/// The place and its softening.
pub(crate) fn place(p: DVec3, softening: f64) -> Place {
    [p.x, p.y, p.z, softening]
}

/// A box: its middle and its half sides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Frame {
    pub middle: Place,
    pub half: Place,
}

impl Frame {
    /// The box between two corners.
    pub fn between(low: Place, high: Place) -> Self {
        Self {
            middle: std::array::from_fn(|d| 0.5 * (low[d] + high[d])),
            half: std::array::from_fn(|d| 0.5 * (high[d] - low[d])),
        }
    }

    /// Coordinate along direction d, from -1 to 1 in the box; 0 where it has no extent.
    fn coordinate(&self, d: usize, value: f64) -> f64 {
        match self.half[d] > 0.0 {
            true => (value - self.middle[d]) / self.half[d],
            false => 0.0,
        }
    }
}

/// Roots of a Chebyshev polynomial, and the inverses of the products of their differences.
#[derive(Clone, Copy, Debug)]
struct Line {
    count: usize,
    root: [f64; MOST],
    scale: [f64; MOST],
}

impl Line {
    fn new(count: usize) -> Self {
        assert!((1..=MOST).contains(&count), "{count} points");
        let mut root = [0.0; MOST];
        for (i, root) in root[..count].iter_mut().enumerate() {
            *root = ((2 * i + 1) as f64 * std::f64::consts::PI / (2 * count) as f64).cos();
        }
        let others = |i: usize| (0..count).filter(move |&j| j != i);
        let mut scale = [0.0; MOST];
        for (i, scale) in scale[..count].iter_mut().enumerate() {
            *scale = others(i)
                .map(|j| root[i] - root[j])
                .product::<f64>()
                .recip();
        }
        Self { count, root, scale }
    }

    /// L_i(t) of all points.
    fn basis(&self, t: f64) -> [f64; MOST] {
        let mut basis = self.scale;
        let mut before = 1.0;
        for i in 0..self.count {
            basis[i] *= before;
            before *= t - self.root[i];
        }
        let mut after = 1.0;
        for i in (0..self.count).rev() {
            basis[i] *= after;
            after *= t - self.root[i];
        }
        basis
    }
}

/// The points of a grid: as many along each direction of space, and along that of softening.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    space: Line,
    soft: Line,
}

impl Grid {
    /// So many points along each direction of space, and along that of softening.
    pub fn new([space, soft]: [usize; 2]) -> Self {
        let [space, soft] = [space, soft].map(Line::new);
        Self { space, soft }
    }

    /// Points in all; those of one softening follow each other.
    pub fn len(&self) -> usize {
        self.space.count.pow(3) * self.soft.count
    }

    fn line(&self, d: usize) -> &Line {
        if d < 3 { &self.space } else { &self.soft }
    }

    /// Offset of point number i from the middle of the box [m].
    pub fn offset(&self, frame: &Frame, i: usize) -> DVec3 {
        let n = self.space.count;
        let [z, y, x] = [i / (n * n) % n, i / n % n, i % n].map(|k| self.space.root[k]);
        DVec3::new(x * frame.half[0], y * frame.half[1], z * frame.half[2])
    }

    /// Points along a direction.
    pub fn along(&self, d: usize) -> usize {
        self.line(d).count
    }

    /// Coordinate of point number i along a direction.
    pub fn root(&self, d: usize, i: usize) -> f64 {
        self.line(d).root[i]
    }

    /// L_i of all four directions at a place.
    fn bases(&self, frame: &Frame, at: Place) -> [[f64; MOST]; 4] {
        std::array::from_fn(|d| self.line(d).basis(frame.coordinate(d, at[d])))
    }

    /// Calls `take` with each point's number and what its value weighs at a place.
    fn weigh(&self, frame: &Frame, at: Place, mut take: impl FnMut(usize, f64)) {
        let [x, y, z, soft] = self.bases(frame, at);
        let (n, m) = (self.space.count, self.soft.count);
        let mut i = 0;
        for soft in &soft[..m] {
            for z in &z[..n] {
                for y in &y[..n] {
                    let before = soft * z * y;
                    for x in &x[..n] {
                        take(i, before * x);
                        i += 1;
                    }
                }
            }
        }
    }

    /// Replaces a source of this strength by sources at the points.
    pub fn spread(&self, frame: &Frame, at: Place, strength: DVec3, out: &mut [[f64; 3]]) {
        let strength = strength.to_array();
        self.weigh(frame, at, |i, weight| {
            for (out, strength) in out[i].iter_mut().zip(strength) {
                *out += weight * strength;
            }
        });
    }

    /// The function with these values, at a place.
    pub fn read(&self, frame: &Frame, at: Place, values: &[[f64; VALUES]]) -> [f64; VALUES] {
        let mut sum = [0.0; VALUES];
        self.weigh(frame, at, |i, weight| {
            for (sum, value) in sum.iter_mut().zip(values[i]) {
                *sum += weight * value;
            }
        });
        sum
    }

    /// Adds to sources at the points of a larger box those at the points of a smaller one inside.
    pub fn gather<const C: usize>(
        &self,
        [small, large]: [&Frame; 2],
        from: &[[f64; C]],
        room: &mut Room<C>,
        out: &mut [[f64; C]],
    ) {
        self.carry::<C, true>([small, large], from, room, out);
    }

    /// Adds to the values at the points of a smaller box those of the function with these values in a larger one.
    pub fn refine<const C: usize>(
        &self,
        [small, large]: [&Frame; 2],
        from: &[[f64; C]],
        room: &mut Room<C>,
        out: &mut [[f64; C]],
    ) {
        self.carry::<C, false>([small, large], from, room, out);
    }

    /// One direction after the other.
    fn carry<const C: usize, const GATHERS: bool>(
        &self,
        [small, large]: [&Frame; 2],
        from: &[[f64; C]],
        room: &mut Room<C>,
        out: &mut [[f64; C]],
    ) {
        let n = self.space.count;
        // Points between neighbours along a direction.
        let strides = [1, n, n * n, n * n * n];
        let Room([one, two]) = room;
        one.clear();
        one.extend_from_slice(from);
        for (d, stride) in strides.into_iter().enumerate() {
            let line = self.line(d);
            // Values of the large box's polynomials at the points of the small one.
            let points = line.root.map(|root| {
                let place = small.middle[d] + root * small.half[d];
                line.basis(large.coordinate(d, place))
            });
            two.clear();
            two.resize(one.len(), [0.0; C]);
            for first in (0..one.len()).filter(|i| (i / stride).is_multiple_of(line.count)) {
                for to in 0..line.count {
                    let sum = &mut two[first + to * stride];
                    for from in 0..line.count {
                        let weight = match GATHERS {
                            true => points[from][to],
                            false => points[to][from],
                        };
                        let value = &one[first + from * stride];
                        (sum.iter_mut().zip(value)).for_each(|(s, v)| *s += weight * v);
                    }
                }
            }
            std::mem::swap(one, two);
        }
        for (out, value) in out.iter_mut().zip(one) {
            out.iter_mut().zip(value).for_each(|(o, v)| *o += *v);
        }
    }
}

/// Memory of [`Grid::gather`] and [`Grid::refine`].
#[derive(Clone, Debug)]
pub(crate) struct Room<const C: usize>([Vec<[f64; C]>; 2]);

impl<const C: usize> Default for Room<C> {
    fn default() -> Self {
        Self([vec![], vec![]])
    }
}
