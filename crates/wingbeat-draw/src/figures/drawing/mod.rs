//! A drawing as a list of marks, what it is written as, and how it looks.

mod dark;
pub(crate) mod font;
mod marks;
mod pdf;
mod raster;
pub(crate) mod style;
mod svg;

pub(crate) use marks::{Anchor, COLOURS, Colour, Drawing, FAINT, GROUND, INK, Mark, SHADE, Stroke};
