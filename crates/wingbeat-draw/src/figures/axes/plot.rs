//! One pair of axes with curves: ranges, frame, ticks, legend.

use crate::figures::axes::ticks;
use crate::figures::drawing::font;
use crate::figures::drawing::style::Look;
use crate::figures::drawing::{Anchor, Colour, Drawing, FAINT, INK, SHADE, Stroke};

/// A rectangle \[points\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Area {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

/// A line through points; a break where a number is not finite.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    /// Legend; empty: none.
    pub label: String,
    pub points: Vec<[f64; 2]>,
    pub stroke: Stroke,
    /// Whether the points are marked.
    pub dotted: bool,
}

/// What stands on the axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Plot {
    /// Quantity and unit along; empty: neither name nor numbers.
    pub x_label: String,
    /// Quantity and unit upward.
    pub y_label: String,
    pub x: [f64; 2],
    /// Whether numbers along are whole.
    pub counts: bool,
    /// Range upward; of a logarithmic axis, exponents of ten.
    pub y: [f64; 2],
    pub logarithmic: bool,
    /// Shaded intervals of x.
    pub shaded: Vec<[f64; 2]>,
    pub curves: Vec<Curve>,
    /// Filled between a lower and an upper line, under the curves.
    pub bands: Vec<Band>,
}

/// What lies between two lines with the same abscissas.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Band {
    /// Abscissa, lower and upper value.
    pub points: Vec<[f64; 3]>,
    pub colour: Colour,
}

/// From quantities to points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub area: Area,
    x: [f64; 2],
    y: [f64; 2],
}

impl Axes {
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Area {
            left,
            top,
            width,
            height,
        } = self.area;
        let part = |v: f64, [lo, hi]: [f64; 2]| (v - lo) / (hi - lo);
        [
            left + width * part(x, self.x),
            top + height * (1.0 - part(y, self.y)),
        ]
    }
}

impl Plot {
    /// Room left of the frame for the labels of the ticks.
    pub fn margin(&self, height: f64, look: &Look) -> f64 {
        let labels = self.y_ticks(height, look);
        let widest = labels.iter().map(|t| font::width(&t.1, look.font));
        widest.fold(0.0, f64::max) + 0.9 * look.font
    }

    /// Room above the frame for name and legend, in a plot of this width.
    pub fn head(&self, width: f64, look: &Look) -> f64 {
        self.legend_rows(width, look).len().max(1) as f64 * look.row() + 0.3 * look.font
    }

    /// Room below the frame.
    pub fn foot(&self, look: &Look) -> f64 {
        match self.x_label.is_empty() {
            true => 0.5 * look.font,
            false => 3.1 * look.font,
        }
    }

    /// Draws everything into the frame `area`, its labels around it.
    pub fn draw(&self, to: &mut Drawing, area: Area, look: &Look) -> Axes {
        let axes = Axes {
            area,
            x: self.x,
            y: self.y,
        };
        self.background(to, &axes, look);
        for band in &self.bands {
            let line = |k: usize| band.points.iter().map(move |p| axes.at([p[0], p[k]]));
            to.area(line(1).chain(line(2).rev()).collect(), band.colour, 0.35);
        }
        for curve in &self.curves {
            draw_curve(to, &axes, curve, self.logarithmic);
        }
        let corner = |x: f64, y: f64| [area.left + x * area.width, area.top + y * area.height];
        let frame = vec![
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(1.0, 1.0),
            corner(0.0, 1.0),
        ];
        to.outline(frame, Stroke::solid(INK, look.hair));
        self.legend(to, area, look);
        axes
    }

    fn y_ticks(&self, height: f64, look: &Look) -> Vec<(f64, String)> {
        let most = (height / (2.1 * look.font)).floor().max(2.0) as usize;
        let [lo, hi] = self.y;
        match self.logarithmic {
            true => ticks::decades(lo, hi, most.min(8)),
            false => ticks::linear(lo, hi, most.min(7)),
        }
    }

    fn x_ticks(&self, width: f64, look: &Look) -> Vec<(f64, String)> {
        let mut most = (width / (3.2 * look.font)).floor().clamp(2.0, 12.0) as usize;
        if self.counts {
            most = most.min((self.x[1] - self.x[0]).max(1.0) as usize);
        }
        loop {
            let ticks = ticks::linear(self.x[0], self.x[1], most);
            let widths = ticks
                .iter()
                .map(|t| font::width(&t.1, look.font) + look.font);
            if most <= 2 || widths.sum::<f64>() <= width {
                return ticks;
            }
            most -= 1;
        }
    }

