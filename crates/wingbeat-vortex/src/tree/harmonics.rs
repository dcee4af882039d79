//! Far field of a cluster of vortex segments: solid harmonics of the velocity.
//!
//! With 1/|r - s| = sum over n, m of conj(R_nm(s)) T_nm(r), abs(s) < abs(r), where
//!
//! - R_nm regular: R_00 = 1, R_nn = (x + i y)/(2n) R_(n-1)(n-1),
//!   (n^2 - m^2) R_nm = (2n - 1) z R_(n-1)m - (x^2 + y^2 + z^2) R_(n-2)m,
//! - T_nm irregular: T_00 = 1/r, T_nn = (2n - 1)(x + i y)/r^2 T_(n-1)(n-1),
//!   r^2 T_nm = (2n - 1) z T_(n-1)m - ((n - 1)^2 - m^2) T_(n-2)m,
//!
//! and both change by m -> -m into (-1)^m times the conjugate [Dehnen 2014, Comput. Astrophys.
//! Cosmol. 1:1, appendix A; the sign (-1)^m of both left out].
//!
//! The vector potential Gamma/(4 pi) of the segments has moments M_nm = integral of
//! Gamma/(4 pi) R_nm(s) dl, n <= p; its curl follows from d/dz T_nm = -T_(n+1)m,
//! (d/dx + i d/dy) T_nm = -T_(n+1)(m+1), (d/dx - i d/dy) T_nm = T_(n+1)(m-1). The velocity is then
//! v = sum of conj(N_nm) T_nm over 1 <= n <= P = p + 1, each N_nm a complex 3-vector.

use crate::cores::INV_4PI;
use crate::quadrature::gauss_legendre;
use crate::sources::Network;
use crate::tree::moments::{Complex, MAX_ORDER, Moment, Moments, regular, square_index};
use fearless_simd::{Simd, prelude::*};
use glam::DVec3;

/// Real and imaginary parts of the three components of N_nm: x, i x, y, i y, z, i z.
pub(crate) type Coefficient = [f64; 6];

/// What depends on the order only. Coefficients of a cell stand column by column: m, then n from
/// max(m, 1) to P.
#[derive(Clone, Debug)]
pub(crate) struct Harmonics {
    /// P, even.
    pub order: usize,
    /// Where column m begins.
    offset: [usize; MAX_ORDER + 2],
    /// (n^2 - m^2) / ((2n + 1)(2n - 1)), the factor of t_(n-1) in t_(n+1).
    back: Vec<f64>,
    /// (2 - [m = 0]) (2n - 1)!!: from N_nm to the coefficients of t_nm = T_nm / (2n - 1)!!.
    scale: Vec<f64>,
    /// (2 - [m = 0]) (n - m)! (n + m)! / (2n + 1): mean square of T_nm on the unit sphere.
    power: Vec<f64>,
    /// Gauss-Legendre points on (0, 1) and weights, exact to degree P - 1.
    quadrature: Vec<(f64, f64)>,
}

impl Harmonics {
    /// Tables for order P, an even number from 2 to [`MAX_ORDER`].
    pub fn new(order: usize) -> Self {
        assert!(
            order.is_multiple_of(2) && (2..=MAX_ORDER).contains(&order),
            "order {order}"
        );
        let mut new = Self {
            order,
            offset: [0; MAX_ORDER + 2],
            back: vec![],
            scale: vec![],
            power: vec![],
            quadrature: gauss_legendre(order / 2),
        };
        for m in 0..=order {
            (m.max(1)..=order).for_each(|n| new.push_factors(n as f64, m as f64));
            new.offset[m + 1] = new.back.len();
        }
        new
    }

    fn push_factors(&mut self, n: f64, m: f64) {
        let twice = if m > 0.0 { 2.0 } else { 1.0 };
        self.back
            .push((n * n - m * m) / ((2.0 * n + 1.0) * (2.0 * n - 1.0)));
        self.scale.push(twice * product(1.0, 2.0, 2.0 * n - 1.0));
        let factorials = product(1.0, 1.0, n - m) * product(1.0, 1.0, n + m);
        self.power.push(twice * factorials / (2.0 * n + 1.0));
    }

    /// Coefficients of a cell.
    pub fn len(&self) -> usize {
        self.back.len()
    }

    /// Place of N_nm, m >= 0.
    fn at(&self, n: usize, m: usize) -> usize {
        self.offset[m] + n - m.max(1)
    }

    /// Sets `out` to the N_nm of these edges about `centre`.
    #[inline(always)]
    pub fn expand<S: Simd>(
        &self,
        simd: S,
        network: &Network,
        edges: impl Iterator<Item = u32>,
        centre: DVec3,
        out: &mut [Coefficient],
    ) {
        let mut moments = Moments::new(simd, self.order - 1);
        for e in edges {
            let (a, b) = network.ends(e as usize);
            let dl = (b - a) * (network.gamma[e as usize] * INV_4PI);
            for &(t, w) in &self.quadrature {
                moments.add(a + t * (b - a) - centre, dl * w);
            }
        }
        self.curl(&moments.total(), out);
    }

    /// N of the velocity from M of the vector potential: N_x = N_y[A_z] - N_z[A_y] and so on.
    fn curl(&self, moments: &[Moment], out: &mut [Coefficient]) {
        for n in 0..self.order {
            for l in 0..=n + 1 {
                let at = |l: isize| signed(moments, n, l);
                let (low, mid, high) = (at(l as isize - 1), at(l as isize), at(l as isize + 1));
                let dx = |k: usize| [0, 1].map(|c| 0.5 * (high[k][c] - low[k][c]));
                let dy = |k: usize| {
                    [
                        0.5 * (low[k][1] + high[k][1]),
                        -0.5 * (low[k][0] + high[k][0]),
                    ]
                };
                let dz = |k: usize| mid[k].map(|c| -c);
                let [x, y, z] = [sub(dy(2), dz(1)), sub(dz(0), dx(2)), sub(dx(1), dy(0))];
                out[self.at(n + 1, l)] = [x[0], x[1], y[0], y[1], z[0], z[1]];
            }
        }
    }

