//! Noise in measured angles: samples that scatter about the motion, all of which a spline goes through.
//!
//! The rates of a smooth motion fall from octave to octave of its harmonics: by a half for a triangle wave,
//! whose corners are the sharpest that a stroke has, faster for others. Noise has the same amplitude at all of
//! them, so its rates grow eightfold. Where the highest octave that the samples resolve has clearly more than
//! the one below, and is no small part of the whole, it is noise.

use crate::motion::Fourier;
use crate::motion::spline::PeriodicSpline;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Samples from which on octaves can be told apart.
const SAMPLES: usize = 32;
/// Harmonics that are looked at at most.
const HARMONICS: usize = 256;
/// Mean square rates of the highest octave over those of the one below from which on it is noise: triangle
/// waves have 0.5, in 32 to 40 samples up to 1.1, noise 8, as it falls out 2 or more.
const GROWTH: f64 = 1.5;
/// The same over those of all below from which on it counts: rates of a tenth.
const COUNTS: f64 = 0.01;
/// Amplitude over that of the noise from which on a harmonic is motion.
const MOTION: f64 = 5.0;

/// How the samples of an angle scatter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Standard deviation of a sample, about \[rad\].
    pub deviation: f64,
    /// Samples of a beat \[1\].
    pub samples: usize,
    /// Harmonics that stand out of the noise \[1\].
    pub harmonics: usize,
    /// Root mean square of the rates beyond these over that of theirs \[1\].
    pub rates: f64,
}

impl PeriodicSpline {
    /// How its samples scatter; none where they do not, or are too few to know.
    pub fn scatter(&self) -> Option<Scatter> {
        let samples = self.rows().count() - 1;
        Scatter::of(&amplitudes(self, samples), samples)
    }
}

impl Fourier {
    /// How the samples scatter that it was fitted to, by its own harmonics: whether the highest are noise. None
    /// where they are not, or are too few to know.
    pub fn scatter(&self, samples: usize) -> Option<Scatter> {
        let harmonics = self.cos.iter().zip(&self.sin).map(|(c, s)| c.hypot(*s));
        let amplitude: Vec<f64> = [self.mean.abs()].into_iter().chain(harmonics).collect();
        Scatter::of(&amplitude, samples)
    }
}

impl Scatter {
    /// By the amplitudes of the harmonics 0, 1, 2, ... \[rad\] of so many samples.
    fn of(amplitude: &[f64], samples: usize) -> Option<Self> {
        let highest = amplitude.len() - 1;
        if highest < SAMPLES / 2 {
            return None;
        }
        let rates = |from: usize, to: usize| -> f64 {
            (from + 1..=to)
                .map(|k| (k as f64 * amplitude[k]).powi(2))
                .sum()
        };
        let [quarter, half] = [highest / 4, highest / 2];
        let upper = rates(half, highest);
        if upper < GROWTH * rates(quarter, half) || upper <= COUNTS * rates(0, half) {
            return None;
        }
        let square: f64 = amplitude[half + 1..].iter().map(|a| a * a).sum();
        let noise = (square / (highest - half) as f64).sqrt();
        let stands_out = |k: &usize| amplitude[*k] > MOTION * noise;
        let harmonics = (1..=half).rev().find(stands_out).unwrap_or(1);
        Some(Self {
            // Of all harmonics of noise, that many times half the mean square.
            deviation: noise * (0.25 * samples as f64).sqrt(),
            samples,
            harmonics,
            rates: (rates(harmonics, highest) / rates(0, harmonics)).sqrt(),
        })
    }
}

/// Amplitudes of the harmonics 0, 1, 2, ... up to half as many as there are samples \[rad\].
fn amplitudes(spline: &PeriodicSpline, samples: usize) -> Vec<f64> {
    let points = 4 * samples;
    let at = |n: usize| Complex::new(spline.at(n as f64 / points as f64)[0], 0.0);
    let mut values: Vec<_> = (0..points).map(at).collect();
    FftPlanner::new()
        .plan_fft_forward(points)
        .process(&mut values);
    let looked_at = values.iter().take((samples / 2).min(HARMONICS) + 1);
    looked_at.map(|v| 2.0 * v.norm() / points as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use wingbeat_math::SplitMix64;

    fn spline(samples: usize, q: impl FnMut(f64) -> f64) -> PeriodicSpline {
        let phases = (0..samples).map(|k| k as f64 / samples as f64);
        let mut values: Vec<f64> = phases.clone().map(q).collect();
        values.push(values[0]);
        let rows: Vec<_> = phases.chain([1.0]).zip(values).collect();
        PeriodicSpline::new("q", &rows).expect("a table")
    }

    /// A degree of white noise on a stroke of 140 deg is found, and how much it is; the harmonics of the motion
    /// stand out.
    #[test]
    fn exact_noise_is_found_with_its_size() {
        for samples in [64, 200] {
            let mut random = SplitMix64::new(7);
            let mut noise = || (random.unit() - 0.5) * 12f64.sqrt();
            let stroke = |x: f64| 70.0 * (TAU * x).cos() + 6.0 * (3.0 * TAU * x).sin();
            let table = spline(samples, |x| (stroke(x) + noise()).to_radians());
            let found = table.scatter().expect("noise");
            let deviation = found.deviation.to_degrees();
            println!("{found:?} {deviation}");
            assert!((deviation - 1.0).abs() < 0.5, "{deviation}"); // 0.66 to 0.94: of few harmonics, less what splines smooth
            assert_eq!((found.samples, found.harmonics), (samples, 3));
            assert!(found.rates > 0.1);
        }
    }

    /// A series of 40 harmonics fitted to 100 samples follows their noise, one of 20 to samples without noise
    /// follows none.
    #[test]
    fn exact_harmonics_that_follow_noise_are_found() {
        let mut random = SplitMix64::new(7);
        let stroke = |x: f64| 70.0 * (TAU * x).cos() + 6.0 * (3.0 * TAU * x).sin();
        let mut fitted = |noise: f64, harmonics: usize| {
            let sample = |k: usize| {
                let x = k as f64 / 100.0;
                let scatter = noise * (random.unit() - 0.5) * 12f64.sqrt();
                (x, (stroke(x) + scatter).to_radians())
            };
            let rows: Vec<_> = (0..100).map(sample).collect();
            let (series, _) = Fourier::fitted("q", &rows, harmonics).expect("a fit");
            series.scatter(100)
        };
        let found = fitted(1.0, 40).expect("noise");
        let deviation = found.deviation.to_degrees();
        // Of 20 harmonics, each with two numbers of noise: to one part in nine, here 2 of these.
        assert!((deviation - 1.0).abs() < 0.22, "{deviation}");
        assert_eq!(found.harmonics, 3);
        assert_eq!(fitted(1.0, 8), None);
        assert_eq!(fitted(0.0, 40), None);
    }

    /// Corners, quick turns and steps of rounding are no noise.
    #[test]
    fn limit_sharp_but_sound_motions_do_not_scatter() {
        for samples in [32, 40, 100, 200] {
            let triangle = |x: f64| 70.0 - 280.0 * (x - 0.5).abs();
            assert_eq!(spline(samples, triangle).scatter(), None);
            let turns = |x: f64| 45.0 * (5.0 * (TAU * x).sin()).tanh();
            assert_eq!(spline(samples, turns).scatter(), None);
            let rounded = |x: f64| (700.0 * (TAU * x).cos()).round() / 10.0;
            assert_eq!(spline(samples, rounded).scatter(), None);
        }
    }
}
