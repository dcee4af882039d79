//! What figures are drawn from, and the drawing of every kind.

use std::ops::Range;
use std::path::Path;

use crate::figures::axes::chart::Chart;
use crate::figures::drawing::Drawing;
use crate::figures::drawing::style::Style;
use crate::figures::order::Kind;
use crate::figures::over_time::part::TimeWindow;
use crate::figures::over_time::window::{Window, charts};
use crate::figures::stills::{beats, lollipop, path, phase, wake};
use wingbeat_case::{IoError, LoadedCase};
use wingbeat_results::rows::Rows;
use wingbeat_results::summary::BeatMeans;
use wingbeat_results::{History, Summary};

/// More abscissas than this do not make a figure better: of longer flights, extremes are drawn.
const MAX_POINTS: usize = 4000;

/// Rows, the last ones, from which phase planes and single wingbeats are drawn.
const MAX_ROWS: usize = 8000;

/// What figures are drawn from.
pub(super) struct Source<'a> {
    pub dir: &'a Path,
    pub case: &'a LoadedCase,
    /// Rows of the history that are drawn.
    rows: Range<usize>,
    /// Steps of these rows.
    pub steps: Vec<usize>,
    part: TimeWindow,
    /// The last of these rows, at most [`MAX_ROWS`].
    history: History,
    charts: Vec<(&'static str, Chart)>,
    /// Whole wingbeats in these rows.
    beats: Vec<BeatMeans>,
    /// Frame whose wake is drawn.
    step: Option<usize>,
}

impl<'a> Source<'a> {
    pub fn new(
        dir: &'a Path,
        case: &'a LoadedCase,
        summary: &Summary,
        (window, step): (Window, Option<usize>),
    ) -> Result<Self, IoError> {
        let path = dir.join("history.csv");
        let times = Rows::times(&path)?;
        let rows = window.rows(&case.setup, &path, &times)?;
        let part = TimeWindow::of(&case.setup, case.output.history_every, &times, &rows);
        let last = rows.end.saturating_sub(MAX_ROWS).max(rows.start)..rows.end;
        let history = History::of_rows(&path, last)?;
        let drawn = (part.clone(), MAX_POINTS);
        let (charts, _) = charts(&case.setup, &path, rows.clone(), drawn)?;
        let whole = Window::beats(&case.setup, &times, &rows);
        let steps = times[rows.clone()].iter();
        let steps = steps.map(|t| (t / case.setup.time.step).round() as usize);
        let steps: Vec<usize> = steps.collect();
        let inside = |b: &&BeatMeans| whole.contains(&b.beat);
        Ok(Self {
            dir,
            case,
            history,
            charts,
            beats: summary.beats.iter().filter(inside).cloned().collect(),
            step: step.or_else(|| steps.last().copied()),
            steps,
            part,
            rows,
        })
    }

    /// Places of the body in all rows, at most [`MAX_POINTS`] of them \[m, N\].
    fn path(&self) -> Result<path::Path, IoError> {
        let mut rows = Rows::open(&self.dir.join("history.csv"))?;
        let names = ["body_x_m", "body_y_m", "body_z_m"];
        let column = |name: &str| rows.names().iter().position(|n| n == name);
        let Some(columns) = names
            .iter()
            .map(|n| column(n))
            .collect::<Option<Vec<usize>>>()
        else {
            return Ok(path::Path::default());
        };
        rows.skip(self.rows.start)?;
        let mut path = path::Path::new(self.rows.len().div_ceil(MAX_POINTS));
        for k in 0..self.rows.len() {
            let Some(row) = rows.next_row()? else { break };
            path.add(k, row[1], [0, 1, 2].map(|c| row[columns[c]]));
        }
        Ok(path)
    }

    /// What phase planes show, where it is not everything.
    fn note(&self) -> String {
        match self.rows.len() - self.history.rows() {
            0 => self.part.note(),
            _ => format!("{}, last {} rows", self.part.note(), self.history.rows()),
        }
    }

    /// Why there is no drawing of a kind.
    pub fn lacks(&self, kind: Kind) -> String {
        let beat = match kind {
            Kind::Lollipop | Kind::Beats => self.part.lacks_beat(),
            _ => None,
        };
        beat.unwrap_or_else(|| kind.needs().to_owned())
    }

    /// The drawing of a kind; none where the run has no such thing.
    pub fn draw(&self, kind: Kind, style: Style) -> Result<Option<Drawing>, IoError> {
        let (look, setup) = (style.look(), &self.case.setup);
        if self.history.rows() < 2 {
            return Ok(None);
        }
        let chart = || {
            let found = self.charts.iter().find(|c| c.0 == kind.name());
            found.map(|c| c.1.drawing(&look))
        };
        let drawn = match kind {
            Kind::Lollipop => lollipop::lollipop(setup, &self.history, &self.part, &look),
            Kind::Beats => beats::beats(
                setup,
                &self.history,
                (&self.beats, &self.part.note()),
                &look,
            ),
            Kind::Path => path::path(setup, (&self.path()?, &self.part), &look),
            Kind::Phase => phase::phase(setup, &self.history, &self.note(), &look),
            Kind::Wake => wake::wake(self.dir, self.case, self.step, &look)?,
            Kind::Animation => None,
            Kind::Angles
            | Kind::Forces
            | Kind::Trajectory
            | Kind::Commands
            | Kind::Bending
            | Kind::Balances => chart(),
        };
        Ok(drawn.map(|d| style.grounded(d)))
    }
}
