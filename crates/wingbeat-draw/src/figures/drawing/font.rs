//! The font of the figures: widths for the layout, outlines for pictures.
//!
//! A part of DejaVu Sans (`assets/DejaVuSans.LICENSE`): Latin 1, Greek, raised and lowered digits.

use std::sync::OnceLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

const FONT: &[u8] = include_bytes!("../../../assets/DejaVuSans.subset.ttf");

fn face() -> &'static Face<'static> {
    static FACE: OnceLock<Face<'static>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(FONT, 0).expect("the font that comes with wingbeat is whole"))
}

/// The glyph of a character; a question mark for those the font does not have.
fn glyph(c: char) -> GlyphId {
    let face = face();
    let found = face.glyph_index(c).or_else(|| face.glyph_index('?'));
    found.unwrap_or(GlyphId(0))
}

/// Points per font unit at a size.
fn scale(size: f64) -> f64 {
    size / f64::from(face().units_per_em())
}

fn advance(glyph: GlyphId) -> f64 {
    f64::from(face().glyph_hor_advance(glyph).unwrap_or(0))
}

/// Width of a text \[points\].
pub(crate) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(|c| advance(glyph(c))).sum::<f64>() * scale(size)
}

/// Draws the outlines of a text that begins at `at` on its baseline.
pub(crate) fn outline(text: &str, size: f64, at: [f64; 2], pen: &mut tiny_skia::PathBuilder) {
    let scale = scale(size);
    let mut x = at[0];
    for glyph in text.chars().map(glyph) {
        let mut placed = Placed {
            pen,
            origin: [x, at[1]],
            scale,
        };
        face().outline_glyph(glyph, &mut placed);
        x += advance(glyph) * scale;
    }
}

/// A glyph on its way to a picture: font units up become points down.
struct Placed<'a> {
    pen: &'a mut tiny_skia::PathBuilder,
    origin: [f64; 2],
    scale: f64,
}

impl Placed<'_> {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        let [x0, y0] = self.origin;
        let x = x0 + f64::from(x) * self.scale;
        let y = y0 - f64::from(y) * self.scale;
        (x as f32, y as f32)
    }
}

impl OutlineBuilder for Placed<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.pen.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.pen.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (x1, y1) = self.at(x1, y1);
        let (x, y) = self.at(x, y);
        self.pen.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (x1, y1) = self.at(x1, y1);
        let (x2, y2) = self.at(x2, y2);
        let (x, y) = self.at(x, y);
        self.pen.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.pen.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_widths_add_up_and_grow_with_the_size() {
        assert!((width("ab", 10.0) - width("a", 10.0) - width("b", 10.0)).abs() < 1e-12);
        assert!((width("stroke φ", 20.0) - 2.0 * width("stroke φ", 10.0)).abs() < 1e-9);
        // DejaVu Sans: digits are 1303 of 2048 units wide.
        assert!((width("0", 2048.0) - 1303.0).abs() < 1e-9);
    }

    #[test]
    fn exact_the_font_has_what_figures_write() {
        let question = glyph('?');
        for c in "θφψµ°·²⁰¹³⁴⁵⁶⁷⁸⁹⁻−äé".chars() {
            assert!(glyph(c) != question && glyph(c) != GlyphId(0), "{c}");
        }
    }
}
