//! Flights.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use pyo3::PyTraverseError;
use pyo3::gc::PyVisit;
use pyo3::prelude::*;
use wingbeat::analysis::TrimSettings;
use wingbeat::analysis::wake::WakeSettings;
use wingbeat::campaign::named;
use wingbeat::case::{IoError, LoadedCase, OwnControl};
use wingbeat::flight::{AirModel, MotionMode, Snapshot};

use crate::errors::{raised, refused};
use crate::frame::is_framed;
use crate::mechanics::{self, Trim};
use crate::own::{OwnFunctions, PendingException, air, controller};
use crate::run::Run;
use crate::stepping::Stepper;
use crate::threads::detached;
use crate::vibration;
use crate::wake::{self, WakeTrim};
use crate::worker::{Worked, work};

/// A flight: a case, keys set on top of it, and parts written in Python.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Flight {
    flight: wingbeat::Flight,
    case: LoadedCase,
    /// Folder that paths in the case are relative to.
    base: PathBuf,
    sets: Vec<String>,
    /// Exceptions of parts written in Python.
    pending: PendingException,
    /// Such parts, if it has any.
    parts: OwnFunctions,
    /// Whether one of these remembers what it was called with.
    remembers: bool,
}

impl Flight {
    fn of(case: LoadedCase, base: PathBuf, sets: Vec<String>) -> Self {
        Self {
            flight: case.clone().into(),
            case,
            base,
            sets,
            pending: PendingException::default(),
            parts: OwnFunctions::default(),
            remembers: false,
        }
    }

    /// The same with another part, a `function` which may remember what it was called with.
    fn with(
        &self,
        function: Bound<'_, PyAny>,
        remembers: bool,
        change: impl FnOnce(&mut wingbeat::Flight),
    ) -> Self {
        let mut flight = self.flight.clone();
        change(&mut flight);
        Self {
            flight,
            case: self.case.clone(),
            base: self.base.clone(),
            sets: self.sets.clone(),
            pending: self.pending.clone(),
            parts: self.parts.copy(function.py()).with(function.unbind()),
            remembers: self.remembers || remembers,
        }
    }
}

impl Flight {
    /// What `[control]` says to a controller written in Python.
    fn own_control(&self, py: Python<'_>) -> PyResult<Option<OwnControl>> {
        let own = self.case.own_control();
        own.map_err(|e| raised(py, &IoError::Case(e).into()))
    }

    /// Refuses to trim in air written in Python that has a memory.
    fn check_memory(&self, py: Python<'_>) -> PyResult<()> {
        if self.is_own() && matches!(self.flight.setup.air, AirModel::External(_)) {
            let problem = "it has a memory (`accept`): no wingbeat need be like the next";
            let remedy = "air without `accept` whose `is_steady_and_uniform` is True; or fly it";
            return Err(refused(py, "air", problem, remedy));
        }
        Ok(())
    }

    /// Refuses a map of one wingbeat where air or wings remember.
    fn check_map(&self, py: Python<'_>) -> PyResult<()> {
        let setup = &self.flight.setup;
        let (key, problem) = match (&setup.air, setup.animal.is_elastic()) {
            (AirModel::VortexLattice(_), _) => ("air.model", "the lattice has wakes"),
            (_, true) => ("wing.structure", "loads bend the wings"),
            (air, _) if air.has_strip_wakes() => ("air.blade.unsteady", "the strips have wakes"),
            _ => return Ok(()),
        };
        let problem = format!("{problem}, and a wingbeat depends on those before it");
        let remedy = "air.model = \"blade_element\" without air.blade.unsteady and rigid wings; to trim such a flight trim_with_wake() takes the memory along";
        Err(refused(py, key, &problem, remedy))
    }
}

