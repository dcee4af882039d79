//! Parts of a flight that are written in Python: controllers, models of the air.
//!
//! An exception in one of them ends the flight; it is kept in its [`PendingException`] and raised when the
//! flight has stopped.
//!
//! Their functions belong to the Python objects that fly them ([`OwnFunctions`]), where the garbage collector of
//! Python sees them: an object whose method is the controller of a flight that it keeps is freed with it. The
//! flight itself, which Rust shares and the collector cannot look into, has weak references.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArray2, PyArrayMethods};
use pyo3::PyTraverseError;
use pyo3::exceptions::PyReferenceError;
use pyo3::gc::PyVisit;
use pyo3::prelude::*;
use pyo3::types::{PyWeakrefMethods, PyWeakrefReference};
use wingbeat::dynamics::{BodyMotion, Wrench};
use wingbeat::flight::AirMemory;
use wingbeat::flight::control::{check_heeded, for_all};
use wingbeat::flight::{
    Air, AirModel, AirProbe, AirScratch, Announcement, ControlModel, Controller, ExternalAir,
    ExternalSession, FlightError, FlightSetup, Instant,
};
use wingbeat::math::DVec3;
use wingbeat::model::Wing;
use wingbeat::model::motion::Adjustment;

use crate::arrays::{array, points, rows, vector};
use crate::errors::{no_lattice, raised, refused};
use crate::threads::detached;

/// The exception of a part that failed.
#[derive(Clone, Default)]
pub struct PendingException(Arc<Mutex<Option<PyErr>>>);

impl PendingException {
    /// The exception, if there was one.
    pub fn take(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// What Python answered; keeps its exception.
    fn keep<T>(&self, answer: PyResult<T>) -> Result<T, String> {
        answer.map_err(|e| {
            let words = e.to_string();
            *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(e);
            words
        })
    }
}

/// The functions of the parts of a flight, owned by a Python object: each object that flies them has its own.
#[derive(Default)]
pub struct OwnFunctions(Vec<Py<PyAny>>);

impl OwnFunctions {
    /// The same of another object.
    pub fn copy(&self, py: Python<'_>) -> Self {
        Self(self.0.iter().map(|part| part.clone_ref(py)).collect())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// With another function.
    pub fn with(mut self, function: Py<PyAny>) -> Self {
        self.0.push(function);
        self
    }

    /// Tells the garbage collector of all. None changes, so none is taken away: cycles go through attributes of
    /// theirs, or of what they call.
    pub fn traverse(&self, visit: &PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.0.iter().try_for_each(|part| visit.call(part))
    }
}

/// What a controller sees.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Sensed {
    seen: wingbeat::flight::Sensed,
    air: Mutex<AtLook>,
}

/// The air at a look.
enum AtLook {
    Lattice(AirProbe),
    /// It is no vortex lattice.
    Other,
    /// The look is over.
    Over,
}

impl Sensed {
    fn new(seen: wingbeat::flight::Sensed, air: Option<AirProbe>) -> Self {
        let air = Mutex::new(air.map_or(AtLook::Other, AtLook::Lattice));
        Self { seen, air }
    }

    /// Ends the look: who keeps what was seen keeps no wakes.
    fn end(&self) {
        *self.air.lock().unwrap_or_else(PoisonError::into_inner) = AtLook::Over;
    }

    /// The lattice at the look.
    fn lattice(&self, py: Python<'_>) -> PyResult<AirProbe> {
        match &*self.air.lock().unwrap_or_else(PoisonError::into_inner) {
            AtLook::Lattice(air) => Ok(air.clone()),
            AtLook::Other => Err(no_lattice(py)),
            AtLook::Over => {
                let remedy = "ask within the call of the controller; after a step, air_velocity of the stepper";
                Err(refused(py, "sensed", "this look is over", remedy))
            }
        }
    }
}

#[pymethods]
impl Sensed {
    /// Velocity of the air at points at this look, both N components of shape (n, 3) [m, m/s], a single point
    /// as (3,) too: vortex lattice only, and within the call of the controller.
    fn air_velocity<'py>(
        &self,
        py: Python<'py>,
        points_m: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let at = points(points_m)?;
        let air = self.lattice(py)?;
        let velocity = detached(py, || air.velocity(&at))?.map_err(|e| raised(py, &e.into()))?;
        rows(py, &velocity.ok_or_else(|| no_lattice(py))?)
    }

