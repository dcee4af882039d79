//! Sensors that are not perfect: noise and bias of what a controller sees.
//!
//! The noise of a look is a function of seed, number of the look and channel alone (a hash, made
//! normal by Box and Muller's transform): the same case gives the same bits, and a flight that is
//! resumed needs no memory of it.

use std::f64::consts::TAU;

use wingbeat_flight::Sensed;
use wingbeat_math::{DMat3, DQuat, DVec3, SplitMix64};

/// One number for each thing that is sensed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Channels<T> {
    /// Of the place, N components [m]: mass centre and origin of the root have the same error.
    pub position: T,
    /// Of the velocity, N components [m/s]: that of mass centre and of the origin of the root, likewise.
    pub velocity: T,
    /// Rotation vector of the attitude, root components \[rad\].
    pub tilt: T,
    /// Of the angular velocity, root components [rad/s].
    pub rate: T,
}

/// Noise and bias.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensors {
    /// Which noise.
    pub seed: u64,
    /// Standard deviations of every component, drawn again at each look.
    pub noise: Channels<f64>,
    /// What is always added.
    pub bias: Channels<DVec3>,
}

impl Sensors {
    /// The same with a seed later by `by`; none where there is no noise.
    pub fn redrawn(mut self, by: u64) -> Option<Self> {
        let noise = &self.noise;
        let parts = [noise.position, noise.velocity, noise.tilt, noise.rate];
        self.seed = self.seed.wrapping_add(by);
        parts.iter().any(|x| *x != 0.0).then_some(self)
    }

    /// What they make of the truth.
    pub fn seen(&self, truth: &Sensed) -> Sensed {
        let error = |channel: u64, noise: f64, bias: DVec3| {
            if noise == 0.0 {
                return bias;
            }
            let number = |axis: u64| self.normal(truth.look as u64, 3 * channel + axis);
            bias + noise * DVec3::new(number(0), number(1), number(2))
        };
        let (noise, bias) = (&self.noise, &self.bias);
        let mut seen = *truth;
        let place = error(0, noise.position, bias.position);
        let velocity = error(1, noise.velocity, bias.velocity);
        (seen.centre, seen.root.p) = (truth.centre + place, truth.root.p + place);
        (seen.velocity, seen.root.v) = (truth.velocity + velocity, truth.root.v + velocity);
        let turn = DQuat::from_scaled_axis(error(2, noise.tilt, bias.tilt));
        seen.root.r *= DMat3::from_quat(turn);
        seen.root.w += error(3, noise.rate, bias.rate);
        seen
    }

    /// A normal number of mean 0 and deviation 1.
    fn normal(&self, look: u64, channel: u64) -> f64 {
        let bits = SplitMix64::mixed_with(self.seed, &[look, channel]);
        // Two numbers in (0, 1) of 32 bits each.
        let share = |bits: u64| (bits as f64 + 0.5) / 4_294_967_296.0;
        let [u, v] = [share(bits >> 32), share(bits & 0xffff_ffff)];
        (-2.0 * u.ln()).sqrt() * (TAU * v).cos()
    }
}

#[cfg(test)]
mod tests {
    use wingbeat_dynamics::BodyMotion;

    use super::*;

    #[test]
    fn behaves_one_error_of_place_shifts_mass_centre_and_body() {
        let sensors = Sensors {
            noise: Channels {
                position: 1e-4,
                velocity: 0.01,
                ..Channels::default()
            },
            bias: Channels {
                velocity: DVec3::new(0.5, 0.0, 0.0),
                ..Channels::default()
            },
            ..Sensors::default()
        };
        let truth = Sensed {
            look: 3,
            time: 0.0,
            root: BodyMotion::REST,
            centre: DVec3::new(0.0, 0.0, 1e-3),
            velocity: DVec3::ZERO,
        };
        let seen = sensors.seen(&truth);
        assert!(seen.root.p.length() > 0.0 && seen.root.v.x > 0.4);
        assert_eq!(truth.centre + seen.root.p, seen.centre);
        assert_eq!(seen.root.v, seen.velocity);
    }

    #[test]
    fn agrees_noise_with_the_moments_of_the_normal_distribution() {
        let sensors = Sensors::default();
        let n = 40_000;
        let numbers: Vec<f64> = (0..n).map(|k| sensors.normal(k / 12, k % 12)).collect();
        let mean = |power: i32| numbers.iter().map(|x| x.powi(power)).sum::<f64>() / n as f64;
        // Five standard errors: sqrt(var(x^p) / n) with variances 1, 2, 15, 96.
        for (power, expect, variance) in [
            (1, 0.0, 1.0),
            (2, 1.0, 2.0),
            (3, 0.0, 15.0),
            (4, 3.0, 96.0_f64),
        ] {
            let error = 5.0 * (variance / n as f64).sqrt();
            assert!(
                (mean(power) - expect).abs() < error,
                "{power}: {}",
                mean(power)
            );
        }
        let other = Sensors { seed: 1, ..sensors };
        let product: f64 = (0..n)
            .map(|k| sensors.normal(k, 0) * other.normal(k, 0))
            .sum();
        assert!((product / n as f64).abs() < 5.0 / (n as f64).sqrt());
    }
}
