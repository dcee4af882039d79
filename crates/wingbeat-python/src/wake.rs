//! Trim and stability in air with a memory: the vortex lattice.

use pyo3::prelude::*;
use wingbeat::analysis::wake::{
    WakeMemory, WakeSettings, trim_with_wake, wake_modes, wake_monodromy,
};
use wingbeat::analysis::{TrimProblem, Unknown, power_with_wake};
use wingbeat::case::{LoadedCase, wake_trimmed_case};

use crate::arrays::array;
use crate::errors::raised;
use crate::mechanics::{ModeParts, modes, powers};
use crate::worker::analyse;

/// Trims the flight, its feedback left out.
pub fn trim(
    py: Python<'_>,
    flight: &wingbeat::Flight,
    problem: TrimProblem,
    settings: WakeSettings,
    case: Option<LoadedCase>,
) -> PyResult<WakeTrim> {
    let mut setup = flight.setup.clone();
    setup.feedback = None;
    let found = analyse(py, move || trim_with_wake(&setup, &problem, &settings))?;
    let trim = found.map_err(|e| raised(py, &e.into()))?;
    Ok(WakeTrim { trim, case })
}

/// A trimmed flight in air with a memory, or the best point that was found.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct WakeTrim {
    trim: wingbeat::analysis::wake::WakeTrim,
    /// None where parts written in Python fly, which no case says.
    case: Option<LoadedCase>,
}

#[pymethods]
impl WakeTrim {
    /// Whether it is steady flight, and within the bounds that were asked.
    #[getter]
    fn is_as_asked(&self) -> bool {
        self.trim.is_as_asked()
    }

    /// Whether the residual is within the tolerance.
    #[getter]
    fn converged(&self) -> bool {
        self.trim.converged
    }

    /// The residuals; see `wingbeat.WakeTrim`.
    #[getter]
    fn residual<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        array(py, self.trim.residual.clone(), &[self.trim.residual.len()])
    }

    /// Quasi-Newton steps made, and flights flown.
    #[getter]
    fn effort(&self) -> (usize, usize) {
        (self.trim.iterations, self.trim.flights)
    }

    /// The adjustment of all wings, in the order of `wingbeat.Adjustment`.
    #[getter]
    fn adjustment(&self) -> [f64; 8] {
        self.trim.adjustment.numbers().map(|(_, x)| x)
    }

    /// What right wings have more of it than left ones.
    #[getter]
    fn difference(&self) -> [f64; 8] {
        self.trim.difference.numbers().map(|(_, x)| x)
    }

    /// Roll of the body at its release [rad].
    #[getter]
    fn body_roll_rad(&self) -> f64 {
        self.trim.body_roll
    }

    /// Names of the unknowns outside their bounds, and of those at one.
    #[getter]
    fn at_bounds(&self) -> [Vec<&'static str>; 2] {
        let names = |list: &[Unknown]| list.iter().map(|u| u.name()).collect();
        [names(&self.trim.outside), names(&self.trim.at_bound)]
    }

    /// Pitch of the body at its release [rad].
    #[getter]
    fn body_pitch_rad(&self) -> f64 {
        self.trim.body_pitch
    }

    /// The trimmed flight as the text of a case; none where no case says it.
    #[getter]
    fn case_text(&self) -> Option<String> {
        let case = self.case.as_ref()?;
        Some(wake_trimmed_case(case, &self.trim))
    }

    /// Powers over the free wingbeat, in the order of `wingbeat.Power`.
    fn power(&self, py: Python<'_>) -> PyResult<[f64; 6]> {
        let trim = self.trim.clone();
        let found = analyse(py, move || power_with_wake(&trim))?;
        let power = found.map_err(|e| raised(py, &e.into()))?;
        Ok(powers(&power))
    }

    /// Monodromy matrix of the free wingbeat by rows, and Floquet's modes; held fixed when the body is disturbed: the wake of
    /// the trimmed flight (`is_given`), or the disturbance during the hold.
    fn stability<'py>(
        &self,
        py: Python<'py>,
        is_given: bool,
    ) -> PyResult<(Bound<'py, PyAny>, Vec<ModeParts>)> {
        let trim = self.trim.clone();
        let found = analyse(py, move || {
            let memory = match is_given {
                true => WakeMemory::Given,
                false => WakeMemory::Carried,
            };
            let matrix = wake_monodromy(&trim, memory)?;
            wake_modes(&trim, &matrix).map(|set| (matrix, set))
        })?;
        let (matrix, set) = found.map_err(|e| raised(py, &e.into()))?;
        Ok((array(py, matrix, &[9, 9])?, modes(&set)))
    }
}
