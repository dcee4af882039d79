//! Drawings as pictures of pixels.

use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform,
};

use crate::figures::drawing::font;
use crate::figures::drawing::{Colour, Drawing, Mark, Stroke};

/// Pixels, three bytes each.
pub(crate) struct Picture {
    pub width: u32,
    pub height: u32,
    pub rgb: Vec<u8>,
}

impl Drawing {
    /// The drawing with `scale` pixels per point.
    pub(crate) fn to_picture(&self, scale: f64) -> Result<Picture, String> {
        let [width, height] = self.size.map(|x| (x * scale).ceil().max(1.0) as u32);
        let mut pixels = Pixmap::new(width, height)
            .ok_or_else(|| format!("a picture of {width} x {height} pixels is too large"))?;
        let Colour(r, g, b) = self.ground;
        pixels.fill(Color::from_rgba8(r, g, b, 255));
        let transform = Transform::from_scale(scale as f32, scale as f32);
        for mark in &self.marks {
            draw(&mut pixels, mark, transform);
        }
        let rgb = pixels.pixels().iter();
        let rgb = rgb.flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
        Ok(Picture { width, height, rgb })
    }
}

fn draw(pixels: &mut Pixmap, mark: &Mark, transform: Transform) {
    match mark {
        Mark::Line {
            points,
            closed,
            stroke,
        } => {
            if let Some(path) = path(points, *closed) {
                let paint = paint(stroke.colour, 1.0);
                pixels.stroke_path(&path, &paint, &pen(stroke), transform, None);
            }
        }
        Mark::Area {
            points,
            fill,
            opacity,
        } => {
            if let Some(path) = path(points, true) {
                let paint = paint(*fill, *opacity);
                pixels.fill_path(&path, &paint, FillRule::Winding, transform, None);
            }
        }
        Mark::Text {
            at,
            text,
            size,
            colour,
            anchor,
        } => {
            let left = anchor.left(at[0], font::width(text, *size));
            let mut builder = PathBuilder::new();
            font::outline(text, *size, [left, at[1]], &mut builder);
            if let Some(path) = builder.finish() {
                let paint = paint(*colour, 1.0);
                pixels.fill_path(&path, &paint, FillRule::Winding, transform, None);
            }
        }
    }
}

fn path(points: &[[f64; 2]], closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (k, [x, y]) in points.iter().enumerate() {
        match k {
            0 => builder.move_to(*x as f32, *y as f32),
            _ => builder.line_to(*x as f32, *y as f32),
        }
    }
    if closed {
        builder.close();
    }
    builder.finish()
}

fn paint(Colour(r, g, b): Colour, opacity: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, (255.0 * opacity).round() as u8);
    paint.anti_alias = true;
    paint
}

fn pen(stroke: &Stroke) -> tiny_skia::Stroke {
    let lengths = stroke.dash.iter().map(|d| (d * stroke.width) as f32);
    tiny_skia::Stroke {
        width: stroke.width as f32,
        line_join: LineJoin::Round,
        dash: StrokeDash::new(lengths.collect(), 0.0),
        ..tiny_skia::Stroke::default()
    }
}

impl Picture {
    /// As PNG, with `scale` pixels per point noted as its resolution.
    pub(crate) fn to_png(&self, scale: f64) -> Result<Vec<u8>, String> {
        let mut bytes = vec![];
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let per_metre = (scale * 72.0 / 0.0254).round() as u32;
        encoder.set_pixel_dims(Some(png::PixelDimensions {
            xppu: per_metre,
            yppu: per_metre,
            unit: png::Unit::Meter,
        }));
        let mut writer = encoder.write_header().map_err(|e| e.to_string())?;
        writer
            .write_image_data(&self.rgb)
            .map_err(|e| e.to_string())?;
        writer.finish().map_err(|e| e.to_string())?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_pixels_have_the_colour_of_what_covers_them() {
        let mut drawing = Drawing::new([4.0, 2.0]);
        let half = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        drawing.area(half, Colour(10, 20, 30), 1.0);
        let picture = drawing.to_picture(2.0).unwrap();
        assert_eq!((picture.width, picture.height), (8, 4));
        assert_eq!(&picture.rgb[..3], &[10, 20, 30]);
        assert_eq!(&picture.rgb[3 * 7..3 * 8], &[255; 3]);
        let png = picture.to_png(2.0).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(png))
            .read_info()
            .unwrap();
        let mut back = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut back).unwrap();
        assert_eq!(back, picture.rgb);
    }
}
