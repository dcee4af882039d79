//! The 3-D part of the page: where everything is in the frames that are shown.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use serde_json::{Value, json};
use wingbeat_math::{DMat3, DQuat, DVec3, to_digits};

use super::pack::{Blob, Packed, Surfaces};
use super::plan::Plan;
use super::solid::{Solid, solids};
use crate::figures;
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
use wingbeat_results::ResultDir;
use wingbeat_results::columns::column_stems;
use wingbeat_results::frames::{self, Frame, JoinedEdges, Mesh};
use wingbeat_results::particles::Cloud;
use wingbeat_results::poses::{Poses, picture};
use wingbeat_results::rows::Rows;
use wingbeat_results::summary::down;

/// Frames drawn from the history where no frames were written: so many if the flight has them, and more where that is
/// too few a wingbeat.
const POSES: usize = 1000;
/// Frames of a wingbeat that show its strokes smoothly.
const POSES_A_BEAT: f64 = 40.0;
/// Frames of a wingbeat below which strokes seem slower or backward.
const FEWEST_A_BEAT: f64 = 8.0;
/// Room for what JSON says of a frame \[bytes before base64\].
const ENTRY: usize = 600;
/// Wake older than this is not shown: it is not resolved \[wingbeats\].
const WAKE_BEATS: f64 = 3.0;

/// A frame as the page knows it.
#[derive(Serialize)]
struct Shown {
    #[serde(flatten)]
    packed: Packed,
    step: usize,
    time: f64,
    x: f64,
    /// Place \[m\] and quaternion (x, y, z, w), picture axes, of every body that carries solids.
    poses: Vec<[f64; 7]>,
    /// Force of the air on every body, picture axes \[N\].
    forces: Vec<[f64; 3]>,
}

/// The frames while they are gathered.
pub(super) struct Scene<'a> {
    dir: &'a ResultDir,
    poses: Poses,
    solids: Vec<Solid>,
    plan: Plan,
    framed: bool,
    /// Wingbeats in a second; 0 without wingbeats.
    frequency: f64,
    blob: Blob,
    shown: Vec<Shown>,
    /// Steps at which downstroke and upstroke change places, wing by wing; the flight begins with an upstroke.
    turns: Vec<Vec<usize>>,
    /// Number of the wing that sheds a sheet, by number of the sheet; none of sheets without rings.
    shedding: Vec<Option<usize>>,
    /// Edges along which sheets are one.
    joined: Vec<JoinedEdges>,
}

impl<'a> Scene<'a> {
    pub fn new(
        dir: &'a ResultDir,
        case: &LoadedCase,
        names: &[String],
        budget: usize,
    ) -> Result<Self, IoError> {
        let poses = Poses::new(&case.setup.animal, names).ok_or_else(|| IoError::Damaged {
            path: dir.join("history.csv"),
            problem: "this history belongs to another animal than case.toml".to_owned(),
        })?;
        let written = frames::steps(dir.path())?;
        let framed = !written.is_empty();
        let wings = poses.surfaces.iter().filter(|s| poses.is_wing(s.body));
        let nodes = wings.map(|s| s.nodes.len()).sum();
        let panels = match framed {
            true => poses.surfaces.iter().map(|s| s.quads.len()).sum(),
            false => 0,
        };
        let own = Surfaces::bytes(nodes, panels) + ENTRY;
        let solids = solids(&case.setup.animal, &poses);
        let list = solids.iter().map(|s| 24 * s.quads.len()).sum::<usize>() + 1000; // their JSON
        let room = budget.saturating_sub(list) / 4 * 3;
        let period = case.setup.time.period.map(|p| p / case.setup.time.step);
        let blob = Blob::with_rows(period.map_or(usize::MAX, |n| (WAKE_BEATS * n).ceil() as usize));
        let plan = if framed {
            Plan::of_directory(dir.path(), &written, (own, blob.most_rows), room)?
        } else {
            let times = Rows::times(&dir.join("history.csv"))?;
            let step = |t: &f64| (t / case.setup.time.step).round() as usize;
            let steps: Vec<usize> = times.iter().map(step).collect();
            let beats = period.map_or(0.0, |n| steps.last().map_or(0.0, |k| *k as f64 / n));
            let enough = POSES.max((POSES_A_BEAT * beats) as usize);
            Plan::of_steps(&steps, enough, own, room)
        };
        Ok(Self {
            dir,
            poses,
            solids,
            plan,
            framed,
            frequency: case.setup.time.period.map_or(0.0, f64::recip),
            blob,
            shown: vec![],
            turns: vec![],
            shedding: vec![],
            joined: vec![],
        })
    }

