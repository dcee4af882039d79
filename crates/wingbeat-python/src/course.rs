//! What episodes about one trimmed flight share: equations, reference, limits, the regulator.

use std::sync::Arc;

use pyo3::PyTraverseError;
use pyo3::gc::PyVisit;
use pyo3::prelude::*;
use wingbeat::analysis::control::{Regulator, Weights};
use wingbeat::analysis::episode::{self, Task};
use wingbeat::analysis::{AnalysisError, Trim};

use crate::errors::{named, raised};
use crate::own::OwnFunctions;
use crate::threads::detached;

/// Settings of episodes: a dictionary of Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Settings {
    /// Name of the task.
    task: String,
    /// Integration steps from one control to the next.
    interval: usize,
    /// Wingbeats of an episode.
    beats: usize,
    /// Limit of relative amplitudes \[1\].
    amplitude_limit: f64,
    /// Limit of angles [rad].
    angle_limit_rad: f64,
    /// Control steps from sensing to observing.
    delay: usize,
    /// Standard deviation of places that are sensed [m].
    position_noise_m: f64,
    /// Of velocities [m/s].
    velocity_noise_m_per_s: f64,
    /// Of the tilt [rad].
    tilt_noise_rad: f64,
    /// Of angular velocities [rad/s].
    rate_noise_rad_per_s: f64,
}

impl Settings {
    /// What they make of episodes about `trim`.
    fn course(&self, task: Task, trim: Trim) -> Result<episode::Course, AnalysisError> {
        let mut course = episode::Course::new(task, trim)?;
        (course.interval, course.beats, course.delay) = (self.interval, self.beats, self.delay);
        let (limits, noise) = (&mut course.limits, &mut course.sensors.noise);
        (limits.amplitude, limits.angle) = (self.amplitude_limit, self.angle_limit_rad);
        (noise.position, noise.velocity) = (self.position_noise_m, self.velocity_noise_m_per_s);
        (noise.tilt, noise.rate) = (self.tilt_noise_rad, self.rate_noise_rad_per_s);
        Ok(course)
    }
}

/// What the episodes of a flight share.
pub struct Shared {
    pub course: Arc<episode::Course>,
    /// The regulator at the start of an episode; none where it does not fit.
    pub regulator: Option<Regulator>,
}

/// The same, as Python has it.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Course {
    pub shared: Arc<Shared>,
    /// Parts of the flyer that are written in Python.
    pub parts: OwnFunctions,
}

impl Course {
    /// Of episodes about the trimmed flight `trim`.
    pub fn of(
        py: Python<'_>,
        trim: Trim,
        settings: Settings,
        parts: OwnFunctions,
    ) -> PyResult<Self> {
        let task = named(py, "task", &settings.task, &Task::ALL)?;
        let built = detached(py, move || {
            let course = settings.course(task, trim)?;
            let is_per_beat = course.interval == course.trim.beat.steps() && course.delay == 0;
            let regulator =
                is_per_beat.then(|| Regulator::new(&course.trim, &Weights::default(), 0).ok());
            let shared = Arc::new(Shared {
                course: Arc::new(course),
                regulator: regulator.flatten(),
            });
            Ok(Self { shared, parts })
        })?;
        built.map_err(|e: AnalysisError| raised(py, &e.into()))
    }
}

#[pymethods]
impl Course {
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.parts.traverse(&visit)
    }

    /// Wing length [m] and wingbeat [s] of the flyer.
    #[getter]
    fn scales(&self) -> [f64; 2] {
        let beat = &self.shared.course.trim.beat;
        [beat.wing_length(), beat.period()]
    }

    /// Whether the linear-quadratic regulator fits: controls once per wingbeat, without a delay, of a flight that
    /// it can hold.
    #[getter]
    fn is_regulated(&self) -> bool {
        self.shared.regulator.is_some()
    }
}