    /// Number of this look, from 0.
    #[getter]
    fn look(&self) -> usize {
        self.seen.look
    }

    /// Time since the release [s].
    #[getter]
    fn time_s(&self) -> f64 {
        self.seen.time
    }

    /// Origin of the body, N components, shape (3,) [m].
    #[getter]
    fn position_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        vector(py, self.seen.root.p)
    }

    /// Velocity of that origin, N components, shape (3,) [m/s].
    #[getter]
    fn velocity_m_per_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        vector(py, self.seen.root.v)
    }

    /// Attitude R_NB, from body to N components, shape (3, 3).
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let rows = self.seen.root.r.transpose().to_cols_array();
        array(py, rows.to_vec(), &[3, 3])
    }

    /// Angular velocity, body components, shape (3,) [rad/s].
    #[getter]
    fn angular_velocity_rad_per_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        vector(py, self.seen.root.w)
    }

    /// Mass centre of the whole, N components, shape (3,) [m].
    #[getter]
    fn mass_centre_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        vector(py, self.seen.centre)
    }

    /// Velocity of the mass centre, N components, shape (3,) [m/s].
    #[getter]
    fn mass_centre_velocity_m_per_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        vector(py, self.seen.velocity)
    }
}

/// A function of Python in a part of the flight, which [`OwnFunctions`] own.
#[derive(Clone)]
struct Function {
    function: Arc<Py<PyWeakrefReference>>,
    pending: PendingException,
}

impl Function {
    fn new(function: &Bound<'_, PyAny>, pending: &PendingException) -> PyResult<Self> {
        Ok(Self {
            function: Arc::new(PyWeakrefReference::new(function)?.unbind()),
            pending: pending.clone(),
        })
    }

    /// The function. It is gone where nobody waits for the flight any more.
    fn get<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let function = self.function.bind(py).upgrade();
        function.ok_or_else(|| PyReferenceError::new_err("the flight of this part is gone"))
    }
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Python({:p})", self.function)
    }
}

/// A controller: a function from [`Sensed`] to eight numbers for all wings, or for each.
#[derive(Clone, Debug)]
struct PythonController {
    function: Function,
    has_memory: bool,
}

/// The controller `function`, which somebody's [`OwnFunctions`] own. One with a memory is reset when a flight begins.
pub fn controller(
    function: &Bound<'_, PyAny>,
    pending: &PendingException,
    has_memory: bool,
) -> PyResult<Arc<dyn ControlModel>> {
    Ok(Arc::new(PythonController {
        function: Function::new(function, pending)?,
        has_memory,
    }))
}

impl ControlModel for PythonController {
    fn open(&self, setup: &FlightSetup) -> Result<Box<dyn Controller>, FlightError> {
        if self.has_memory {
            let function = &self.function;
            let reset = Python::attach(|py| function.get(py)?.call_method0("reset").map(drop));
            let refused = |problem| FlightError::Control { time: 0.0, problem };
            self.function.pending.keep(reset).map_err(refused)?;
        }
        Ok(Box::new(Steered {
            function: self.function.clone(),
            air: None,
            wings: setup.animal.wings.clone(),
            steered: (0..setup.animal.wings.len())
                .map(|w| setup.is_adjusted(w))
                .collect(),
        }))
    }
}

/// The controller of a flight.
struct Steered {
    function: Function,
    /// At the look that follows.
    air: Option<AirProbe>,
    wings: Vec<Wing>,
    /// Whether a command to all wings acts on them.
    steered: Vec<bool>,
}

