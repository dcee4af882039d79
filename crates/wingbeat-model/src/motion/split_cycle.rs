//! Split-cycle strokes of constant period [Doman, Oppenheimer & Sigthorsson 2009]: one half stroke takes more of the
//! beat than the other, which makes a mean drag without another frequency or amplitude.
//!
//! In the paper's words the wing moves as `cos((omega - delta) t)` in the first half stroke and as
//! `cos((omega + sigma) t + xi)` in the second, `sigma = delta omega / (omega - 2 delta)` so that both take a beat
//! together. Here the share h of the beat that the first half stroke takes stands for delta:
//! `delta / omega = 1 - 1 / (2 h)`, `sigma / omega = 1 / (2 (1 - h)) - 1`.

use std::f64::consts::{PI, TAU};

use crate::ModelError;
use crate::error::{finite, require};

/// `mean + amplitude cos(pi s / h)` for `s < h`, `mean - amplitude cos(pi (s - h) / (1 - h))` from there to 1, s the
/// fraction of `x + shift / (2 pi)`. Once continuously differentiable: the second derivative jumps at both reversals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitCycle {
    /// Amplitude: the first half stroke runs from `mean + amplitude` to `mean - amplitude` \[rad\].
    pub amplitude: f64,
    /// Share h of the beat that the first half stroke takes \[1\], above 0 and below 1.
    pub first_share: f64,
    /// Phase shift \[rad\].
    pub shift: f64,
    /// Mean over a beat \[rad\].
    pub mean: f64,
}

impl SplitCycle {
    /// Value and first two derivatives with respect to the phase x.
    pub fn at(&self, x: f64) -> [f64; 3] {
        let s = (x + self.shift / TAU).rem_euclid(1.0);
        let h = self.first_share;
        let (amplitude, w, begun) = match s < h {
            true => (self.amplitude, PI / h, 0.0),
            false => (-self.amplitude, PI / (1.0 - h), h),
        };
        let (sin, cos) = (w * (s - begun)).sin_cos();
        [
            self.mean + amplitude * cos,
            -amplitude * w * sin,
            -amplitude * w * w * cos,
        ]
    }

    pub(crate) fn check(&self, key: &str) -> Result<(), ModelError> {
        finite(&format!("{key}.amplitude"), self.amplitude)?;
        finite(&format!("{key}.shift"), self.shift)?;
        finite(&format!("{key}.mean"), self.mean)?;
        let h = self.first_share;
        let inside = h > 0.0 && h < 1.0;
        let allowed = "in (0, 1): the part of the beat that the first half stroke takes";
        require(&format!("{key}.first_share"), h, inside, allowed).map(|_| ())
    }
}
