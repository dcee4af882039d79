//! Wings, body, the vortex filaments of the wakes and the vortex particles of one frame, from above and
//! from the side.

use std::path::Path;

use crate::figures::axes::grid::one_scale;
use crate::figures::axes::plot::{self, Area, Axes, Plot};
use crate::figures::axes::units::prefix;
use crate::figures::drawing::style::Look;
use crate::figures::drawing::{Anchor, COLOURS, Colour, Drawing, INK, Stroke};
use crate::figures::stills::dots::{Dots, FAINTEST, dye};
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
use wingbeat_results::frames::{self, Frame, JoinedEdges, Mesh, Sheet};
use wingbeat_results::poses::{Poses, picture};
use wingbeat_results::rows::Rows;

/// More rings than this are not drawn: the newest of every sheet are.
pub(crate) const MAX_RINGS: usize = 2500;
/// More particles than this are not drawn: the strongest are.
const MAX_DOTS: usize = 2500;
/// Body and wings.
pub(crate) const SKIN: Colour = Colour(222, 217, 203);

/// The figure of the frame nearest to a step, the last one if none is given; none where no frames
/// were written.
///
/// # Errors
/// A frame that is missing or damaged.
pub(crate) fn wake(
    dir: &Path,
    case: &LoadedCase,
    step: Option<usize>,
    look: &Look,
) -> Result<Option<Drawing>, IoError> {
    let steps = frames::steps(dir)?;
    let wanted = step.unwrap_or(usize::MAX);
    let Some(step) = steps.into_iter().min_by_key(|s| s.abs_diff(wanted)) else {
        return Ok(None);
    };
    let mut frame = Frame::read(dir, step)?;
    add_bodies(&mut frame, step, (dir, case))?;
    let time = step as f64 * case.setup.time.step;
    let when = match case.setup.time.period {
        Some(period) => format!("after {:.2} wingbeats", time / period),
        None => format!("after {:.4} s", time),
    };
    let filaments = Filaments::newest(
        &frame.wakes,
        &frame.wakes.joined_edges(&case.setup),
        MAX_RINGS,
    );
    let dots = Dots::strongest(&frame.particles, MAX_DOTS);
    let note = match filaments.left_out {
        0 => String::new(),
        n => format!(", oldest {n} rings left out"),
    };
    let weak = match dots.left_out {
        0 => String::new(),
        n => format!(", weakest {n} particles left out"),
    };
    let title = format!("{}: wakes {when}{note}{weak}", case.name);
    let wakes = Wakes { filaments, dots };
    Ok(Some(draw(&frame, &wakes, &title, look)))
}

/// Adds the parts of bodies that the air of the case does not have, where the history says they are at that step.
fn add_bodies(
    frame: &mut Frame,
    step: usize,
    (dir, case): (&Path, &LoadedCase),
) -> Result<(), IoError> {
    let mut rows = Rows::open(&dir.join("history.csv"))?;
    let Some(poses) = Poses::new(&case.setup.animal, rows.names()) else {
        return Ok(());
    };
    let is_part = |k: &usize| !poses.is_wing(poses.surfaces[*k].body);
    let (parts, wings): (Vec<usize>, Vec<usize>) = (0..poses.surfaces.len()).partition(is_part);
    let nodes: usize = wings.iter().map(|k| poses.surfaces[*k].nodes.len()).sum();
    let surfaces = &mut frame.surfaces;
    if parts.is_empty() || surfaces.points.len() != nodes {
        return Ok(());
    }
    while let Some(row) = rows.next_row()? {
        if row[0] as usize != step {
            continue;
        }
        for k in parts {
            let first = surfaces.points.len();
            surfaces.points.extend(poses.nodes(row, k).map(picture));
            let quads = poses.surfaces[k].quads.iter();
            surfaces.quads.extend(quads.map(|q| q.map(|n| first + n)));
        }
        return Ok(());
    }
    Ok(())
}

/// What is drawn of the wakes.
struct Wakes {
    filaments: Filaments,
    dots: Dots,
}

/// Vortex filaments between the rings of wakes, weak ones first: two ends, and the difference of the
/// rings' circulations over that which few filaments exceed.
pub(crate) struct Filaments {
    pub list: Vec<([[f64; 3]; 2], f64)>,
    /// The circulation the strengths are counted in \[m2/s\].
    pub usual: f64,
    /// Rings that were left out.
    pub left_out: usize,
}

