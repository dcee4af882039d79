//! Cubic splines, and what nodes of a mesh must do to each other so that two splines and the mesh between them
//! make a Gaussian.

use std::f64::consts::{PI, TAU};

/// Nodes that a spline reaches along an axis.
pub(super) const ORDER: usize = 4;

/// The farthest neighbour of a stencil.
pub(super) const FARTHEST: usize = 8;

/// Values, for `f` = u - floor(u), of the splines at floor(u) - 1 to floor(u) + 2.
#[inline(always)]
pub(super) fn weights(f: f32) -> [f32; ORDER] {
    let (g, sixth) = (1.0 - f, 1.0 / 6.0);
    let inner = |x: f32| 2.0 / 3.0 - x * x * (1.0 - 0.5 * x);
    [sixth * (g * g * g), inner(f), inner(g), sixth * (f * f * f)]
}

/// What a node takes of its neighbours along an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stencil {
    /// The farthest neighbour.
    pub reach: usize,
    /// The Gaussian `exp(-t x^2)`, by the distance of the neighbour.
    pub even: [f32; FARTHEST + 1],
    /// `x exp(-t x^2)` in nodes, x from the source to the target.
    pub odd: [f32; FARTHEST + 1],
}

impl Stencil {
    /// Of a Gaussian whose standard deviation is `width` nodes: what leaves the least error of all places
    /// between nodes [Hockney & Eastwood 1988, sec. 8-3-3], cut off at `reach`.
    pub fn new(width: f64, reach: usize) -> Self {
        const WAVES: usize = 512;
        let (mut even, mut odd) = ([0.0; FARTHEST + 1], [0.0; FARTHEST + 1]);
        for i in 0..WAVES {
            let phase = PI * (i as f64 + 0.5) / WAVES as f64;
            let (mut gaussian, mut moment, mut spline) = (0.0, 0.0, 0.0);
            for alias in -3..=3 {
                let wave = phase + TAU * f64::from(alias);
                let twice = spectrum(wave).powi(2);
                let value = twice * TAU.sqrt() * width * (-0.5 * (wave * width).powi(2)).exp();
                gaussian += value;
                moment += width * width * wave * value;
                spline += twice;
            }
            let scale = (spline * spline * WAVES as f64).recip();
            for j in 0..=reach {
                even[j] += scale * gaussian * (j as f64 * phase).cos();
                odd[j] += scale * moment * (j as f64 * phase).sin();
            }
        }
        let [even, odd] = [even, odd].map(|taps| taps.map(|tap| tap as f32));
        Self { reach, even, odd }
    }
}

/// Spectrum of the spline; `wave` is not zero.
fn spectrum(wave: f64) -> f64 {
    ((0.5 * wave).sin() / (0.5 * wave)).powi(ORDER as i32)
}
