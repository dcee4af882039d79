//! Fourier transforms of four lines at once, with the same operations on every processor.
//!
//! The transforms are rustfft's; numbers of four lanes make vectors of them without any choice of instructions.

use rustfft::num_complex::{Complex, Complex32};
use rustfft::num_traits::{FromPrimitive, Num, One, Signed, Zero};
use rustfft::{Fft, FftPlannerScalar};
use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Rem, Sub};
use std::sync::Arc;

/// Lines that are transformed together.
pub(crate) const LANES: usize = 4;

/// The same number of each line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Lanes([f32; LANES]);

/// Values of both fields.
pub(crate) type Pair = [Complex32; 2];

/// Two complex fields on [`LANES`] lines.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lines {
    fields: [Vec<Complex<Lanes>>; 2],
    scratch: Vec<Complex<Lanes>>,
}

impl Lines {
    /// Makes them `value(i, line)` for i below `used`, and zeros up to `length`.
    #[inline(always)]
    pub fn fill(&mut self, length: usize, used: usize, value: impl Fn(usize, usize) -> Pair) {
        for field in &mut self.fields {
            field.clear();
            field.resize(length, Complex::zero());
        }
        let [a, b] = &mut self.fields;
        for (i, (a, b)) in a.iter_mut().zip(b).take(used).enumerate() {
            for l in 0..LANES {
                let [x, y] = value(i, l);
                (a.re.0[l], a.im.0[l]) = (x.re, x.im);
                (b.re.0[l], b.im.0[l]) = (y.re, y.im);
            }
        }
    }

    /// Values number `i` of a line.
    #[inline(always)]
    pub fn at(&self, i: usize, lane: usize) -> Pair {
        let (a, b) = (&self.fields[0][i], &self.fields[1][i]);
        [
            Complex::new(a.re.0[lane], a.im.0[lane]),
            Complex::new(b.re.0[lane], b.im.0[lane]),
        ]
    }

    /// Multiplies with a spectrum, i times which is x, y, z of `kernel(k)` at wave number k, three real numbers of each
    /// line: a becomes (x + i y) b - z a, and b becomes (y + i x) a.
    #[inline(always)]
    pub fn multiply(&mut self, kernel: impl Fn(usize) -> [[f32; LANES]; 3]) {
        let [first, second] = &mut self.fields;
        for (k, (a, b)) in first.iter_mut().zip(second).enumerate() {
            let [x, y, z] = kernel(k);
            let (x, y, z) = (Lanes(x), Lanes(y), Lanes(z));
            let turned = Complex::new(y, x) * *a;
            *a = Complex::new(x, y) * *b - a.scale(z);
            *b = turned;
        }
    }

    pub fn transform(&mut self, by: &dyn Fft<Lanes>) {
        let length = by.get_inplace_scratch_len().max(self.scratch.len());
        self.scratch.resize(length, Complex::zero());
        for field in &mut self.fields {
            by.process_with_scratch(field, &mut self.scratch);
        }
    }
}

/// Forward and backward, neither divided by the length.
#[derive(Clone)]
pub(crate) struct Transform {
    pub forward: Arc<dyn Fft<Lanes>>,
    pub backward: Arc<dyn Fft<Lanes>>,
}

impl Transform {
    pub fn new(length: usize) -> Self {
        let mut planner = FftPlannerScalar::new();
        Self {
            forward: planner.plan_fft_forward(length),
            backward: planner.plan_fft_inverse(length),
        }
    }
}

/// The next even number without prime factors above five.
pub(crate) fn good_length(min: usize) -> usize {
    let is_good = |&n: &usize| {
        let mut rest = n;
        for p in [2, 3, 5] {
            while rest % p == 0 {
                rest /= p;
            }
        }
        rest == 1 && n % 2 == 0
    };
    (min.max(2)..)
        .find(is_good)
        .expect("powers of two have no end")
}

macro_rules! by_lanes {
    ($($trait:ident $method:ident),*) => {
        $(impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
                Self([a.$method(e), b.$method(f), c.$method(g), d.$method(h)])
            }
        })*
    };
}

by_lanes!(Add add, Sub sub, Mul mul, Div div, Rem rem);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([-a, -b, -c, -d])
    }
}

impl Zero for Lanes {
    #[inline(always)]
    fn zero() -> Self {
        Self([0.0; LANES])
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for Lanes {
    #[inline(always)]
    fn one() -> Self {
        Self([1.0; LANES])
    }
}

impl Num for Lanes {
    type FromStrRadixErr = <f32 as Num>::FromStrRadixErr;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f32::from_str_radix(text, radix).map(|x| Self([x; LANES]))
    }
}

impl Signed for Lanes {
    fn abs(&self) -> Self {
        Self(self.0.map(f32::abs))
    }
    fn abs_sub(&self, other: &Self) -> Self {
        Self(from_fn(|l| (self.0[l] - other.0[l]).max(0.0)))
    }
    fn signum(&self) -> Self {
        Self(self.0.map(f32::signum))
    }
    fn is_positive(&self) -> bool {
        self.0.iter().all(|x| *x > 0.0)
    }
    fn is_negative(&self) -> bool {
        self.0.iter().all(|x| *x < 0.0)
    }
}

impl FromPrimitive for Lanes {
    fn from_i64(n: i64) -> Option<Self> {
        Some(Self([n as f32; LANES]))
    }
    fn from_u64(n: u64) -> Option<Self> {
        Some(Self([n as f32; LANES]))
    }
    fn from_f64(n: f64) -> Option<Self> {
        Some(Self([n as f32; LANES]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every lane against the sum that defines the transform; and back again.
    #[test]
    fn exact_transform() {
        let n = 12;
        let value = |i: usize, l: usize| {
            let x = (7 * i + 3 * l) as f32;
            [Complex::new(x.sin(), x.cos()), Complex::new(0.5, x.sin())]
        };
        let mut lines = Lines::default();
        lines.fill(n, n - 2, value);
        let transform = Transform::new(n);
        lines.transform(&*transform.forward);
        for lane in 0..LANES {
            for k in 0..n {
                let wave =
                    |i: usize| Complex::cis(-std::f32::consts::TAU * (i * k % n) as f32 / n as f32);
                for f in 0..2 {
                    let sum: Complex32 = (0..n - 2).map(|i| value(i, lane)[f] * wave(i)).sum();
                    let error = (lines.at(k, lane)[f] - sum).norm();
                    assert!(error < 5e-6, "{k} {lane} {f}: {error:e}"); // roundings, of the sum too
                }
            }
        }
        lines.transform(&*transform.backward);
        let back = lines.at(4, 1)[0] / n as f32 - value(4, 1)[0];
        assert!(back.norm() < 5e-7);
        assert!(lines.at(n - 1, 2)[1].norm() < 5e-6);
    }

    #[test]
    fn exact_good_lengths() {
        assert_eq!([1, 7, 31, 122, 128].map(good_length), [2, 8, 32, 128, 128]);
    }
}
