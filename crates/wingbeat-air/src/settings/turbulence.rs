//! Turbulence as a sum of waves with a given spectrum, by seed.
//!
//! Of one component of velocity, over its root mean square, with T the time in which the air carries a length scale
//! past (L / V of the flight-mechanics specifications), one-sided in omega [rad/s], `integral S d omega = 1`
//! [MIL-F-8785C, sec. 3.7]:
//!
//! | spectrum | along the motion | across it |
//! |---|---|---|
//! | Dryden | `(2 T / pi) / (1 + x^2)`, x = omega T | `(T / pi) (1 + 3 x^2) / (1 + x^2)^2` |
//! | von Karman | `(2 T / pi) / (1 + y^2)^(5/6)`, y = 1.339 x | `(T / pi) (1 + 8/3 y^2) / (1 + y^2)^(11/6)` |
//!
//! Waves stand one in each of equal bins of log omega, at a place in its bin and with a phase that the seed draws, and
//! carry their bin's share of the variance, `sum of a^2 / 2 = 1`: the same seed gives the same air, bit for bit, at any
//! time and place and on any number of threads, for the sum has no memory.

use std::f64::consts::{PI, TAU};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wingbeat_math::SplitMix64;

use crate::error::{AirError, is_positive, require};

/// Which spectrum, and of which component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Spectrum {
    /// Dryden, component along the motion.
    DrydenAlong,
    /// Dryden, component across it.
    #[default]
    DrydenAcross,
    /// Von Karman, component along the motion.
    VonKarmanAlong,
    /// Von Karman, component across it.
    VonKarmanAcross,
}

/// Bins of log omega, from [`BAND`].0 / T to [`BAND`].1 / T.
const WAVES: usize = 64;
/// Ends of the band over 1 / T. Below it are 0.6 % of the variance (along, Dryden; across 0.3 %), carried by
/// the first wave; above it 0.6 % (along, Dryden) to 4 % (across, von Karman), shared out among all waves.
const BAND: (f64, f64) = (0.01, 100.0);

/// Turbulent course of one component over its root mean square.
#[derive(Clone, Debug, PartialEq)]
pub struct Turbulence {
    /// The spectrum.
    pub spectrum: Spectrum,
    /// Time scale T [s].
    pub time_scale: f64,
    /// The seed.
    pub seed: u64,
    /// Omega [rad/s], amplitude \[1\] and phase \[rad\] of every wave.
    waves: Vec<[f64; 3]>,
}

impl Spectrum {
    /// `S / T` at x = omega T, one-sided, of unit variance.
    pub fn density(self, x: f64) -> f64 {
        let y = 1.339 * x;
        match self {
            Self::DrydenAlong => 2.0 / PI / (1.0 + x * x),
            Self::DrydenAcross => (1.0 + 3.0 * x * x) / (1.0 + x * x).powi(2) / PI,
            Self::VonKarmanAlong => 2.0 / PI / (1.0 + y * y).powf(5.0 / 6.0),
            Self::VonKarmanAcross => {
                (1.0 + 8.0 / 3.0 * y * y) / (1.0 + y * y).powf(11.0 / 6.0) / PI
            }
        }
    }

    /// Variance between the x = omega T of a bin: Simpson's rule over log x, error 1e-6.
    fn variance(self, [from, to]: [f64; 2]) -> f64 {
        const PARTS: usize = 8;
        let (start, step) = (from.ln(), (to / from).ln() / PARTS as f64);
        let at = |k: usize| {
            let x = (start + step * k as f64).exp();
            let weight = match k {
                0 | PARTS => 1.0,
                _ if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * x * self.density(x)
        };
        step / 3.0 * (0..=PARTS).map(at).sum::<f64>()
    }
}

impl Turbulence {
    /// Turbulence of this spectrum with the time scale `time_scale` [s].
    ///
    /// # Errors
    /// A time scale that is not above 0.
    pub fn new(spectrum: Spectrum, time_scale: f64, seed: u64) -> Result<Self, AirError> {
        let allowed = "a time in s above 0";
        let key = "turbulence time scale";
        require(is_positive(time_scale), key, time_scale, allowed)?;
        let mut draw = SplitMix64::new(seed);
        let ratio = (BAND.1 / BAND.0).powf(1.0 / WAVES as f64);
        let bin = |k: usize| {
            let from = BAND.0 * ratio.powi(k as i32);
            let below = if k == 0 {
                from * spectrum.density(0.0)
            } else {
                0.0
            };
            (from, below + spectrum.variance([from, from * ratio]))
        };
        let bins: Vec<_> = (0..WAVES).map(bin).collect();
        let all: f64 = bins.iter().map(|(_, variance)| variance).sum();
        let wave = |&(from, variance): &(f64, f64)| {
            let x = from * ratio.powf(draw.unit());
            let amplitude = (2.0 * variance / all).sqrt();
            [x / time_scale, amplitude, TAU * draw.unit()]
        };
        Ok(Self {
            spectrum,
            time_scale,
            seed,
            waves: bins.iter().map(wave).collect(),
        })
    }

