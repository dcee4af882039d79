//! Trim, stability, controls, power.

use pyo3::PyTraverseError;
use pyo3::gc::PyVisit;
use pyo3::prelude::*;
use wingbeat::analysis::{
    AnalysisError, Bound as Limits, Control, ControlDerivative, LinearModel, Mode, ModeSet, Power,
    STATE, STATE_UNITS, TrimProblem, TrimRequest, UNKNOWNS, Unknown, floquet_of_trim, input_matrix,
    linear_model, power_of_trim, trimmed_controls,
};
use wingbeat::case::{LoadedCase, trimmed_case};
use wingbeat::math::DVec3;

use crate::arrays::array;
use crate::course::{Course, Settings};
use crate::errors::{raised, refused};
use crate::own::OwnFunctions;
use crate::solution::TrimSolution;
use crate::worker::analyse;

/// What is asked of a trim, as Python has it: mean velocity forward, right and up [m/s]; turn to the right [rad/s];
/// names of the unknowns, none for those of its kind; of those with bounds the least and the largest value.
pub type Asked = ([f64; 3], f64, Option<Vec<String>>, Vec<(String, f64, f64)>);

/// What is asked of a trim.
pub fn problem(
    py: Python<'_>,
    flight: &wingbeat::Flight,
    (velocity, turn_rate, unknowns, bounds): &Asked,
    steps: usize,
) -> PyResult<TrimProblem> {
    let named = |list: &Vec<String>| {
        list.iter()
            .map(|name| known(py, "unknowns", name))
            .collect()
    };
    let [forward, right, up] = *velocity;
    let request = TrimRequest {
        velocity: DVec3::new(forward, right, -up),
        turn_rate: *turn_rate,
        unknowns: unknowns.as_ref().map(named).transpose()?,
        bounds: vec![],
        steps: Some(steps),
    };
    let problem = request.problem(&flight.setup);
    let mut problem = problem.map_err(|e| raised(py, &e.into()))?;
    let limits = bounds.iter().map(|b| limits(py, b, &problem.unknowns));
    problem.bounds = limits.collect::<PyResult<_>>()?;
    Ok(problem)
}

/// The unknown of this name, given as `key`.
fn known(py: Python<'_>, key: &str, name: &str) -> PyResult<Unknown> {
    Unknown::from_name(name).ok_or_else(|| {
        let names = UNKNOWNS.map(|u| u.1).join(", ");
        refused(py, key, &format!("`{name}` is not known"), &names)
    })
}

/// Between what one of the `unknowns` must lie.
fn limits(
    py: Python<'_>,
    (name, from, to): &(String, f64, f64),
    unknowns: &[Unknown],
) -> PyResult<Limits> {
    let unknown = known(py, "bounds", name)?;
    let is_range = from < to && from.is_finite() && to.is_finite();
    if !is_range || !unknowns.contains(&unknown) {
        let problem = format!("`{name}` from {from} to {to}");
        let remedy = "finite, the first below the second, of what is among the unknowns";
        return Err(refused(py, "bounds", &problem, remedy));
    }
    let (from, to) = (*from, *to);
    let bound = Limits { unknown, from, to };
    match bound.check() {
        Ok(()) => Ok(bound),
        Err(problem) => {
            let remedy = "parts of 1, which is the whole of what the animal has";
            Err(refused(py, "bounds", &problem, remedy))
        }
    }
}

/// Trims the flight, its feedback left out; its `parts` go with what is found.
pub fn trim(
    py: Python<'_>,
    flight: &wingbeat::Flight,
    problem: TrimProblem,
    case: Option<LoadedCase>,
    parts: OwnFunctions,
) -> PyResult<Trim> {
    let mut open = flight.clone();
    open.setup.feedback = None;
    let found = analyse(py, move || open.trim(&problem))?;
    let trim = found.map_err(|e| raised(py, &e))?;
    Ok(Trim { trim, case, parts })
}

/// A trimmed flight, or the best point that was found.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Trim {
    trim: wingbeat::analysis::Trim,
    /// None where parts written in Python fly, which no case says.
    case: Option<LoadedCase>,
    parts: OwnFunctions,
}

/// Name, plane, growth [1/s], frequency [rad/s], multiplier, eigenvector: component, size, phase [rad].
pub type ModeParts = (
    String,
    String,
    f64,
    f64,
    [f64; 2],
    Vec<(&'static str, f64, f64)>,
);

pub fn modes(set: &ModeSet) -> Vec<ModeParts> {
    let parts = |m: &Mode| {
        let plane = format!("{:?}", m.plane).to_lowercase();
        (
            m.name.clone(),
            plane,
            m.growth,
            m.frequency,
            m.multiplier,
            m.vector.clone(),
        )
    };
    set.modes.iter().map(parts).collect()
}

impl Trim {
    /// Does `work` on the trim beside the interpreter.
    fn analyse<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&wingbeat::analysis::Trim) -> Result<T, AnalysisError> + Send + 'static,
    ) -> PyResult<T> {
        let trim = self.trim.clone();
        let found = analyse(py, move || work(&trim))?;
        found.map_err(|e| raised(py, &e.into()))
    }

    /// Refuses a turn: loads are averaged about a flight that is straight in the mean.
    fn check_straight(&self, py: Python<'_>) -> PyResult<()> {
        match self.trim.turn_rate {
            0.0 => Ok(()),
            _ => Err(refused(
                py,
                "turn_rate_rad_per_s",
                "an averaged model and control derivatives are those of a flight that is straight in the mean",
                "0, or floquet_modes(), power() and flight() of the turn",
            )),
        }
    }

    fn controls(&self, py: Python<'_>) -> PyResult<Vec<ControlDerivative>> {
        self.check_straight(py)?;
        self.analyse(py, trimmed_controls)
    }
}

