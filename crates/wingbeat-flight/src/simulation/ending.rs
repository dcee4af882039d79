//! Why a flight ended: errors that growth on a free joint makes are said to be its, and what surfaces meet that a
//! diverging motion throws about is said to be that.

use std::f64::consts::TAU;

use wingbeat_dynamics::DynamicsError;

use super::Simulation;
use crate::bodies::joint_steps::{growing_joint, stiff_joint};
use crate::error::FlightError;
use crate::setup::{FormulationChoice, IntegratorChoice};

/// Lengths of a flyer by which no body moves in a step [1].
const LENGTHS: f64 = 100.0;

impl Simulation {
    /// The error `ended` of a step, or what made it: a free joint whose motion the integrator does not carry,
    /// or whose spring is far stiffer than steps resolve.
    pub(super) fn explained(&self, ended: FlightError) -> FlightError {
        let may_follow = matches!(
            ended,
            FlightError::Dynamics(DynamicsError::NotFinite { .. })
                | FlightError::NotConverged { .. }
                | FlightError::Asymmetric { .. }
                | FlightError::TurnedPast { .. }
                | FlightError::Air(_)
        );
        if !may_follow {
            return ended;
        }
        let (setup, integrator) = (&self.setup, self.setup.integrator.name());
        let time = self.time(self.state.step);
        let ended = Box::new(ended);
        if let Some(found) = growing_joint(setup).or_else(|| stiff_joint(setup)) {
            return FlightError::JointGrows {
                time,
                acts: Some(found.said(setup)),
                joint: found.joint,
                integrator,
                remedy: found.remedy,
                ended,
            };
        }
        let is_explicit = matches!(
            setup.integrator,
            IntegratorChoice::Hamming | IntegratorChoice::Adams
        );
        let is_of_place = matches!(*ended, FlightError::Asymmetric { .. } | FlightError::Air(_));
        match is_explicit.then(|| self.alternating_joint()).flatten() {
            Some(joint) => FlightError::JointGrows {
                time,
                joint,
                integrator,
                acts: None,
                remedy: "dynamics.integrator = \"bdf\", or more steps (time.steps_per_beat, or a smaller time.step_s)".into(),
                ended,
            },
            None if is_of_place => self.diverged(time).unwrap_or(*ended),
            None => *ended,
        }
    }

    /// The error of a free motion that diverges within a step, by what was evaluated last: a root that turns by more
    /// than a whole turn in it, or moves by more than a hundred lengths of the flyer.
    fn diverged(&self, time: f64) -> Option<FlightError> {
        let (core, step) = (&self.equations().core, self.setup.time.step);
        let (body, motion) = (core.system().bodies().first()?, self.scratch.motions[0]);
        let [turned, moved] = [motion.w, motion.v].map(|x| x.length() * step);
        let is_thrown = turned > TAU || moved > LENGTHS * core.system().units().length;
        // Numbers that are none have causes of their own.
        if core.is_supported() || !is_thrown || !(turned + moved).is_finite() {
            return None;
        }
        Some(FlightError::Diverged {
            time,
            body: body.name.clone(),
            turned: turned.to_degrees(),
            moved,
            remedy: match self.setup.formulation {
                FormulationChoice::Euler(_) => {
                    "more steps (time.steps_per_beat, or a smaller time.step_s), or dynamics.formulation = \"momentum\""
                }
                _ => {
                    "more steps (time.steps_per_beat, or a smaller time.step_s), or corrector.relaxation below 1"
                }
            },
        })
    }

    /// The first joint whose rate went to and fro in the last steps, farther each time.
    fn alternating_joint(&self) -> Option<String> {
        let equations = self.equations();
        let (core, mechanism) = (&equations.core, &equations.mechanism);
        let t = self.time(self.state.step);
        let mut motions = self.scratch.motions.clone();
        let mut rates: Vec<Vec<f64>> = vec![];
        for y in &self.state.past.y {
            let mut found = vec![];
            let state = y.get(..core.dim())?; // without quadratures
            core.motions(t, state, &mut core.workspace(), &mut motions)
                .ok()?;
            mechanism.coordinates(t, &motions, &mut found);
            rates.push(found.iter().map(|[_, rate]| *rate).collect());
        }
        let names = mechanism.joints().iter();
        let names = names.flat_map(|j| (0..j.model.kind.directions()).map(|_| &j.name));
        let of = |k: usize| std::array::from_fn(|n| rates[n][k]);
        names
            .enumerate()
            .find(|(k, _)| zigzags(of(*k)))
            .map(|(_, name)| name.clone())
    }
}

/// Whether rates at four steps, oldest first, go to and fro, farther each time.
fn zigzags(u: [f64; 4]) -> bool {
    let [a, b, c] = [u[1] - u[0], u[2] - u[1], u[3] - u[2]];
    a * b < 0.0 && b * c < 0.0 && b.abs() > a.abs() && c.abs() > b.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_rates_that_alternate_and_grow_zigzag() {
        assert!(zigzags([1.0, -1.5, 2.25, -3.375]));
        assert!(zigzags([10.0 + 1.0, 10.0 - 1.5, 10.0 + 2.25, 10.0 - 3.375]));
        assert!(!zigzags([1.0, -0.5, 0.25, -0.125]), "dies out");
        assert!(!zigzags([1.0, 2.0, 4.0, 8.0]), "grows one way");
        assert!(!zigzags([0.0; 4]));
    }
}
