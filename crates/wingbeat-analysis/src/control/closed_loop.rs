//! The loop that a regulator closes over a wingbeat of the linear flight: states that are seen, free joints,
//! which are not, what the regulator remembers, and commands in force and under way.
//!
//! ```text
//! z[k+1] = F z[k]        the departure dies out where every eigenvalue of F is less than 1 in size
//! ```

use std::collections::VecDeque;

use crate::AnalysisError;
use crate::beat::JOINTS;
use crate::control::departure::{CONTROLS, Controls, Departure, pass_on};
use crate::control::regulator::plant::{STATES, natural_sizes};
use crate::control::regulator::{Regulator, Timing};
use crate::stability::eigen::{Eigenpair, eigen};
use crate::trim::Trim;

/// Growth in a wingbeat from which a departure is not said to die out: rounding and differences are below it.
const STEADY: f64 = 1.0 - 1e-6;

/// The loop that `regulator` closes over the trimmed flight.
struct ClosedLoop<'a> {
    trim: &'a Trim,
    regulator: &'a Regulator,
    timing: &'a Timing,
}

impl Regulator {
    /// An error if free joints keep it from holding the flight that it was laid out for.
    ///
    /// # Errors
    /// A departure of the closed loop that grows or stays, with the joint that has the largest part in it.
    pub(crate) fn check_joints(&self, trim: &Trim, timing: &Timing) -> Result<(), AnalysisError> {
        let closed = ClosedLoop {
            trim,
            regulator: self,
            timing,
        };
        closed.check()
    }
}

impl ClosedLoop<'_> {
    /// An error if a departure of a flight with free joints grows or stays.
    fn check(&self) -> Result<(), AnalysisError> {
        if self.trim.beat.joint_sizes().is_empty() {
            return Ok(());
        }
        let pair = self.slowest()?;
        let growth = size(&pair);
        if growth < STEADY {
            return Ok(());
        }
        Err(AnalysisError::not_covered(
            format!(
                "feedback would not hold this flight: the closed loop of body, free joints and commands under way has a departure that becomes {growth:.3} times itself in a wingbeat; of the joints, which are not seen, {} has the largest part in it",
                self.joint(&pair)
            ),
            "its own motion does not die out, and neither weights nor looks reach it: give the joint damping, or weld it",
        ))
    }

    /// The eigenvalue that is largest in size, with its eigenvector in natural sizes.
    fn slowest(&self) -> Result<Eigenpair, AnalysisError> {
        let commands = CONTROLS * (self.timing.latency + 1);
        let mut sizes = natural_sizes(&self.trim.beat);
        let rest = self.regulator.memory().len() + commands;
        sizes.extend(std::iter::repeat_n(1.0, rest));
        let n = sizes.len();
        let mut a = vec![0.0; n * n];
        for j in 0..n {
            let mut z = vec![0.0; sizes.len()];
            z[j] = sizes[j];
            let ahead = self.advance(z);
            for i in 0..n {
                a[i * n + j] = ahead[i] / sizes[i];
            }
        }
        let pairs = eigen(&a, n)?.into_iter();
        let pair = pairs
            .max_by(|p, q| size(p).total_cmp(&size(q)))
            .expect("states");
        Ok(pair)
    }

    /// A wingbeat from states, memory of the regulator and commands `z`, oldest first.
    fn advance(&self, z: Vec<f64>) -> Vec<f64> {
        let mut regulator = self.regulator.clone();
        let (x, rest) = z.split_at(self.regulator.plants()[0].states());
        let (memory, commands) = rest.split_at(regulator.memory().len());
        regulator.restore(memory).expect("its own memory");
        let mut x = x.to_vec();
        let mut queue: VecDeque<Controls> = commands.as_chunks().0.iter().copied().collect();
        let share = self.timing.share();
        for (look, plant) in self.regulator.plants().iter().enumerate() {
            let d = Departure::from_states(look, &x);
            let u = regulator.controls(&d);
            regulator.remember(&d, u, 1);
            let now = pass_on(&mut queue, u, share);
            x = plant.advance(&x, &now, &queue[0]);
        }
        let commands = queue.iter().flatten().copied();
        x.into_iter()
            .chain(regulator.memory())
            .chain(commands)
            .collect()
    }

    /// The free joint that moves most, by its rate.
    fn joint(&self, pair: &Eigenpair) -> String {
        let beat = &self.trim.beat;
        let joints = beat.joints(&self.trim.state);
        let names = joints
            .iter()
            .flat_map(|(name, _, rates)| vec![name; rates.len()]);
        let coordinates = self.trim.state.len() - JOINTS - names.clone().count();
        let rates = pair.vector[STATES + coordinates..].iter();
        let parts = rates.map(|[re, im]| re.hypot(*im));
        let most = names.zip(parts).max_by(|a, b| a.1.total_cmp(&b.1));
        most.map_or_else(String::new, |(name, _)| name.clone())
    }
}

/// The size of an eigenvalue.
fn size(pair: &Eigenpair) -> f64 {
    pair.value[0].hypot(pair.value[1])
}
