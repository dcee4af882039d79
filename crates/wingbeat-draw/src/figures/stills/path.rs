//! The way of the body in space: from above, from the right and from behind, to one scale.

use wingbeat_flight::FlightSetup;

use crate::figures::axes::plot::{self, Area, Plot};
use crate::figures::axes::units::prefix;
use crate::figures::drawing::font;
use crate::figures::drawing::style::Look;
use crate::figures::drawing::{Anchor, COLOURS, Drawing, INK};
use crate::figures::over_time::part::TimeWindow;

/// Places of the body, thinned: a way has no oscillation finer than its steps are long.
#[derive(Clone, Debug, Default)]
pub(crate) struct Path {
    stride: usize,
    /// Times \[s\] and places, picture axes from the first one \[m\].
    points: Vec<(f64, [f64; 3])>,
    first: [f64; 3],
}

impl Path {
    /// A path of every `stride`-th place.
    pub fn new(stride: usize) -> Self {
        Self {
            stride: stride.max(1),
            ..Self::default()
        }
    }

    /// Adds the place of row `k`, N components \[m\].
    pub fn add(&mut self, k: usize, time: f64, [x, y, z]: [f64; 3]) {
        let place = [x, -y, -z];
        if k == 0 {
            self.first = place;
        }
        if k.is_multiple_of(self.stride) {
            let moved = [0, 1, 2].map(|c| place[c] - self.first[c]);
            self.points.push((time, moved));
        }
    }

    /// Where the path is nearest to the starts of wingbeats.
    fn beats(&self, period: f64) -> Vec<[f64; 3]> {
        let beat = |t: f64| (t / period + 1e-6).floor();
        let pairs = self.points.windows(2);
        let turned = pairs.filter(|p| beat(p[1].0) > beat(p[0].0));
        turned.map(|p| p[1].1).collect()
    }
}

/// A view of the path.
struct View {
    name: &'static str,
    /// Axis along and axis upward: 0 forward, 1 left, 2 up.
    axes: [usize; 2],
    /// Which way the axis along is looked at: 1, or -1 where it points to the left of the picture.
    sense: f64,
    /// What the axes of the picture show.
    words: [&'static str; 2],
}

const VIEWS: [View; 3] = [
    View {
        name: "from above",
        axes: [0, 1],
        sense: 1.0,
        words: ["forward", "left"],
    },
    View {
        name: "from the right",
        axes: [0, 2],
        sense: 1.0,
        words: ["forward", "up"],
    },
    View {
        name: "from behind",
        axes: [1, 2],
        sense: -1.0,
        words: ["right", "up"],
    },
];

impl View {
    /// A place in the picture.
    fn flat(&self, p: &[f64; 3]) -> [f64; 2] {
        let [along, up] = self.axes.map(|c| p[c]);
        [self.sense * along, up]
    }

    /// Ranges of the axes of the picture, by those of space.
    fn ranges(&self, all: &[[f64; 2]; 3]) -> [[f64; 2]; 2] {
        let [[a, b], up] = self.axes.map(|c| all[c]);
        let along = if self.sense > 0.0 { [a, b] } else { [-b, -a] };
        [along, up]
    }
}

/// More starts of wingbeats than this are not marked.
const MAX_DOTS: usize = 60;

/// The figure; none where the body stays.
pub(crate) fn path(
    setup: &FlightSetup,
    (path, part): (&Path, &TimeWindow),
    look: &Look,
) -> Option<Drawing> {
    let frame = Frame::of(path, setup, look)?;
    let high: f64 = VIEWS.iter().map(|v| frame.height(v.axes, look)).sum();
    let mut drawing = Drawing::new([look.width, look.head() + high]);
    let title = format!(
        "{}: path of the body (dots: starts of wingbeats){}",
        setup.name,
        part.note()
    );
    plot::title(&mut drawing, &title, look);
    let dots = setup.time.period.map_or(vec![], |p| path.beats(p));
    let mut top = look.head();
    for view in &VIEWS {
        let flat = |p: &[f64; 3]| view.flat(&p.map(|x| x / frame.scale));
        let points = path.points.iter().map(|p| flat(&p.1)).collect();
        let unit = frame.unit;
        let labels = [
            format!("{} [{unit}m]", view.words[0]),
            format!("{}: {} [{unit}m]", view.name, view.words[1]),
        ];
        let plot = plot_of(labels, view.ranges(&frame.ranges), points, look);
        let area = frame.area(view.axes, top + head(look), look);
        let placed = plot.draw(&mut drawing, area, look);
        if dots.len() <= MAX_DOTS {
            dots.iter()
                .for_each(|p| drawing.dot(placed.at(flat(p)), 1.3 * look.line, COLOURS[1]));
        }
        let end = area.left + area.width;
        start_mark(
            &mut drawing,
            (placed.at([0.0, 0.0]), end),
            &part.start(),
            look,
        );
        top = area.top + (area.height + foot(look));
    }
    Some(drawing)
}

/// What all views share: unit, ranges along the axes, and how large they are on paper.
struct Frame {
    /// Unit of the axes [m], and its prefix.
    scale: f64,
    unit: &'static str,
    ranges: [[f64; 2]; 3],
    /// Points per unit.
    per_unit: f64,
}

impl Frame {
    fn of(path: &Path, setup: &FlightSetup, look: &Look) -> Option<Self> {
        let ends = ends(path);
        let longest = ends.iter().map(|[a, b]| b - a).fold(0.0, f64::max);
        if longest.is_nan() || longest <= 1e-6 * setup.animal.body_length().max(1e-6) {
            return None;
        }
        let (scale, unit) = prefix(&[longest]);
        // A way that is nearly straight gets a frame that is not too flat.
        let ranges = ends.map(|[a, b]| {
            let half = 0.5 * (b - a).max(0.3 * longest) * 1.12;
            [0.5 * (a + b) - half, 0.5 * (a + b) + half].map(|v| v / scale)
        });
        let extent = |c: usize| ranges[c][1] - ranges[c][0];
        let width = look.width - left(look) - 1.6 * look.font;
        // The widest view fills the width, and none is much higher.
        let per_unit = width / extent(0).max(extent(1)).max(0.8 * extent(2));
        Some(Self {
            scale,
            unit,
            ranges,
            per_unit,
        })
    }

