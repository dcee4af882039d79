//! Many episodes at once, for who learns: one call steps all of them on threads, into arrays that are there already.

use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyReadonlyArray2, PyReadwriteArray1, PyReadwriteArray2, PyUntypedArrayMethods};
use pyo3::PyTraverseError;
use pyo3::gc::PyVisit;
use pyo3::prelude::*;
use rayon::prelude::*;
use wingbeat::analysis::AnalysisError;
use wingbeat::analysis::control::{CONTROLS, Regulator};
use wingbeat::analysis::episode::{Episode, Kept, OBSERVED, SharedModel, Task};

use crate::arrays::array;
use crate::course::{Course, Shared};
use crate::errors::{broken, named, raised, refused};
use crate::own::OwnFunctions;
use crate::threads::detached;

/// An episode that is stepped over and over.
struct Cell {
    episode: Episode,
    /// What it shares with the others of its flight.
    shared: Arc<Shared>,
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

/// A vector of episodes of one task. Several flights take turns: that of episode k is number k modulo their
/// count.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Fleet {
    cells: Mutex<Vec<Cell>>,
    /// How many flights there are.
    flights: usize,
    autoreset: Autoreset,
    /// Parts of the flyers that are written in Python, flight by flight.
    parts: Vec<OwnFunctions>,
}

