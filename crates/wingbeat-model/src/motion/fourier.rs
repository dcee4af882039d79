//! Fourier series of an angle.

use wingbeat_math::with_harmonics;

use crate::ModelError;
use crate::error::finite;
use std::f64::consts::TAU;

/// `q(x) = mean + sum_k cos[k] cos(2 pi (k+1) x) + sin[k] sin(2 pi (k+1) x)`, x in wingbeats.
/// The mean is not halved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fourier {
    /// Mean value \[rad\].
    pub mean: f64,
    /// Cosine coefficients of harmonics 1, 2, ... \[rad\].
    pub cos: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ... \[rad\].
    pub sin: Vec<f64>,
}

impl Fourier {
    /// Value and first two derivatives with respect to `x`.
    pub fn at(&self, x: f64) -> [f64; 3] {
        self.at_turn((TAU * x).sin_cos())
    }

    /// Whether it is its mean at all times.
    pub fn is_constant(&self) -> bool {
        self.cos.iter().chain(&self.sin).all(|c| *c == 0.0)
    }

    /// As [`Self::at`], from sine and cosine of 2 pi x; those of the harmonics follow by addition
    /// of angles, each with a rounding more.
    pub(crate) fn at_turn(&self, (s1, c1): (f64, f64)) -> [f64; 3] {
        let (mut s, mut c) = (0.0, 1.0);
        let turn = |_| {
            (s, c) = (s * c1 + c * s1, c * c1 - s * s1);
            (s, c)
        };
        let coefficients = [&*self.cos, &*self.sin];
        with_harmonics([self.mean, 0.0, 0.0], TAU, coefficients, turn)
    }

    /// The series times `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        let times = |v: &[f64]| v.iter().map(|c| c * factor).collect();
        Self {
            mean: self.mean * factor,
            cos: times(&self.cos),
            sin: times(&self.sin),
        }
    }

    /// The series `q(x + shift)`, shift in wingbeats.
    pub fn shifted(&self, shift: f64) -> Self {
        let n = self.cos.len().max(self.sin.len());
        let get = |v: &[f64], k: usize| v.get(k).copied().unwrap_or(0.0);
        let turn = |k: usize| (TAU * (k + 1) as f64 * shift).sin_cos();
        let cos = |k| {
            let (s, c) = turn(k);
            get(&self.cos, k) * c + get(&self.sin, k) * s
        };
        let sin = |k| {
            let (s, c) = turn(k);
            get(&self.sin, k) * c - get(&self.cos, k) * s
        };
        Self {
            mean: self.mean,
            cos: (0..n).map(cos).collect(),
            sin: (0..n).map(sin).collect(),
        }
    }

    pub(crate) fn check(&self, key: &str) -> Result<(), ModelError> {
        finite(&format!("{key}.mean"), self.mean)?;
        for (name, list) in [("cos", &self.cos), ("sin", &self.sin)] {
            for (k, &c) in list.iter().enumerate() {
                finite(&format!("{key}.{name}[{k}]"), c)?;
            }
        }
        Ok(())
    }
}
