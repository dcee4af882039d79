//! Trim and stability in air with a memory: the vortex lattice.

use pyo3::prelude::*;
use wingbeat::analysis::wake::{
    WakeMemory, WakeSettings, trim_with_wake, wake_modes, wake_monodromy,
};
use wingbeat::analysis::{TrimProblem, power_with_wake};
use wingbeat::case::{LoadedCase, wake_trimmed_case};

use crate::arrays::array;
use crate::errors::{named, raised};
use crate::mechanics::{ModeParts, modes, powers};
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

    /// Monodromy matrix of the free wingbeat by rows, and Floquet's modes; held fixed when the body is
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
        let trim = self.trim.clone();
        let found = analyse(py, move || {
            let matrix = wake_monodromy(&trim, memory)?;
            wake_modes(&trim, &matrix).map(|set| (matrix, set))
        })?;
        let (matrix, set) = found.map_err(|e| raised(py, &e.into()))?;
        Ok((array(py, matrix, &[9, 9])?, modes(&set)))
    }
}
