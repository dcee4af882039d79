//! Baumgarte's stabilization: constraints kept by feedback (seed eq. 29).

use std::ops::{Mul, Neg, Sub};

/// Constants of Baumgarte's stabilization (seed eq. 29).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Baumgarte {
    /// alpha [1/s].
    pub alpha: f64,
    /// beta [1/s].
    pub beta: f64,
}

impl Baumgarte {
    /// No stabilization: seed eq. 28.
    pub const OFF: Self = Self {
        alpha: 0.0,
        beta: 0.0,
    };

    /// `alpha = beta = a / h` for the step h \[s\]; a = 0.1 is recommended.
    pub fn step_tied(a: f64, h: f64) -> Self {
        Self {
            alpha: a / h,
            beta: a / h,
        }
    }

    /// The default for the step h \[s\]: a = 0.1.
    pub fn for_step(h: f64) -> Self {
        Self::step_tied(0.1, h)
    }

    /// S of seed eq. 30 from the bias of `Phi''`, and `Phi'` and `Phi`: numbers or vectors.
    pub fn right_side<V>(&self, bias: V, rate: V, value: V) -> V
    where
        V: Neg<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
    {
        -bias - rate * (2.0 * self.alpha) - value * (self.beta * self.beta)
    }
}
