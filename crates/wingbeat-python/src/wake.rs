//! Trim and stability in air with a memory and of elastic wings.

use pyo3::prelude::*;
use wingbeat::analysis::wake::{
    WakeMemory, WakeSettings, elastic_floquet, trim_with_wake, wake_modes, wake_monodromy,
};
use wingbeat::analysis::{TrimProblem, power_with_wake};
use wingbeat::case::{LoadedCase, wake_trimmed_case};

use crate::arrays::array;
use crate::errors::{named, raised, refused};
use crate::mechanics::{ModeParts, modes, powers, velocity};
use crate::solution::TrimSolution;
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
    /// What was found.
    #[getter]
    fn solution(&self) -> TrimSolution {
        TrimSolution(self.trim.solution.clone())
    }

    /// Flights flown.
    #[getter]
    fn flights(&self) -> usize {
        self.trim.flights
    }

    /// Mean velocity forward, right and up, as asked for [m/s].
    #[getter]
    fn velocity(&self) -> [f64; 3] {
        velocity(self.trim.velocity)
    }

    /// The trimmed flight as the text of a case; none where no case says it.
    #[getter]
    fn case_text(&self) -> Option<String> {
        let case = self.case.as_ref()?;
        Some(wake_trimmed_case(case, &self.trim))
    }

    /// Powers over the free wingbeat, in the order of `wingbeat.Power`.
    fn power(&self, py: Python<'_>) -> PyResult<[f64; 7]> {
        let trim = self.trim.clone();
        let found = analyse(py, move || power_with_wake(&trim))?;
        let power = found.map_err(|e| raised(py, &e.into()))?;
        Ok(powers(&power))
    }

    /// In the lattice, monodromy matrix of the free wingbeat by rows, and Floquet's modes; held fixed when the body is
    /// disturbed: the wake of the trimmed flight (`given`), or the disturbance during the hold (`carried`).
    fn stability<'py>(
        &self,
        py: Python<'py>,
        wake: &str,
    ) -> PyResult<(Bound<'py, PyAny>, Vec<ModeParts>)> {
        let memories = [
            ("given", WakeMemory::Given),
            ("carried", WakeMemory::Carried),
        ];
        let memory = named(py, "wake", wake, &memories)?;
        if self.trim.is_orbit() {
            let problem = "this flight is periodic with its elastic wings or wakes of strips, and no wake is given or carried";
            let remedy = "floquet_modes(), the modes of body, wings and wakes together";
            return Err(refused(py, "wake", problem, remedy));
        }
        let trim = self.trim.clone();
        let found = analyse(py, move || {
            let matrix = wake_monodromy(&trim, memory)?;
            wake_modes(&trim, &matrix).map(|set| (matrix, set))
        })?;
        let (matrix, set) = found.map_err(|e| raised(py, &e.into()))?;
        Ok((array(py, matrix, &[9, 9])?, modes(&set)))
    }

    /// Floquet's modes of the periodic orbit of body, elastic wings, `count` modes of each, and wakes of strips.
    fn floquet_modes(&self, py: Python<'_>, count: usize) -> PyResult<Vec<ModeParts>> {
        if !self.trim.is_orbit() {
            let problem = "wakes in space have no orbit of few unknowns, and a wingbeat after a hold was trimmed";
            let remedy = "stability(wake=\"given\") and stability(wake=\"carried\"), which bracket its modes";
            return Err(refused(py, "air.model", problem, remedy));
        }
        let trim = self.trim.clone();
        let count = if trim.past.wings.is_empty() { 0 } else { count };
        let found = analyse(py, move || elastic_floquet(&trim, count))?;
        let set = found.map_err(|e| raised(py, &e.into()))?;
        Ok(modes(&set))
    }
}
