//! The flight as a moving picture (GIF or MP4), drawn without a browser: the animal and its wakes from
//! the right, in front and above, the camera moving with the body.

mod reel;

use std::path::Path;

use wingbeat_math::DVec3;

use crate::figures::axes::plot;
use crate::figures::drawing::font;
use crate::figures::drawing::style::Style;
use crate::figures::drawing::{Anchor, COLOURS, Drawing, INK, Stroke};
use crate::figures::source::Source;
use crate::figures::stills::dots::Dots;
use crate::figures::stills::wake::{Filaments, SKIN, pen};
use reel::{Film, Gif, Reel, SIZE};
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
use wingbeat_results::frames::{self, Frame};
use wingbeat_results::poses::{Poses, picture};
use wingbeat_results::rows::Rows;
/// More pictures than this are thinned.
const MAX_PICTURES: usize = 150;
/// The same for a film.
const MAX_FILMED: usize = 900;
/// More rings than this are not drawn: the newest of every sheet are; nor more particles: the
/// strongest are.
const MAX_RINGS: usize = 1500;
/// Width of the picture in wing lengths.
const WING_LENGTHS: f64 = 4.8;

/// Writes the animation to `path`, picture by picture; returns how many there are.
///
/// # Errors
/// A result that is damaged, a file that cannot be written, a film without ffmpeg.
pub(super) fn write(
    source: &Source<'_>,
    (path, film): (&Path, bool),
    style: Style,
) -> Result<usize, IoError> {
    let (dir, case) = (source.dir, source.case);
    let fault = |problem: String| IoError::Figure {
        path: path.to_owned(),
        problem,
    };
    let history = dir.join("history.csv");
    let written = frames::steps(dir)?;
    let framed = !written.is_empty();
    let all = match framed {
        true => written,
        false => source.steps.clone(),
    };
    let steps: Vec<usize> = all
        .into_iter()
        .filter(|k| source.steps.binary_search(k).is_ok())
        .collect();
    let most = if film { MAX_FILMED } else { MAX_PICTURES };
    let stride = steps.len().div_ceil(most).max(1);
    let mut wanted = steps.into_iter().step_by(stride).peekable();
    if wanted.peek().is_none() {
        return Ok(0);
    }
    let mut rows = Rows::open(&history)?;
    let poses = Poses::new(&case.setup.animal, rows.names()).ok_or_else(|| IoError::Damaged {
        path: history.clone(),
        problem: "this history belongs to another animal than case.toml".to_owned(),
    })?;
    let mut reel: Box<dyn Reel> = match film {
        true => Box::new(Film::begin(path).map_err(fault)?),
        false => Box::new(Gif::begin(path).map_err(fault)?),
    };
    let view = View::of(case);
    let mut count = 0;
    while let Some(row) = rows.next_row()? {
        if wanted.next_if_eq(&(row[0] as usize)).is_none() {
            continue;
        }
        let frame = match framed {
            true => Some(Frame::read(dir, row[0] as usize)?),
            false => None,
        };
        let drawing = view.draw((case, &poses, style), row, frame.as_ref());
        let shown = drawing.to_picture(reel.scale()).map_err(fault)?;
        reel.add(&shown.rgb).map_err(fault)?;
        count += 1;
    }
    reel.end().map_err(fault)?;
    Ok(count)
}

/// The camera: unit vectors along, upward and toward the reader, picture axes.
struct View {
    along: DVec3,
    upward: DVec3,
    toward: DVec3,
    /// Points per metre.
    scale: f64,
}

impl View {
    fn of(case: &LoadedCase) -> Self {
        let (azimuth, height) = (-55f64.to_radians(), 18f64.to_radians());
        let [(s, c), (sin, cos)] = [azimuth.sin_cos(), height.sin_cos()];
        let toward = DVec3::new(cos * c, cos * s, sin);
        let along = DVec3::new(-s, c, 0.0);
        Self {
            along,
            upward: toward.cross(along),
            toward,
            scale: SIZE[0] / (WING_LENGTHS * size(case)),
        }
    }

