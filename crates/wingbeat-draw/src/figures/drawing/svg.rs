//! Drawings as SVG: words stay words, lines stay lines.

use std::fmt::Write as _;

use crate::figures::drawing::{Anchor, Colour, Drawing, Mark, Stroke};
use crate::markup::escaped;

/// Fonts of about the same widths, the one widths are computed with first.
const FONTS: &str = "'DejaVu Sans', Verdana, sans-serif";

impl Drawing {
    /// The file.
    pub(crate) fn to_svg(&self) -> String {
        let [width, height] = self.size.map(number);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONTS}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
            hex(self.ground)
        );
        for mark in &self.marks {
            write_mark(&mut out, mark);
        }
        out + "</svg>\n"
    }
}

fn write_mark(out: &mut String, mark: &Mark) {
    let written = match mark {
        Mark::Line {
            points,
            closed,
            stroke,
        } => writeln!(
            out,
            "<path d=\"{}\" fill=\"none\"{}/>",
            path(points, *closed),
            pen(stroke)
        ),
        Mark::Area {
            points,
            fill,
            opacity,
        } => {
            let opacity = match *opacity < 1.0 {
                true => format!(" fill-opacity=\"{}\"", number(*opacity)),
                false => String::new(),
            };
            let (path, fill) = (path(points, true), hex(*fill));
            writeln!(out, "<path d=\"{path}\" fill=\"{fill}\"{opacity}/>")
        }
        Mark::Text {
            at,
            text,
            size,
            colour,
            anchor,
        } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let [x, y, size] = [at[0], at[1], *size].map(number);
            writeln!(
                out,
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{}\">{}</text>",
                hex(*colour),
                escaped(text)
            )
        }
    };
    written.expect("writing to a string cannot fail");
}

fn path(points: &[[f64; 2]], closed: bool) -> String {
    let mut text = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let word = if k == 0 { 'M' } else { 'L' };
        let _ = write!(text, "{word}{} {}", number(*x), number(*y));
    }
    if closed {
        text.push('Z');
    }
    text
}

fn pen(stroke: &Stroke) -> String {
    let mut text = format!(
        " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
        hex(stroke.colour),
        number(stroke.width)
    );
    if !stroke.dash.is_empty() {
        let lengths = stroke.dash.iter().map(|d| number(d * stroke.width));
        let lengths: Vec<String> = lengths.collect();
        let _ = write!(text, " stroke-dasharray=\"{}\"", lengths.join(" "));
    }
    text
}

fn hex(Colour(r, g, b): Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Hundredths of a point are finer than any printer.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0" } else { short }.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::drawing::INK;

    #[test]
    fn exact_numbers_are_short_and_text_is_escaped() {
        assert_eq!(
            [0.0, -0.001, 1.5, 20.0].map(number),
            ["0", "0", "1.5", "20"]
        );
        let mut drawing = Drawing::new([10.0, 20.0]);
        drawing.text([1.0, 2.0], "a < b & c", 8.0, Anchor::End);
        drawing.line(vec![[0.0, 1.0], [2.0, 3.25]], Stroke::solid(INK, 0.5));
        let svg = drawing.to_svg();
        assert!(svg.contains("a &lt; b &amp; c") && svg.contains("d=\"M0 1L2 3.25\""));
    }
}
