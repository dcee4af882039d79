//! Berman & Wang's angle laws [Berman & Wang 2007, J. Fluid Mech. 582:153, sec. 2].
//!
//! All are functions of the phase x \[wingbeats\], `u = 2 pi x + shift`:
//! stroke `phi_m / asin K asin(K sin u) + phi_0`, feathering
//! `psi_m / tanh C tanh(C sin u) + psi_0`, deviation `theta_m cos(2 pi N x + shift) + theta_0`.

use crate::ModelError;
use crate::error::{finite, require, require_count};
use std::f64::consts::TAU;

/// Stroke angle between a sine (K = 0) and a triangle wave (K -> 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothTriangle {
    /// Amplitude phi_m \[rad\].
    pub amplitude: f64,
    /// Shape K \[1\], from 0 and below 1; the triangle wave itself (K = 1) has corners and is refused.
    pub shape: f64,
    /// Phase shift of the sine \[rad\].
    pub shift: f64,
    /// Mean phi_0 \[rad\].
    pub mean: f64,
}

impl SmoothTriangle {
    /// Value and first two derivatives with respect to the phase.
    pub fn at(&self, x: f64) -> [f64; 3] {
        let k = self.shape;
        let norm = if k == 0.0 { 1.0 } else { k / k.asin() };
        let outer = |s: f64| {
            let root = (1.0 - k * k * s * s).sqrt();
            let value = if k == 0.0 { s } else { (k * s).asin() / k };
            [value, 1.0 / root, k * k * s / (root * root * root)]
        };
        of_sine(x, self.shift, outer, self.amplitude * norm, self.mean)
    }

    pub(crate) fn check(&self, key: &str) -> Result<(), ModelError> {
        finite_all(key, self.amplitude, self.shift, self.mean)?;
        let k = self.shape;
        let allowed = "in [0, 1): 0 is a sine, towards 1 a triangle wave";
        require(&format!("{key}.shape"), k, (0.0..1.0).contains(&k), allowed).map(|_| ())
    }
}

/// Feathering angle between a sine (C = 0) and a square wave (C -> infinity).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothSquare {
    /// Amplitude psi_m \[rad\].
    pub amplitude: f64,
    /// Shape C >= 0 \[1\].
    pub shape: f64,
    /// Phase shift of the sine \[rad\].
    pub shift: f64,
    /// Mean psi_0 \[rad\].
    pub mean: f64,
}

impl SmoothSquare {
    /// Value and first two derivatives with respect to the phase.
    pub fn at(&self, x: f64) -> [f64; 3] {
        let c = self.shape;
        let norm = if c == 0.0 { 1.0 } else { c / c.tanh() };
        let outer = |s: f64| {
            let th = (c * s).tanh();
            let value = if c == 0.0 { s } else { th / c };
            [value, 1.0 - th * th, -2.0 * c * th * (1.0 - th * th)]
        };
        of_sine(x, self.shift, outer, self.amplitude * norm, self.mean)
    }

    pub(crate) fn check(&self, key: &str) -> Result<(), ModelError> {
        finite_all(key, self.amplitude, self.shift, self.mean)?;
        let c = self.shape;
        let allowed = "a finite number >= 0: 0 is a sine, large a square wave";
        require(&format!("{key}.shape"), c, c >= 0.0, allowed).map(|_| ())
    }
}

/// Deviation angle: N = 1 draws an oval, N = 2 a figure of eight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oval {
    /// Amplitude theta_m \[rad\].
    pub amplitude: f64,
    /// Oscillations per beat N >= 1.
    pub count: usize,
    /// Phase shift of the cosine \[rad\].
    pub shift: f64,
    /// Mean theta_0 \[rad\].
    pub mean: f64,
}

impl Oval {
    /// Value and first two derivatives with respect to the phase.
    pub fn at(&self, x: f64) -> [f64; 3] {
        let w = TAU * self.count as f64;
        let (s, c) = (w * x + self.shift).sin_cos();
        let a = self.amplitude;
        [a * c + self.mean, -a * w * s, -a * w * w * c]
    }

    pub(crate) fn check(&self, key: &str) -> Result<(), ModelError> {
        finite_all(key, self.amplitude, self.shift, self.mean)?;
        let n = self.count;
        require_count(&format!("{key}.count"), n, n >= 1, ">= 1")
    }
}

/// `amplitude g(sin u) + mean` with `u = 2 pi x + shift` and `g` given with two derivatives.
fn of_sine(x: f64, shift: f64, g: impl Fn(f64) -> [f64; 3], amplitude: f64, mean: f64) -> [f64; 3] {
    let (s, c) = (TAU * x + shift).sin_cos();
    let [g0, g1, g2] = g(s);
    [
        amplitude * g0 + mean,
        amplitude * g1 * c * TAU,
        amplitude * (g2 * c * c - g1 * s) * TAU * TAU,
    ]
}

fn finite_all(key: &str, amplitude: f64, shift: f64, mean: f64) -> Result<(), ModelError> {
    finite(&format!("{key}.amplitude"), amplitude)?;
    finite(&format!("{key}.shift"), shift)?;
    finite(&format!("{key}.mean"), mean)?;
    Ok(())
}
