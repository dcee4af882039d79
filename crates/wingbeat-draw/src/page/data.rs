//! Everything the page knows of a flight, as JSON.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use serde_json::{Value, json};
use wingbeat_math::DVec3;

use super::pack::{Blob, Packed, Surfaces};
use super::plan::Plan;
use crate::figures::{self, Chart};
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
use wingbeat_results::columns::body_names;
use wingbeat_results::frames::{self, Frame, Mesh};
use wingbeat_results::particles::Cloud;
use wingbeat_results::poses::{Poses, picture};
use wingbeat_results::rows::Rows;
use wingbeat_results::{History, Outcome, ResultDir, Summary};

/// More points than this do not make a plot on a page better.
const MOST_ROWS: usize = 1500;
/// Frames drawn from the history where no frames were written.
const MOST_POSES: usize = 1000;
/// Room for what JSON says of a frame \[bytes before base64\].
const ENTRY: usize = 450;
/// Trail of a wing tip, wingbeats.
const TRAIL_BEATS: f64 = 1.0;

/// A frame as the page knows it.
#[derive(Serialize)]
struct Shown {
    #[serde(flatten)]
    packed: Packed,
    step: usize,
    time: f64,
    x: f64,
    down: bool,
    forces: Vec<[f64; 3]>,
}

/// Title and data of the page in at most about `budget` bytes.
pub(super) fn gather(
    dir: &ResultDir,
    outcome: &Outcome,
    budget: usize,
) -> Result<(String, String), IoError> {
    let case = dir.case()?;
    let path = dir.join("history.csv");
    let (history, stride) = History::thinned(&path, MOST_ROWS)?;
    let charts = figures::charts(&case.setup, &history);
    let summary = Summary::read(&case, &path, outcome)?;
    let mut head = json!({
        "name": case.name,
        "description": case.raw.description,
        "version": dir.manifest()?.version,
        "outcome": words(outcome),
        "summary": summary.to_text(),
        "case": case.text(),
        "period": case.setup.time.period,
        "air": case.setup.air.is_some(),
        "charts": charts.iter().map(chart).collect::<Vec<Value>>(),
    });
    let left = budget.saturating_sub(head.to_string().len());
    let scene = Scene::new(dir, &case, history.names(), left)?;
    let scene = scene.read(&case, &charts)?;
    scene.describe(&mut head, &case, stride);
    Ok((case.name, head.to_string().replace("</", "<\\/")))
}

fn words(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Finished => "flown to its end",
        Outcome::Running => "still running",
        Outcome::Interrupted => "interrupted",
        Outcome::Unwritten(_) => "stopped because it could not be written",
        Outcome::Failed(_) => "ended early by an error",
    }
}

/// Five digits are more than a screen shows.
fn short(value: f64) -> Value {
    let rounded = format!("{value:.4e}").parse::<f64>();
    rounded.map_or(Value::Null, |v| json!(v)) // not finite: null
}

fn chart(chart: &Chart) -> Value {
    let list = |v: &[f64]| v.iter().map(|x| short(*x)).collect::<Vec<Value>>();
    let panels = chart.panels.iter().map(|p| {
        let series = p
            .series
            .iter()
            .map(|s| json!({ "label": s.label, "values": list(&s.values) }));
        json!({
            "label": p.label,
            "logarithmic": p.logarithmic,
            "series": series.collect::<Vec<Value>>(),
        })
    });
    json!({
        "title": chart.title,
        "x_label": chart.x_label,
        "x": list(&chart.x),
        "shaded": chart.shaded,
        "panels": panels.collect::<Vec<Value>>(),
    })
}

/// The 3-D part while it is gathered.
struct Scene<'a> {
    dir: &'a ResultDir,
    poses: Poses,
    plan: Plan,
    framed: bool,
    blob: Blob,
    shown: Vec<Shown>,
    path: Vec<f64>,
}

impl<'a> Scene<'a> {
    fn new(
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
        let nodes = poses.surfaces.iter().map(|s| s.nodes.len()).sum();
        let panels = poses.surfaces.iter().map(|s| s.quads.len()).sum();
        let own = Surfaces::bytes(nodes, panels) + ENTRY;
        let list = 24 * panels + 1000; // JSON of the surfaces
        let room = budget.saturating_sub(list) / 4 * 3;
        let plan = if framed {
            Plan::of_directory(dir.path(), &written, own, room)?
        } else {
            let rows = Rows::count(&dir.join("history.csv"))?;
            let stride = rows.div_ceil(MOST_POSES).max(1);
            let steps: Vec<usize> = (0..rows).step_by(stride).collect();
            Plan::new(&steps, &vec![own; steps.len()], own, room)
        };
        Ok(Self {
            dir,
            poses,
            plan,
            framed,
            blob: Blob::default(),
            shown: vec![],
            path: vec![],
        })
    }

