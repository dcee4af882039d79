//! Stacked line charts with a shared horizontal axis, drawn with plotters.

use plotters::coord::Shift;
use plotters::prelude::*;

/// Okabe & Ito's colours, told apart by colour-blind readers.
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];
const INK: RGBColor = RGBColor(40, 40, 40);
const SHADE: RGBColor = RGBColor(235, 235, 235);
const WIDTH: u32 = 900;
const PANEL_HEIGHT: u32 = 250;
const TITLE_HEIGHT: u32 = 44;
const LEGEND_WIDTH: u32 = 150;

/// A line of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Legend.
    pub label: String,
    /// Values at the abscissas of the chart.
    pub values: Vec<f64>,
}

/// One pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Quantity and unit of the vertical axis.
    pub label: String,
    /// Lines.
    pub series: Vec<Series>,
    /// Logarithmic vertical axis of magnitudes.
    pub logarithmic: bool,
}

/// Panels above each other with one abscissa.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Quantity and unit of the horizontal axis.
    pub x_label: String,
    /// Abscissas.
    pub x: Vec<f64>,
    /// Shaded intervals of the horizontal axis (downstrokes).
    pub shaded: Vec<[f64; 2]>,
    /// Panels from top to bottom.
    pub panels: Vec<Panel>,
}

impl Chart {
    /// The drawing.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn to_svg(&self) -> Result<String, String> {
        let mut svg = String::new();
        let height = TITLE_HEIGHT + PANEL_HEIGHT * self.panels.len() as u32;
        let root = SVGBackend::with_string(&mut svg, (WIDTH, height)).into_drawing_area();
        self.draw(&root).map_err(|e| e.to_string())?;
        root.present().map_err(|e| e.to_string())?;
        drop(root);
        Ok(svg)
    }

    fn draw<B: DrawingBackend>(
        &self,
        root: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        root.fill(&WHITE)?;
        let body = root.titled(&self.title, ("sans-serif", 22).into_font().color(&INK))?;
        let areas = body.split_evenly((self.panels.len(), 1));
        for (k, (panel, area)) in self.panels.iter().zip(&areas).enumerate() {
            let last = k + 1 == self.panels.len();
            let (axes, names) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
            if panel.logarithmic {
                self.logarithmic(panel, &axes, last)?;
            } else {
                self.linear(panel, &axes, last)?;
            }
            legend(panel, &names)?;
        }
        Ok(())
    }

    fn x_range(&self) -> std::ops::Range<f64> {
        let first = self.x.first().copied().unwrap_or(0.0);
        first
            ..self
                .x
                .last()
                .copied()
                .unwrap_or(1.0)
                .max(first + f64::MIN_POSITIVE)
    }

    fn linear<B: DrawingBackend>(
        &self,
        panel: &Panel,
        area: &DrawingArea<B, Shift>,
        last: bool,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let [lo, hi] = panel.range();
        let mut chart = builder(area, last).build_cartesian_2d(self.x_range(), lo..hi)?;
        for &[a, b] in &self.shaded {
            chart.draw_series([Rectangle::new([(a, lo), (b, hi)], SHADE.filled())])?;
        }
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(215, 215, 215))
            .axis_style(INK)
            .x_desc(if last { self.x_label.as_str() } else { "" })
            .y_desc(panel.label.as_str())
            .x_labels(11)
            .y_labels(6)
            .y_label_formatter(&|y| tick(*y, hi - lo))
            .x_label_formatter(&|x| tick(*x, self.x_range().end - self.x_range().start))
            .label_style(("sans-serif", 14).into_font().color(&INK))
            .axis_desc_style(("sans-serif", 15).into_font().color(&INK))
            .draw()?;
        for (k, series) in panel.series.iter().enumerate() {
            let style = ShapeStyle::from(COLOURS[k % COLOURS.len()]).stroke_width(2);
            let points = self.x.iter().copied().zip(series.values.iter().copied());
            chart.draw_series(LineSeries::new(points.filter(|p| p.1.is_finite()), style))?;
        }
        Ok(())
    }

    fn logarithmic<B: DrawingBackend>(
        &self,
        panel: &Panel,
        area: &DrawingArea<B, Shift>,
        last: bool,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let [lo, hi] = panel.log_range();
        let range = (lo..hi).log_scale();
        let mut chart = builder(area, last).build_cartesian_2d(self.x_range(), range)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(215, 215, 215))
            .axis_style(INK)
            .x_desc(if last { self.x_label.as_str() } else { "" })
            .y_desc(panel.label.as_str())
            .x_labels(11)
            .y_labels(6)
            .y_label_formatter(&|y| format!("{y:.0e}"))
            .x_label_formatter(&|x| tick(*x, self.x_range().end - self.x_range().start))
            .label_style(("sans-serif", 14).into_font().color(&INK))
            .axis_desc_style(("sans-serif", 15).into_font().color(&INK))
            .draw()?;
        for (k, series) in panel.series.iter().enumerate() {
            let style = ShapeStyle::from(COLOURS[k % COLOURS.len()]).stroke_width(2);
            let points = self
                .x
                .iter()
                .copied()
                .zip(series.values.iter().map(|y| y.abs()));
            chart.draw_series(LineSeries::new(points.filter(|p| p.1 >= lo), style))?;
        }
        Ok(())
    }
}

