//! Many episodes at once, for who learns: one call steps all of them on threads, into arrays that are there already.

use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyReadonlyArray2, PyReadwriteArray1, PyReadwriteArray2, PyUntypedArrayMethods};
use pyo3::PyTraverseError;
use pyo3::gc::PyVisit;
use pyo3::prelude::*;
use rayon::prelude::*;
use wingbeat::analysis::control::{CONTROLS, Regulator, Weights};
use wingbeat::analysis::episode::{Course, Episode, Kept, OBSERVED, Task};
use wingbeat::analysis::{AnalysisError, Trim};

use crate::arrays::array;
use crate::errors::{broken, named, raised, refused};
use crate::own::Parts;
use crate::threads::detached;

/// An episode that is stepped over and over.
struct Cell {
    episode: Episode,
    /// The last step ended it.
    is_done: bool,
    /// Gains and memory of the regulator; none where it does not fit.
    regulator: Option<Regulator>,
}

/// When an episode that has ended begins again.
#[derive(Clone, Copy, PartialEq)]
enum Autoreset {
    NextStep,
    SameStep,
    Disabled,
}

impl Autoreset {
    /// All with their names.
    const ALL: [(&'static str, Self); 3] = [
        ("next_step", Self::NextStep),
        ("same_step", Self::SameStep),
        ("disabled", Self::Disabled),
    ];
}

/// A vector of episodes of one task.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Fleet {
    course: Arc<Course>,
    cells: Mutex<Vec<Cell>>,
    autoreset: Autoreset,
    /// At the start of an episode.
    regulator: Option<Regulator>,
    /// Parts of the flyer that are written in Python.
    parts: Parts,
}

/// Settings of a fleet: a dictionary of Python.
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
    /// Name of the autoreset mode.
    autoreset_mode: String,
}

impl Settings {
    /// What they make of episodes about `trim`.
    fn course(&self, task: Task, trim: Trim) -> Result<Course, AnalysisError> {
        let mut course = Course::new(task, trim)?;
        (course.interval, course.beats, course.delay) = (self.interval, self.beats, self.delay);
        let (limits, noise) = (&mut course.limits, &mut course.sensors.noise);
        (limits.amplitude, limits.angle) = (self.amplitude_limit, self.angle_limit_rad);
        (noise.position, noise.velocity) = (self.position_noise_m, self.velocity_noise_m_per_s);
        (noise.tilt, noise.rate) = (self.tilt_noise_rad, self.rate_noise_rad_per_s);
        Ok(course)
    }
}

impl Fleet {
    /// Episodes about the trimmed flight `trim`, of these seeds.
    pub fn of(
        py: Python<'_>,
        trim: Trim,
        settings: Settings,
        seeds: Vec<u64>,
        parts: Parts,
    ) -> PyResult<Self> {
        let autoreset = named(
            py,
            "autoreset_mode",
            &settings.autoreset_mode,
            &Autoreset::ALL,
        )?;
        let task = named(py, "task", &settings.task, &Task::ALL)?;
        let built = detached(py, move || {
            let course = settings.course(task, trim)?;
            let is_per_beat = course.interval == course.trim.beat.steps() && course.delay == 0;
            let regulator =
                is_per_beat.then(|| Regulator::new(&course.trim, &Weights::default(), 0).ok());
            let (course, regulator) = (Arc::new(course), regulator.flatten());
            let group = group(seeds.len());
            let grouped = seeds.par_chunks(group).map(|seeds| {
                let model = course.model()?;
                let cell = |seed: &u64| {
                    Ok(Cell {
                        episode: Episode::new(Arc::clone(&course), &model, *seed)?,
                        is_done: false,
                        regulator: regulator.clone(),
                    })
                };
                seeds.iter().map(cell).collect::<Result<Vec<Cell>, _>>()
            });
            let cells: Result<Vec<Vec<Cell>>, AnalysisError> = grouped.collect();
            let cells = cells.map(|groups| groups.into_iter().flatten().collect());
            Ok(Self {
                cells: Mutex::new(cells?),
                course,
                autoreset,
                regulator,
                parts,
            })
        })?;
        built.map_err(|e: AnalysisError| raised(py, &e.into()))
    }
}

