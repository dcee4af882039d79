//! Moments of the vector potential: sums of q R_nm(s) over points s with strengths q.

use fearless_simd::{Simd, f64x8, prelude::*};
use glam::DVec3;

/// Highest order P offered.
pub(crate) const MAX_ORDER: usize = 12;

/// A complex number.
pub(crate) type Complex = [f64; 2];

/// M_nm of the three components of the vector potential, at n (n + 1)/2 + m.
pub(crate) type Moment = [Complex; 3];

const MOMENTS: usize = MAX_ORDER * (MAX_ORDER + 1) / 2;

/// Running sums over points; lanes are eight points, whatever the processor, so that the order of
/// the sums is the same everywhere.
pub(crate) struct Moments<S: Simd> {
    simd: S,
    order: usize,
    sums: [[f64x8<S>; 6]; MOMENTS],
    /// Points that wait: s and q, component by component.
    batch: [[f64; 8]; 6],
    waiting: usize,
}

impl<S: Simd> Moments<S> {
    /// Moments 0 <= n <= `order`.
    #[inline(always)]
    pub fn new(simd: S, order: usize) -> Self {
        let sums = [[f64x8::splat(simd, 0.0); 6]; MOMENTS];
        Self {
            simd,
            order,
            sums,
            batch: [[0.0; 8]; 6],
            waiting: 0,
        }
    }

    /// Adds the point at `s` from the centre with strength `q`.
    #[inline(always)]
    pub fn add(&mut self, s: DVec3, q: DVec3) {
        for (lane, value) in self.batch.iter_mut().zip([s.x, s.y, s.z, q.x, q.y, q.z]) {
            lane[self.waiting] = value;
        }
        self.waiting += 1;
        if self.waiting == 8 {
            self.take_batch();
        }
    }

    /// R_nm of the eight points, column by column, times their strengths.
    #[inline(always)]
    fn take_batch(&mut self) {
        let [x, y, z, qx, qy, qz] = self.batch.map(|c| f64x8::from_slice(self.simd, &c));
        let r2 = x * x + y * y + z * z;
        let zero = f64x8::splat(self.simd, 0.0);
        let (mut re, mut im) = (f64x8::splat(self.simd, 1.0), zero);
        for m in 0..=self.order {
            if m > 0 {
                let half = 0.5 / m as f64;
                (re, im) = ((re * x - im * y) * half, (re * y + im * x) * half);
            }
            let (mut old, mut new) = ([zero; 2], [re, im]);
            for n in m..=self.order {
                if n > m {
                    let back = 1.0 / ((n * n - m * m) as f64);
                    let (up, down) = (z * ((2 * n - 1) as f64 * back), r2 * back);
                    (old, new) = (
                        new,
                        [up * new[0] - down * old[0], up * new[1] - down * old[1]],
                    );
                }
                let sum = &mut self.sums[n * (n + 1) / 2 + m];
                for (i, q) in [qx, qy, qz].into_iter().enumerate() {
                    sum[2 * i] += q * new[0];
                    sum[2 * i + 1] += q * new[1];
                }
            }
        }
        self.batch = [[0.0; 8]; 6];
        self.waiting = 0;
    }

    /// The moments of all points, zero beyond the order.
    #[inline(always)]
    pub fn total(&mut self) -> [Moment; MOMENTS] {
        if self.waiting > 0 {
            self.take_batch();
        }
        let add = |v: f64x8<S>| v.as_slice().iter().sum::<f64>();
        let mut total = [[[0.0; 2]; 3]; MOMENTS];
        let count = (self.order + 1) * (self.order + 2) / 2;
        for (total, s) in total[..count].iter_mut().zip(&self.sums) {
            *total = [
                [add(s[0]), add(s[1])],
                [add(s[2]), add(s[3])],
                [add(s[4]), add(s[5])],
            ];
        }
        total
    }
}

/// R_nm(d) of both signs of m for n <= `order`, at [`square_index`].
pub(crate) fn regular(order: usize, d: DVec3) -> [Complex; MAX_ORDER * MAX_ORDER] {
    let mut r = [[0.0; 2]; MAX_ORDER * MAX_ORDER];
    let (mut re, mut im) = (1.0, 0.0);
    for m in 0..=order {
        if m > 0 {
            let half = 0.5 / m as f64;
            (re, im) = ((re * d.x - im * d.y) * half, (re * d.y + im * d.x) * half);
        }
        let (mut old, mut new) = ([0.0; 2], [re, im]);
        for n in m..=order {
            if n > m {
                let back = 1.0 / ((n * n - m * m) as f64);
                let (up, down) = ((2 * n - 1) as f64 * back * d.z, d.length_squared() * back);
                (old, new) = (
                    new,
                    [up * new[0] - down * old[0], up * new[1] - down * old[1]],
                );
            }
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            r[square_index(n, -(m as isize))] = [sign * new[0], -sign * new[1]];
            r[square_index(n, m as isize)] = new;
        }
    }
    r
}

/// Place of (n, m), -n <= m <= n.
pub(crate) fn square_index(n: usize, m: isize) -> usize {
    n * n + (n as isize + m) as usize
}
