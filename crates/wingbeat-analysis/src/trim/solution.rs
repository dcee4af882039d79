//! What solves the equations of steady flight, in whatever air: the controls found, and what is left of the equations.

use wingbeat_flight::FlightSetup;
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::trim::lost::Way;
use crate::trim::preconditions::check_symmetric;
use crate::trim::problem::TrimProblem;
use crate::trim::root::largest;
use crate::trim::unknown::{Unknown, adjusted};

/// The solution of a [`TrimProblem`], or the best point found.
#[derive(Clone, Debug)]
pub struct TrimSolution {
    /// Whether the residual is within the tolerance.
    pub converged: bool,
    /// The residuals, [`Residuals::names`](crate::Residuals::names); then the change of every coordinate and
    /// speed of a free joint over its natural size.
    pub residual: Vec<f64>,
    /// Largest lateral residual where only those of the plane of symmetry are asked, else 0 \[1\].
    pub lateral: f64,
    /// Steps of Newton's method made, in air with memory of a quasi-Newton method.
    pub iterations: usize,
    /// What was chosen, in the order in which it was named, and what was given.
    pub unknowns: Vec<Unknown>,
    /// Values of the unknowns \[1, rad or m/s\].
    pub values: Vec<f64>,
    /// Unknowns whose values are outside the bounds of the problem: steady flight, but not as asked.
    pub outside: Vec<Unknown>,
    /// Unknowns at a bound.
    pub at_bound: Vec<Unknown>,
    /// The adjustment of all wings.
    pub adjustment: Adjustment,
    /// What right wings have more of it than left ones.
    pub difference: Adjustment,
    /// Shift of the mass centre of the body along b1, against its hinges [m].
    pub mass_centre: f64,
    /// Change of the feathering angle of the tail, leading edge up \[rad\].
    pub tail_incidence: f64,
    /// Relative change of what drives joints \[1\].
    pub drive_amplitude: f64,
    /// Pitch of the body at the start of the beat, in air with memory at its release \[rad\].
    pub body_pitch: f64,
    /// Roll of the body then, right side down \[rad\].
    pub body_roll: f64,
    /// Where it was sought by way of slower flights and not found: how far they led.
    pub way: Option<Way>,
}

impl TrimSolution {
    /// The point at which the unknowns of `problem` have the values `chosen`, its residuals not known yet; and
    /// the setup with them.
    pub(crate) fn at(
        setup: &FlightSetup,
        problem: &TrimProblem,
        chosen: &[f64],
    ) -> (Self, FlightSetup) {
        let (unknowns, values) = problem.with_given(chosen);
        let a = adjusted(setup, &unknowns, problem.angles(), &values);
        let [outside, at_bound] = problem.beyond(&unknowns, &values);
        let point = Self {
            converged: false,
            residual: vec![],
            lateral: 0.0,
            iterations: 0,
            unknowns,
            values,
            outside,
            at_bound,
            adjustment: a.adjustment,
            difference: a.difference,
            mass_centre: a.mass_centre,
            tail_incidence: a.tail_incidence,
            drive_amplitude: a.drive_amplitude,
            body_pitch: a.pitch,
            body_roll: a.roll,
            way: None,
        };
        (point, a.setup)
    }

    /// Found after `iterations` steps: whether the residuals are within `tolerance`.
    ///
    /// # Errors
    /// Lateral residuals beyond `rounding` of what was trimmed in the plane of symmetry.
    pub(crate) fn conclude(
        &mut self,
        iterations: usize,
        tolerance: f64,
        rounding: f64,
    ) -> Result<(), AnalysisError> {
        self.iterations = iterations;
        self.converged = self.error() <= tolerance;
        match self.converged {
            true => check_symmetric(self.lateral, rounding),
            false => Ok(()), // elsewhere rounding grows with the numbers
        }
    }

    /// Lists unknowns as in `names`, those that are not there after them.
    pub(crate) fn in_order_of(&mut self, names: &[Unknown]) {
        let place = |u: &Unknown| names.iter().position(|n| n == u).unwrap_or(names.len());
        let pairs = self.unknowns.iter().copied().zip(self.values.drain(..));
        let mut pairs: Vec<(Unknown, f64)> = pairs.collect();
        pairs.sort_by_key(|(u, _)| place(u));
        (self.unknowns, self.values) = pairs.into_iter().unzip();
        for list in [&mut self.outside, &mut self.at_bound] {
            list.sort_by_key(place);
        }
    }

    /// The value of an unknown, in its own unit; none if it was neither chosen nor given.
    pub fn value(&self, unknown: Unknown) -> Option<f64> {
        let mut pairs = self.unknowns.iter().zip(&self.values);
        pairs.find(|(u, _)| **u == unknown).map(|(_, x)| *x)
    }

    /// Largest residual.
    pub fn error(&self) -> f64 {
        largest(&self.residual)
    }

    /// Whether it is steady flight, and within the bounds that were asked.
    pub fn is_as_asked(&self) -> bool {
        self.converged && self.outside.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_unknowns_are_listed_in_the_order_in_which_they_are_named() {
        use Unknown::{BodyPitch, Frequency, MassCentre, StrokeAmplitude};
        let mut found = TrimSolution {
            converged: true,
            residual: vec![],
            lateral: 0.0,
            iterations: 1,
            unknowns: vec![Frequency, MassCentre, BodyPitch, StrokeAmplitude],
            values: vec![1.0, 2.0, 3.0, 4.0],
            outside: vec![],
            at_bound: vec![StrokeAmplitude, Frequency],
            adjustment: Adjustment::default(),
            difference: Adjustment::default(),
            mass_centre: 0.0,
            tail_incidence: 0.0,
            drive_amplitude: 0.0,
            body_pitch: 0.0,
            body_roll: 0.0,
            way: None,
        };
        found.in_order_of(&[BodyPitch, Frequency, StrokeAmplitude]);
        let order = [BodyPitch, Frequency, StrokeAmplitude, MassCentre];
        assert_eq!(found.unknowns, order);
        assert_eq!(found.values, [3.0, 1.0, 4.0, 2.0]);
        assert_eq!(found.at_bound, [Frequency, StrokeAmplitude]);
    }
}