/// How many episodes take turns with one model: neighbours, which fly in one thread.
fn group(count: usize) -> usize {
    match rayon::current_num_threads() {
        1 => count,
        threads => count.div_ceil(4 * threads),
    }
    .max(1)
}

impl Cell {
    fn reset(
        &mut self,
        seed: Option<u64>,
        regulator: &Option<Regulator>,
    ) -> Result<(), AnalysisError> {
        self.regulator.clone_from(regulator);
        self.is_done = false;
        self.episode.reset(seed)
    }

    fn observe(&self, out: &mut [f32]) {
        let mut seen = [0.0; OBSERVED];
        self.episode.observe(&mut seen);
        for (to, x) in out.iter_mut().zip(seen) {
            *to = x as f32;
        }
    }
}

/// Environments that are neighbours, and what they are stepped by and into.
struct Rows<'a> {
    cells: &'a mut [Cell],
    actions: &'a [f32],
    observed: &'a mut [f32],
    last: &'a mut [f32],
    rewards: &'a mut [f64],
    terminated: &'a mut [bool],
    truncated: &'a mut [bool],
}

impl<'a> Rows<'a> {
    /// Whether all are as long as they should be.
    fn fit(&self) -> bool {
        let n = self.cells.len();
        let wide = [self.observed.len(), self.last.len()];
        let flat = [
            self.rewards.len(),
            self.terminated.len(),
            self.truncated.len(),
        ];
        self.actions.len() == CONTROLS * n && wide == [OBSERVED * n; 2] && flat == [n; 3]
    }

    /// Takes the first `count` out of them; none where there are fewer.
    fn split_off(&mut self, count: usize) -> Option<Self> {
        Some(Self {
            cells: self.cells.split_off_mut(..count)?,
            actions: self.actions.split_off(..CONTROLS * count)?,
            observed: self.observed.split_off_mut(..OBSERVED * count)?,
            last: self.last.split_off_mut(..OBSERVED * count)?,
            rewards: self.rewards.split_off_mut(..count)?,
            terminated: self.terminated.split_off_mut(..count)?,
            truncated: self.truncated.split_off_mut(..count)?,
        })
    }

    /// Steps all, over threads in groups of at most `most`; by itself if that is all.
    fn step(
        mut self,
        most: usize,
        autoreset: Autoreset,
        regulator: &Option<Regulator>,
    ) -> Result<(), AnalysisError> {
        let count = self.cells.len();
        if count <= most {
            return (0..count).try_for_each(|k| self.step_one(k, autoreset, regulator));
        }
        let groups = count.div_ceil(most);
        let first = self.split_off(most * groups.div_ceil(2));
        let first = first.expect("more than that");
        let (one, other) = rayon::join(
            || first.step(most, autoreset, regulator),
            || self.step(most, autoreset, regulator),
        );
        one.and(other)
    }

    /// Steps number `k`.
    fn step_one(
        &mut self,
        k: usize,
        autoreset: Autoreset,
        regulator: &Option<Regulator>,
    ) -> Result<(), AnalysisError> {
        let (cell, own) = (&mut self.cells[k], OBSERVED * k..OBSERVED * (k + 1));
        let observed = &mut self.observed[own.clone()];
        let (reward, lost, over) = match cell.is_done && autoreset == Autoreset::NextStep {
            true => {
                cell.reset(None, regulator)?;
                (0.0, false, false)
            }
            false => {
                let action = &self.actions[CONTROLS * k..CONTROLS * (k + 1)];
                let action = std::array::from_fn(|i| f64::from(action[i]));
                let outcome = cell.episode.step(&action);
                cell.is_done = outcome.is_lost || outcome.is_over;
                let over = outcome.is_over && !outcome.is_lost;
                (outcome.reward, outcome.is_lost, over)
            }
        };
        (self.rewards[k], self.terminated[k], self.truncated[k]) = (reward, lost, over);
        cell.observe(observed);
        if cell.is_done && autoreset == Autoreset::SameStep {
            self.last[own].copy_from_slice(observed);
            cell.reset(None, regulator)?;
            cell.observe(observed);
        }
        Ok(())
    }
}

/// Of a state that other environments have saved.
fn foreign(py: Python<'_>) -> PyErr {
    let remedy = "the state of environments with the same settings and the same flight";
    refused(py, "state", "it is that of other environments", remedy)
}