    /// Reads the history once, stopping at the frames that are shown.
    fn read(mut self, case: &LoadedCase, charts: &[Chart]) -> Result<Self, IoError> {
        let mut rows = Rows::open(&self.dir.join("history.csv"))?;
        let bodies = body_names(&case.setup.animal);
        let names = rows.names();
        let force = |b: &String| {
            names
                .iter()
                .position(|n| *n == format!("air_{b}_force_n1_newton"))
        };
        let forces: Vec<usize> = bodies[1..].iter().filter_map(force).collect();
        let shaded = charts.first().map_or(&[][..], |c| &c.shaded[..]);
        let unit = case.setup.time.period.unwrap_or(1.0);
        let steps = self.plan.steps.clone();
        let mut wanted = steps.into_iter().peekable();
        while let Some(row) = rows.next_row()? {
            if wanted.next_if_eq(&(row[0] as usize)).is_none() {
                continue;
            }
            let x = row[1] / unit;
            let (surfaces, wakes, cloud) = self.frame(row)?;
            let most = self.plan.frame_bytes.saturating_sub(ENTRY);
            let packed = self.blob.add(&surfaces, &wakes, &cloud, most);
            let vector = |k: &usize| picture(DVec3::from_slice(&row[*k..]));
            self.path.extend(picture(self.poses.pose(row, 0).0));
            self.shown.push(Shown {
                packed,
                step: row[0] as usize,
                time: row[1],
                x,
                down: shaded.iter().any(|[a, b]| *a <= x && x <= *b),
                forces: forces.iter().map(vector).collect(),
            });
        }
        Ok(self)
    }

    /// Surfaces, wakes and particles at a row: as they were written; what was not is carried by its body.
    fn frame(&self, row: &[f64]) -> Result<(Surfaces, Mesh, Cloud), IoError> {
        let step = row[0] as usize;
        let frame = if self.framed {
            Frame::read(self.dir.path(), step)?
        } else {
            Frame::default()
        };
        let mut points = frame.surfaces.points.clone();
        let mut count = 0;
        let mut written = 0;
        for (k, surface) in self.poses.surfaces.iter().enumerate() {
            if count == points.len() && count >= frame.surfaces.points.len() {
                points.extend(self.poses.nodes(row, k).map(picture));
            } else {
                written += surface.quads.len();
            }
            count += surface.nodes.len();
        }
        if count != points.len() || written != frame.surfaces.quads.len() {
            return Err(IoError::Damaged {
                path: Frame::paths(self.dir.path(), step)[0].clone(),
                problem: "this frame belongs to another animal than case.toml".to_owned(),
            });
        }
        let panels = self.poses.surfaces.iter().map(|s| s.quads.len()).sum();
        let values = |name: &str| {
            let mut list = frame.surfaces.cell(name).to_vec();
            list.resize(panels, 0.0);
            list
        };
        let surfaces = Surfaces {
            circulation: values("circulation_m2_per_s"),
            pressure: values("pressure_jump_pascal"),
            points,
        };
        Ok((surfaces, frame.wakes, frame.particles))
    }

    /// Writes the scene into the data of the page.
    fn describe(self, head: &mut Value, case: &LoadedCase, stride: usize) {
        let animal = &case.setup.animal;
        let reports = animal.wing_reports();
        let longest = reports.iter().map(|r| r.length).fold(0.0, f64::max);
        let length = if longest > 0.0 {
            longest
        } else {
            animal.body_length()
        };
        let length = if length > 0.0 { length } else { 1.0 };
        let beat = case
            .setup
            .time
            .period
            .map_or(f64::INFINITY, |p| TRAIL_BEATS * p);
        let spacing = match &self.shown[..] {
            [a, b, ..] => b.time - a.time,
            _ => 1.0,
        };
        let surfaces = self.poses.surfaces.iter().map(
            |s| json!({ "name": s.name, "body": s.body, "nodes": s.nodes.len(), "quads": s.quads.as_flattened() }),
        );
        let size = |f: &[f64; 3]| DVec3::from_array(*f).length();
        let forces = self.shown.iter().flat_map(|f| f.forces.iter().map(size));
        head["surfaces"] = surfaces.collect();
        head["sheets"] = json!(self.blob.columns);
        head["scale"] = json!(1.0 / length);
        head["wings"] = json!(animal.wings.len());
        head["trail"] = json!((beat / spacing).clamp(1.0, 1e6).round());
        head["force_scale"] = json!(usual(forces));
        head["most"] = json!({
            "circulation": usual(self.shown.iter().map(|f| f.packed.circulation)),
            "pressure": usual(self.shown.iter().map(|f| f.packed.pressure)),
            "strength": usual(self.shown.iter().map(|f| f.packed.usual_strength)),
        });
        head["thinned"] = json!(self.thinned(stride));
        head["path"] = json!(self.path);
        head["blob"] = json!(STANDARD.encode(&self.blob.bytes));
        head["frames"] = json!(self.shown);
    }

    /// What was left out, in words.
    fn thinned(&self, stride: usize) -> String {
        let (shown, of) = (self.shown.len(), self.plan.of);
        let source = if self.framed {
            "frames that were written"
        } else {
            "steps, drawn from the history (no wakes)"
        };
        let mut text = format!("Shown here: {shown} of {of} {source}");
        if self.blob.shortened > 0 {
            text += &format!(
                ", {} of them without their oldest wake rows",
                self.blob.shortened
            );
        }
        if self.blob.weakened > 0 {
            text += &format!(
                ", {} of them without their weakest particles",
                self.blob.weakened
            );
        }
        text += &match stride {
            1 => "; plots with every step".to_owned(),
            n => format!("; plots with every {n}th step"),
        };
        text + "; positions rounded to 1/65535 of the frame. history.csv and frames/ hold everything."
    }
}

/// What is large without being the rarest of all: nineteen in twenty are smaller.
fn usual(values: impl Iterator<Item = f64>) -> f64 {
    let mut list: Vec<f64> = values.filter(|v| v.is_finite() && *v > 0.0).collect();
    list.sort_by(f64::total_cmp);
    let at = (list.len() * 19 / 20).min(list.len().saturating_sub(1));
    list.get(at).copied().unwrap_or(1.0)
}
