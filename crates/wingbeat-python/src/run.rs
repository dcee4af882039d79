//! Flights that were flown.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use wingbeat::case::LoadedCase;
use wingbeat::draw::figures::{Chart, charts_of};
use wingbeat::flight::Snapshot;
use wingbeat::results::export::{Format, export};
use wingbeat::results::file::Existing;
use wingbeat::results::frames;
use wingbeat::results::{Outcome, ResultDir, Summary};
use wingbeat::{Error, results};

use crate::arrays::array;
use crate::errors::{named, raised, refused, without_case};
use crate::frame::Frame;

/// A flight that was flown, in memory or in a result directory.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Run {
    run: wingbeat::Run,
    snapshots: Vec<Snapshot>,
    dir: Option<PathBuf>,
    case: String,
}

/// Name, unit, frame, symbol and meaning of a column.
type About = (String, &'static str, &'static str, &'static str, String);
/// Label of an axis, its lines (label and values) and its shaded intervals.
type Panel = (String, Vec<(String, Vec<f64>)>, Vec<[f64; 2]>);
/// Title, label of the abscissa, abscissas, panels.
type Picture = (String, String, Vec<f64>, Vec<Panel>);

impl Run {
    /// Of a flight that has just ended.
    pub fn flown(
        run: wingbeat::Run,
        snapshots: Vec<Snapshot>,
        dir: Option<PathBuf>,
        case: String,
    ) -> Self {
        Self {
            run,
            snapshots,
            dir,
            case,
        }
    }

    /// The result directory.
    fn open(&self, py: Python<'_>) -> PyResult<Option<ResultDir>> {
        let open = |dir| ResultDir::open(dir).map_err(|e| raised(py, &e.into()));
        self.dir.as_deref().map(open).transpose()
    }

    fn directory(&self, py: Python<'_>, what: &str) -> PyResult<ResultDir> {
        let dir = self.open(py)?;
        let remedy = "fly into a result directory: fly(out=DIR)";
        dir.ok_or_else(|| {
            refused(
                py,
                "out",
                &format!("{what} needs the files of a run"),
                remedy,
            )
        })
    }

    fn summarised(&self) -> Result<Summary, Error> {
        let Some(path) = &self.dir else {
            return Ok(self.run.summary());
        };
        let dir = ResultDir::open(path)?;
        let history = dir.join("history.csv");
        Ok(Summary::read(&dir.case()?, &history, &self.run.outcome)?)
    }
}

#[pymethods]
impl Run {
    /// A result directory, finished or not.
    #[staticmethod]
    fn read(py: Python<'_>, dir: PathBuf) -> PyResult<Self> {
        let read = || -> Result<(wingbeat::Run, LoadedCase), Error> {
            let run = wingbeat::Run::read(&dir)?;
            Ok((run, ResultDir::open(&dir)?.case()?))
        };
        let has = |name: &str| dir.join(name).is_file();
        let (run, case) = py.detach(read).map_err(|e| match has("manifest.json") {
            false if has("history.csv") && has("summary.json") => without_case(py, &dir),
            _ => raised(py, &e),
        })?;
        Ok(Self::flown(run, vec![], Some(dir), case.resolved()))
    }

    /// The case with everything filled in, as TOML.
    #[getter]
    fn case_text(&self) -> &str {
        &self.case
    }

    /// The result directory; none of a flight in memory.
    #[getter]
    fn dir(&self) -> Option<PathBuf> {
        self.dir.clone()
    }

    /// How it ended: `finished`, `interrupted`, `failed`, `unwritten` or `running`, and why.
    #[getter]
    fn outcome(&self) -> (&'static str, &str) {
        match &self.run.outcome {
            Outcome::Running => ("running", ""),
            Outcome::Finished => ("finished", ""),
            Outcome::Interrupted => ("interrupted", ""),
            Outcome::Unwritten(why) => ("unwritten", why),
            Outcome::Failed(why) => ("failed", why),
        }
    }

    /// Rows of the history.
    #[getter]
    fn rows(&self) -> usize {
        self.run.records.len()
    }

    /// The columns of the history: name, unit, frame, symbol, meaning.
    fn columns(&self, py: Python<'_>) -> PyResult<Vec<About>> {
        let columns = self.run.columns().map_err(|e| raised(py, &e))?;
        let about = |c: &results::columns::Column| {
            (c.name.clone(), c.unit, c.frame, c.symbol, c.about.clone())
        };
        Ok(columns.iter().map(about).collect())
    }

    /// The history: an array for each column, whole numbers for counts.
    fn history<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let history = py.detach(|| -> Result<_, Error> {
            let columns = self.run.columns()?;
            Ok((self.run.history()?.into_columns(), columns))
        });
        let (mut values, columns) = history.map_err(|e| raised(py, &e))?;
        let dict = PyDict::new(py);
        for column in columns.iter() {
            let numbers = values.remove(&column.name).unwrap_or_default();
            let rows = [numbers.len()];
            let array = match column.is_count && numbers.iter().all(|x| x.is_finite()) {
                true => array(
                    py,
                    numbers.iter().map(|x| *x as i64).collect::<Vec<_>>(),
                    &rows,
                )?,
                false => array(py, numbers, &rows)?,
            };
            dict.set_item(&column.name, array)?;
        }
        Ok(dict)
    }

    /// Wingbeats at the start that means leave out: those that smooth starts or the hold reach into.
    #[getter]
    fn starting_beats(&self) -> usize {
        results::summary::starting_beats(&self.run.setup)
    }

    /// The summary: as JSON, in words.
    fn summary(&self, py: Python<'_>) -> PyResult<(String, String)> {
        let summary = py.detach(|| self.summarised());
        let summary = summary.map_err(|e| raised(py, &e))?;
        Ok((summary.to_json(), summary.to_text()))
    }

    /// Steps that have frames.
    fn frame_steps(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        match &self.dir {
            Some(dir) => frames::steps(dir).map_err(|e| raised(py, &e.into())),
            None => Ok(self.snapshots.iter().map(|s| s.step).collect()),
        }
    }

    /// The frame of a step.
    fn frame(&self, py: Python<'_>, step: usize) -> PyResult<Frame> {
        if let Some(dir) = &self.dir {
            let frame = frames::Frame::read(dir, step).map_err(|e| raised(py, &e.into()))?;
            return Ok(Frame::of(frame, step as f64 * self.run.setup.time.step));
        }
        let found = self.snapshots.iter().find(|s| s.step == step);
        let remedy = "see run.frame_steps; output.frames_every says how often frames are kept";
        let found = found.ok_or_else(|| refused(py, "step", "there is no frame of it", remedy))?;
        Ok(Frame::from(found))
    }

    /// The figures over time, by their names.
    fn charts(&self, py: Python<'_>) -> PyResult<Vec<(&'static str, Picture)>> {
        let charts = py.detach(|| -> Result<_, Error> {
            Ok(charts_of(&self.run.setup, &self.run.history()?))
        });
        let charts = charts.map_err(|e| raised(py, &e))?;
        Ok(charts
            .into_iter()
            .map(|(name, chart)| (name, picture(chart)))
            .collect())
    }

    /// Writes `history.csv` and the summary into a new folder.
    fn write(&self, py: Python<'_>, dir: PathBuf) -> PyResult<()> {
        let written = py.detach(|| self.run.write(dir));
        written.map_err(|e| raised(py, &e))
    }

    /// Exports the result directory in another format; the files.
    fn export(
        &self,
        py: Python<'_>,
        format: &str,
        into: Option<PathBuf>,
        overwrite: bool,
    ) -> PyResult<Vec<PathBuf>> {
        let format = named(py, "format", format, &Format::ALL)?;
        let dir = self.directory(py, "an export")?;
        let into = into.unwrap_or_else(|| dir.path().to_owned());
        let files = py.detach(|| export(&dir, format, &into, Existing::kept_unless(overwrite)));
        files.map_err(|e| raised(py, &e.into()))
    }

    /// The flight page, which opens in a browser; none where the directory has none, or of a flight in memory.
    fn page(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let Some(dir) = self.open(py)? else {
            return Ok(None);
        };
        let path = dir.join("flight.html");
        match path.is_file() {
            true => Ok(Some(std::fs::read_to_string(path)?)),
            false => Ok(None),
        }
    }
}

fn picture(chart: Chart) -> Picture {
    let lines = |series: Vec<wingbeat::draw::figures::Series>| {
        series.into_iter().map(|s| (s.label, s.values)).collect()
    };
    let panels = chart.panels.into_iter().map(|p| {
        let shaded = p.shaded.unwrap_or_else(|| chart.shaded.clone());
        (p.label, lines(p.series), shaded)
    });
    let panels = panels.collect();
    (chart.title, chart.x_label, chart.x, panels)
}
