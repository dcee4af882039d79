//! Stacked line charts with a shared horizontal axis.

use crate::figures::axes::plot::{self, Area, Curve, Plot};
use crate::figures::drawing::style::{Look, Style};
use crate::figures::drawing::{COLOURS, Drawing, INK};

/// A line of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Legend.
    pub label: String,
    /// Values at the abscissas of the chart \[unit of its axis\].
    pub values: Vec<f64>,
    /// Whether these are given and not computed: black, with a dot at each number.
    pub measured: bool,
}

/// One pair of axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// Quantity and unit of the vertical axis.
    pub label: String,
    /// Lines.
    pub series: Vec<Series>,
    /// Logarithmic vertical axis of magnitudes.
    pub logarithmic: bool,
    /// The vertical axis shows no less than this: smaller differences are rounding \[unit of the axis\].
    pub least: f64,
    /// Shaded intervals of its own, in place of those of the chart \[unit of the horizontal axis\].
    pub shaded: Option<Vec<[f64; 2]>>,
}

/// Panels above each other with one abscissa.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Quantity and unit of the horizontal axis.
    pub x_label: String,
    /// Abscissas \[unit of the axis\].
    pub x: Vec<f64>,
    /// Shaded intervals of the horizontal axis (downstrokes) \[unit of the axis\].
    pub shaded: Vec<[f64; 2]>,
    /// Panels from top to bottom.
    pub panels: Vec<Panel>,
}

impl Chart {
    /// The drawing as SVG, for the screen.
    pub fn to_svg(&self) -> String {
        self.drawing(&Style::Screen.look()).to_svg()
    }

    /// The drawing.
    pub(crate) fn drawing(&self, look: &Look) -> Drawing {
        let plots: Vec<Plot> = (0..self.panels.len()).map(|k| self.plot(k, look)).collect();
        let margins = plots.iter().map(|p| p.margin(look.panel, look));
        let left = margins.fold(0.0, f64::max) + 0.6 * look.font;
        let width = look.width - left - 1.6 * look.font;
        let above = |p: &Plot| p.head(width, look) + 0.3 * look.font;
        let heights = plots.iter().map(|p| above(p) + look.panel + p.foot(look));
        let mut drawing = Drawing::new([look.width, look.head() + heights.sum::<f64>()]);
        plot::title(&mut drawing, &self.title, look);
        let mut top = look.head();
        for plot in &plots {
            top += above(plot);
            let area = Area {
                left,
                top,
                width,
                height: look.panel,
            };
            plot.draw(&mut drawing, area, look);
            top += look.panel + plot.foot(look);
        }
        drawing
    }

    fn plot(&self, k: usize, look: &Look) -> Plot {
        let panel = &self.panels[k];
        let last = k + 1 == self.panels.len();
        let curves = panel.series.iter().enumerate().map(|(n, s)| {
            let points = self.x.iter().zip(&s.values).map(|(x, y)| [*x, *y]);
            let colour = match s.measured {
                true => INK,
                false => COLOURS[n % COLOURS.len()],
            };
            Curve {
                dotted: s.measured,
                ..plot::curve(&s.name(), points.collect(), colour, n, look)
            }
        });
        Plot {
            x_label: if last {
                self.x_label.clone()
            } else {
                String::new()
            },
            y_label: panel.label.clone(),
            x: self.x_range(),
            counts: false,
            y: panel.range(),
            logarithmic: panel.logarithmic,
            shaded: panel.shaded.as_ref().unwrap_or(&self.shaded).clone(),
            curves: curves.collect(),
            bands: vec![],
        }
    }

    fn x_range(&self) -> [f64; 2] {
        let first = self.x.first().copied().unwrap_or(0.0);
        let last = self.x.last().copied().unwrap_or(1.0);
        [first, if last > first { last } else { first + 1.0 }]
    }
}

impl Series {
    /// The legend; a line that is zero throughout says so.
    fn name(&self) -> String {
        match self.values.iter().all(|v| *v == 0.0) {
            true => format!("{} = 0", self.label),
            false => self.label.clone(),
        }
    }
}

impl Panel {
    /// A linear panel.
    pub fn new(label: &str, series: Vec<(&str, Vec<f64>)>) -> Self {
        let series = series.into_iter().map(|(label, values)| Series {
            label: label.to_owned(),
            values,
            measured: false,
        });
        Self {
            label: label.to_owned(),
            series: series.collect(),
            ..Self::default()
        }
    }

    /// The same with a logarithmic axis of magnitudes.
    pub fn logarithmic(self) -> Self {
        Self {
            logarithmic: true,
            ..self
        }
    }

    pub(crate) fn range(&self) -> [f64; 2] {
        let values = self.series.iter().flat_map(|s| s.values.iter().copied());
        match self.logarithmic {
            true => plot::decades(values),
            false => plot::at_least(plot::range(values), self.least),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::drawing::Mark;

    /// The curve of y = x passes the ticks of both axes at the same numbers.
    #[test]
    fn exact_curves_agree_with_ticks() {
        let values: Vec<f64> = (0..=40).map(|k| f64::from(k) * 0.25).collect();
        let chart = Chart {
            title: String::new(),
            x_label: "x [s]".to_owned(),
            x: values.clone(),
            shaded: vec![],
            panels: vec![Panel::new("y [m]", vec![("y", values)])],
        };
        let look = Style::Paper.look();
        let drawing = chart.drawing(&look);
        let place = |wanted: &str, c: usize| {
            let places = drawing.marks.iter().filter_map(|m| match m {
                Mark::Text { at, text, .. } if text == wanted => Some(*at),
                _ => None,
            });
            let places: Vec<[f64; 2]> = places.collect();
            // Numbers along stand lowest, numbers upward stand leftmost.
            let by = |a: &&[f64; 2], b: &&[f64; 2]| a[1 - c].total_cmp(&b[1 - c]);
            match c {
                0 => places.iter().max_by(by).unwrap()[0],
                _ => places.iter().min_by(by).unwrap()[1] - 0.36 * look.font,
            }
        };
        let longest = drawing.marks.iter().filter_map(|m| match m {
            Mark::Line { points, .. } => Some(points),
            _ => None,
        });
        let curve = longest.max_by_key(|p| p.len()).unwrap();
        for tick in ["2", "4", "8"] {
            let k = 4 * tick.parse::<usize>().unwrap();
            assert!((curve[k][0] - place(tick, 0)).abs() < 1e-9);
            assert!((curve[k][1] - place(tick, 1)).abs() < 1e-9);
        }
    }
}