impl Filaments {
    /// Of the newest rows of all sheets, about `most` rings in all.
    /// Edges that are one (`joined`, as [`Mesh::joined_edges`] lists them) carry their common circulation.
    pub fn newest(wakes: &Mesh, joined: &[JoinedEdges], most: usize) -> Self {
        let sheets = wakes.sheets();
        let per_row: usize = sheets.iter().map(|s| s.cols).sum();
        let rows = most.div_ceil(per_row.max(1));
        let mut list = vec![];
        let mut kept = 0;
        for sheet in &sheets {
            kept += rows.min(sheet.rows()) * sheet.cols;
            edges(
                wakes,
                (sheet, &sheets, joined),
                rows.min(sheet.rows()),
                &mut list,
            );
        }
        list.sort_by(|a, b| a.1.total_cmp(&b.1));
        let usual = list.get(list.len() * 19 / 20).map_or(0.0, |f| f.1);
        let usual = if usual > 0.0 { usual } else { 1.0 };
        list.retain(|f| f.1 > FAINTEST * usual);
        for filament in &mut list {
            filament.1 = (filament.1 / usual).min(1.0);
        }
        Self {
            list,
            usual,
            left_out: wakes.quads.len() - kept,
        }
    }
}

/// The edges between the rings of a sheet; not the one it leaves the wing by, whose bound ring the
/// wake does not know, nor the one where older rows are left out.
fn edges(
    wakes: &Mesh,
    (sheet, sheets, joined): (&Sheet, &[Sheet], &[JoinedEdges]),
    rows: usize,
    list: &mut Vec<([[f64; 3]; 2], f64)>,
) {
    // An edge that two sheets share is drawn with the first of them.
    let is_drawn = |i: usize, j: usize| {
        let pair = joined.iter().find(|p| p[1] == (sheet.id, j));
        pair.is_some_and(|p| sheets.iter().any(|s| s.id == p[0].0 && i < s.rows()))
    };
    let gamma = wakes.cell("circulation_m2_per_s");
    let ring = |i: usize, j: usize| {
        let value = gamma.get(sheet.first_cell + i * sheet.cols + j);
        value.copied().unwrap_or(0.0)
    };
    let node = |i: usize, j: usize| wakes.points[sheet.first_node + i * (sheet.cols + 1) + j];
    for i in 0..rows {
        for j in 0..sheet.cols {
            let older = i + 1;
            let next = match older {
                _ if older < rows => Some(ring(older, j)),
                _ if older == sheet.rows() => Some(0.0),
                _ => None,
            };
            if let Some(next) = next {
                let ends = [node(older, j), node(older, j + 1)];
                list.push((ends, (ring(i, j) - next).abs()));
            }
        }
        for j in 0..=sheet.cols {
            if is_drawn(i, j) {
                continue;
            }
            let strength = wakes.streamwise((sheets, joined), sheet, (i, j));
            list.push(([node(i, j), node(i + 1, j)], strength.abs()));
        }
    }
}

/// From nearly white to blue, the stronger the darker.
pub(crate) fn pen(strength: f64, width: f64) -> Stroke {
    let colour = Colour(226, 233, 240).toward(COLOURS[0], strength);
    Stroke::solid(colour, width * (0.5 + strength))
}

/// A view: name, axes along and upward, the axis that looks at the reader, all picture axes.
struct View {
    name: &'static str,
    along: &'static str,
    axes: [usize; 2],
    toward: (usize, f64),
}

const VIEWS: [View; 2] = [
    View {
        name: "from above: left",
        along: "forward",
        axes: [0, 1],
        toward: (2, 1.0),
    },
    View {
        name: "from the right: up",
        along: "forward",
        axes: [0, 2],
        toward: (1, -1.0),
    },
];