#[pymethods]
impl Trim {
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.parts.traverse(&visit)
    }

    /// What was found.
    #[getter]
    fn solution(&self) -> TrimSolution {
        TrimSolution(self.trim.solution.clone())
    }

    /// Period of the wingbeat [s].
    #[getter]
    fn period_s(&self) -> f64 {
        self.trim.beat.period()
    }

    /// Mean velocity forward, right and up, asked for or found [m/s].
    #[getter]
    fn velocity(&self) -> [f64; 3] {
        velocity(self.trim.velocity)
    }

    /// The trimmed flight as the text of a case; none where no case says it.
    #[getter]
    fn case_text(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let text = self
            .case
            .as_ref()
            .map(|case| trimmed_case(case, &self.trim));
        text.transpose().map_err(|e| raised(py, &e.into()))
    }

    /// The averaged model: A by rows, derivatives of loads by rows, its modes; Floquet's modes.
    #[allow(clippy::type_complexity)]
    fn stability<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(
        Bound<'py, PyAny>,
        [Bound<'py, PyAny>; 2],
        Vec<ModeParts>,
        Vec<ModeParts>,
    )> {
        self.check_straight(py)?;
        let (model, orbit): (LinearModel, ModeSet) = self.analyse(py, |trim| {
            let model = linear_model(&trim.beat, &trim.state)?;
            Ok((model, floquet_of_trim(trim)?))
        })?;
        let six = |matrix: [[f64; 6]; 6]| array(py, matrix.concat(), &[6, 6]);
        let derivatives = six(model.derivatives)?;
        let added_mass = six(model.added_mass)?;
        Ok((
            array(py, model.matrix, &[9, 9])?,
            [derivatives, added_mass],
            modes(&model.modes),
            modes(&orbit),
        ))
    }

    /// Floquet's modes of the periodic orbit, of turns and with free joints, too.
    fn floquet_modes(&self, py: Python<'_>) -> PyResult<Vec<ModeParts>> {
        Ok(modes(&self.analyse(py, floquet_of_trim)?))
    }

    /// Control derivatives: control, wing, force and moment by it; and the inputs of the averaged model, B of
    /// shape (9, controls).
    #[allow(clippy::type_complexity)]
    fn derivatives<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(
        Vec<(&'static str, String)>,
        Bound<'py, PyAny>,
        Bound<'py, PyAny>,
    )> {
        let found = self.controls(py)?;
        let b = input_matrix(&self.trim.beat, &self.trim.state, &found);
        let b = b.map_err(|e| raised(py, &e.into()))?;
        let names = found.iter().map(|d| (d.control, d.wing.clone())).collect();
        let loads = |d: &ControlDerivative| [d.derivative.force, d.derivative.moment];
        let rows = found.iter().flat_map(loads).flat_map(|v| v.to_array());
        let rows: Vec<f64> = rows.collect();
        let count = found.len();
        Ok((
            names,
            array(py, rows, &[count, 6])?,
            array(py, b, &[9, count])?,
        ))
    }

    /// Mean powers over a wingbeat [W]: aerodynamic, positive inertial, with perfect elastic storage, without
    /// storage, peak, damping of elastic wings; mass [kg].
    fn power(&self, py: Python<'_>) -> PyResult<[f64; 7]> {
        let p = self.analyse(py, power_of_trim)?;
        Ok(powers(&p))
    }

    /// What episodes about it share.
    fn course(&self, py: Python<'_>, settings: Settings) -> PyResult<Course> {
        Course::of(py, self.trim.clone(), settings, self.parts.copy(py))
    }

    /// Names and units of the state of the averaged model, and of the controls.
    #[staticmethod]
    fn names() -> [Vec<(&'static str, &'static str)>; 2] {
        let states = STATE.into_iter().zip(STATE_UNITS);
        let controls = Control::ALL.map(|c| (c.name(), c.unit()));
        [states.collect(), controls.to_vec()]
    }
}

/// A velocity of N components as Python has it: forward, right and up [m/s].
pub fn velocity(v: DVec3) -> [f64; 3] {
    [v.x, v.y, 0.0 - v.z]
}

/// In the order of `wingbeat.Power`.
pub fn powers(p: &Power) -> [f64; 7] {
    [
        p.aerodynamic,
        p.inertial_positive,
        p.perfect_storage,
        p.no_storage,
        p.peak,
        p.damping,
        p.mass,
    ]
}