    /// Reads the history once, stopping at the frames that are shown.
    pub fn read(mut self, case: &LoadedCase) -> Result<Self, IoError> {
        let mut rows = Rows::open(&self.dir.join("history.csv"))?;
        let forces = force_columns(case, rows.names());
        let columns = figures::stroke_columns(&case.setup, rows.names());
        let mut strokes: Vec<Stroke> = columns.into_iter().map(Stroke::new).collect();
        self.turns = vec![vec![]; strokes.len()];
        let unit = case.setup.time.period.unwrap_or(1.0);
        let posed = self.posed();
        let steps = self.plan.steps.clone();
        let mut wanted = steps.into_iter().peekable();
        let mut before = 0; // step of the row before
        while let Some(row) = rows.next_row()? {
            let step = row[0] as usize;
            for (stroke, turns) in strokes.iter_mut().zip(&mut self.turns) {
                if stroke.turns(row) {
                    turns.push(before);
                }
            }
            before = step;
            if wanted.next_if_eq(&step).is_none() {
                continue;
            }
            let (surfaces, wakes, cloud) = self.frame(row)?;
            let most = self.plan.frame_bytes.saturating_sub(ENTRY);
            let packed = self.blob.add(&surfaces, &wakes, &cloud, most);
            self.note(&surfaces, &wakes);
            for pair in wakes.joined_edges(&case.setup) {
                if !self.joined.contains(&pair) {
                    self.joined.push(pair);
                }
            }
            let vector =
                |k: &Option<usize>| k.map_or(DVec3::ZERO, |k| DVec3::from_slice(&row[k..]));
            self.shown.push(Shown {
                packed,
                step,
                time: row[1],
                x: row[1] / unit,
                poses: posed
                    .iter()
                    .map(|b| pose(self.poses.pose(row, *b)))
                    .collect(),
                forces: forces
                    .iter()
                    .map(|k| picture(vector(k)).map(digits))
                    .collect(),
            });
        }
        Ok(self)
    }

    /// Notes which wings shed the sheets not seen before: those their newest nodes are nearest to.
    fn note(&mut self, surfaces: &Surfaces, wakes: &Mesh) {
        for sheet in wakes.sheets() {
            let known = self.shedding.len().max(sheet.id + 1);
            self.shedding.resize(known, None);
            if self.shedding[sheet.id].is_some() {
                continue;
            }
            let edge = &wakes.points[sheet.first_node..][..=sheet.cols];
            let mut first = 0;
            let wings = self.poses.surfaces.iter();
            let distances = wings.filter(|s| self.poses.is_wing(s.body)).map(|s| {
                let nodes = &surfaces.points[first..][..s.nodes.len()];
                first += s.nodes.len();
                edge.iter().map(|p| nearest(nodes, p)).sum::<f64>()
            });
            let wing = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            self.shedding[sheet.id] = wing.map(|w| w.0);
        }
    }

    /// Bodies that carry solids.
    fn posed(&self) -> Vec<usize> {
        let mut list: Vec<usize> = self.solids.iter().map(|s| s.body).chain([0]).collect();
        list.sort_unstable();
        list.dedup();
        list
    }