#[pymethods]
impl Fleet {
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.parts.traverse(&visit)
    }

    /// Names of the tasks.
    #[classattr]
    #[pyo3(name = "TASKS")]
    fn tasks() -> [&'static str; 4] {
        Task::ALL.map(|(name, _)| name)
    }

    /// Numbers of an action.
    #[classattr]
    const CONTROLS: usize = CONTROLS;

    /// Numbers of an observation.
    #[classattr]
    const OBSERVED: usize = OBSERVED;

    /// Begins new episodes where `mask` says, of these seeds where there are any; observations into `observed`, shape
    /// (environments, 17).
    fn reset(
        &self,
        py: Python<'_>,
        seeds: Vec<Option<u64>>,
        mask: Vec<bool>,
        mut observed: PyReadwriteArray2<'_, f32>,
    ) -> PyResult<()> {
        let observed = observed.as_slice_mut()?;
        let done = detached(py, || {
            let mut cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
            if seeds.len() != cells.len()
                || mask.len() != cells.len()
                || observed.len() != OBSERVED * cells.len()
            {
                return None;
            }
            let rows = cells.par_iter_mut().zip(observed.par_chunks_mut(OBSERVED));
            let rows = rows.zip(&seeds).zip(&mask);
            Some(rows.try_for_each(|(((cell, out), seed), chosen)| {
                if *chosen {
                    cell.reset(*seed, &self.regulator)?;
                }
                cell.observe(out);
                Ok::<(), AnalysisError>(())
            }))
        })?;
        done.ok_or_else(broken)?.map_err(|e| raised(py, &e.into()))
    }

    /// Steps all environments by `actions`, shape (environments, 4), fractions of the limits, into the other arrays:
    /// observations and, where an episode ended and began again in this step, its last ones, shape (environments, 17);
    /// rewards; whether the flyer is lost; whether the time is over. Whether any episode has ended.
    #[allow(clippy::too_many_arguments)]
    fn step(
        &self,
        py: Python<'_>,
        actions: PyReadonlyArray2<'_, f32>,
        mut observed: PyReadwriteArray2<'_, f32>,
        mut last: PyReadwriteArray2<'_, f32>,
        mut rewards: PyReadwriteArray1<'_, f64>,
        mut terminated: PyReadwriteArray1<'_, bool>,
        mut truncated: PyReadwriteArray1<'_, bool>,
    ) -> PyResult<bool> {
        let actions = actions.as_slice()?;
        if !actions.iter().all(|x| x.is_finite()) {
            let remedy = "finite numbers, fractions of the limits";
            return Err(refused(py, "actions", "one is not finite", remedy));
        }
        let (observed, last) = (observed.as_slice_mut()?, last.as_slice_mut()?);
        let (rewards, terminated) = (rewards.as_slice_mut()?, terminated.as_slice_mut()?);
        let truncated = truncated.as_slice_mut()?;
        let stepped = detached(py, || {
            let mut cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
            let most = group(cells.len());
            let rows = Rows {
                cells: &mut cells,
                actions,
                observed,
                last,
                rewards,
                terminated: &mut *terminated,
                truncated: &mut *truncated,
            };
            let fit = rows.fit();
            fit.then(|| rows.step(most, self.autoreset, &self.regulator))
        })?;
        stepped
            .ok_or_else(broken)?
            .map_err(|e| raised(py, &e.into()))?;
        Ok(terminated.iter().chain(truncated.iter()).any(|x| *x))
    }

    /// What the linear-quadratic regulator would do now, into `actions`; it remembers, so once per step. False
    /// where it does not fit: controls within a wingbeat, a delay.
    fn regulate(&self, mut actions: PyReadwriteArray2<'_, f32>) -> PyResult<bool> {
        let limits = &self.course.limits;
        let sizes = limits.sizes();
        let mut cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
        let rows = actions.as_slice_mut()?.as_chunks_mut::<CONTROLS>().0;
        for (cell, row) in cells.iter_mut().zip(rows) {
            let Some(regulator) = &mut cell.regulator else {
                return Ok(false);
            };
            let d = cell.episode.seen_on_the_way();
            let u = limits.applied(regulator.controls(&d));
            regulator.remember(&d, u, limits.reached(&u));
            *row = std::array::from_fn(|i| (u[i] / sizes[i]) as f32);
        }
        Ok(true)
    }

    /// Seconds that `count` control steps take within Rust: what Python adds to it is seen beside it.
    fn core_seconds(&self, py: Python<'_>, count: usize) -> PyResult<f64> {
        let timed = detached(py, || {
            let mut cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
            let n = cells.len();
            let actions = vec![0.0; CONTROLS * n];
            let [mut observed, mut last] = [0, 1].map(|_| vec![0.0; OBSERVED * n]);
            let [mut terminated, mut truncated] = [0, 1].map(|_| vec![false; n]);
            let mut rewards = vec![0.0; n];
            let begun = std::time::Instant::now();
            for _ in 0..count {
                let rows = Rows {
                    cells: &mut cells,
                    actions: &actions,
                    observed: &mut observed,
                    last: &mut last,
                    rewards: &mut rewards,
                    terminated: &mut terminated,
                    truncated: &mut truncated,
                };
                rows.step(group(n), Autoreset::NextStep, &self.regulator)?;
            }
            Ok(begun.elapsed().as_secs_f64())
        })?;
        timed.map_err(|e: AnalysisError| raised(py, &e.into()))
    }

    /// Everything that the environments remember: counts, shape (environments, 5), numbers, and those of the
    /// regulators, (environments, any).
    fn save<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyAny>; 3]> {
        let (mut counts, mut numbers, mut regulators) = (vec![], vec![], vec![]);
        let cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
        for cell in &*cells {
            let kept = cell.episode.keep();
            counts.extend(kept.counts);
            counts.push(u64::from(cell.is_done));
            numbers.extend(kept.numbers);
            regulators.extend(cell.regulator.iter().flat_map(Regulator::memory));
        }
        let n = cells.len();
        let [of_numbers, of_regulators] = [numbers.len(), regulators.len()].map(|all| all / n);
        Ok([
            array(py, counts, &[n, 5])?,
            array(py, numbers, &[n, of_numbers])?,
            array(py, regulators, &[n, of_regulators])?,
        ])
    }

    /// Goes on from there; observations into `observed`, shape (environments, 17).
    fn restore(
        &self,
        py: Python<'_>,
        counts: PyReadonlyArray2<'_, u64>,
        numbers: PyReadonlyArray2<'_, f64>,
        regulators: PyReadonlyArray2<'_, f64>,
        mut observed: PyReadwriteArray2<'_, f32>,
    ) -> PyResult<()> {
        let mut cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
        let widths = [counts.shape()[1], numbers.shape()[1], regulators.shape()[1]];
        let heights = [counts.shape()[0], numbers.shape()[0], regulators.shape()[0]];
        if widths[0] != 5 || heights != [cells.len(); 3] {
            return Err(foreign(py));
        }
        let (counts, numbers) = (counts.as_slice()?.as_chunks::<5>().0, numbers.as_slice()?);
        let (regulators, observed) = (regulators.as_slice()?, observed.as_slice_mut()?);
        let row = |all: &[f64], k: usize, n: usize| all[n * k..n * (k + 1)].to_vec();
        for (k, cell) in cells.iter_mut().enumerate() {
            let [seed, number, looks, steps, is_done] = counts[k];
            let kept = Kept {
                counts: [seed, number, looks, steps],
                numbers: row(numbers, k, widths[1]),
            };
            let gone_on = cell.episode.go_on(&kept);
            gone_on.map_err(|e| raised(py, &e.into()))?;
            cell.is_done = is_done != 0;
            cell.regulator.clone_from(&self.regulator);
            if let Some(regulator) = &mut cell.regulator {
                let memory = row(regulators, k, widths[2]);
                regulator.restore(&memory).map_err(|_| foreign(py))?;
            }
            cell.observe(&mut observed[OBSERVED * k..OBSERVED * (k + 1)]);
        }
        Ok(())
    }

    /// Distances of the mass centres from their targets [m].
    fn distances(&self, py: Python<'_>) -> Vec<f64> {
        py.detach(|| {
            let cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
            let of = |cell: &Cell| {
                cell.episode
                    .truth()
                    .map_or(f64::NAN, |d| d.position.length())
            };
            cells.iter().map(of).collect()
        })
    }
}