fn builder<'a, 'b, B: DrawingBackend>(
    area: &'a DrawingArea<B, Shift>,
    last: bool,
) -> ChartBuilder<'a, 'b, B> {
    let mut builder = ChartBuilder::on(area);
    builder
        .margin_left(12)
        .margin_right(14)
        .margin_top(8)
        .set_label_area_size(LabelAreaPosition::Left, 78)
        .set_label_area_size(LabelAreaPosition::Bottom, if last { 46 } else { 24 });
    builder
}

/// Names of the lines beside the axes, in their colours; a line that is zero throughout says so.
fn legend<B: DrawingBackend>(
    panel: &Panel,
    area: &DrawingArea<B, Shift>,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    for (k, series) in panel.series.iter().enumerate() {
        let y = 24 + 22 * k as i32;
        let style = ShapeStyle::from(COLOURS[k % COLOURS.len()]).stroke_width(3);
        area.draw(&PathElement::new([(0, y), (20, y)], style))?;
        let zero = series.values.iter().all(|v| *v == 0.0);
        let text = if zero {
            format!("{} = 0", series.label)
        } else {
            series.label.clone()
        };
        let font = ("sans-serif", 14).into_font().color(&INK);
        area.draw(&Text::new(text, (26, y - 7), font))?;
    }
    Ok(())
}

impl Panel {
    /// A linear panel.
    pub fn new(label: &str, series: Vec<(&str, Vec<f64>)>) -> Self {
        let series = series.into_iter().map(|(label, values)| Series {
            label: label.to_owned(),
            values,
        });
        Self {
            label: label.to_owned(),
            series: series.collect(),
            logarithmic: false,
        }
    }

    /// The same with a logarithmic axis of magnitudes.
    pub fn logarithmic(self) -> Self {
        Self {
            logarithmic: true,
            ..self
        }
    }

    fn values(&self) -> impl Iterator<Item = f64> {
        self.series
            .iter()
            .flat_map(|s| s.values.iter().copied())
            .filter(|y| y.is_finite())
    }

    /// Range with a margin, never empty.
    fn range(&self) -> [f64; 2] {
        let [lo, hi] = self
            .values()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], y| {
                [a.min(y), b.max(y)]
            });
        if lo > hi {
            return [-1.0, 1.0];
        }
        let margin = if hi - lo > 1e-12 * hi.abs().max(lo.abs()) {
            0.06 * (hi - lo)
        } else {
            (0.1 * hi.abs()).max(1e-3)
        };
        [lo - margin, hi + margin]
    }

    /// Decades that hold all magnitudes, at most sixteen of them.
    fn log_range(&self) -> [f64; 2] {
        let positive = self.values().map(f64::abs).filter(|y| *y > 0.0);
        let [lo, hi] = positive.fold([f64::INFINITY, 0.0_f64], |[a, b], y| [a.min(y), b.max(y)]);
        if hi == 0.0 {
            return [1e-16, 1.0];
        }
        let top = hi.log10().ceil() + 0.2;
        let bottom = (lo.log10().floor()).max(top - 16.0);
        [10f64.powf(bottom), 10f64.powf(top)]
    }
}

/// A tick label with as many digits as the range needs.
fn tick(value: f64, range: f64) -> String {
    let digits = (1.0 - (range / 5.0).log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.digits$}");
    let short = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    if short == "-0" {
        "0".to_owned()
    } else {
        short.to_owned()
    }
}
