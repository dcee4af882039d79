//! Added masses in any formulation: the added loads from its response to unit loads.

use wingbeat_math::{BodyMotion, Wrench, largest, solve_small};

use crate::added_mass::{seen, wrench};
use crate::{AddedMass, DynamicsError, Solution};

/// Accelerations of all bodies under loads.
pub(crate) type Accelerate<'a> =
    dyn FnMut(&[Wrench], &mut Solution) -> Result<(), DynamicsError> + 'a;

/// Room for the added loads `z` that the accelerations under them ask for, `(1 + A S) z = -A a(0)`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Response {
    /// Motions of all bodies, given before [`Self::add`].
    pub motions: Vec<BodyMotion>,
    /// Added mass and direction of every unknown load.
    unknowns: Vec<(usize, usize)>,
    /// All loads, the trial's added ones among them.
    trial: Vec<Wrench>,
    /// Added loads that the accelerations ask for: under `z` = 0, and under the last trial.
    at_rest: Vec<f64>,
    answer: Vec<f64>,
    z: Vec<f64>,
    /// `1 + A S`, and a copy to be eliminated.
    matrix: Vec<f64>,
    eliminated: Vec<f64>,
}

impl Response {
    /// Adds to `loads` what `added` exerts at time `t` \[s\]. `out` is scratch.
    ///
    /// # Errors
    /// What `accelerate` reports; added masses that no accelerations agree with.
    pub fn add(
        &mut self,
        (t, added): (f64, &[AddedMass]),
        loads: &mut [Wrench],
        accelerate: &mut Accelerate<'_>,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        self.unknowns.clear();
        for (i, a) in added.iter().enumerate() {
            (self.unknowns).extend(a.directions().iter().map(|&k| (i, k)));
        }
        let mut answer = |s: &mut Self| s.answer(added, loads, accelerate, out);
        if !self.linearise(&mut answer)? {
            return Ok(());
        }
        let singular = |_| DynamicsError::SingularAddedMass { time: t };
        self.z.clone_from(&self.at_rest);
        self.eliminated.clone_from(&self.matrix);
        solve_small(&mut self.eliminated, &mut self.z).map_err(singular)?;
        // One step of iterative refinement takes the rounding of the differences away.
        answer(self)?;
        let rest = &mut self.answer;
        rest.iter_mut().zip(&self.z).for_each(|(a, z)| *a -= z);
        solve_small(&mut self.matrix, rest).map_err(singular)?;
        self.z.iter_mut().zip(rest).for_each(|(z, r)| *z += *r);
        put(added, &self.unknowns, &self.z, &self.motions, loads);
        Ok(())
    }

    /// `-A a(0)` and `1 + A S`; false where nothing is to be added.
    fn linearise(
        &mut self,
        answer: &mut impl FnMut(&mut Self) -> Result<(), DynamicsError>,
    ) -> Result<bool, DynamicsError> {
        let n = self.unknowns.len();
        self.z.clear();
        self.z.resize(n, 0.0);
        answer(self)?;
        self.at_rest.clone_from(&self.answer);
        // Any size of the trial loads serves a linear map; theirs own keeps the digits.
        let size = largest(self.at_rest.iter().map(|x| x.abs()));
        if size == 0.0 {
            return Ok(false);
        }
        self.matrix.resize(n * n, 0.0);
        for j in 0..n {
            self.z.fill(0.0);
            self.z[j] = size;
            answer(self)?;
            for i in 0..n {
                let response = (self.answer[i] - self.at_rest[i]) / size;
                self.matrix[i * n + j] = f64::from(i == j) - response;
            }
        }
        Ok(true)
    }

    /// Added loads that the accelerations under `loads` and the trial `z` ask for.
    fn answer(
        &mut self,
        added: &[AddedMass],
        loads: &[Wrench],
        accelerate: &mut Accelerate<'_>,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        self.trial.clear();
        self.trial.extend_from_slice(loads);
        let trial = &mut self.trial;
        put(added, &self.unknowns, &self.z, &self.motions, trial);
        accelerate(trial, out)?;
        let load = |&(i, k): &(usize, usize)| {
            let body = added[i].body();
            added[i].load(&seen(&self.motions[body], &out.bodies[body]))[k]
        };
        self.answer.clear();
        self.answer.extend(self.unknowns.iter().map(load));
        Ok(())
    }
}

/// Adds the components `z` of the added loads to `loads`.
fn put(
    added: &[AddedMass],
    unknowns: &[(usize, usize)],
    z: &[f64],
    motions: &[BodyMotion],
    loads: &mut [Wrench],
) {
    for (&(i, k), z) in unknowns.iter().zip(z) {
        let (body, mut six) = (added[i].body(), [0.0; 6]);
        six[k] = *z;
        loads[body] += wrench(motions[body].r, &six);
    }
}
