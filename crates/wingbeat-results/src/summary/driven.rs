//! Whether passive joints keep their energy.
//!
//! The work of the joints in the balance of energy holds that of free ones as the energy of their motion: a
//! method that damps such a motion, or lets it grow, takes from the balance what it takes from the motion. Work
//! of the drives that follows from it, what springs, dampers and stops did by their own laws taken out, is
//! therefore compared with the integral of the power of the drives.

use serde::{Deserialize, Serialize};
use wingbeat_flight::Record;
use wingbeat_math::larger;

/// Work of the drives by the balance of energy less that by their power, from step to step \[J\].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct DrivenWork {
    /// Step, time \[s\] and power \[W\] of the last steps, newest first.
    last: Vec<(usize, f64, f64)>,
    /// Difference at the first step, and integral of the power since \[J\].
    first: f64,
    sum: f64,
    /// Largest magnitude of the difference \[J\].
    pub(super) most: f64,
}

impl DrivenWork {
    /// Takes the next step. Where steps are left out, as in thinned histories, the integral begins again.
    pub fn take(&mut self, r: &Record) {
        let (work, power) = (r.driving_work(), r.driving_power());
        let follows = self
            .last
            .first()
            .is_some_and(|(step, ..)| step + 1 == r.step);
        if !follows {
            self.last.clear();
            (self.first, self.sum) = (work, 0.0);
        }
        if let Some(&(_, time, before)) = self.last.first() {
            self.sum += (r.time - time) * self.mean(power, before);
        }
        self.last.insert(0, (r.step, r.time, power));
        self.last.truncate(3);
        self.most = larger(self.most, (work - self.first - self.sum).abs());
    }

    /// Mean power of a step: of the cubic through the last four [Moulton 1926], the trapezium where there are fewer.
    fn mean(&self, now: f64, before: f64) -> f64 {
        match self.last[..] {
            [_, (.., earlier), (.., first)] => {
                (9.0 * now + 19.0 * before - 5.0 * earlier + first) / 24.0
            }
            _ => 0.5 * (now + before),
        }
    }
}