    fn draw(
        &self,
        (case, poses, style): (&LoadedCase, &Poses, Style),
        row: &[f64],
        frame: Option<&Frame>,
    ) -> Drawing {
        let mut to = Drawing::new(SIZE);
        let centre = DVec3::from_array(picture(poses.pose(row, 0).0));
        let flat = |p: [f64; 3]| {
            let p = DVec3::from_array(p) - centre;
            let [x, y] = [self.along, self.upward].map(|a| self.scale * a.dot(p));
            [0.5 * SIZE[0] + x, 0.42 * SIZE[1] - y]
        };
        let near = |quad: &[[f64; 3]; 4]| {
            let all = quad.iter().map(|p| self.toward.dot(DVec3::from_array(*p)));
            all.sum::<f64>()
        };
        if let Some(frame) = frame {
            let joined = frame.wakes.joined_edges(&case.setup);
            for (ends, strength) in &Filaments::newest(&frame.wakes, &joined, MAX_RINGS).list {
                to.line(ends.map(flat).to_vec(), pen(*strength, 0.8));
            }
            Dots::strongest(&frame.particles, MAX_RINGS).draw(&mut to, flat, 1.6);
        }
        // The animal has its own light, which is not turned into dark.
        let mut to = style.grounded(to);
        let mut quads = animal(poses, row);
        quads.sort_by(|a, b| near(&a.0).total_cmp(&near(&b.0)));
        for (quad, wing) in quads {
            let colour = if wing { COLOURS[5] } else { SKIN };
            let lit = colour.toward(INK, 0.55 * (1.0 - self.light(&quad)));
            let points = quad.map(flat).to_vec();
            to.area(points.clone(), lit, 1.0);
            to.outline(points, Stroke::solid(lit.toward(INK, 0.35), 0.5));
        }
        let mut said = Drawing::new(SIZE);
        words(&mut said, case, row[1]);
        to.marks.extend(style.grounded(said).marks);
        to
    }

    /// How much light a panel has: 1 where it looks at the camera, a little upward.
    fn light(&self, quad: &[[f64; 3]; 4]) -> f64 {
        let p = quad.map(DVec3::from_array);
        let normal = (p[2] - p[0]).cross(p[3] - p[1]).normalize_or_zero();
        let lamp = (self.toward + 0.6 * self.upward).normalize_or_zero();
        normal.dot(lamp).abs()
    }
}

/// Panels of the animal in a row of its history, and whether they are wings'.
fn animal(poses: &Poses, row: &[f64]) -> Vec<([[f64; 3]; 4], bool)> {
    let mut list = vec![];
    for (k, surface) in poses.surfaces.iter().enumerate() {
        let nodes: Vec<[f64; 3]> = poses.nodes(row, k).map(picture).collect();
        let quads = surface.quads.iter().map(|q| q.map(|n| nodes[n]));
        list.extend(quads.map(|q| (q, poses.is_wing(surface.body))));
    }
    list
}

/// What lengths are counted in: the longest wing, or the body without one.
fn size(case: &LoadedCase) -> f64 {
    let animal = &case.setup.animal;
    let size = animal.wing_length().max(0.5 * animal.body_length());
    if size > 0.0 { size } else { 1.0 }
}

fn words(to: &mut Drawing, case: &LoadedCase, time: f64) {
    let when = match case.setup.time.period {
        Some(period) => format!("{:.2} wingbeats", time / period),
        None => format!("{:.4} s", time),
    };
    to.text([SIZE[0] - 12.0, 22.0], &when, 14.0, Anchor::End);
    let room = SIZE[0] - 48.0 - font::width(&when, 14.0);
    let (name, letters) = plot::fitted(&case.name, room, 14.0);
    to.text([12.0, 22.0], &name, letters, Anchor::Start);
    // Three axes would say more than needed: one bar of a wing length says how large it is.
    let length = size(case);
    let end = 12.0 + SIZE[0] / WING_LENGTHS;
    let y = SIZE[1] - 26.0;
    to.line(vec![[12.0, y], [end, y]], Stroke::solid(INK, 1.5));
    let (scale, prefix) = crate::figures::axes::units::prefix(&[length]);
    let text = format!("{:.1} {prefix}m", length / scale);
    to.text([12.0, y + 16.0], &text, 12.0, Anchor::Start);
}
