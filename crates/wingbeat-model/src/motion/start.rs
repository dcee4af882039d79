//! How a motion starts: at once, or from rest by a smooth time warp.

use crate::ModelError;
use crate::error::positive;

/// The start of a periodic motion at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// The law runs at full rate from the first instant.
    Impulsive,
    /// The wing rests in the law's pose at t = 0 and before; the rate of its clock rises to
    /// one over `duration` \[s\], four times continuously differentiable.
    Smooth {
        /// Length of the rise \[s\].
        duration: f64,
    },
}

impl Start {
    /// The warped time `tau(t)` with its first two derivatives \[s, 1, 1/s\].
    ///
    /// Smooth: `tau' = s(t/T)` with the smoothstep `s = 35 z^4 - 84 z^5 + 70 z^6 - 20 z^7`,
    /// whose first three derivatives vanish at both ends; after the rise `tau = t - T/2`.
    pub fn warp(&self, t: f64) -> [f64; 3] {
        let Start::Smooth { duration } = *self else {
            return [t, 1.0, 0.0];
        };
        let z = t / duration;
        if z <= 0.0 {
            return [0.0; 3];
        }
        if z >= 1.0 {
            return [t - self.delay(), 1.0, 0.0];
        }
        let z4 = z * z * z * z;
        let integral = z4 * z * (7.0 + z * (-14.0 + z * (10.0 - 2.5 * z)));
        let step = z4 * (35.0 + z * (-84.0 + z * (70.0 - 20.0 * z)));
        let y = z * (1.0 - z);
        [duration * integral, step, 140.0 * y * y * y / duration]
    }

    /// Time by which the motion lags the impulsive one after the rise \[s\]: half the duration.
    pub fn delay(&self) -> f64 {
        match *self {
            Start::Impulsive => 0.0,
            Start::Smooth { duration } => 0.5 * duration,
        }
    }

    /// The default: smooth over one wingbeat of the frequency \[Hz\] (impulsive if nothing beats).
    pub fn default_for(frequency: f64) -> Self {
        if frequency > 0.0 {
            Start::Smooth {
                duration: 1.0 / frequency,
            }
        } else {
            Start::Impulsive
        }
    }

    pub(crate) fn check(&self, key: &str) -> Result<(), ModelError> {
        match *self {
            Start::Impulsive => Ok(()),
            Start::Smooth { duration } => {
                positive(&format!("{key}.duration"), duration).map(|_| ())
            }
        }
    }
}
