//! How figures look: for the screen, for a paper or for slides.

use crate::figures::drawing::{Colour, Drawing, Stroke};

/// What a figure is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Large, with title and grid.
    #[default]
    Screen,
    /// 180 mm wide (two columns of most journals), small type, thin lines also told apart by
    /// their dashes, no title: the caption says it.
    Paper,
    /// As for the screen, on a dark ground: for slides.
    Dark,
}

impl Style {
    /// All styles by name.
    pub const ALL: [(&'static str, Self); 3] = [
        ("screen", Self::Screen),
        ("paper", Self::Paper),
        ("dark", Self::Dark),
    ];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        let known = Self::ALL.iter().find(|s| s.1 == self);
        known.expect("every style has a name").0
    }

    /// A drawing on its ground.
    pub(crate) fn grounded(self, drawing: Drawing) -> Drawing {
        match self {
            Self::Screen | Self::Paper => drawing,
            Self::Dark => drawing.on_dark(),
        }
    }

    pub(crate) fn look(self) -> Look {
        match self {
            Self::Screen | Self::Dark => Look {
                width: 675.0,
                font: 10.5,
                line: 1.5,
                hair: 0.75,
                panel: 165.0,
                titled: true,
                gridded: true,
                dashed: false,
                pixels_per_point: 2.0,
            },
            Self::Paper => Look {
                width: 510.0,
                font: 8.0,
                line: 1.0,
                hair: 0.5,
                panel: 112.0,
                titled: false,
                gridded: false,
                dashed: true,
                pixels_per_point: 300.0 / 72.0,
            },
        }
    }
}

/// Sizes \[points\] and choices of a style.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub width: f64,
    pub font: f64,
    /// Width of curves.
    pub line: f64,
    /// Width of frames, ticks and grids.
    pub hair: f64,
    /// Height of one of several stacked panels.
    pub panel: f64,
    pub titled: bool,
    pub gridded: bool,
    pub dashed: bool,
    pub pixels_per_point: f64,
}

impl Look {
    /// Height that a line of text needs.
    pub fn row(&self) -> f64 {
        1.45 * self.font
    }

    /// Room above the panels, for the title.
    pub fn head(&self) -> f64 {
        if self.titled {
            2.6 * self.font
        } else {
            0.4 * self.font
        }
    }

    /// The pen of the curve with number `k`.
    pub fn pen(&self, colour: Colour, k: usize) -> Stroke {
        const DASHES: [&[f64]; 5] = [
            &[],
            &[5.0, 2.0],
            &[1.5, 1.5],
            &[6.0, 1.5, 1.5, 1.5],
            &[9.0, 2.5],
        ];
        Stroke {
            colour,
            width: self.line,
            dash: if self.dashed { DASHES[k % 5] } else { &[] },
        }
    }
}