    /// Extent of an axis on paper \[pt\].
    fn extent(&self, c: usize) -> f64 {
        self.per_unit * (self.ranges[c][1] - self.ranges[c][0])
    }

    /// Height of a view with its head and foot \[pt\].
    fn height(&self, axes: [usize; 2], look: &Look) -> f64 {
        self.extent(axes[1]) + head(look) + foot(look)
    }

    /// Where the curves of a view stand, below `top` \[pt\].
    fn area(&self, axes: [usize; 2], top: f64, look: &Look) -> Area {
        Area {
            left: left(look),
            top,
            width: self.extent(axes[0]),
            height: self.extent(axes[1]),
        }
    }
}

/// Space left of the curves for labels \[pt\].
fn left(look: &Look) -> f64 {
    5.0 * look.font
}

/// Space above the curves \[pt\].
fn head(look: &Look) -> f64 {
    look.row() + 0.6 * look.font
}

/// Space below the curves for labels \[pt\].
fn foot(look: &Look) -> f64 {
    3.1 * look.font
}

/// Least and largest coordinate along each axis.
fn ends(path: &Path) -> [[f64; 2]; 3] {
    let all = || path.points.iter().map(|p| p.1);
    [0, 1, 2].map(|c| {
        all().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| {
            [a.min(p[c]), b.max(p[c])]
        })
    })
}

/// The plot of one view.
fn plot_of(
    [x_label, y_label]: [String; 2],
    [x, y]: [[f64; 2]; 2],
    points: Vec<[f64; 2]>,
    look: &Look,
) -> Plot {
    Plot {
        x_label,
        y_label,
        x,
        y,
        curves: vec![plot::curve("", points, COLOURS[0], 0, look)],
        ..Plot::default()
    }
}

/// Marks where the path starts, the name left of it where it would go beyond the end of the picture \[pt\].
fn start_mark(drawing: &mut Drawing, (start, end): ([f64; 2], f64), name: &str, look: &Look) {
    drawing.dot(start, 1.8 * look.line, INK);
    let gap = 0.6 * look.font;
    let width = font::width(name, look.font);
    let (x, anchor) = match start[0] + gap + width > end {
        true => (start[0] - gap, Anchor::End),
        false => (start[0] + gap, Anchor::Start),
    };
    drawing.text([x, start[1] - 0.4 * look.font], name, look.font, anchor);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::Style;
    use crate::figures::drawing::Mark;
    use wingbeat_case::LoadedCase;

    /// A helix seen from behind is a circle: as wide as high on paper.
    #[test]
    fn exact_views_have_one_scale() {
        let case = LoadedCase::find("fruit-fly-vacuum", &[]).unwrap();
        let mut helix = Path::new(1);
        for k in 0..=720 {
            let a = f64::from(k).to_radians();
            helix.add(
                k as usize,
                f64::from(k) * 1e-4,
                [2e-4 * a, a.sin(), a.cos()],
            );
        }
        let drawing = path(
            &case.setup,
            (&helix, &TimeWindow::whole(&case.setup)),
            &Style::Paper.look(),
        )
        .unwrap();
        let lines = drawing.marks.iter().filter_map(|m| match m {
            Mark::Line { points, .. } if points.len() > 700 => Some(points),
            _ => None,
        });
        let curves: Vec<&Vec<[f64; 2]>> = lines.collect();
        assert_eq!(curves.len(), 3);
        let extent = |k: usize, c: usize| {
            let of = curves[k].iter().map(|p| p[c]);
            of.fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)])
        };
        let size = |k: usize, c: usize| extent(k, c)[1] - extent(k, c)[0];
        // It begins upwards and goes to the right first: to the right of who looks from behind.
        assert!(curves[2][90][0] > curves[2][0][0]);
        assert!((size(2, 0) - size(2, 1)).abs() < 1e-9 * size(2, 0));
        assert!((size(0, 1) - size(2, 0)).abs() < 1e-9 * size(2, 0)); // left and right, in two views
        assert!((size(1, 0) - size(0, 0)).abs() < 1e-9 * size(0, 0)); // forward, in two views
    }
}