impl Controller for Steered {
    fn feels_air(&self) -> bool {
        true
    }

    fn feel(&mut self, air: Option<AirProbe>) {
        self.air = air;
    }

    fn command(&mut self, sensed: &wingbeat::flight::Sensed) -> Result<Vec<Adjustment>, String> {
        let air = self.air.take();
        let answer = Python::attach(|py| -> PyResult<Vec<[f64; 8]>> {
            let seen = Bound::new(py, Sensed::new(*sensed, air))?;
            let answer = self.function.get(py)?.call1((&seen,));
            seen.get().end();
            answer?.extract()
        });
        let numbers = self.function.pending.keep(answer)?;
        let command: Vec<Adjustment> = numbers.into_iter().map(Adjustment::of_numbers).collect();
        if let [one] = &command[..] {
            return for_all(&self.wings, &self.steered, one);
        }
        check_heeded(&self.wings, &command)?;
        Ok(command)
    }
}

/// Air that Python computes.
#[derive(Clone, Debug)]
struct PythonAir {
    function: Function,
    is_steady_and_uniform: bool,
}

/// The air of `function`, which somebody's [`OwnFunctions`] own, called with time [s] and the motions of all bodies,
/// shape (bodies, 18): origin, rotation to N by rows, velocity, angular velocity in body components; it answers
/// forces and moments about the origins, N components, shape (bodies, 6). An air with a memory hears which
/// steps are accepted (`function.accept(step)`), and is called with the number of the step as well. Loads that
/// `is_steady_and_uniform` depend on the motions alone, not on time or place.
pub fn air(
    function: &Bound<'_, PyAny>,
    pending: &PendingException,
    has_memory: bool,
    is_steady_and_uniform: bool,
) -> PyResult<AirModel> {
    let air = PythonAir {
        function: Function::new(function, pending)?,
        is_steady_and_uniform,
    };
    Ok(match has_memory {
        true => AirModel::External(Arc::new(air)),
        false => AirModel::Own(Arc::new(air)),
    })
}

impl PythonAir {
    fn call(
        &self,
        step: Option<usize>,
        time: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String> {
        let answer = Python::attach(|py| {
            let numbers = motions.iter().flat_map(BodyMotion::numbers).collect();
            let motions = array(py, numbers, &[motions.len(), 18])?;
            let answer = self.function.get(py)?.call1((step, time, motions))?;
            let loads = answer.cast::<PyArray2<f64>>()?.readonly();
            for (load, row) in out.iter_mut().zip(loads.as_slice()?.as_chunks::<6>().0) {
                load.force = DVec3::from_slice(row);
                load.moment = DVec3::from_slice(&row[3..]);
            }
            Ok(())
        });
        self.function.pending.keep(answer)
    }
}

impl Air for PythonAir {
    fn loads(
        &self,
        at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        self.call(None, at.time, at.motions, out)
            .map_err(FlightError::External)
    }

    fn is_steady_and_uniform(&self) -> bool {
        self.is_steady_and_uniform
    }
}

impl ExternalAir for PythonAir {
    fn open(&self, flyer: &Announcement) -> Result<Box<dyn ExternalSession>, String> {
        let opened = Python::attach(|py| {
            let bodies = flyer.bodies.clone();
            let function = self.function.get(py)?;
            function
                .call_method1("open", (bodies, flyer.step))
                .map(drop)
        });
        self.function.pending.keep(opened)?;
        Ok(Box::new(self.clone()))
    }
}

impl ExternalSession for PythonAir {
    fn loads(
        &mut self,
        step: usize,
        time: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String> {
        self.call(Some(step), time, motions, out)
    }

    fn accept(&mut self, step: usize) -> Result<(), String> {
        let accepted = Python::attach(|py| {
            let function = self.function.get(py)?;
            function.call_method1("accept", (step,)).map(drop)
        });
        self.function.pending.keep(accepted)
    }
}
