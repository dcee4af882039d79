//! Flights step by step.

use std::sync::{Mutex, PoisonError};
use std::thread::{self, ThreadId};

use pyo3::PyTraverseError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::gc::PyVisit;
use pyo3::prelude::*;
use wingbeat::case::OutputSettings;
use wingbeat::flight::{Record, Simulation, Snapshot};
use wingbeat::results::Outcome;

use crate::arrays::{points, rows};
use crate::errors::{broken, no_lattice, raised, refused};
use crate::frame::{Frame, is_framed};
use crate::own::{OwnFunctions, PendingException};
use crate::run::Run;
use crate::threads::within;

/// A flight and what it has flown.
struct Course {
    flight: Simulation,
    records: Vec<Record>,
    snapshots: Vec<Snapshot>,
    outcome: Outcome,
}

/// The thread that works on a flight, while one does.
#[derive(Default)]
struct Holder(Mutex<Option<ThreadId>>);

impl Holder {
    fn set(&self, thread: Option<ThreadId>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = thread;
    }

    /// Takes down this thread until the answer is dropped.
    fn here(&self) -> Held<'_> {
        self.set(Some(thread::current().id()));
        Held(self)
    }

    /// Whether it is this one: a controller or air written in Python asks within a step.
    fn is_here(&self) -> bool {
        let holder = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *holder == Some(thread::current().id())
    }
}

/// While a thread works on the flight.
struct Held<'a>(&'a Holder);

impl Drop for Held<'_> {
    fn drop(&mut self) {
        self.0.set(None);
    }
}

/// A flight in progress.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Stepper {
    course: Mutex<Course>,
    /// The thread that has the flight now.
    holder: Holder,
    output: OutputSettings,
    case: String,
    parts: OwnFunctions,
    pending: PendingException,
    /// Whether parts written in Python remember what they were called with.
    remembers: bool,
}

impl Stepper {
    /// Before the first step of `flight`, whose `parts` written in Python keep their exceptions there, and may
    /// remember what they were called with.
    pub fn new(
        flight: Simulation,
        output: OutputSettings,
        case: String,
        parts: OwnFunctions,
        (pending, remembers): (PendingException, bool),
    ) -> Self {
        let course = Course {
            records: vec![flight.record().clone()],
            snapshots: match is_framed(&output, &flight) {
                true => vec![flight.snapshot()],
                false => vec![],
            },
            flight,
            outcome: Outcome::Running,
        };
        Self {
            course: Mutex::new(course),
            holder: Holder::default(),
            output,
            case,
            parts,
            pending,
            remembers,
        }
    }

    /// Does `work` beside the interpreter, once no other thread has the flight. A part of it that is written in
    /// Python and asks within a step, in the thread of that step, would wait for itself: it is refused.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Course) -> T + Send,
    ) -> PyResult<T> {
        self.check(py)?;
        // The lock is waited for outside the pool: one of its threads may be the one that has it.
        py.detach(|| {
            let mut course = self.course.lock().map_err(|_| broken())?;
            let course = &mut *course;
            let done = within(move || {
                let _held = self.holder.here();
                work(course)
            });
            done.map_err(|e| PyRuntimeError::new_err(e.to_string()))
        })
    }
}

#[pymethods]
impl Stepper {
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.parts.traverse(&visit)
    }

    /// Refuses what a part of the flight asks for within a step.
    fn check(&self, py: Python<'_>) -> PyResult<()> {
        if self.holder.is_here() {
            let problem =
                "the flight is within a step, in which its own controller or air asks for it";
            let remedy = "ask between calls of step(); what a controller is called with has time_s, the motion of the \
                          body and air_velocity";
            return Err(refused(py, "stepper", problem, remedy));
        }
        Ok(())
    }

    /// A second flight that goes on from here.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        if self.remembers {
            let problem = "a part of this flight is written in Python and remembers what it was called with \
                           (`reset` or `accept`): copies would share its memory";
            let remedy = "a controller or air without memory; begin both flights with start()";
            return Err(refused(py, "copy", problem, remedy));
        }
        let course = self.with(py, |course| course.branch())?;
        let course = course.map_err(|e| self.pending.take().unwrap_or_else(|| raised(py, &e)))?;
        Ok(Self {
            course: Mutex::new(course),
            holder: Holder::default(),
            output: self.output,
            case: self.case.clone(),
            parts: self.parts.copy(py),
            pending: self.pending.clone(),
            remembers: false,
        })
    }

    /// Makes up to `count` steps; how many were made before the end.
    fn step(&self, py: Python<'_>, count: usize) -> PyResult<usize> {
        for made in 0..count {
            py.check_signals()?;
            match self.with(py, |course| course.step(&self.output))? {
                Ok(true) => {}
                Ok(false) => return Ok(made),
                Err(e) => return Err(self.pending.take().unwrap_or_else(|| raised(py, &e))),
            }
        }
        Ok(count)
    }

    /// Steps made: one that fails is not.
    #[getter]
    fn steps_done(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |course| course.records.len() - 1)
    }

    /// Time after them [s].
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |course| course.newest().time)
    }

    /// Whether it is at its end: the last step was made, or an error ended it.
    #[getter]
    fn is_finished(&self, py: Python<'_>) -> PyResult<bool> {
        self.with(py, |course| course.outcome != Outcome::Running)
    }

    /// Surfaces and wakes now.
    fn frame(&self, py: Python<'_>) -> PyResult<Frame> {
        self.with(py, |course| Frame::from(&course.flight.snapshot()))
    }

    /// Velocity of the air at points, shape (n, 3), N components [m, m/s].
    fn air_velocity<'py>(
        &self,
        py: Python<'py>,
        at: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let at = points(at)?;
        let velocity = self.with(py, |course| course.flight.air_velocity(&at))?;
        let velocity = velocity.map_err(|e| raised(py, &e.into()))?;
        rows(py, &velocity.ok_or_else(|| no_lattice(py))?)
    }

    /// What was flown so far.
    fn run(&self, py: Python<'_>) -> PyResult<Run> {
        self.with(py, |course| {
            let run = wingbeat::Run {
                setup: course.flight.setup().clone(),
                records: course.records.clone(),
                outcome: course.outcome.clone(),
            };
            Run::flown(run, course.snapshots.clone(), None, self.case.clone())
        })
    }
}

impl Course {
    /// Another one with the same past.
    fn branch(&self) -> Result<Self, wingbeat::Error> {
        Ok(Self {
            flight: self.flight.branch()?,
            records: self.records.clone(),
            snapshots: self.snapshots.clone(),
            outcome: self.outcome.clone(),
        })
    }

    /// After the last step made.
    fn newest(&self) -> &Record {
        self.records.last().expect("the start has a record")
    }

    /// One step; false at the end.
    fn step(&mut self, output: &OutputSettings) -> Result<bool, wingbeat::Error> {
        if self.outcome != Outcome::Running {
            return Ok(false);
        }
        match self.flight.step() {
            Ok(record) => self.records.push(record.clone()),
            Err(e) => {
                self.outcome = Outcome::Failed(e.to_string());
                return Err(e.into());
            }
        }
        if is_framed(output, &self.flight) {
            self.snapshots.push(self.flight.snapshot());
        }
        if self.flight.finished() {
            self.outcome = Outcome::Finished;
        }
        Ok(true)
    }
}
