//! Vortex lift of attached lattices: what a leading edge does that holds some suction and has a vortex of the rest.
//!
//! No vorticity leaves the edge, so what a flight does is smooth. Of the suction parameter A0 of a strip the
//! edge holds `h`, the lesser of A0 and the threshold, rounded where they meet. The force of the suction is as
//! the square of A0, so the part `sigma = (h / A0)^2` acts as suction, times the edge's efficiency; the rest
//! would be the normal force of a vortex at the edge that the flow closes behind [Polhamus 1966, NASA TN
//! D-3767]. How much of it is there says a state of the strip, the chords T for which its vortex has been fed:
//!
//! `dT/dt = g U / c - T (|W| + (1 - g) U / (c T_r))`
//!
//! g is 0 below the threshold and 1 above, U the speed of stream and motion at the quarter chord and c the
//! chord of the section normal to the edge, W the rate at which the section turns about axes across the span,
//! T_r [`RECOVERY`]:
//!
//! - The circulation of a vortex grows with the way the wing goes, up to T* chords, 3.7 +- 0.3 of pitching
//!   plates [Onoue & Breuer 2016, J. Fluid Mech. 793:229] and about 4 otherwise: its force is T / T* of
//!   Polhamus's.
//! - A wing that turns carries the vorticity outboard at the rate of its turning. In steady revolution T is
//!   then the strip's radius in chords, and less than T* within the radius of four chords, where vortices of
//!   revolving wings stay [Kruyt et al. 2015, J. R. Soc. Interface 12:20150051].
//! - A vortex that is fed for longer leaves, between T* and 1.5 T*. What remains is a wing that has stalled:
//!   its circulation makes `((1 + sigma) / 2)^2` of its normal force, Kirchhoff's law where `sigma^2` of the
//!   chord is attached [Leishman & Beddoes 1989, J. Am. Helicopter Soc. 34(3):3], and of Polhamus's force
//!   [`REMAINDER`] is left.
//! - An edge that has again no more suction than it holds recovers within [`RECOVERY`] chords.

use crate::error::{AirError, is_positive, require};
use wingbeat_math::smoothstep;

/// Rounding, relative to the threshold and to T*: plates hold 0.11 to 0.19 about 0.15 [Ramesh et al. 2014, J.
/// Fluid Mech. 751:500], flow attaches again at 0.07 to 0.13, and vortex lift decays within two to three chords
/// [Leishman & Beddoes 1989].
const SPREAD: f64 = 0.25;

/// Part of Polhamus's normal force that a stalled plate has: across the stream, where the attached lattice has
/// 2 pi in plane flow, it has a normal force coefficient of 2.
const REMAINDER: f64 = 1.0 / std::f64::consts::PI;

/// Chords of travel in which flow attaches: three half chords [Leishman & Beddoes 1989].
const RECOVERY: f64 = 1.5;

/// Law of a leading edge without free vorticity, strip by strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VortexLift {
    /// Leading-edge suction parameter that the edge holds \[1\], above 0.
    pub threshold: f64,
    /// Part of the force of the suction held that acts \[1\], 0 to 1.
    pub efficiency: f64,
    /// Chords T* for which a vortex is fed before it leaves \[1\], above 0.
    pub formation: f64,
}

/// Thin edges.
impl Default for VortexLift {
    fn default() -> Self {
        Self {
            threshold: 0.15,
            efficiency: 0.0,
            formation: 4.0,
        }
    }
}

/// How a section moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage {
    /// Speed of stream and motion at the quarter chord in chords a second \[1/s\].
    pub chords: f64,
    /// Rate at which the section turns about axes across the span [rad/s].
    pub turning: f64,
}

/// What becomes of the forces of a strip \[1\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ForceFactors {
    /// Of the suction, that which acts as such.
    pub suction: f64,
    /// Of the suction, that which acts along the normal.
    pub vortex: f64,
    /// Of the normal force of the circulation.
    pub normal: f64,
}

impl VortexLift {
    /// Chords for which the vortex has been fed when the suction parameter `a0` has lasted for `dt` [s] of this
    /// passage.
    pub(crate) fn fed(&self, before: f64, a0: f64, passage: Passage, dt: f64) -> f64 {
        let Passage { chords, turning } = passage;
        let feeds = step(a0.abs() / self.threshold);
        let loss = turning + (1.0 - feeds) * chords / RECOVERY;
        before + (feeds * chords - loss * before) * dt * mean_decay(loss * dt)
    }

