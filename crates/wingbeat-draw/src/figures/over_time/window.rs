//! Which part of a flight is drawn, and how: every row, or the extremes of so many rows each. Rows
//! are never left out in between, which would show oscillations that are not there.

use std::ops::Range;
use std::path::Path;

use wingbeat_flight::FlightSetup;

use crate::figures::axes::chart::Chart;
use crate::figures::over_time::kinds::{measured, time_axis};
use crate::figures::over_time::measure::Measured;
use crate::figures::over_time::part::TimeWindow;
use crate::figures::over_time::shades::Shades;
use crate::figures::over_time::strokes::strokes;
use wingbeat_case::IoError;
use wingbeat_results::History;
use wingbeat_results::rows::Rows;

/// A part of a flight, on its time axis: wingbeats where there are any, else seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Window {
    /// Where it begins; the start if none \[wingbeats\].
    pub from: Option<f64>,
    /// Where it ends; the end if none \[wingbeats\].
    pub to: Option<f64>,
    /// How many of them, from `from` on, or up to `to`, or the last ones \[wingbeats\].
    pub beats: Option<f64>,
}

impl Window {
    /// Ends that contradict each other, whatever the flight; none where they do not.
    pub(crate) fn contradiction(self) -> Option<String> {
        match (self.from, self.to, self.beats) {
            (Some(_), Some(_), Some(_)) => Some(
                "--beats says too much beside both --from and --to; leave one of them out"
                    .to_owned(),
            ),
            (Some(from), Some(to), None) if from >= to => Some(format!(
                "--from {from} does not lie before --to {to}: nothing is drawn; exchange them"
            )),
            _ => None,
        }
    }

    /// The rows of the history at `path`, with these times \[s\], that lie in it.
    ///
    /// # Errors
    /// A window without two rows; wingbeats of a flight that has none.
    pub(crate) fn rows(
        self,
        setup: &FlightSetup,
        path: &Path,
        times: &[f64],
    ) -> Result<Range<usize>, IoError> {
        let unit = setup.time.period.unwrap_or(1.0);
        let all = 0..times.len();
        if self == Self::default() {
            return Ok(all);
        }
        let refused = |problem: String| IoError::Figure {
            path: path.to_owned(),
            problem,
        };
        let end = times.last().copied().unwrap_or(0.0) / unit;
        let [from, to] = self.ends(setup, end).map_err(refused)?;
        let slack = 1e-6; // of a wingbeat: steps are counted in seconds
        let inside = |t: &f64| (from - slack..=to + slack).contains(&(t / unit));
        let first = times.iter().position(inside).unwrap_or(0);
        let count = times.iter().filter(|t| inside(t)).count();
        if count < 2 {
            let name = if setup.time.period.is_some() {
                "wingbeats"
            } else {
                "seconds"
            };
            return Err(refused(format!(
                "from {from} to {to} there are {count} steps of this flight, which lasts from 0 to \
                 {end:.4} {name}; choose another --from, --to or --beats"
            )));
        }
        Ok(first..first + count)
    }

    /// Numbers, from 1, of the whole wingbeats in these rows of a history with these times \[s\].
    pub(crate) fn beats(setup: &FlightSetup, times: &[f64], rows: &Range<usize>) -> Range<usize> {
        let (Some(period), false) = (setup.time.period, rows.is_empty()) else {
            return 0..0;
        };
        let [first, last] = [times[rows.start], times[rows.end - 1]].map(|t| t / period);
        (first - 1e-6).ceil() as usize + 1..(last + 1e-6).floor() as usize + 1
    }

    /// Start and end on the time axis of a flight that lasts until `end`.
    fn ends(self, setup: &FlightSetup, end: f64) -> Result<[f64; 2], String> {
        if self.beats.is_some() && setup.time.period.is_none() {
            return Err(
                "--beats: this flight has no wingbeats; use --from and --to, seconds".into(),
            );
        }
        if let Some(problem) = self.contradiction() {
            return Err(problem);
        }
        match self {
            Self {
                from: Some(from),
                to,
                beats,
            } => Ok([from, to.or(beats.map(|b| from + b)).unwrap_or(end)]),
            Self {
                from: None,
                to,
                beats,
            } => {
                let to = to.unwrap_or(end);
                Ok([beats.map_or(0.0, |b| to - b), to])
            }
        }
    }
}