    /// Wings, pressures, wakes and particles at a row: as they were written; wings that were not are
    /// carried by their bodies.
    fn frame(&self, row: &[f64]) -> Result<(Surfaces, Mesh, Cloud), IoError> {
        let step = row[0] as usize;
        let wings = self.poses.surfaces.iter().enumerate();
        let wings = wings.filter(|(_, s)| self.poses.is_wing(s.body));
        if !self.framed {
            let nodes = wings.flat_map(|(k, _)| self.poses.nodes(row, k).map(picture));
            let surfaces = Surfaces {
                points: nodes.collect(),
                pressure: vec![],
            };
            return Ok((surfaces, Mesh::default(), Cloud::default()));
        }
        let frame = Frame::read(self.dir.path(), step)?;
        let mut points = frame.surfaces.points.clone();
        let count: usize = wings.map(|(_, s)| s.nodes.len()).sum();
        let total = |part: &dyn Fn(&wingbeat_results::poses::Surface) -> usize| -> Vec<usize> {
            let mut sums = vec![0];
            for s in &self.poses.surfaces {
                sums.push(sums[sums.len() - 1] + part(s));
            }
            sums
        };
        // Air without a lattice on the body writes the wings alone.
        let known = total(&|s| s.nodes.len())
            .into_iter()
            .zip(total(&|s| s.quads.len()));
        let found = (points.len(), frame.surfaces.quads.len());
        if !known.into_iter().any(|k| k == found) || points.len() < count {
            return Err(IoError::Damaged {
                path: Frame::paths(self.dir.path(), step)[0].clone(),
                problem: "this frame belongs to another animal than case.toml".to_owned(),
            });
        }
        points.truncate(count);
        let panels = self.poses.surfaces.iter().map(|s| s.quads.len()).sum();
        let mut pressure = frame.surfaces.cell("pressure_jump_pascal").to_vec();
        pressure.resize(panels, 0.0);
        Ok((Surfaces { points, pressure }, frame.wakes, frame.particles))
    }

    /// Writes the scene into the data of the page.
    pub fn describe(&self, head: &mut Value, case: &LoadedCase) {
        let (animal, setup) = (&case.setup.animal, &case.setup);
        let weight = animal.mass() * setup.gravity.length();
        let wings = self
            .poses
            .surfaces
            .iter()
            .filter(|s| self.poses.is_wing(s.body));
        let wings = wings.zip(&animal.wings).map(|(s, w)| {
            json!({
                "name": s.name, "body": s.body, "rows": w.mesh.rows, "cols": w.mesh.cols,
                "left": w.side.sign() < 0.0,
            })
        });
        head["wings"] = wings.collect();
        head["solids"] = json!(self.solids);
        head["posed"] = json!(self.posed());
        head["lattice"] = json!(self.framed);
        let on_bodies = setup.air.lattice().is_some_and(|air| air.body_surfaces);
        head["body_pressures"] = json!(on_bodies);
        head["sheets"] = json!(self.blob.columns);
        head["length_m"] = json!(self.length(case));
        head["down"] = json!(picture(down(setup)));
        head["weight_newton"] = json!(weight);
        head["turns"] = json!(self.turns);
        head["shedding"] = json!(self.shedding);
        head["joined"] = json!(self.joined);
        head["most"] = json!({
            "circulation": usual(self.shown.iter().map(|f| f.packed.circulation)),
            "pressure": usual(self.shown.iter().map(|f| f.packed.pressure)),
            "strength": usual(self.shown.iter().map(|f| f.packed.usual_strength)),
            "force": usual(self.shown.iter().map(|f| total(&f.forces))),
        });
        head["blob"] = json!(STANDARD.encode(&self.blob.bytes));
        head["frames"] = json!(self.shown);
    }

    /// What lengths are counted in: the longest wing, else the largest solid \[m\].
    fn length(&self, case: &LoadedCase) -> f64 {
        let longest = case.setup.animal.wing_length();
        let size = self.solids.iter().map(Solid::size).fold(0.0, f64::max);
        let length = if longest > 0.0 { longest } else { size };
        if length > 0.0 { length } else { 1.0 }
    }