    /// Adds to `out` the coefficients `from` of a cell whose centre is at `d` from the new one:
    /// N_nm += sum over k, l of R_kl(d) N_(n-k)(m-l).
    pub fn shift(&self, from: &[Coefficient], d: DVec3, out: &mut [Coefficient]) {
        let r = regular(self.order - 1, d);
        let full = self.both_signs(from);
        for m in 0..=self.order {
            for n in m.max(1)..=self.order {
                let mut sum = [0.0; 6];
                for k in 0..n {
                    let (m, k_, rest) = (m as isize, k as isize, (n - k) as isize);
                    for l in (-k_).max(m - rest)..=k_.min(m + rest) {
                        let [re, im] = r[square_index(k, l)];
                        let c = &full[square_index(n - k, m - l)];
                        for i in [0, 2, 4] {
                            sum[i] += re * c[i] - im * c[i + 1];
                            sum[i + 1] += re * c[i + 1] + im * c[i];
                        }
                    }
                }
                let out = &mut out[self.at(n, m)];
                out.iter_mut().zip(sum).for_each(|(o, s)| *o += s);
            }
        }
    }

    /// The N_nm with the negative m, at [`square_index`].
    fn both_signs(&self, from: &[Coefficient]) -> [Coefficient; (MAX_ORDER + 1).pow(2)] {
        let mut full = [[0.0; 6]; (MAX_ORDER + 1).pow(2)];
        for n in 1..=self.order {
            for m in 0..=n {
                let c = from[self.at(n, m)];
                let s = if m % 2 == 0 { 1.0 } else { -1.0 };
                full[square_index(n, -(m as isize))] = [
                    s * c[0],
                    -s * c[1],
                    s * c[2],
                    -s * c[3],
                    s * c[4],
                    -s * c[5],
                ];
                full[square_index(n, m as isize)] = c;
            }
        }
        full
    }

    /// Root mean square over directions of the part of order n at distance 1.
    pub fn strength(&self, n: usize, c: &[Coefficient]) -> f64 {
        let square = |m: usize| c[self.at(n, m)].iter().map(|v| v * v).sum::<f64>();
        (0..=n)
            .map(|m| self.power[self.at(n, m)] * square(m))
            .sum::<f64>()
            .sqrt()
    }

    /// From N_nm to what [`Harmonics::velocity`] wants.
    pub fn finish(&self, c: &mut [Coefficient]) {
        for (c, s) in c.iter_mut().zip(&self.scale) {
            c.iter_mut().for_each(|v| *v *= s);
        }
    }

    /// Velocity at `r` from the centre, from finished coefficients, one column after the other:
    /// t_mm = (x + i y)/r^2 t_(m-1)(m-1), t_(n+1)m = z/r^2 t_nm - back/r^2 t_(n-1)m. `P` is the
    /// order, known to the compiler so that it can lay out the loops.
    #[inline(always)]
    pub fn velocity<S: Simd, const P: usize>(
        &self,
        simd: S,
        r: [S::f64s; 3],
        c: &[Coefficient],
    ) -> [S::f64s; 3] {
        let (c, back) = (&c[..length(P)], &self.back[..length(P)]);
        let u = S::f64s::splat(simd, 1.0) / (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        let [x, y, z] = r.map(|r| r * u);
        let zero = S::f64s::splat(simd, 0.0);
        let mut v = [zero; 3];
        let (mut re, mut im) = (u.sqrt(), zero);
        let (mut old, mut new) = (re, re * z);
        for k in 0..P {
            if k > 0 {
                (old, new) = (new, new * z - old * (u * back[k - 1]));
            }
            for i in 0..3 {
                v[i] += new * c[k][2 * i];
            }
        }
        let mut at = P;
        for m in 1..=P {
            (re, im) = (re * x - im * y, re * y + im * x);
            let (mut old, mut new) = ([zero; 2], [re, im]);
            for n in m..=P {
                if n > m {
                    let ub = u * back[at - 1];
                    (old, new) = (new, [new[0] * z - old[0] * ub, new[1] * z - old[1] * ub]);
                }
                for i in 0..3 {
                    v[i] += new[0] * c[at][2 * i] + new[1] * c[at][2 * i + 1];
                }
                at += 1;
            }
        }
        v
    }
}

/// Coefficients of a cell at order `p`: a column of p for m = 0, then p, p - 1, ..., 1.
const fn length(p: usize) -> usize {
    p + p * (p + 1) / 2
}

/// M_nl with l of either sign; zero beyond n.
fn signed(moments: &[Moment], n: usize, l: isize) -> [Complex; 3] {
    let m = l.unsigned_abs();
    if m > n {
        return [[0.0; 2]; 3];
    }
    let c = moments[n * (n + 1) / 2 + m];
    match (l < 0, m % 2) {
        (false, _) => c,
        (true, 0) => c.map(|[re, im]| [re, -im]),
        (true, _) => c.map(|[re, im]| [-re, im]),
    }
}

fn sub(a: Complex, b: Complex) -> Complex {
    [a[0] - b[0], a[1] - b[1]]
}

/// from (from + step) (from + 2 step) ... up to `to`.
fn product(from: f64, step: f64, to: f64) -> f64 {
    std::iter::successors(Some(from), |k| Some(k + step))
        .take_while(|k| *k <= to)
        .product()
}
