//! Ramps of the incidence with smoothed corners.

use std::f64::consts::LN_2;

/// A ramp from zero: height [rad], length and smoothing of the corners [m, 1/m], or in chords.
pub(crate) struct Ramp {
    pub height: f64,
    pub length: f64,
    pub smoothing: f64,
}

impl Ramp {
    /// Incidence [rad] and its rate after a way `s` from the first corner [Eldredge, Wang, Ol 2009, AIAA 2009-3687].
    pub fn at(&self, s: f64) -> [f64; 2] {
        let a = self.smoothing;
        let [rise, hold] = [a * s, a * (s - self.length)];
        // ln cosh without overflow.
        let log = |x: f64| x.abs() + (-2.0 * x.abs()).exp().ln_1p() - LN_2;
        let slope = 0.5 * self.height / self.length;
        [
            slope * (self.length + (log(rise) - log(hold)) / a),
            slope * (rise.tanh() - hold.tanh()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_rate_of_the_ramp_with_differences_and_its_ends() {
        for [length, smoothing] in [[1.0, 15.0], [6.0, 4.0]] {
            let ramp = Ramp {
                height: 0.8,
                length,
                smoothing,
            };
            for s in [-0.2, 0.0, 0.5, 1.0, 5.9] {
                let h = 1e-5;
                let [a, b] = [s + h, s - h].map(|s| ramp.at(s)[0]);
                // Central differences: h^2 of the third derivative, some 1e2.
                assert!(((a - b) / (2.0 * h) - ramp.at(s)[1]).abs() < 1e-8);
            }
            assert!(ramp.at(-30.0)[0].abs() < 1e-12);
            assert!((ramp.at(30.0)[0] - ramp.height).abs() < 1e-12);
        }
    }
}