    /// What was left out, in words.
    pub fn thinned(&self) -> String {
        let (shown, of) = (self.shown.len(), self.plan.of);
        let source = match self.framed {
            true => "frames that were written",
            false => "steps, drawn from the history (no wakes)",
        };
        let mut text = format!("Shown here: {shown} of {of} {source}");
        let beats = self.shown.last().map_or(0.0, |f| f.time) * self.frequency;
        let each = shown as f64 / beats;
        if !self.framed && shown < of && beats > 1.0 {
            text += &format!(", {each:.0} a wingbeat");
            if each < FEWEST_A_BEAT {
                text += ": too few to see its strokes, which may seem slower or backward (a larger page has more: \
                    `wingbeat view --size`)";
            }
        }
        if self.blob.aged > 0 {
            text += &format!(", wakes younger than {WAKE_BEATS} wingbeats");
        }
        for (count, what) in [
            (self.blob.shortened, "oldest wake rows"),
            (self.blob.weakened, "weakest particles"),
        ] {
            if count > 0 {
                text += &format!(", {count} of them without their {what}");
            }
        }
        text
    }

    /// How positions are rounded here, and the files that hold them in full.
    pub fn precision(&self) -> String {
        let files = match self.framed {
            true => "history.csv and frames/ hold",
            false => "history.csv holds",
        };
        format!("positions rounded to 1/65535 of the frame. {files} everything")
    }
}

/// Square of the distance from a place to the nearest of these points \[m2\].
fn nearest(points: &[[f64; 3]], to: &[f64; 3]) -> f64 {
    let far = |p: &[f64; 3]| (0..3).map(|c| (p[c] - to[c]).powi(2)).sum::<f64>();
    points.iter().map(far).fold(f64::INFINITY, f64::min)
}

/// Where the forces of the air stand in a row, per body.
fn force_columns(case: &LoadedCase, names: &[String]) -> Vec<Option<usize>> {
    let column = |b: &String| {
        let name = format!("air_{b}_force_n1_newton");
        names.iter().position(|n| *n == name)
    };
    let list: Vec<Option<usize>> = column_stems(&case.setup.animal)
        .iter()
        .map(column)
        .collect();
    match case.setup.air.is_some() {
        true => list,
        false => vec![],
    }
}

/// Finds the steps between which the stroke turns.
struct Stroke {
    column: Option<(usize, f64)>,
    before: f64,
    down: bool,
}

impl Stroke {
    fn new(column: Option<(usize, f64)>) -> Self {
        Self {
            column,
            before: f64::INFINITY,
            down: false,
        }
    }

    /// Whether the wing has begun to go the other way since the row before.
    fn turns(&mut self, row: &[f64]) -> bool {
        let Some((column, sign)) = self.column else {
            return false;
        };
        let angle = sign * row[column];
        let down = angle > self.before;
        self.before = angle;
        std::mem::replace(&mut self.down, down) != down
    }
}

/// Place and quaternion in picture axes, which are N turned by half a turn about n1.
fn pose((place, rotation): (DVec3, DMat3)) -> [f64; 7] {
    let q = DQuat::from_mat3(&rotation);
    let [x, y, z] = picture(place);
    [x, y, z, q.x, -q.y, -q.z, q.w].map(digits)
}

/// Eight digits, as many as single precision has.
fn digits(x: f64) -> f64 {
    to_digits(x, 8)
}

/// Size of the sum.
fn total(forces: &[[f64; 3]]) -> f64 {
    let sum: DVec3 = forces.iter().map(|f| DVec3::from_array(*f)).sum();
    sum.length()
}

/// What is large without being the rarest of all: nineteen in twenty are smaller.
fn usual(values: impl Iterator<Item = f64>) -> f64 {
    let mut list: Vec<f64> = values.filter(|v| v.is_finite() && *v > 0.0).collect();
    list.sort_by(f64::total_cmp);
    let at = (list.len() * 19 / 20).min(list.len().saturating_sub(1));
    list.get(at).copied().unwrap_or(0.0)
}
