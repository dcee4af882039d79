//! What a figure over time shows before its units are chosen: SI numbers, row by row. Units, and what
//! is worth a line, depend on the whole flight; the rows may come piece by piece.

use wingbeat_flight::FlightSetup;

use crate::figures::axes::chart::{Chart, Panel, Series};
use crate::figures::axes::units::{FORCE_FLOOR, force_unit, prefix, scaled};
use crate::figures::over_time::shades::Shades;

/// A figure.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measured {
    /// Name of its kind.
    pub name: &'static str,
    /// Title without the name of the flight.
    pub title: String,
    /// Whether downstrokes are shaded.
    pub shaded: bool,
    pub panels: Vec<Measure>,
}

/// One pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measure {
    label: String,
    unit: Unit,
    pub lines: Vec<Line>,
    logarithmic: bool,
    /// Extent below which differences are rounding, SI.
    floor: f64,
    /// Whether lines that lie on each other are shown as one.
    joins_alike: bool,
    /// Number of the wing whose downstrokes are shaded; none: those of the chart are.
    wing: Option<usize>,
}

/// Differences of angles below this are rounding \[deg\].
const ANGLE_FLOOR: f64 = 1e-5;

/// What the numbers are shown in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    /// Newtons over the weight, where there is any.
    Weight,
    /// This unit with a decimal prefix that suits the numbers.
    Prefixed(&'static str),
    /// Radians as degrees.
    Degrees,
    /// As the label says.
    Given,
}

/// When a line is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kept {
    Always,
    NotZero,
    /// With all lines of its panel, if one of them has more than this, SI.
    Over(f64),
    /// Beside the other lines of its panel: more than [`FORCE_FLOOR`] of the largest.
    Felt,
    /// Never; so many times its largest value is what is rounding in the others of its panel.
    Floor(f64),
}

/// A quantity over time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    label: String,
    pub values: Vec<f64>,
    /// From which it may be counted: its value in the first row of all.
    first: f64,
    kept: Kept,
    from_start: bool,
}

impl Line {
    pub fn new(label: &str, values: Vec<f64>) -> Self {
        Self {
            label: label.to_owned(),
            first: values.first().copied().unwrap_or(0.0),
            values,
            kept: Kept::Always,
            from_start: false,
        }
    }

    pub fn kept(self, kept: Kept) -> Self {
        Self { kept, ..self }
    }

    /// The same counted from its first value.
    pub fn since_start(self) -> Self {
        let first = self.first;
        self.since(first)
    }

    /// The same counted from this value, SI.
    pub fn since(self, first: f64) -> Self {
        Self {
            first,
            from_start: true,
            ..self
        }
    }

    fn offset(&self) -> f64 {
        if self.from_start { self.first } else { 0.0 }
    }

    /// Its largest value in size, as it is shown.
    fn way(&self) -> f64 {
        let from = self.offset();
        self.values.iter().fold(0.0, |a, v| a.max((v - from).abs()))
    }
}

impl Measure {
    pub fn new(label: &str, unit: Unit, lines: Vec<Line>) -> Self {
        Self {
            label: label.to_owned(),
            unit,
            lines,
            logarithmic: false,
            floor: match unit {
                Unit::Degrees => ANGLE_FLOOR.to_radians(),
                _ => 0.0,
            },
            joins_alike: false,
            wing: None,
        }
    }

    /// The same with an axis that shows no less than this extent, SI.
    pub fn floored(self, floor: f64) -> Self {
        Self { floor, ..self }
    }

    /// The same, left out where no line has more than the floor.
    pub fn if_moving(mut self) -> Self {
        let kept = Kept::Over(self.floor);
        self.lines.iter_mut().for_each(|line| line.kept = kept);
        self
    }

    /// The same with one line for those that cannot be told apart, which has all their names.
    pub fn of_alike(self) -> Self {
        Self {
            joins_alike: true,
            ..self
        }
    }