/// Charts with the names of their kinds.
pub type NamedCharts = Vec<(&'static str, Chart)>;

/// The charts over time of some rows, by name of their kind, with at most about `most` abscissas;
/// and how many rows stand behind two of them (1: each row has its own).
///
/// # Errors
/// A history that cannot be read.
pub(crate) fn charts(
    setup: &FlightSetup,
    path: &Path,
    rows: Range<usize>,
    (part, most): (TimeWindow, usize),
) -> Result<(NamedCharts, usize), IoError> {
    let group = match rows.len() <= most {
        true => 1,
        false => rows.len().div_ceil((most / 2).max(1)),
    };
    let piece = if group == 1 { rows.len() } else { group };
    let mut source = Rows::open(path)?;
    source.skip(rows.start)?;
    let mut drawn = Drawn::of(part);
    let mut left = rows.len();
    while left > 0 {
        let next = History::next(&mut source, piece.min(left))?;
        left = left.saturating_sub(next.rows().max(1));
        if next.rows() > 0 {
            drawn.add(setup, &next, group > 1);
        }
    }
    Ok((drawn.charts(setup, group), group))
}

/// The figures over time of a history in memory, every row of it: name and chart.
pub fn charts_of(setup: &FlightSetup, history: &History) -> NamedCharts {
    let mut drawn = Drawn::of(TimeWindow::whole(setup));
    drawn.add(setup, history, false);
    drawn.charts(setup, 1)
}

/// What has been read of a history for its charts.
struct Drawn {
    part: TimeWindow,
    label: String,
    /// Abscissas of the charts.
    x: Vec<f64>,
    figures: Vec<Measured>,
    /// Abscissa of every row, and stroke angles there, wing by wing.
    times: Vec<f64>,
    strokes: Vec<Vec<f64>>,
}

impl Drawn {
    fn of(part: TimeWindow) -> Self {
        Self {
            part,
            label: String::new(),
            x: vec![],
            figures: vec![],
            times: vec![],
            strokes: vec![],
        }
    }

    /// Adds rows, each or their extremes.
    fn add(&mut self, setup: &FlightSetup, rows: &History, extremes: bool) {
        let (label, times) = time_axis(setup, rows);
        self.label = label;
        let strokes = strokes(setup, rows);
        self.strokes.resize(strokes.len(), vec![]);
        for (all, next) in self.strokes.iter_mut().zip(strokes) {
            all.extend(next);
        }
        match extremes {
            true => self.x.extend([times[0], times[times.len() - 1]]),
            false => self.x.extend(&times),
        }
        self.times.extend(times);
        let next = measured(setup, rows, &self.part).into_iter();
        let next = next.map(|m| if extremes { m.extremes() } else { m });
        match self.figures.is_empty() {
            true => self.figures = next.collect(),
            false => (self.figures.iter_mut().zip(next)).for_each(|(all, n)| all.extend(n)),
        }
    }

    fn charts(&self, setup: &FlightSetup, group: usize) -> Vec<(&'static str, Chart)> {
        let shades = Shades::new(&self.strokes, &self.times);
        let note = self.part.extremes(group);
        let axis = (&self.label[..], &self.x[..]);
        let chart = |m: &Measured| (m.name, m.chart(setup, axis, &shades, &note));
        self.figures.iter().map(chart).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_case::LoadedCase;

    /// 1500 wingbeats of 40 steps in 1500 abscissas: every 40th row alone would be a straight line.
    #[test]
    fn exact_long_flights_keep_their_amplitude() {
        let case = LoadedCase::find("fruit-fly-vacuum", &[]).unwrap();
        let period = case.setup.time.period.unwrap();
        let path = std::env::temp_dir().join(format!("wingbeat-window-{}.csv", std::process::id()));
        let mut text = "step_count,time_s,wing_right_prescribed_phi_rad\n".to_owned();
        for k in 0..=60_000 {
            let beats = f64::from(k) / 40.0;
            let phi = (std::f64::consts::TAU * beats).sin();
            text += &format!("{k},{},{phi}\n", beats * period);
        }
        std::fs::write(&path, text).unwrap();
        let times = Rows::times(&path).unwrap();
        let drawn = |rows: Range<usize>| {
            let part = TimeWindow::of(&case.setup, 1, &times, &rows);
            charts(&case.setup, &path, rows, (part, 1500)).unwrap()
        };
        let (all, group) = drawn(0..60_001);
        let angles = |list: &[(&'static str, Chart)]| {
            let chart = &list.iter().find(|c| c.0 == "angles").unwrap().1;
            let right = chart
                .panels
                .iter()
                .find(|p| p.label.contains("right"))
                .unwrap();
            (
                chart.x.clone(),
                right.series[0].values.clone(),
                chart.shaded.len(),
            )
        };
        let (x, phi, shaded) = angles(&all);
        assert_eq!((group, shaded), (81, 0));
        assert!(x.len() <= 1500 && x.len() == phi.len() && x[x.len() - 1] == 1500.0);
        assert!(all[0].1.title.contains("extremes of every 81 steps"));
        for pair in phi[..phi.len() - 2].chunks(2) {
            let [a, b] = [pair[0].min(pair[1]), pair[0].max(pair[1])];
            assert!((a + 57.29577951308232).abs() < 1e-9 && (b - 57.29577951308232).abs() < 1e-9);
        }
        let (part, group) = drawn(400..801);
        let (x, _, shaded) = angles(&part);
        assert_eq!((group, x.len(), x[0], shaded), (1, 401, 10.0, 11));
        assert!(
            part[0].1.title.ends_with(", 10 to 20 wingbeats"),
            "{}",
            part[0].1.title
        );
        let window = Window {
            to: Some(20.0),
            beats: Some(10.0),
            from: None,
        };
        assert_eq!(window.rows(&case.setup, &path, &times).unwrap(), 400..801);
        std::fs::remove_file(&path).unwrap();
    }
}
