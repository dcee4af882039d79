//! A drawing as a list of marks, from which SVG, PDF and pictures are made alike.
//!
//! Coordinates are points (1/72 inch) from the upper left corner, the second one downwards.

/// Colours: Okabe & Ito's, told apart by colour-blind readers
/// [Okabe & Ito 2008, *Color Universal Design*, J*Fly, <https://jfly.uni-koeln.de/color/>].
pub(crate) const COLOURS: [Colour; 7] = [
    Colour(0, 114, 178),
    Colour(213, 94, 0),
    Colour(0, 158, 115),
    Colour(204, 121, 167),
    Colour(86, 180, 233),
    Colour(230, 159, 0),
    Colour(110, 110, 110),
];
/// Frames, ticks and words.
pub(crate) const INK: Colour = Colour(40, 40, 40);
/// Shaded intervals.
pub(crate) const SHADE: Colour = Colour(233, 233, 236);
/// What drawings are on.
pub(crate) const GROUND: Colour = Colour(255, 255, 255);
/// Grid lines.
pub(crate) const FAINT: Colour = Colour(214, 214, 218);
/// Red, green, blue, 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Colour(pub u8, pub u8, pub u8);

impl Colour {
    /// A part `x` (0 to 1) of the way to another colour.
    pub fn toward(self, other: Self, x: f64) -> Self {
        let mix = |a: u8, b: u8| (f64::from(a) + x * (f64::from(b) - f64::from(a))).round() as u8;
        Self(
            mix(self.0, other.0),
            mix(self.1, other.1),
            mix(self.2, other.2),
        )
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stroke {
    pub colour: Colour,
    pub width: f64,
    /// Lengths of dash and gap in line widths; none: solid.
    pub dash: &'static [f64],
}

impl Stroke {
    pub fn solid(colour: Colour, width: f64) -> Self {
        Self {
            colour,
            width,
            dash: &[],
        }
    }
}

/// Where a text stands to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    /// Left edge of a text of this width whose point is at `x` \[points\].
    pub fn left(self, x: f64, width: f64) -> f64 {
        match self {
            Self::Start => x,
            Self::Middle => x - width / 2.0,
            Self::End => x - width,
        }
    }
}

/// One mark.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Mark {
    /// A line, open or closed.
    Line {
        points: Vec<[f64; 2]>,
        closed: bool,
        stroke: Stroke,
    },
    /// A filled polygon, covering by `opacity`.
    Area {
        points: Vec<[f64; 2]>,
        fill: Colour,
        opacity: f64,
    },
    /// Words; the point is on their baseline.
    Text {
        at: [f64; 2],
        text: String,
        size: f64,
        colour: Colour,
        anchor: Anchor,
    },
}

/// Marks in the order they are drawn.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drawing {
    /// What it shows, for its title or the caption.
    pub title: String,
    /// Width and height \[points\].
    pub size: [f64; 2],
    /// What they are on.
    pub ground: Colour,
    pub marks: Vec<Mark>,
}

impl Drawing {
    pub fn new(size: [f64; 2]) -> Self {
        Self {
            title: String::new(),
            size,
            ground: GROUND,
            marks: vec![],
        }
    }

    pub fn line(&mut self, points: Vec<[f64; 2]>, stroke: Stroke) {
        self.marks.push(Mark::Line {
            points,
            closed: false,
            stroke,
        });
    }

    pub fn outline(&mut self, points: Vec<[f64; 2]>, stroke: Stroke) {
        self.marks.push(Mark::Line {
            points,
            closed: true,
            stroke,
        });
    }

    pub fn area(&mut self, points: Vec<[f64; 2]>, fill: Colour, opacity: f64) {
        self.marks.push(Mark::Area {
            points,
            fill,
            opacity,
        });
    }

    pub fn text(&mut self, at: [f64; 2], text: &str, size: f64, anchor: Anchor) {
        self.marks.push(Mark::Text {
            at,
            text: text.to_owned(),
            size,
            colour: INK,
            anchor,
        });
    }

    /// A filled disk, as a polygon of 20 corners.
    pub fn dot(&mut self, at: [f64; 2], radius: f64, fill: Colour) {
        self.disk(at, radius, fill, 20);
    }

    /// A filled disk, as a polygon of so many corners.
    pub fn disk(&mut self, [x, y]: [f64; 2], radius: f64, fill: Colour, corners: usize) {
        let corner = |k: usize| {
            let (s, c) = (k as f64 * std::f64::consts::TAU / corners as f64).sin_cos();
            [x + radius * c, y + radius * s]
        };
        self.area((0..corners).map(corner).collect(), fill, 1.0);
    }

    /// An arrow; its head is as long as four line widths, or as the arrow.
    pub fn arrow(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = dx.hypot(dy);
        if length == 0.0 || !length.is_finite() {
            return;
        }
        let [ux, uy] = [dx / length, dy / length];
        let head = (4.0 * stroke.width).min(length);
        let neck = [to[0] - head * ux, to[1] - head * uy];
        let half = 0.4 * head;
        self.line(vec![from, neck], stroke);
        let side = |s: f64| [neck[0] - s * half * uy, neck[1] + s * half * ux];
        self.area(vec![to, side(1.0), side(-1.0)], stroke.colour, 1.0);
    }
}
