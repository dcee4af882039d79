//! Motions that repeat themselves in a whole number of equal steps.

use crate::System;

/// Most steps that are kept: those of a start and of one period.
const MOST: usize = 1 << 12;

/// A motion that is at step number k + `period` where it was at k, from step number `first` on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycle {
    first: usize,
    period: usize,
}

impl Cycle {
    /// The same in steps of half the size.
    pub fn halved(self) -> Self {
        Self {
            first: 2 * self.first,
            period: 2 * self.period,
        }
    }

    /// The step number of the start or of the first period at which the motion is where it is at step number `k`.
    ///
    /// The period of a beat of 100 steps that starts over one beat:
    /// ```
    /// # use wingbeat_dynamics::Cycle;
    /// let cycle = Cycle::new(100, 100);
    /// assert_eq!([7, 107, 207, 1007].map(|k| cycle.fold(k)), [7, 107, 107, 107]);
    /// ```
    pub fn fold(&self, k: usize) -> usize {
        match k > self.last() {
            true => self.first + (k - self.first) % self.period,
            false => k,
        }
    }

    /// Last step number of the first period.
    pub fn last(&self) -> usize {
        self.first + self.period - 1
    }

    /// From step number `first` on, every `period` steps, at least one.
    pub fn new(first: usize, period: usize) -> Self {
        assert!(period > 0, "a period has a step");
        Self { first, period }
    }
}

impl System {
    /// How the laws of the hinges repeat themselves in steps of `step` \[s\]; none where one of them does not, or does
    /// not in whole steps, or where it takes thousands.
    pub fn cycle(&self, step: f64) -> Option<Cycle> {
        let (mut first, mut period) = (0, None);
        for hinge in self.hinges() {
            if hinge.model.travel.is_some() {
                return None;
            }
            let [from, length] = hinge.law.as_ref().map_or(Some([0.0; 2]), |l| l.cycle())?;
            // A start that ends with a step, to roundings.
            first = first.max((from / step - 1e-9).ceil() as usize);
            if length > 0.0 {
                let steps = (length / step).round();
                let whole = (length / step - steps).abs() <= 8.0 * f64::EPSILON * steps;
                if !whole || period.is_some_and(|other| other != steps as usize) {
                    return None;
                }
                period = Some(steps as usize);
            }
        }
        let period = period.unwrap_or(1);
        let known = period > 0 && first.checked_add(period)? <= MOST;
        known.then(|| Cycle::new(first, period))
    }
}