    /// The same with the downstrokes of wing number `k` shaded.
    pub fn of_wing(self, k: usize) -> Self {
        Self {
            wing: Some(k),
            ..self
        }
    }

    /// The same with a logarithmic axis of magnitudes.
    pub fn logarithmic(self) -> Self {
        Self {
            logarithmic: true,
            ..self
        }
    }

    /// The panel; none where no line is worth showing.
    fn panel(&self, setup: &FlightSetup, shades: &Shades) -> Option<Panel> {
        let shown = self
            .lines
            .iter()
            .filter(|l| !matches!(l.kept, Kept::Floor(_)));
        let most = shown.map(Line::way).fold(0.0, f64::max);
        let kept = |line: &&Line| match line.kept {
            Kept::Always => true,
            Kept::NotZero => line.values.iter().any(|v| *v != 0.0),
            Kept::Over(least) => most > least,
            Kept::Felt => line.way() > FORCE_FLOOR * most,
            Kept::Floor(_) => false,
        };
        let lines = self.lines.iter().filter(kept);
        let mut lines: Vec<(String, Vec<f64>)> = lines
            .map(|l| {
                let values = l.values.iter().map(|v| v - l.offset());
                (l.label.clone(), values.collect())
            })
            .collect();
        if lines.is_empty() {
            return None;
        }
        let floor = self.floor();
        if self.joins_alike {
            lines = joined(lines, floor);
        }
        let (label, factor) = self.axis(setup, &lines, floor);
        let series = lines.iter().map(|(label, values)| Series {
            label: label.clone(),
            values: scaled(values, factor),
            measured: false,
        });
        Some(Panel {
            label,
            series: series.collect(),
            logarithmic: self.logarithmic,
            least: floor * factor,
            shaded: self.wing.and_then(|k| shades.own(k)),
        })
    }

    /// Extent below which differences are rounding, SI.
    fn floor(&self) -> f64 {
        let of_line = |line: &Line| match line.kept {
            Kept::Floor(part) => part * line.way(),
            _ => 0.0,
        };
        self.lines.iter().map(of_line).fold(self.floor, f64::max)
    }

    /// Name of the axis with its unit, and the factor from SI.
    fn axis(&self, setup: &FlightSetup, lines: &[(String, Vec<f64>)], floor: f64) -> (String, f64) {
        let label = &self.label;
        match self.unit {
            Unit::Given => (label.clone(), 1.0),
            Unit::Degrees => (format!("{label} [deg]"), 1f64.to_degrees()),
            Unit::Prefixed(unit) => {
                let all = lines.iter().flat_map(|l| &l.1);
                let (scale, prefix) = prefix(all.chain([&floor]));
                (format!("{label} [{prefix}{unit}]"), 1.0 / scale)
            }
            Unit::Weight => match force_unit(setup, lines.iter().flat_map(|l| &l.1)) {
                (unit, factor) if unit == "weight" => (format!("{label} / weight"), factor),
                (unit, factor) => (format!("{label} [{unit}]"), factor),
            },
        }
    }
}

impl Measured {
    /// Appends what the next rows show.
    pub fn extend(&mut self, next: Self) {
        for (panel, more) in self.panels.iter_mut().zip(next.panels) {
            for (line, more) in panel.lines.iter_mut().zip(more.lines) {
                line.values.extend(more.values);
            }
        }
    }

    /// The smallest and the largest value of every line, in the order they come: two rows.
    pub fn extremes(mut self) -> Self {
        for line in self.panels.iter_mut().flat_map(|p| &mut p.lines) {
            line.values = extremes(&line.values).to_vec();
        }
        self
    }

