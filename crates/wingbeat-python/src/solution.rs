//! What trims in any air find.

use pyo3::prelude::*;
use wingbeat::analysis::Unknown;

use crate::arrays::array;

/// The solution of a trim problem, or the best point found.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct TrimSolution(pub wingbeat::analysis::TrimSolution);

#[pymethods]
impl TrimSolution {
    /// Whether it is steady flight, and within the bounds that were asked.
    #[getter]
    fn is_as_asked(&self) -> bool {
        self.0.is_as_asked()
    }

    /// Whether the residual is within the tolerance.
    #[getter]
    fn converged(&self) -> bool {
        self.0.converged
    }

    /// The residuals; see `wingbeat.Trim`.
    #[getter]
    fn residual<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        array(py, self.0.residual.clone(), &[self.0.residual.len()])
    }

    /// Steps of Newton's method made, in air with a memory of a quasi-Newton method.
    #[getter]
    fn iterations(&self) -> usize {
        self.0.iterations
    }

    /// The adjustment of all wings, in the order of `wingbeat.Adjustment`.
    #[getter]
    fn adjustment(&self) -> [f64; 8] {
        self.0.adjustment.numbers().map(|(_, x)| x)
    }

    /// What right wings have more of it than left ones.
    #[getter]
    fn difference(&self) -> [f64; 8] {
        self.0.difference.numbers().map(|(_, x)| x)
    }

    /// Names of the unknowns outside their bounds, and of those at one.
    #[getter]
    fn at_bounds(&self) -> [Vec<&'static str>; 2] {
        let names = |list: &[Unknown]| list.iter().map(|u| u.name()).collect();
        [names(&self.0.outside), names(&self.0.at_bound)]
    }

    /// Values of the unknowns by their names, in their own units.
    #[getter]
    fn unknowns(&self) -> Vec<(&'static str, f64)> {
        let names = self.0.unknowns.iter().map(|u| u.name());
        names.zip(self.0.values.iter().copied()).collect()
    }

    /// Shift of the mass centre along b1 [m].
    #[getter]
    fn mass_centre_m(&self) -> f64 {
        self.0.mass_centre
    }

    /// Change of the feathering angle of the tail, leading edge up [rad].
    #[getter]
    fn tail_incidence_rad(&self) -> f64 {
        self.0.tail_incidence
    }

    /// Pitch of the body at the start of the beat, in air with a memory at its release [rad].
    #[getter]
    fn body_pitch_rad(&self) -> f64 {
        self.0.body_pitch
    }

    /// Roll of the body then [rad].
    #[getter]
    fn body_roll_rad(&self) -> f64 {
        self.0.body_roll
    }
}