fn draw(frame: &Frame, wakes: &Wakes, title: &str, look: &Look) -> Drawing {
    let ends = wakes.filaments.list.iter().flat_map(|f| f.0);
    let ends = ends.chain(wakes.dots.list.iter().map(|d| d.0));
    let points: Vec<[f64; 3]> = frame.surfaces.points.iter().copied().chain(ends).collect();
    let extent: Vec<f64> = points.iter().flatten().copied().collect();
    let (scale, unit) = prefix(&extent);
    let left = 5.0 * look.font;
    let width = look.width - left - 1.6 * look.font;
    let range = |axis: usize| plot::range(points.iter().map(|p| p[axis] / scale));
    let ranges = [0, 1, 2].map(range);
    let extent = |axis: usize| ranges[axis][1] - ranges[axis][0];
    // Both views have one scale: the higher of them is not too high.
    let highest = extent(1).max(extent(2));
    let mut along = ranges[0];
    one_scale(
        &mut along,
        &mut [0.0, highest],
        width,
        [0.0, 2.4 * look.panel],
    );
    let plots = VIEWS.each_ref().map(|view| {
        let (mut x, mut y) = (along, ranges[view.axes[1]]);
        let limits = [0.8 * look.panel, f64::INFINITY];
        let height = one_scale(&mut x, &mut y, width, limits);
        let plot = Plot {
            x_label: format!("{} [{unit}m]", view.along),
            y_label: format!("{} [{unit}m]", view.name),
            x,
            y,
            ..Plot::default()
        };
        (plot, height)
    });
    let extra = look.row() + 0.6 * look.font + 3.1 * look.font;
    let whole: f64 = plots.iter().map(|(_, height)| height + extra).sum();
    let mut drawing = Drawing::new([look.width, look.head() + whole]);
    plot::title(&mut drawing, title, look);
    let mut top = look.head();
    for (view, (plot, height)) in VIEWS.iter().zip(&plots) {
        top += look.row() + 0.6 * look.font;
        let area = Area {
            left,
            top,
            width,
            height: *height,
        };
        let axes = plot.draw(&mut drawing, area, look);
        scene(&mut drawing, &axes, view, [scale, look.hair], frame, wakes);
        bar(&mut drawing, &axes, view, wakes, look);
        top += height + 3.1 * look.font;
    }
    drawing
}

/// Wakes, then body and wings over them, from the farthest panel to the nearest.
fn scene(
    to: &mut Drawing,
    axes: &Axes,
    view: &View,
    [scale, hair]: [f64; 2],
    frame: &Frame,
    wakes: &Wakes,
) {
    let flat = |p: [f64; 3]| axes.at(view.axes.map(|c| p[c] / scale));
    let (axis, sign) = view.toward;
    let near = |quad: &[[f64; 3]; 4]| sign * quad.iter().map(|p| p[axis]).sum::<f64>();
    for (ends, strength) in &wakes.filaments.list {
        to.line(ends.map(flat).to_vec(), pen(*strength, hair));
    }
    wakes.dots.draw(to, flat, 1.6 * hair);
    let surfaces = &frame.surfaces;
    let quads = surfaces.quads.iter().map(|q| q.map(|n| surfaces.points[n]));
    let mut quads: Vec<[[f64; 3]; 4]> = quads.collect();
    quads.sort_by(|a, b| near(a).total_cmp(&near(b)));
    for quad in quads {
        let points = quad.map(flat).to_vec();
        to.area(points.clone(), SKIN, 1.0);
        to.outline(points, Stroke::solid(INK, 0.35 * hair));
    }
}

/// What the colours mean, above the frame on the right: filaments in the first view, particles in the
/// second.
fn bar(to: &mut Drawing, axes: &Axes, view: &View, wakes: &Wakes, look: &Look) {
    let (what, usual, unit) = match view.axes == VIEWS[0].axes {
        true => ("filaments", wakes.filaments.usual, "m²/s"),
        false if wakes.dots.list.is_empty() => return,
        false => ("particles", wakes.dots.usual, "m³/s"),
    };
    let y = axes.area.top - 0.55 * look.font;
    let right = axes.area.left + axes.area.width;
    let text = format!("{what}, 0 to {} {unit} and more", short(usual));
    to.text([right, y], &text, look.font, Anchor::End);
    let step = 0.4 * look.font;
    let end = right - crate::figures::drawing::font::width(&text, look.font) - 0.6 * look.font;
    for k in 0..15 {
        let x = end - f64::from(15 - k) * step;
        let [low, high] = [y, y - 0.75 * look.font];
        let corners = vec![[x, low], [x + step, low], [x + step, high], [x, high]];
        let strength = f64::from(k) / 14.0;
        let colour = match what {
            "filaments" => pen(strength, 1.0).colour,
            _ => dye(strength),
        };
        to.area(corners, colour, 1.0);
    }
}

