//! The coupled right-hand side over the starting steps of a multistep method.

use wingbeat_dynamics::Wrench;
use wingbeat_math::DVec3;
use wingbeat_math::ode::{Multistep, Replay};

use crate::carried::CarriedState;
use crate::elastic::ElasticState;
use crate::equations::quadratures::IMPULSES;
use crate::equations::{Equations, Memory, Scratch};
use crate::error::FlightError;
use crate::interface::memory::AirMemory;

/// Weights of f0 to f3 in `(y_k - y_0) / h` of impulses of a support of elastic wings, whose accelerations are
/// all along the first step what they are at its end, and change evenly within later ones.
const OF_ENDS: [[f64; 4]; 3] = [
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 1.5, 0.5, 0.0],
    [0.0, 1.5, 1.0, 0.5],
];

/// Makes the impulses in the starting steps, of states of `dim` numbers before the quadratures in steps of
/// `step` \[s\], those of what the wings do in them: the force of the first instant is gone before any step
/// ends.
pub(super) fn take_impulses_of_ends(past: &mut Multistep, (dim, step): (usize, f64)) {
    for i in IMPULSES.map(|k| dim + k) {
        for (k, weights) in OF_ENDS.iter().enumerate() {
            let all = weights.iter().zip(&past.f);
            let sum: f64 = all.map(|(w, f)| w * f[i]).sum();
            past.y[k + 1][i] = past.y[0][i] + step * sum;
        }
    }
}

/// A step \[s\], and the number of the step at which a stage begins.
pub(super) struct At {
    pub step: f64,
    pub first: usize,
}

/// Weights of f0 to f3 in `(y_k - y_0) / h` of a start of order four, whose rates change evenly from the first
/// instant on.
const EVEN: [[f64; 4]; 3] = [
    [9.0 / 24.0, 19.0 / 24.0, -5.0 / 24.0, 1.0 / 24.0],
    [1.0 / 3.0, 4.0 / 3.0, 1.0 / 3.0, 0.0],
    [3.0 / 8.0, 9.0 / 8.0, 9.0 / 8.0, 3.0 / 8.0],
];

/// Makes the places in the starting steps of bodies whose accelerations jump those to which their velocities
/// lead, which do not: what has rates that no load changes.
///
/// # Errors
/// What the dynamics report.
pub(super) fn follow_velocities(
    past: &mut Multistep,
    equations: &Equations,
    at: At,
) -> Result<(), FlightError> {
    let (core, n) = (&equations.core, equations.core.dim());
    let (mut ws, bodies) = (core.workspace(), core.system().bodies().len());
    let t = at.first as f64 * at.step;
    let mut under = |push: DVec3| -> Result<Vec<f64>, FlightError> {
        let load = Wrench {
            force: push,
            moment: push,
        };
        let mut rates = vec![0.0; n];
        core.rates(t, &past.y[0][..n], &vec![load; bodies], &mut ws, &mut rates)?;
        Ok(rates)
    };
    let (still, pushed) = (under(DVec3::ZERO)?, under(DVec3::new(1.0, 2.0, 3.0))?);
    for i in (0..n).filter(|&i| still[i] == pushed[i]) {
        for (k, weights) in EVEN.iter().enumerate() {
            let all = weights.iter().zip(&past.f);
            let sum: f64 = all.map(|(w, f)| w * f[i]).sum();
            past.y[k + 1][i] = past.y[0][i] + at.step * sum;
        }
    }
    Ok(())
}

/// The coupled right-hand side over the starting steps: the wake is replayed with them.
pub(super) struct StartingSteps<'a> {
    pub equations: &'a Equations,
    pub scratch: Scratch,
    pub first: usize,
    pub at_start: &'a Option<AirMemory>,
    pub air: Option<AirMemory>,
    pub wings_at_start: &'a [ElasticState],
    pub wings: Vec<ElasticState>,
    pub carried_at_start: &'a [CarriedState],
    pub carried: Vec<CarriedState>,
}

impl StartingSteps<'_> {
    pub fn time(&self, k: usize) -> f64 {
        (self.first + k) as f64 * self.equations.step
    }
}

impl Replay for StartingSteps<'_> {
    type Error = FlightError;

    fn enter(&mut self, k: usize) -> Result<(), FlightError> {
        if k == 1 {
            self.air.clone_from(self.at_start);
            self.wings.clear();
            self.wings.extend_from_slice(self.wings_at_start);
            self.carried.clear();
            self.carried.extend_from_slice(self.carried_at_start);
        }
        self.equations.advance_air(&mut self.air, &mut self.scratch)
    }

    fn rates(&mut self, k: usize, y: &[f64], f: &mut [f64]) -> Result<(), FlightError> {
        let t = self.time(k);
        let memory = Memory {
            air: self.air.as_ref(),
            wings: &self.wings,
            carried: &self.carried,
        };
        self.equations.evaluate(t, y, memory, &mut self.scratch, f)
    }

    fn leave(&mut self, _k: usize) -> Result<(), FlightError> {
        let remembered = (&mut self.wings[..], &mut self.carried[..]);
        (self.equations).accept(&mut self.air, remembered, &self.scratch)
    }
}