#[pymethods]
impl Flight {
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.parts.traverse(&visit)
    }

    /// A preset or case file with keys set to other values, each as `KEY=VALUE`.
    #[staticmethod]
    fn find(py: Python<'_>, name: &str, sets: Vec<String>) -> PyResult<Self> {
        let case = LoadedCase::find(name, &sets).map_err(|e| raised(py, &e.into()))?;
        let path = Path::new(name);
        let parent = path.is_file().then(|| path.parent()).flatten();
        Ok(Self::of(
            case,
            parent.map(Path::to_owned).unwrap_or_default(),
            sets,
        ))
    }

    /// The case of this text; `origin` names it in messages, paths in it are relative to `base`.
    #[staticmethod]
    fn from_text(
        py: Python<'_>,
        origin: &str,
        text: &str,
        base: PathBuf,
        sets: Vec<String>,
    ) -> PyResult<Self> {
        let case = LoadedCase::from_text(origin, text, &base, &sets);
        let case = case.map_err(|e| raised(py, &e.into()))?;
        Ok(Self::of(case, base, sets))
    }

    /// The same with further keys set to other values.
    fn set(&self, py: Python<'_>, sets: Vec<String>) -> PyResult<Self> {
        if self.is_own() {
            let problem = "this flight has parts written in Python";
            let remedy = "set keys first, then with_controller and with_air";
            return Err(refused(py, "set", problem, remedy));
        }
        let sets = [&self.sets[..], &sets].concat();
        Self::from_text(
            py,
            self.case.origin(),
            self.case.text(),
            self.base.clone(),
            sets,
        )
    }

    /// Whether the case gives a key.
    fn gives(&self, key: &str) -> bool {
        self.case.gives(key)
    }

    /// The hash of what is in the files that the commands of its programs name, in hexadecimal digits; empty
    /// where none are.
    fn hash_of_programs(&self) -> String {
        hexadecimal(named::of_programs(&self.case))
    }

    /// Of `[control]`: steps from one look to the next, looks from one call of a controller to the next, looks from
    /// sensing to acting; none without the table. Refused where the case has a controller.
    fn control_times(&self, py: Python<'_>) -> PyResult<Option<(usize, usize, usize)>> {
        let own = self.own_control(py)?;
        Ok(own.map(|own| (own.interval, own.every, own.latency)))
    }

    /// Under the controller `function`, which looks every so many steps, is called every so many looks, and whose
    /// commands act so many looks later; noise, bias and lag are those of `[control]`. One with a memory is reset when a
    /// flight begins.
    fn with_controller(
        &self,
        py: Python<'_>,
        function: Bound<'_, PyAny>,
        times: (usize, usize, usize),
        has_memory: bool,
    ) -> PyResult<Self> {
        let own = self.own_control(py)?;
        let (interval, every, latency) = times;
        let own = OwnControl {
            interval,
            every,
            latency,
            lag: own.map_or(0.0, |own| own.lag),
            sensors: own.and_then(|own| own.sensors),
        };
        let feedback = own.feedback(controller(&function, &self.pending, has_memory)?);
        Ok(self.with(function, has_memory, |flight| {
            flight.setup.feedback = Some(feedback);
        }))
    }

    /// In air that `function` computes.
    fn with_air(
        &self,
        py: Python<'_>,
        function: Bound<'_, PyAny>,
        has_memory: bool,
        is_steady_and_uniform: bool,
    ) -> PyResult<Self> {
        let checked = self.case.check_own_air();
        checked.map_err(|e| raised(py, &IoError::Case(e).into()))?;
        let air = air(&function, &self.pending, has_memory, is_steady_and_uniform)?;
        Ok(self.with(function, has_memory, |flight| flight.setup.air = air))
    }

    /// Name of the case.
    #[getter]
    fn name(&self) -> &str {
        &self.case.name
    }

    /// The case with everything filled in, as TOML.
    #[getter]
    fn case_text(&self) -> String {
        self.case.resolved()
    }

    /// Whether a controller steers it, of the case or written in Python.
    #[getter]
    fn is_steered(&self) -> bool {
        self.flight.setup.feedback.is_some()
    }

    /// Wingbeats for which the body is held at first.
    #[getter]
    fn held_beats(&self) -> f64 {
        self.case.raw.flight.held_beats
    }

    /// Whether the body moves as prescribed.
    #[getter]
    fn is_tethered(&self) -> bool {
        matches!(self.flight.setup.mode, MotionMode::Tethered(_))
    }

    /// Whether it has parts written in Python.
    #[getter]
    fn is_own(&self) -> bool {
        !self.parts.is_empty()
    }

    /// Number of steps.
    #[getter]
    fn steps(&self) -> usize {
        self.flight.setup.time.steps
    }

    /// Time step [s].
    #[getter]
    fn step_s(&self) -> f64 {
        self.flight.setup.time.step
    }

    /// Period of the wingbeat [s]; none of motions without one.
    #[getter]
    fn period_s(&self) -> Option<f64> {
        self.flight.setup.time.period
    }

    /// Mass of the animal [kg].
    #[getter]
    fn mass_kg(&self) -> f64 {
        self.flight.setup.animal.mass()
    }

    /// Names of the wings and their sides: right 1, left -1.
    #[getter]
    fn wings(&self) -> Vec<(String, f64)> {
        let wings = self.flight.setup.animal.wings.iter();
        wings.map(|w| (w.name.clone(), w.side.sign())).collect()
    }

    /// Number of bodies: the central one, wings, segments.
    #[getter]
    fn body_count(&self) -> usize {
        let animal = &self.flight.setup.animal;
        1 + animal.wings.len() + animal.segments.len()
    }

    /// Flies it to its end: what was flown, and the exception that ended it early, if any.
    fn fly(
        &self,
        py: Python<'_>,
        out: Option<PathBuf>,
        progress: Option<Py<PyAny>>,
        frames: bool,
    ) -> PyResult<(Option<Run>, Option<PyErr>)> {
        let (flight, output) = (self.flight.clone(), self.case.output);
        let (dir, patient) = (out.clone(), out.is_some());
        let keeps = frames && !patient;
        let fly = move |watch: &crate::worker::Watch| {
            let mut snapshots: Vec<Snapshot> = vec![];
            let flown = flight.fly_watched(dir.as_deref(), |flight| {
                if keeps && is_framed(&output, flight) {
                    snapshots.push(flight.snapshot());
                }
                match watch.reached(flight.state().step) {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            });
            flown.map(|(run, error)| (run, error, snapshots))
        };
        let told = progress.as_ref().map(|callback| (callback, self.steps()));
        let Worked {
            result,
            interrupted,
        } = work(py, told, patient, fly)?;
        let own = self.pending.take();
        match result {
            None => Ok((None, interrupted)),
            Some(Err(e)) => Ok((None, Some(own.unwrap_or_else(|| raised(py, &e))))),
            Some(Ok((run, error, snapshots))) => {
                let error = own.or_else(|| error.map(|e| raised(py, &e)));
                let run = Run::flown(run, snapshots, out, self.case_text());
                Ok((Some(run), interrupted.or(error)))
            }
        }
    }

    /// The flight before its first step.
    fn start(&self, py: Python<'_>) -> PyResult<Stepper> {
        let flight = detached(py, || self.flight.begin())?;
        let flight = flight.map_err(|e| self.pending.take().unwrap_or_else(|| raised(py, &e)))?;
        Ok(Stepper::new(
            flight,
            self.case.output,
            self.case_text(),
            self.parts.copy(py),
            (self.pending.clone(), self.remembers),
        ))
    }

    /// Steady flight, in so many steps per wingbeat.
    fn trim(&self, py: Python<'_>, asked: mechanics::Asked, steps: usize) -> PyResult<Trim> {
        self.check_memory(py)?;
        self.check_map(py)?;
        let problem = mechanics::problem(py, &self.flight, &asked, steps)?;
        let case = (!self.is_own()).then(|| self.case.clone());
        let parts = self.parts.copy(py);
        let found = mechanics::trim(py, &self.flight, problem, case, parts);
        found.map_err(|e| self.pending.take().unwrap_or(e))
    }

    /// The same in air with a memory, its steps those of the case: the body is held for `held_beats` wingbeats
    /// while its wake grows; trimmed is what has residuals within `tolerance`.
    fn trim_with_wake(
        &self,
        py: Python<'_>,
        asked: mechanics::Asked,
        held_beats: usize,
        tolerance: Option<f64>,
    ) -> PyResult<WakeTrim> {
        const MOST: usize = 100;
        let usual = WakeSettings::of(&self.flight.setup);
        let tolerance = tolerance.unwrap_or(usual.tolerance);
        if !(1..=MOST).contains(&held_beats) {
            let remedy = format!("a whole number from 1 to {MOST}");
            return Err(refused(py, "held_beats", "out of range", &remedy));
        }
        if !(1e-9..=0.1).contains(&tolerance) {
            return Err(refused(py, "tolerance", "out of range", "from 1e-9 to 0.1"));
        }
        let settings = WakeSettings {
            held_beats,
            tolerance,
            ..usual
        };
        let steps = TrimSettings::default().steps;
        self.check_memory(py)?;
        let problem = mechanics::problem(py, &self.flight, &asked, steps)?;
        let case = (!self.is_own()).then(|| self.case.clone());
        let found = wake::trim(py, &self.flight, problem, settings, case);
        found.map_err(|e| self.pending.take().unwrap_or(e))
    }

    /// Modes of the elastic wings, about the wing at rest or its deformed steady state.
    fn wing_modes<'py>(
        &self,
        py: Python<'py>,
        count: usize,
        steady: bool,
    ) -> PyResult<Vec<vibration::WingParts<'py>>> {
        let found = vibration::modes(py, &self.flight, count, steady);
        found.map_err(|e| self.pending.take().unwrap_or(e))
    }

    /// Vibrations at these speeds [m/s], and where they begin or cease to grow; modes that are disturbed, amplitude
    /// of the disturbance over the length of the wing, periods of the response, whether mirror images move against
    /// each other.
    fn flutter(
        &self,
        py: Python<'_>,
        speeds: Vec<f64>,
        how: (usize, f64, f64, bool),
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Vec<vibration::ConditionParts>, Vec<vibration::OnsetParts>)> {
        let found = vibration::flutter(py, &self.flight, speeds, how, progress);
        found.map_err(|e| self.pending.take().unwrap_or(e))
    }
}

/// The hash of what is in the files that a key set to another value names (`line` is `KEY=VALUE`), in
/// hexadecimal digits; empty where none are. `base` is the flight on which it is set: paths are relative to its
/// folder.
#[pyfunction]
#[pyo3(signature = (line, base))]
pub fn hash_of_files(line: &str, base: Option<&Flight>) -> String {
    let (case, folder) = base.map_or((None, Path::new("")), |f| (Some(&f.case), &*f.base));
    hexadecimal(named::content(line, case, folder))
}

fn hexadecimal(hash: Option<[u8; 32]>) -> String {
    let bytes = hash.iter().flatten();
    bytes.map(|byte| format!("{byte:02x}")).collect()
}