    /// What becomes of the forces of a strip at this suction parameter, whose vortex has been fed for so many chords.
    pub(crate) fn parts(&self, a0: f64, fed: f64) -> ForceFactors {
        let sigma = held_part(a0.abs() / self.threshold).powi(2);
        let grown = fed / self.formation;
        let lost = step(grown - SPREAD); // from T* to 1.5 T*
        ForceFactors {
            suction: self.efficiency * sigma,
            vortex: (1.0 - sigma) * ((1.0 - lost) * grown + lost * REMAINDER),
            normal: 1.0 - lost + lost * (0.5 * (1.0 + sigma)).powi(2),
        }
    }

    /// # Errors
    /// [`AirError::Setting`] names the first number that makes no sense.
    pub(crate) fn validate(&self) -> Result<(), AirError> {
        for (key, value) in [
            ("leading suction threshold", self.threshold),
            ("leading vortex formation", self.formation),
        ] {
            require(is_positive(value), key, value, "a finite number above 0")?;
        }
        require(
            (0.0..=1.0).contains(&self.efficiency),
            "leading suction efficiency",
            self.efficiency,
            "a number from 0 to 1",
        )
    }
}

/// Part of the suction parameter that an edge holds, from that parameter over the threshold.
pub(super) fn held_part(ratio: f64) -> f64 {
    match ratio > 0.0 {
        true => held(ratio) / ratio,
        false => 1.0,
    }
}

/// The lesser of a number and 1, rounded within [`SPREAD`] of 1.
fn held(ratio: f64) -> f64 {
    let over = (ratio - 1.0 + SPREAD).clamp(0.0, 2.0 * SPREAD);
    ratio.min(1.0 + SPREAD) - over * over / (4.0 * SPREAD)
}

/// Rises from 0 to 1 within [`SPREAD`] of 1.
fn step(x: f64) -> f64 {
    smoothstep((x - 1.0 + SPREAD) / (2.0 * SPREAD))
}

/// Mean of `exp(-s)` from 0 to `x`.
fn mean_decay(x: f64) -> f64 {
    match x > 0.0 {
        true => -(-x).exp_m1() / x,
        false => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forces are differentiable in the suction parameter and in what was fed, where the edge begins to yield
    /// and where vortices are lost too.
    #[test]
    fn exact_no_kinks() {
        let law = VortexLift {
            efficiency: 1.0,
            ..VortexLift::default()
        };
        let h = 1e-6;
        let forces = |a0: f64, fed: f64| {
            let parts = law.parts(a0, fed);
            [parts.suction, parts.vortex, parts.normal].map(|part| part * a0 * a0)
        };
        let all = (1..200).map(|k| k as f64 * 0.25);
        for (a0, fed) in all.map(|k| (0.0075 * k, 0.125 * k)) {
            for i in 0..3 {
                let kink = |at: &dyn Fn(f64) -> f64| (at(h) - 2.0 * at(0.0) + at(-h)).abs() / h;
                let in_a0 = kink(&|d| forces(a0 + d, fed)[i]);
                let in_fed = kink(&|d| forces(a0, fed + d)[i]);
                // Curvatures up to 40 times the difference; a kink of the clamped law has a jump of slope of 0.3.
                assert!(in_a0.max(in_fed) < 1e-4, "{a0} {fed}: {in_a0} {in_fed}");
            }
        }
    }

    /// An edge that holds all has all of its suction and no vortex, to the last bit.
    #[test]
    fn limit_below_the_threshold_nothing_is_taken() {
        let law = VortexLift {
            efficiency: 1.0,
            ..VortexLift::default()
        };
        for a0 in [0.0, 1e-9, -0.05, 0.1, 0.1125] {
            let all = ForceFactors {
                suction: 1.0,
                vortex: 0.0,
                normal: 1.0,
            };
            assert_eq!(law.parts(a0, 2.0), all);
        }
    }

    /// Fed for as many chords as the section goes; turning leaves the radius in chords.
    #[test]
    fn exact_what_is_fed() {
        let law = VortexLift::default();
        let ahead = Passage {
            chords: 2.0,
            turning: 0.0,
        };
        assert_eq!(law.fed(0.5, 0.4, ahead, 0.25), 1.0);
        assert_eq!(law.fed(0.0, 0.1, ahead, 0.25), 0.0);
        let round = Passage {
            chords: 6.0,
            turning: 2.0,
        };
        let mut fed = 0.0;
        for k in 1..50 {
            fed = law.fed(fed, 0.4, round, 0.1);
            let exact = 3.0 * (1.0 - (-0.2 * f64::from(k)).exp());
            assert!((fed - exact).abs() < 1e-14, "{fed} {exact}"); // some roundings
        }
    }
}