    fn background(&self, to: &mut Drawing, axes: &Axes, look: &Look) {
        let Area {
            left,
            top,
            width,
            height,
        } = axes.area;
        let [right, bottom] = [left + width, top + height];
        for [a, b] in &self.shaded {
            let [a, b] = [a, b].map(|x| axes.at([*x, 0.0])[0].clamp(left, right));
            to.area(
                vec![[a, top], [b, top], [b, bottom], [a, bottom]],
                SHADE,
                1.0,
            );
        }
        let tick = Stroke::solid(INK, look.hair);
        let grid = Stroke::solid(FAINT, look.hair);
        for (value, label) in self.y_ticks(height, look) {
            let y = axes.at([self.x[0], value])[1];
            if look.gridded {
                to.line(vec![[left, y], [right, y]], grid);
            }
            to.line(vec![[left, y], [left + 0.35 * look.font, y]], tick);
            let at = [left - 0.4 * look.font, y + 0.36 * look.font];
            to.text(at, &label, look.font, Anchor::End);
        }
        for (value, label) in self.x_ticks(width, look) {
            let x = axes.at([value, self.y[0]])[0];
            if look.gridded {
                to.line(vec![[x, top], [x, bottom]], grid);
            }
            to.line(vec![[x, bottom], [x, bottom - 0.35 * look.font]], tick);
            if !self.x_label.is_empty() {
                let at = [x, bottom + 1.2 * look.font];
                to.text(at, &label, look.font, Anchor::Middle);
            }
        }
        let at = [left + width / 2.0, bottom + 2.55 * look.font];
        to.text(at, &self.x_label, look.font, Anchor::Middle);
    }

    /// Curves with a legend, row by row; the first row begins after the name of the axis.
    fn legend_rows(&self, width: f64, look: &Look) -> Vec<Vec<&Curve>> {
        let mut free = width - font::width(&self.y_label, look.font) - look.font;
        let mut rows: Vec<Vec<&Curve>> = vec![vec![]];
        for curve in self.curves.iter().filter(|c| !c.label.is_empty()) {
            let needed = entry(curve, look);
            if needed > free {
                rows.push(vec![]);
                free = width;
            }
            free -= needed;
            rows.last_mut().expect("there is a row").push(curve);
        }
        rows
    }

    /// The name of the axis on the left above the frame, the legend on the right.
    fn legend(&self, to: &mut Drawing, area: Area, look: &Look) {
        let rows = self.legend_rows(area.width, look);
        let first = area.top - 0.55 * look.font - (rows.len() - 1) as f64 * look.row();
        to.text([area.left, first], &self.y_label, look.font, Anchor::Start);
        for (k, row) in rows.iter().enumerate() {
            let y = first + k as f64 * look.row();
            let whole: f64 = row.iter().map(|c| entry(c, look)).sum();
            let mut x = area.left + area.width - whole;
            for curve in row {
                let sample = x + look.font;
                let end = sample + 1.8 * look.font;
                let middle = y - 0.33 * look.font;
                to.line(vec![[sample, middle], [end, middle]], curve.stroke);
                to.text(
                    [end + 0.4 * look.font, y],
                    &curve.label,
                    look.font,
                    Anchor::Start,
                );
                x += entry(curve, look);
            }
        }
    }
}

/// Width of an entry of the legend.
fn entry(curve: &Curve, look: &Look) -> f64 {
    3.2 * look.font + font::width(&curve.label, look.font)
}

fn draw_curve(to: &mut Drawing, axes: &Axes, curve: &Curve, logarithmic: bool) {
    let mut piece: Vec<[f64; 2]> = vec![];
    let height = |y: f64| if logarithmic { y.abs().log10() } else { y };
    for &[x, y] in &curve.points {
        let point = axes.at([x, height(y)]);
        let bottom = axes.area.top + axes.area.height;
        if point.iter().all(|v| v.is_finite()) && point[1] <= bottom + 0.5 {
            piece.push(point);
            if curve.dotted {
                to.dot(point, 1.6 * curve.stroke.width, curve.stroke.colour);
            }
        } else {
            finish(to, &mut piece, curve.stroke);
        }
    }
    finish(to, &mut piece, curve.stroke);
}

