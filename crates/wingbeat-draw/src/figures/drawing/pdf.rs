//! Drawings as PDF: one page of lines and areas; words are outlines, so that no reader lacks the font.

use std::collections::BTreeSet;

use pdf_writer::types::LineJoinStyle;
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref};
use tiny_skia::{PathBuilder, PathSegment};

use crate::figures::drawing::font;
use crate::figures::drawing::{Colour, Drawing, GROUND, Mark, Stroke};

impl Drawing {
    /// The drawing as a document of one page as large as the drawing.
    pub(crate) fn to_pdf(&self) -> Vec<u8> {
        let [catalogue, pages, page, content] = [1, 2, 3, 4].map(Ref::new);
        let [width, height] = self.size.map(|x| x as f32);
        let mut marks = Content::new();
        marks.transform([1.0, 0.0, 0.0, -1.0, 0.0, height]); // points down, as in drawings
        marks.set_line_join(LineJoinStyle::RoundJoin);
        let [w, h] = self.size;
        let sheet = Mark::Area {
            points: vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]],
            fill: self.ground,
            opacity: 1.0,
        };
        let mut opacities = BTreeSet::new();
        if self.ground != GROUND {
            draw(&mut marks, &sheet, &mut opacities);
        }
        for mark in &self.marks {
            draw(&mut marks, mark, &mut opacities);
        }
        let mut pdf = Pdf::new();
        pdf.catalog(catalogue).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let mut sheet = pdf.page(page);
        sheet.media_box(Rect::new(0.0, 0.0, width, height));
        sheet.parent(pages).contents(content);
        let mut resources = sheet.resources();
        let mut states = resources.ext_g_states();
        for percent in opacities {
            let mut state = states.insert(Name(name(percent).as_bytes())).dict();
            state.pair(Name(b"ca"), f32::from(percent) / 100.0);
        }
        states.finish();
        resources.finish();
        sheet.finish();
        pdf.stream(content, &marks.finish());
        pdf.finish()
    }
}

/// Name of the state in which areas cover by so many percent.
fn name(percent: u8) -> String {
    format!("A{percent}")
}

fn draw(to: &mut Content, mark: &Mark, opacities: &mut BTreeSet<u8>) {
    match mark {
        Mark::Line {
            points,
            closed,
            stroke,
        } => {
            pen(to, stroke);
            path(to, points);
            match closed {
                true => to.close_and_stroke(),
                false => to.stroke(),
            };
        }
        Mark::Area {
            points,
            fill,
            opacity,
        } => {
            let percent = (100.0 * opacity).round() as u8;
            opacities.insert(percent);
            to.set_parameters(Name(name(percent).as_bytes()));
            paint(to, *fill);
            path(to, points);
            to.close_path().fill_nonzero();
        }
        Mark::Text {
            at,
            text,
            size,
            colour,
            anchor,
        } => {
            let left = anchor.left(at[0], font::width(text, *size));
            opacities.insert(100);
            to.set_parameters(Name(name(100).as_bytes()));
            paint(to, *colour);
            outlines(to, text, *size, [left, at[1]]);
        }
    }
}

fn path(to: &mut Content, points: &[[f64; 2]]) {
    for (k, p) in points.iter().enumerate() {
        let [x, y] = p.map(|v| v as f32);
        match k {
            0 => to.move_to(x, y),
            _ => to.line_to(x, y),
        };
    }
}

fn outlines(to: &mut Content, text: &str, size: f64, at: [f64; 2]) {
    let mut builder = PathBuilder::new();
    font::outline(text, size, at, &mut builder);
    let Some(path) = builder.finish() else {
        return; // spaces
    };
    let mut last = tiny_skia::Point::zero();
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(p) => to.move_to(p.x, p.y),
            PathSegment::LineTo(p) => to.line_to(p.x, p.y),
            // A quadratic curve is a cubic one with control points two thirds of the way.
            PathSegment::QuadTo(c, p) => {
                let toward = |end: tiny_skia::Point| {
                    let part = |a: f32, b: f32| a + 2.0 / 3.0 * (b - a);
                    (part(end.x, c.x), part(end.y, c.y))
                };
                let [(x1, y1), (x2, y2)] = [toward(last), toward(p)];
                to.cubic_to(x1, y1, x2, y2, p.x, p.y)
            }
            PathSegment::CubicTo(a, b, p) => to.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y),
            PathSegment::Close => to.close_path(),
        };
        if let PathSegment::MoveTo(p)
        | PathSegment::LineTo(p)
        | PathSegment::QuadTo(_, p)
        | PathSegment::CubicTo(_, _, p) = segment
        {
            last = p;
        }
    }
    to.fill_nonzero();
}

fn shares(Colour(r, g, b): Colour) -> [f32; 3] {
    [r, g, b].map(|x| f32::from(x) / 255.0)
}

fn paint(to: &mut Content, colour: Colour) {
    let [r, g, b] = shares(colour);
    to.set_fill_rgb(r, g, b);
}

fn pen(to: &mut Content, stroke: &Stroke) {
    let [r, g, b] = shares(stroke.colour);
    to.set_stroke_rgb(r, g, b);
    to.set_line_width(stroke.width as f32);
    let dash = stroke.dash.iter().map(|d| (d * stroke.width) as f32);
    to.set_dash_pattern(dash, 0.0);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::drawing::Anchor;

    #[test]
    fn exact_marks_stand_where_the_drawing_has_them() {
        let mut drawing = Drawing::new([200.0, 100.0]);
        let ink = Colour(255, 0, 51);
        drawing.line(vec![[10.0, 20.0], [30.0, 45.5]], Stroke::solid(ink, 0.5));
        drawing.area(vec![[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]], ink, 0.25);
        drawing.text([7.0, 50.0], "I", 10.0, Anchor::Start);
        let pdf = drawing.to_pdf();
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.starts_with("%PDF-1.") && text.trim_end().ends_with("%%EOF"));
        for part in [
            "/MediaBox [0 0 200 100]",
            "1 0 0 -1 0 100 cm",
            "1 0 0.2 RG",
            "10 20 m\n30 45.5 l\nS",
            "/A25 gs",
            "/ca 0.25",
        ] {
            assert!(text.contains(part), "no {part} in {text}");
        }
    }
}