    /// The chart in its units.
    pub fn chart(
        &self,
        setup: &FlightSetup,
        (x_label, x): (&str, &[f64]),
        shades: &Shades,
        note: &str,
    ) -> Chart {
        let shaded = match self.shaded {
            true => shades.of_chart(),
            false => vec![],
        };
        let each = self.panels.iter().all(|p| p.wing.is_some());
        let words = match shaded.is_empty() {
            true => String::new(),
            false => shades.words(setup, each),
        };
        let panels = self.panels.iter();
        Chart {
            title: format!("{}: {}{words}{note}", setup.name, self.title),
            x_label: x_label.to_owned(),
            x: x.to_vec(),
            shaded,
            panels: panels.filter_map(|p| p.panel(setup, shades)).collect(),
        }
    }
}

/// Part of the extent of a panel by which lines differ at least where one can be told from the other \[1\].
const APART: f64 = 2e-3;

/// Lines with one in place of those that cannot be told from it, as they are named: all wings, or their names.
fn joined(lines: Vec<(String, Vec<f64>)>, floor: f64) -> Vec<(String, Vec<f64>)> {
    let all = lines.iter().flat_map(|l| &l.1).filter(|v| v.is_finite());
    let [low, high] = all.fold([0.0_f64; 2], |[low, high], v| [low.min(*v), high.max(*v)]);
    let least = APART * (high - low).max(floor);
    let is_alike = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= least);
    let (count, mut found) = (lines.len(), Vec::<(Vec<String>, Vec<f64>)>::new());
    for (name, values) in lines {
        match found.iter_mut().find(|f| is_alike(&f.1, &values)) {
            Some(like) => like.0.push(name),
            None => found.push((vec![name], values)),
        }
    }
    let named = |(names, values): (Vec<String>, Vec<f64>)| match names.len() {
        1 => (names[0].clone(), values),
        2 if count == 2 => ("both wings".to_owned(), values),
        n if n == count => ("all wings".to_owned(), values),
        _ => (names.join(", ").replace(", wing ", ", "), values),
    };
    found.into_iter().map(named).collect()
}

/// Smallest and largest number, the one that comes first first; what is not a number counts only
/// where there is nothing else.
fn extremes(values: &[f64]) -> [f64; 2] {
    let finite = || {
        values
            .iter()
            .copied()
            .enumerate()
            .filter(|v| v.1.is_finite())
    };
    let least = finite().min_by(|a, b| a.1.total_cmp(&b.1));
    let most = finite().max_by(|a, b| a.1.total_cmp(&b.1));
    match (least, most) {
        (Some(a), Some(b)) if a.0 <= b.0 => [a.1, b.1],
        (Some(a), Some(b)) => [b.1, a.1],
        _ => [f64::NAN; 2],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_extremes_come_in_their_order() {
        assert_eq!(extremes(&[1.0, -2.0, 3.0, f64::NAN]), [-2.0, 3.0]);
        assert_eq!(extremes(&[1.0, 4.0, -3.0]), [4.0, -3.0]);
        assert_eq!(extremes(&[5.0]), [5.0; 2]);
        assert!(extremes(&[f64::NAN]).iter().all(|v| v.is_nan()));
    }

    /// Lines on each other are one, which has all names; a difference that shows keeps them apart.
    #[test]
    fn behaves_lines_that_lie_on_each_other_are_one() {
        let names = |values: &[f64]| {
            let wings = ["left a", "left b", "right a", "right b"]
                .iter()
                .zip(values);
            let lines = wings.map(|(n, v)| (format!("wing {n}"), vec![0.0, *v]));
            let found = joined(lines.collect(), 0.0).into_iter();
            found.map(|l| l.0).collect::<Vec<String>>()
        };
        assert_eq!(names(&[1.0; 4]), ["all wings"]);
        assert_eq!(names(&[1.0, 0.9999]), ["both wings"]);
        assert_eq!(names(&[1.0, 0.99]), ["wing left a", "wing left b"]);
        let pairs = ["wing left a, left b", "wing right a, right b"];
        assert_eq!(names(&[1.0, 1.0, -1.0, -1.0]), pairs);
    }
}
