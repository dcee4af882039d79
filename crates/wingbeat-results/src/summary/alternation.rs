//! Forces that go up and down from step to step: the mark of an integrator that is not stable.
//!
//! The loads of a wake hold the rate of the circulation as a difference over steps; where the air that moves with
//! wings or body weighs too much for the integrator, velocities alternate and grow (docs/dynamics.md,
//! *Integrators*): no change is much smaller than the one before. Forces of wings among their own
//! wakes turn back as well, a dozen times in a row in flights of few panels and long steps, but by changes of any size.

use serde::{Deserialize, Serialize};
use wingbeat_flight::Record;
use wingbeat_math::DVec3;

/// A change counts beside the largest force so far from this part of it on.
const CHANGE: f64 = 0.02;
/// A change counts beside the one before from this part of it on.
const LASTS: f64 = 0.5;

/// What was seen of the forces of the wings, or of the body of a flyer without wings.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Alternation {
    bodies: Vec<Seen>,
    step: usize,
    /// Most steps in a row in which the force of a wing turned back by no much smaller a change.
    pub longest: usize,
}

#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Seen {
    force: DVec3,
    change: DVec3,
    most: f64,
    run: usize,
}

impl Alternation {
    /// Takes the next record; `wings` of its bodies behind the first are wings. Where steps were left out
    /// nothing is counted.
    pub fn take(&mut self, record: &Record, wings: usize) {
        let [first, count] = if wings == 0 { [0, 1] } else { [1, wings] };
        let forces = record.air.iter().skip(first).take(count).map(|w| w.force);
        self.bodies.resize(count, Seen::default());
        let follows = record.step == self.step + 1;
        self.step = record.step;
        for (seen, force) in self.bodies.iter_mut().zip(forces) {
            self.longest = self.longest.max(seen.take(force, follows));
        }
    }
}

impl Seen {
    /// Steps in a row, up to this one, in which the force turned back by no much smaller a change.
    fn take(&mut self, force: DVec3, follows: bool) -> usize {
        let change = if follows {
            force - self.force
        } else {
            DVec3::ZERO
        };
        self.most = self.most.max(force.length());
        let sizes = [change.length(), self.change.length()];
        let turned = change.dot(self.change) < -0.5 * sizes[0] * sizes[1];
        let counts = sizes.iter().all(|s| *s > CHANGE * self.most);
        let lasts = sizes[0] >= LASTS * sizes[1];
        self.run = if turned && counts && lasts {
            self.run + 1
        } else {
            0
        };
        (self.force, self.change) = (force, change);
        self.run
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_dynamics::Wrench;

    /// Longest run of a force along n3 on one wing, the body beside it alternating all the time.
    fn longest(force: impl Fn(usize) -> f64, every: usize) -> usize {
        longest_of(1, force, every)
    }

    /// The same where so many bodies behind the first count as wings.
    fn longest_of(wings: usize, force: impl Fn(usize) -> f64, every: usize) -> usize {
        let mut seen = Alternation::default();
        for step in (0..400).step_by(every) {
            let of = |f: f64| Wrench {
                force: DVec3::new(0.0, 0.0, f),
                ..Wrench::default()
            };
            let body = if step % 2 == 0 { 1.0 } else { -1.0 };
            let record = Record {
                step,
                air: vec![of(body), of(force(step))],
                ..Record::default()
            };
            seen.take(&record, wings);
        }
        seen.longest
    }

    #[test]
    fn limit_smooth_forces_do_not_alternate_and_growing_zigzags_do() {
        let smooth = |k: usize| (0.1 * k as f64).sin();
        assert_eq!(longest(smooth, 1), 0);
        assert!(longest_of(0, smooth, 1) > 300); // without wings the body counts
        let zigzag = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let growing = |k: usize| smooth(k) + 1e-6 * 1.05_f64.powi(k as i32) * zigzag(k);
        assert!(longest(growing, 1) > 50);
        let fast = |k: usize| {
            if k < 27 {
                1e-6 * 3_f64.powi(k as i32) * zigzag(k)
            } else {
                0.0
            }
        };
        assert!(longest(fast, 1) > 20);
        assert_eq!(longest(|k| smooth(k) + 0.005 * zigzag(k), 1), 0); // less than counts
        assert_eq!(longest(growing, 3), 0); // steps were left out
        // A hawkmoth's wing that turns among its wakes, the body held: changes of its force, each back from the
        // one before.
        let changes = [
            0.8, 0.16, 0.44, 0.2, 0.06, 0.08, 0.76, 1.0, 0.92, 0.36, 0.24,
        ];
        let jitter =
            |k: usize| -> f64 { (0..k).map(|i| zigzag(i) * changes[i % changes.len()]).sum() };
        assert!(longest(jitter, 1) < 6);
    }
}