/// Two digits.
fn short(value: f64) -> String {
    crate::figures::axes::ticks::scientific(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_flight::FlightSetup;

    /// Two rows of two rings, 3 and 3 in the newer row, 3 and 1 in the older.
    #[test]
    fn exact_filaments_carry_differences_of_rings() {
        let node = |k: usize| [(k / 3) as f64, (k % 3) as f64, 0.0];
        let quad = |n: usize| {
            let first = (n / 2) * 3 + n % 2;
            [first, first + 3, first + 4, first + 1]
        };
        let mut mesh = Mesh {
            points: (0..9).map(node).collect(),
            quads: (0..4).map(quad).collect(),
            ..Mesh::default()
        };
        let gamma = vec![3.0, 3.0, 3.0, 1.0];
        mesh.cells.insert("circulation_m2_per_s".to_owned(), gamma);
        mesh.cells.insert("sheet".to_owned(), vec![0.0; 4]);
        let strength = |filaments: &Filaments, a: [f64; 2], b: [f64; 2]| {
            let ends = [a, b].map(|p| [p[0], p[1], 0.0]);
            let found = filaments.list.iter().find(|f| f.0 == ends);
            found.map_or(0.0, |f| f.1 * filaments.usual)
        };
        let all = Filaments::newest(&mesh, &[], 100);
        assert_eq!((all.left_out, all.usual), (0, 3.0));
        for (a, b, wanted) in [
            ([0.0, 0.0], [1.0, 0.0], 3.0),
            ([0.0, 1.0], [1.0, 1.0], 0.0),
            ([0.0, 2.0], [1.0, 2.0], 3.0),
            ([1.0, 1.0], [2.0, 1.0], 2.0),
            ([1.0, 0.0], [1.0, 1.0], 0.0),
            ([1.0, 1.0], [1.0, 2.0], 2.0),
            ([2.0, 0.0], [2.0, 1.0], 3.0),
            ([2.0, 1.0], [2.0, 2.0], 1.0),
        ] {
            assert!((strength(&all, a, b) - wanted).abs() < 1e-12, "{a:?} {b:?}");
        }
        let newest = Filaments::newest(&mesh, &[], 2);
        assert_eq!(newest.left_out, 2);
        assert_eq!(strength(&newest, [1.0, 1.0], [1.0, 2.0]), 0.0);
    }

    /// Two sheets of two rings whose roots are one line: of joined wings, its circulation is the sum of both.
    #[test]
    fn exact_joined_sheets_have_one_root() {
        let setup = |name: &str| LoadedCase::find(name, &[]).unwrap().setup;
        let node = |k: usize| {
            let side = if k < 6 { 1.0 } else { -1.0 };
            [(k % 6 / 2) as f64, side * (k % 2) as f64, 0.0]
        };
        let quad = |n: usize| {
            let first = (n / 2) * 6 + (n % 2) * 2;
            [first, first + 2, first + 3, first + 1]
        };
        let mut mesh = Mesh {
            points: (0..12).map(node).collect(),
            quads: (0..4).map(quad).collect(),
            ..Mesh::default()
        };
        let gamma = vec![3.0, 2.0, -3.0, -1.5];
        mesh.cells.insert("circulation_m2_per_s".to_owned(), gamma);
        mesh.cells
            .insert("sheet".to_owned(), vec![0.0, 0.0, 1.0, 1.0]);
        let roots = |setup: &FlightSetup| {
            let all = Filaments::newest(&mesh, &mesh.joined_edges(setup), 100);
            let at_root = |f: &&([[f64; 3]; 2], f64)| f.0.iter().all(|p| p[1] == 0.0);
            let along = |f: &&([[f64; 3]; 2], f64)| f.0[0][0] != f.0[1][0];
            let found = all.list.iter().filter(at_root).filter(along);
            let mut found: Vec<f64> = found.map(|f| f.1 * all.usual).collect();
            found.sort_by(f64::total_cmp);
            found
        };
        assert_eq!(roots(&setup("bird-cruise")), [0.5]);
        assert_eq!(roots(&setup("fruit-fly-hover")), [1.5, 2.0, 3.0, 3.0]);
    }
}