/// Episodes of `courses`, which take turns, of these seeds. Neighbours of one flight share a model.
fn cells(courses: &[Arc<Shared>], seeds: &[u64]) -> Result<Vec<Cell>, AnalysisError> {
    let (group, count) = (group(seeds.len()), courses.len());
    let grouped = seeds.par_chunks(group).enumerate().map(|(chunk, seeds)| {
        let mut models: Vec<Option<SharedModel>> = vec![None; count.min(seeds.len())];
        let cell = |(k, seed): (usize, &u64)| {
            let shared = &courses[(chunk * group + k) % count];
            let slot = &mut models[k % count];
            let model = match slot {
                Some(model) => model,
                None => slot.insert(shared.course.model()?),
            };
            Ok(Cell {
                episode: Episode::new(Arc::clone(&shared.course), model, *seed)?,
                regulator: shared.regulator.clone(),
                shared: Arc::clone(shared),
                is_done: false,
            })
        };
        seeds.iter().enumerate().map(cell).collect()
    });
    let cells: Result<Vec<Vec<Cell>>, AnalysisError> = grouped.collect();
    Ok(cells?.into_iter().flatten().collect())
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
    fn reset(&mut self, seed: Option<u64>) -> Result<(), AnalysisError> {
        self.regulator.clone_from(&self.shared.regulator);
        self.is_done = false;
        self.episode.reset(seed)
    }

    /// What the regulator remembers; nothing where there is none.
    fn memory(&self) -> Vec<f64> {
        self.regulator.iter().flat_map(Regulator::memory).collect()
    }

    /// The regulator hears which `action` acts from now on, in fractions of the limits: its own or another one.
    fn remember(&mut self, action: &[f64; CONTROLS]) {
        if let Some(regulator) = &mut self.regulator {
            let limits = &self.shared.course.limits;
            let sizes = limits.sizes();
            let u = limits.applied(std::array::from_fn(|i| action[i] * sizes[i]));
            let seen = self.episode.seen_on_the_way();
            regulator.remember(&seen, u, usize::from(!limits.reached(&u)));
        }
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

    /// Steps all, over threads in groups of at most `most`; by itself if that is all. Those of one of so many
    /// `flights` come one after the other, so that its model stays in the caches.
    fn step(
        mut self,
        most: usize,
        flights: usize,
        autoreset: Autoreset,
    ) -> Result<(), AnalysisError> {
        let count = self.cells.len();
        if count <= most {
            let mut of_one = |first: usize| {
                let mut all = (first..count).step_by(flights);
                all.try_for_each(|k| self.step_one(k, autoreset))
            };
            return (0..flights.min(count)).try_for_each(&mut of_one);
        }
        let groups = count.div_ceil(most);
        let first = self.split_off(most * groups.div_ceil(2));
        let first = first.expect("more than that");
        let (one, other) = rayon::join(
            || first.step(most, flights, autoreset),
            || self.step(most, flights, autoreset),
        );
        one.and(other)
    }

    /// Steps number `k`.
    fn step_one(&mut self, k: usize, autoreset: Autoreset) -> Result<(), AnalysisError> {
        let (cell, own) = (&mut self.cells[k], OBSERVED * k..OBSERVED * (k + 1));
        let observed = &mut self.observed[own.clone()];
        let (reward, lost, over) = match cell.is_done && autoreset == Autoreset::NextStep {
            true => {
                cell.reset(None)?;
                (0.0, false, false)
            }
            false => {
                let action = &self.actions[CONTROLS * k..CONTROLS * (k + 1)];
                let action = std::array::from_fn(|i| f64::from(action[i]));
                cell.remember(&action);
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
            cell.reset(None)?;
            cell.observe(observed);
        }
        Ok(())
    }
}

/// Rows one after the other, zeros behind those that are shorter than the longest; the length of a row.
fn padded<'a>(rows: impl Iterator<Item = &'a [f64]> + Clone) -> (Vec<f64>, usize) {
    let width = rows.clone().map(<[f64]>::len).max().unwrap_or(0);
    let zeros = |row: &[f64]| std::iter::repeat_n(0.0, width - row.len());
    let all = rows.flat_map(|row| row.iter().copied().chain(zeros(row)));
    (all.collect(), width)
}

/// Of a state that other environments have saved.
fn foreign(py: Python<'_>) -> PyErr {
    let remedy = "the state of environments with the same settings and the same flights";
    refused(py, "state", "it is that of other environments", remedy)
}

#[pymethods]
impl Fleet {
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.parts.iter().try_for_each(|own| own.traverse(&visit))
    }

    /// Episodes of `courses`, which take turns, one for each seed.
    #[new]
    fn new(
        py: Python<'_>,
        courses: Vec<PyRef<'_, Course>>,
        autoreset_mode: &str,
        seeds: Vec<u64>,
    ) -> PyResult<Self> {
        let autoreset = named(py, "autoreset_mode", autoreset_mode, &Autoreset::ALL)?;
        let shared: Vec<_> = courses.iter().map(|c| Arc::clone(&c.shared)).collect();
        let parts = courses.iter().map(|c| c.parts.copy(py)).collect();
        if shared.is_empty() || seeds.is_empty() {
            return Err(broken());
        }
        let built = detached(py, || cells(&shared, &seeds))?;
        Ok(Self {
            cells: Mutex::new(built.map_err(|e| raised(py, &e.into()))?),
            flights: shared.len(),
            autoreset,
            parts,
        })
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
                    cell.reset(*seed)?;
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
            fit.then(|| rows.step(most, self.flights, self.autoreset))
        })?;
        stepped
            .ok_or_else(broken)?
            .map_err(|e| raised(py, &e.into()))?;
        Ok(terminated.iter().chain(truncated.iter()).any(|x| *x))
    }

    /// What the linear-quadratic regulator would do now, after the actions that acted until now, into `actions`. Zeros
    /// where it does not fit.
    fn regulate(&self, mut actions: PyReadwriteArray2<'_, f32>) -> PyResult<()> {
        let cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
        let rows = actions.as_slice_mut()?.as_chunks_mut::<CONTROLS>().0;
        for (cell, row) in cells.iter().zip(rows) {
            let Some(regulator) = &cell.regulator else {
                row.fill(0.0);
                continue;
            };
            let limits = &cell.shared.course.limits;
            let sizes = limits.sizes();
            let u = limits.applied(regulator.controls(&cell.episode.seen_on_the_way()));
            // What may not move at all stays at 0.
            let part = |i: usize| if sizes[i] > 0.0 { u[i] / sizes[i] } else { 0.0 };
            *row = std::array::from_fn(|i| part(i) as f32);
        }
        Ok(())
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
                rows.step(group(n), self.flights, Autoreset::NextStep)?;
            }
            Ok(begun.elapsed().as_secs_f64())
        })?;
        timed.map_err(|e: AnalysisError| raised(py, &e.into()))
    }

    /// Everything that the environments remember: counts, shape (environments, 5), numbers, and those of the
    /// regulators, (environments, any): rows of flyers that remember less end in zeros.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyAny>; 3]> {
        let cells = self.cells.lock().unwrap_or_else(PoisonError::into_inner);
        let kept: Vec<Kept> = cells.iter().map(|cell| cell.episode.keep()).collect();
        let counts = kept.iter().zip(&*cells);
        let counts = counts.flat_map(|(kept, cell)| {
            let is_done = u64::from(cell.is_done);
            kept.counts.into_iter().chain([is_done])
        });
        let (numbers, of_numbers) = padded(kept.iter().map(|kept| &kept.numbers[..]));
        let memories: Vec<Vec<f64>> = cells.iter().map(Cell::memory).collect();
        let (regulators, of_regulators) = padded(memories.iter().map(|memory| &memory[..]));
        let n = cells.len();
        Ok([
            array(py, counts.collect(), &[n, 5])?,
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
        let lengths = |cell: &Cell| [cell.episode.keep().numbers.len(), cell.memory().len()];
        let lengths: Vec<[usize; 2]> = cells.iter().map(lengths).collect();
        let [most, most_of_regulators] =
            [0, 1].map(|i| lengths.iter().map(|own| own[i]).max().unwrap_or(0));
        if widths != [5, most, most_of_regulators] || heights != [cells.len(); 3] {
            return Err(foreign(py));
        }
        let (counts, numbers) = (counts.as_slice()?.as_chunks::<5>().0, numbers.as_slice()?);
        let (regulators, observed) = (regulators.as_slice()?, observed.as_slice_mut()?);
        let row = |all: &[f64], first: usize, length: usize| all[first..first + length].to_vec();
        for (k, cell) in cells.iter_mut().enumerate() {
            let [seed, number, looks, steps, is_done] = counts[k];
            let kept = Kept {
                counts: [seed, number, looks, steps],
                numbers: row(numbers, most * k, lengths[k][0]),
            };
            let gone_on = cell.episode.go_on(&kept);
            gone_on.map_err(|e| raised(py, &e.into()))?;
            cell.is_done = is_done != 0;
            cell.regulator.clone_from(&cell.shared.regulator);
            if let Some(regulator) = &mut cell.regulator {
                let memory = row(regulators, most_of_regulators * k, lengths[k][1]);
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