fn finish(to: &mut Drawing, piece: &mut Vec<[f64; 2]>, stroke: Stroke) {
    if piece.len() > 1 {
        to.line(std::mem::take(piece), stroke);
    }
    piece.clear();
}

/// The range of numbers with a margin, never empty.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [lo, hi] = values
        .filter(|y| y.is_finite())
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

/// A range widened about its middle to this extent, if it is smaller.
pub(crate) fn at_least([lo, hi]: [f64; 2], extent: f64) -> [f64; 2] {
    let missing = 0.5 * (extent - (hi - lo)).max(0.0);
    [lo - missing, hi + missing]
}

/// Exponents of the decades that hold all magnitudes, at most eighteen of them.
pub(crate) fn decades(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let sizes = values.map(f64::abs).filter(|y| y.is_finite() && *y > 0.0);
    let [lo, hi] = sizes.fold([f64::INFINITY, 0.0_f64], |[a, b], y| [a.min(y), b.max(y)]);
    if hi == 0.0 {
        return [-16.0, 0.0];
    }
    let top = hi.log10().ceil() + 0.2;
    [lo.log10().floor().max(top - 18.0), top]
}

/// The title over a figure, for its caption where the style has none.
pub(crate) fn title(to: &mut Drawing, text: &str, look: &Look) {
    text.clone_into(&mut to.title);
    if look.titled {
        let at = [to.size[0] / 2.0, 1.7 * look.font];
        let (text, size) = fitted(text, to.size[0] - 2.0 * look.font, 1.15 * look.font);
        to.text(at, &text, size, Anchor::Middle);
    }
}

/// Characters that a shortened name keeps at least, at both ends together.
const MIN_KEPT: usize = 12;

/// `NAME: what it shows` in so much room \[points\] and in letters of this size: the middle of a long name is left out,
/// and where that is not enough the letters are smaller.
pub(crate) fn fitted(text: &str, room: f64, size: f64) -> (String, f64) {
    let (name, what) = text.split_at(text.find(": ").unwrap_or(text.len()));
    let name: Vec<char> = name.chars().collect();
    let kept = |n: usize| -> String {
        let (start, end) = (&name[..n.div_ceil(2)], &name[name.len() - n / 2..]);
        start.iter().chain(&['…']).chain(end).collect::<String>() + what
    };
    let whole = std::iter::once(text.to_owned());
    let fewer = (MIN_KEPT..name.len().saturating_sub(1)).rev();
    let all = whole.chain(fewer.map(kept));
    let mut shortest = String::new();
    for text in all {
        if font::width(&text, size) <= room {
            return (text, size);
        }
        shortest = text;
    }
    let size = size * room / font::width(&shortest, size);
    (shortest, size)
}

/// A curve in the colour and dash of number `k`.
pub(crate) fn curve(
    label: &str,
    points: Vec<[f64; 2]>,
    colour: Colour,
    k: usize,
    look: &Look,
) -> Curve {
    Curve {
        label: label.to_owned(),
        points,
        stroke: look.pen(colour, k),
        dotted: false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Long names lose their middle, titles that are long without them their size; nothing is wider than its room.
    #[test]
    fn exact_titles_fit() {
        let of = |name: &str, what: &str| {
            let (text, size) = fitted(&format!("{name}: {what}"), 600.0, 14.0);
            assert!(font::width(&text, size) <= 600.0 * (1.0 + 1e-12), "{text}");
            (text, size)
        };
        let what = "wingbeat by wingbeat, with means";
        assert_eq!(of("locust", what), (format!("locust: {what}"), 14.0));
        let long = format!("first-{}-last", "x".repeat(90));
        let (text, size) = of(&long, what);
        assert!(text.starts_with("first-xx") && text.ends_with(&format!("-last: {what}")));
        assert!(text.contains('…') && size == 14.0, "{text}");
        // One more character would not fit.
        assert!(font::width(&text.replace('…', "…x"), 14.0) > 600.0);
        let (text, size) = of(&long, &what.repeat(4));
        assert!(text.starts_with("first-…x-last: ") && size < 14.0, "{text}");
    }
}
