//! Whole steps under loads that follow from the motion, and the accelerations to begin with.

use super::generalized_alpha::{GeneralizedAlpha, State, Trial};
use super::solver::{LoadTangent, Solver};
use crate::configuration::NODE;
use crate::error::StructureError;
use crate::frame::FrameMotion;
use crate::inertia::mass_matrix;
use crate::structure::Structure;
use wingbeat_math::DMat3;

/// When Newton's iteration of a step ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passes {
    /// Largest last change \[1\]: rotation \[rad\], translation over the size of the body.
    pub tolerance: f64,
    /// Most passes.
    pub max: usize,
}

impl Default for Passes {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max: 20,
        }
    }
}

impl Passes {
    /// The error for a step that did not converge.
    pub(crate) fn failed(&self, change: f64, residual: f64) -> StructureError {
        StructureError::NotConverged {
            what: "Newton's iteration for a step in time",
            passes: self.max,
            change,
            tolerance: self.tolerance,
            residual,
            remedy: "take a smaller step, or look whether loads, frame or start are what was meant",
        }
    }
}

impl Solver {
    /// Sets the accelerations of a state to those of the equations of motion, with the frame and loads of its time.
    ///
    /// # Errors
    /// [`StructureError::Singular`] if a mass matrix is singular.
    pub fn start(
        &mut self,
        structure: &Structure,
        state: &mut State,
        frame: &FrameMotion,
        loads: &[f64],
    ) -> Result<(), StructureError> {
        state.acceleration.fill(0.0);
        let trial = Trial::of(state);
        self.residual(structure, &trial, frame, loads);
        state.dissipation = self.dissipation(&trial);
        self.assembly.matrix.clear(false);
        for (n, m) in structure.masses.iter().enumerate() {
            let r = DMat3::from_quat(state.configuration.rotation[n]);
            self.assembly.add(structure, [n, n], &mass_matrix(m, r));
        }
        for m in &structure.between {
            let block = mass_matrix(&m.point(), DMat3::IDENTITY);
            self.assembly.add_between(structure, m.nodes, &block);
        }
        self.assembly.factor(structure)?;
        self.solve_residual(structure);
        for (x, &k) in self.change.iter().zip(&structure.number) {
            state.acceleration[k] = *x;
        }
        state.algorithmic.clone_from(&state.acceleration);
        Ok(())
    }

    /// One step h \[s\] under loads that `loads` fills for each trial (six numbers a node, force in W
    /// components, moment in node components; zero at first), in a frame whose motion at the end of the step is
    /// given. Returns the passes made. `trial` is scratch that holds the end of the step afterwards.
    ///
    /// # Errors
    /// [`StructureError`]: no convergence (the state is unchanged then), singular tangent.
    pub fn advance(
        &mut self,
        method: &GeneralizedAlpha,
        structure: &Structure,
        state: &mut State,
        step: Step<'_>,
        trial: &mut Trial,
    ) -> Result<usize, StructureError> {
        method.predict(structure, state, step.h, trial);
        let mut change = f64::INFINITY;
        let mut loads = std::mem::take(&mut self.given);
        for pass in 1..=step.passes.max {
            loads.clear();
            loads.resize(NODE * structure.nodes(), 0.0);
            (step.loads)(trial, &mut loads);
            self.residual(structure, trial, step.frame, &loads);
            if change <= step.passes.tolerance {
                self.accept(trial, state);
                self.given = loads;
                return Ok(pass);
            }
            self.factor(structure, trial, step.frame, &LoadTangent::default())?;
            change = self.correct(structure, trial);
            if !change.is_finite() {
                break;
            }
        }
        self.given = loads;
        Err(step.passes.failed(change, self.largest_residual(structure)))
    }
}

/// What a step is made with.
pub struct Step<'a> {
    /// Its length \[s\].
    pub h: f64,
    /// Motion of the frame at its end.
    pub frame: &'a FrameMotion,
    /// Fills the loads on the nodes for a trial.
    pub loads: &'a mut dyn FnMut(&Trial, &mut [f64]),
    /// When Newton's iteration ends.
    pub passes: Passes,
}