    /// Share of the root mean square at the time `tau` [s].
    pub fn at(&self, tau: f64) -> f64 {
        let wave = |[omega, amplitude, phase]: &[f64; 3]| amplitude * (omega * tau + phase).cos();
        self.waves.iter().map(wave).sum()
    }

    /// Rate of that share at the time `tau` [1/s].
    pub fn rate(&self, tau: f64) -> f64 {
        let wave =
            |[omega, amplitude, phase]: &[f64; 3]| -amplitude * omega * (omega * tau + phase).sin();
        self.waves.iter().map(wave).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: f64 = 0.3;

    fn drawn(spectrum: Spectrum) -> impl Iterator<Item = Turbulence> {
        (0..400).map(move |seed| Turbulence::new(spectrum, T, seed).unwrap())
    }

    /// Mean over seeds of the product of the velocities at two times, from the waves as they run.
    fn correlation(spectrum: Spectrum, lag: f64) -> f64 {
        let products = drawn(spectrum).map(|air| {
            let times = (0..20).map(|k| 7.3 * T * k as f64);
            times.map(|t| air.at(t) * air.at(t + lag)).sum::<f64>() / 20.0
        });
        products.sum::<f64>() / 400.0
    }

    #[test]
    fn published_correlations_of_dryden_turbulence_are_exponentials() {
        for lag in [0.0, 0.25, 0.5, 1.0, 2.0, 3.0] {
            let fade = f64::exp(-lag);
            for (spectrum, exact) in [
                (Spectrum::DrydenAlong, fade),
                (Spectrum::DrydenAcross, (1.0 - 0.5 * lag) * fade),
            ] {
                let found = correlation(spectrum, lag * T);
                println!("{spectrum:?} {lag}: {found:.4}, {exact:.4}");
                // 8000 products of unit variance, correlated over some T: 2 % each way.
                assert!((found - exact).abs() < 0.05, "{spectrum:?} {lag}");
            }
        }
    }

    fn variance<'a>(waves: impl IntoIterator<Item = &'a [f64; 3]>) -> f64 {
        waves.into_iter().map(|w| 0.5 * w[1] * w[1]).sum()
    }

    #[test]
    fn exact_the_waves_have_unit_variance_and_their_bins_share_it() {
        for spectrum in [
            Spectrum::DrydenAlong,
            Spectrum::DrydenAcross,
            Spectrum::VonKarmanAlong,
            Spectrum::VonKarmanAcross,
        ] {
            for air in drawn(spectrum).take(5) {
                let all = variance(&air.waves);
                assert!((all - 1.0).abs() < 1e-14, "{spectrum:?}: {all}"); // roundings of 64 squares
            }
        }
        // Dryden along: (2 / pi) (atan b - atan a) between two frequencies, here of four bins each way.
        let air = Turbulence::new(Spectrum::DrydenAlong, T, 1).unwrap();
        let edge = |k: i32| BAND.0 * (BAND.1 / BAND.0).powf(f64::from(k) / WAVES as f64);
        for k in [8, 20, 32, 44] {
            let [a, b] = [edge(k), edge(k + 4)];
            let waves = &air.waves[k as usize..k as usize + 4];
            let found = variance(waves);
            // Of what is below the upper end of the band.
            let exact = (b.atan() - a.atan()) / BAND.1.atan();
            assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
        }
    }

    #[test]
    fn invariant_the_same_seed_gives_the_same_air() {
        let make = |seed| Turbulence::new(Spectrum::VonKarmanAcross, T, seed).unwrap();
        assert_eq!(make(5), make(5));
        assert_ne!(make(5).at(0.7), make(6).at(0.7));
    }
}
