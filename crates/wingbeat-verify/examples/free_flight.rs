//! Free flight of *Drosophila hydei*, body and wings tracked at 7500 frames a second [FlyRanch/flycity; Muijres et
//! al. 2014, Science 344:172]: force of the measured wings, by blade elements or by the lattice with leading-edge
//! vorticity, against the measured acceleration of the body. The records are not shipped:
//!
//! `cargo run -p wingbeat-verify --example free_flight -- FOLDER [lattice]`
//!
//! with `wingbeats.csv` and the sequences of frames in the folder; what is not there is skipped by name.
//!
//! Wing size and mass of the animals were not measured (3 mm, 1.8 mg), so the level has one free factor an animal.
//! World components mostly reflect the body's attitude; what tests the air is the magnitude, the component along
//! the normal of the stroke plane, and the residual beside that of a force fixed to the body, which knows nothing
//! of the wings. World axes: z up. Body axes: x forward, y right, z down; stroke-plane axes: turned by -55 deg about y.

use std::path::Path;
use wingbeat_air::{AirError, AirSettings, Lattice, NodeMotion, SheddingKinds, Surface};
use wingbeat_blade::{BladeSettings, BladeWing, Strip};
use wingbeat_flight::AirOptions;
use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, r2};
use wingbeat_model::planform::{Beta, ChordSize};
use wingbeat_verify::lab::forces;
use wingbeat_verify::lab::outline::{Spread, nodes};
use wingbeat_verify::lab::series::{Table, correlation, rms};

/// Frames a second.
pub const RATE: f64 = 7500.0;
/// Frames of a wingbeat.
const BEAT: usize = 39;
/// Wing length and mean chord [m]; a rectangle's radius of gyration is 0.577 of its length, this wing's 0.579.
const WING: [f64; 2] = [2.99e-3, 0.874e-3];
/// The feathering axis behind the leading edge over the chord.
const AXIS: f64 = 0.25;
/// Panels of the lattice along chord and span.
const MESH: [usize; 2] = [5, 8];
/// Where the lattice begins over the length.
const ROOT: f64 = 0.05;
/// Radius of gyration over the length.
const R2_HAT: f64 = 0.579;
const SIDES: [f64; 2] = [-1.0, 1.0];
/// Of the air [kg/m3].
const DENSITY: f64 = 1.225;
/// Weight [N].
const WEIGHT: f64 = 1.8e-6 * 9.81;
/// Right hinge from the origin of the body [m], body axes.
const HINGE: DVec3 = DVec3::new(0.2021e-3, 0.1055e-3, -0.1477e-3);
/// Sequences and their files.
const SEQUENCES: [(&str, &[&str]); 2] = [
    ("20121002_S0003", &["20121002_S0003.csv"]),
    (
        "20121010_S0001",
        &["20121010_S0001_a.csv", "20121010_S0001_b.csv"],
    ),
];

/// What was tracked, frame by frame: place of the body's origin [m], rotations to world axes of the body, the left
/// and the right wing.
#[derive(Default)]
struct Track {
    place: Vec<DVec3>,
    body: Vec<DMat3>,
    wings: [Vec<DMat3>; 2],
}

/// Matrix of a quaternion (x, y, z, w), from the old to the new axes.
pub fn passive([x, y, z, w]: [f64; 4]) -> DMat3 {
    let rows = [
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y + w * z),
        2.0 * (x * z - w * y),
        2.0 * (x * y - w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z + w * x),
        2.0 * (x * z + w * y),
        2.0 * (y * z - w * x),
        1.0 - 2.0 * (x * x + y * y),
    ];
    DMat3::from_cols_array(&rows).transpose()
}

impl Track {
    fn add(&mut self, text: &str) {
        let table = Table::new(text);
        let column = |name: &str| table.numbers(name);
        let place = ["x_mm", "y_mm", "z_mm"].map(column);
        let turn = |who: &str| ["x", "y", "z", "w"].map(|k| column(&format!("q{who}{k}")));
        let [body, left, right] = ["B", "L", "R"].map(turn);
        for k in 0..place[0].len() {
            let at = |q: &[Vec<f64>; 4]| passive([0, 1, 2, 3].map(|i| q[i][k])).transpose();
            self.place
                .push(1e-3 * DVec3::new(place[0][k], place[1][k], place[2][k]));
            self.body.push(at(&body));
            self.wings[0].push(at(&body) * at(&left));
            self.wings[1].push(at(&body) * at(&right));
        }
    }

    /// How the frame of a wing moves, frame by frame: that of the left one for side 0.
    fn frames(&self, side: usize) -> Frames {
        let arm = DVec3::new(HINGE.x, SIDES[side] * HINGE.y, HINGE.z);
        let body = smoothed(&self.body);
        let hinge: Vec<DVec3> = (self.place.iter().zip(&body))
            .map(|(p, r)| *p + *r * arm)
            .collect();
        let (place, turns) = (running_mean(&hinge), smoothed(&self.wings[side]));
        Frames {
            velocity: rates(&place),
            spin: spins(&turns),
            place,
            turns,
        }
    }

    /// Force of both wings on the body over its weight [1], world axes, frame by frame, by blade elements.
    fn blade_forces(&self) -> Vec<DVec3> {
        let mut sum = vec![DVec3::ZERO; self.place.len()];
        for side in 0..2 {
            let frames = self.frames(side);
            let [length, chord] = WING;
            let strips = Strip::rectangle(20, [0.0, length], chord, AXIS * chord, SIDES[side]);
            let wing = BladeWing::new(strips, BladeSettings::insect(DENSITY)).expect("a wing");
            let (linear, angular) = (rates(&frames.velocity), rates(&frames.spin));
            for k in 0..sum.len() {
                let motion = BodyMotion {
                    r: frames.turns[k],
                    v: frames.velocity[k],
                    w: frames.spin[k],
                    ..BodyMotion::REST
                };
                let acceleration = BodyAcceleration {
                    linear: linear[k],
                    angular: angular[k],
                };
                sum[k] += frames.turns[k] * wing.load(&motion, &acceleration).force / WEIGHT;
            }
        }
        sum
    }

    /// The same by the lattice of the insect presets with leading-edge vorticity, its wakes a beat long.
    fn lattice_forces(&self) -> Result<Vec<DVec3>, AirError> {
        let [_, chord] = WING;
        let insect = AirOptions::insect(DENSITY, 1.5e-5, chord).lattice;
        let settings = AirSettings {
            shedding: SheddingKinds {
                leading: true,
                root: true,
                ..insect.shedding
            },
            clearance: 0.1 * chord,
            max_rows: Some(BEAT),
            ..insect
        };
        let surfaces = ["left", "right"].map(|name| Surface::grid(name, MESH[0], MESH[1]));
        let lattice = Lattice::new(surfaces.to_vec(), settings)?;
        let frames = [0, 1].map(|side| self.frames(side));
        let flat = SIDES.map(wing);
        let motion = |t: f64| {
            let k = (t * RATE).round() as usize;
            let mut motion = NodeMotion::default();
            for (f, nodes) in frames.iter().zip(&flat) {
                let arm = |x: &DVec3| f.turns[k] * *x;
                let swept = |x: &DVec3| f.turns[k] * f.spin[k].cross(*x);
                motion
                    .position
                    .extend(nodes.iter().map(|x| f.place[k] + arm(x)));
                motion
                    .velocity
                    .extend(nodes.iter().map(|x| f.velocity[k] + swept(x)));
            }
            motion
        };
        let forces = forces(&lattice, motion, 1.0 / RATE, self.place.len() - 1)?;
        Ok(forces.iter().map(|f| *f / WEIGHT).collect())
    }
}

/// Nodes of a flat wing, x forward, y right: as broad as Ellington's beta distribution. The roots of
/// rectangular wings pass through each other where the strokes end.
fn wing(side: f64) -> Vec<DVec3> {
    let [length, mean] = WING;
    let beta = Beta {
        length,
        size: ChordSize::Mean(mean),
        r2_hat: R2_HAT,
        root_offset: ROOT * length,
        axis_fraction: AXIS,
        least_chord: 0.15,
    };
    let chord = beta.fit().expect("a wing");
    let outline = |y: f64| {
        let c = chord.at((y / length - ROOT) / (1.0 - ROOT));
        [AXIS * c, -c]
    };
    let nodes = nodes(outline, [ROOT * length, length], MESH, Spread::Uniform);
    nodes
        .iter()
        .map(|x| DVec3::new(x.x, side * x.y, 0.0))
        .collect()
}

/// How the frame of a wing moves.
struct Frames {
    /// Of the hinge [m].
    place: Vec<DVec3>,
    /// [m/s], world axes.
    velocity: Vec<DVec3>,
    /// From wing to world axes.
    turns: Vec<DMat3>,
    /// [rad/s], wing axes.
    spin: Vec<DVec3>,
}

/// Rotations without what is faster than 1.5 kHz (Gauss's bell, -3 dB there), which is noise of the tracker.
fn smoothed(turns: &[DMat3]) -> Vec<DMat3> {
    let width = 0.1325 * RATE / 1500.0;
    let bell = |d: f64| (-0.5 * (d / width).powi(2)).exp();
    let last = turns.len() - 1;
    let at = |k: usize| {
        let near = (-3..=3_isize).map(|d| {
            let j = k.saturating_add_signed(d).min(last);
            turns[j] * bell(d as f64)
        });
        let sum = near.fold(DMat3::ZERO, |a, b| a + b);
        let x = sum.x_axis.normalize();
        let y = (sum.y_axis - x * x.dot(sum.y_axis)).normalize();
        DMat3::from_cols(x, y, x.cross(y))
    };
    (0..turns.len()).map(at).collect()
}

/// Central differences; those of the neighbours at the ends.
fn rates(x: &[DVec3]) -> Vec<DVec3> {
    let at = |k: usize| {
        let k = k.clamp(1, x.len() - 2);
        (x[k + 1] - x[k - 1]) * (0.5 * RATE)
    };
    (0..x.len()).map(at).collect()
}

/// Angular velocities in the turning axes [rad/s].
pub fn spins(turns: &[DMat3]) -> Vec<DVec3> {
    let at = |k: usize| {
        let k = k.clamp(1, turns.len() - 2);
        let w = turns[k].transpose() * (turns[k + 1] - turns[k - 1]) * (0.25 * RATE);
        DVec3::new(
            w.y_axis.z - w.z_axis.y,
            w.z_axis.x - w.x_axis.z,
            w.x_axis.y - w.y_axis.x,
        )
    };
    (0..turns.len()).map(at).collect()
}

/// Mean over the beat around each frame; shorter at the ends.
fn running_mean(x: &[DVec3]) -> Vec<DVec3> {
    let at = |k: usize| {
        let near = &x[k.saturating_sub(BEAT / 2)..(k + BEAT / 2 + 1).min(x.len())];
        near.iter().copied().sum::<DVec3>() / near.len() as f64
    };
    (0..x.len()).map(at).collect()
}

/// A wingbeat: measured and computed specific force [g], world axes, and the mean rotation of the body to these.
struct Beat {
    measured: DVec3,
    computed: DVec3,
    body: DMat3,
}

/// The valid beats at least three periods from the ends of the record.
fn beats(name: &str, table: &Table, track: &Track, forces: Vec<DVec3>) -> Vec<Beat> {
    let filtered = (0..3).fold(forces, |x, _| running_mean(&x));
    let column = |name: &str| table.numbers(name);
    let [start, end, valid] = ["frame_start", "frame_end", "valid"].map(column);
    let force = ["sfx", "sfy", "sfz"].map(column);
    let inside = 3.0 * BEAT as f64..=(filtered.len() - 3 * BEAT) as f64;
    let is_used = |(k, owner): &(usize, &str)| {
        *owner == name
            && valid[*k] == 1.0
            && inside.contains(&start[*k])
            && inside.contains(&end[*k])
    };
    let beat = |(k, _): (usize, &str)| {
        let frames = start[k] as usize..end[k] as usize;
        let n = frames.len() as f64;
        let body = frames.clone().fold(DMat3::ZERO, |a, j| a + track.body[j]);
        let x = body.x_axis.normalize();
        let y = (body.y_axis - x * x.dot(body.y_axis)).normalize();
        Beat {
            measured: DVec3::new(force[0][k], force[1][k], force[2][k]),
            computed: frames.map(|j| filtered[j]).sum::<DVec3>() / n,
            body: DMat3::from_cols(x, y, x.cross(y)),
        }
    };
    (table.words("sequence").enumerate())
        .filter(is_used)
        .map(beat)
        .collect()
}

/// Root mean square of the lengths.
fn length(x: impl Iterator<Item = DVec3>) -> f64 {
    rms(&x.map(DVec3::length).collect::<Vec<f64>>())
}

/// The criteria of one sequence: quantity, value, least and largest that pass.
fn judge(beats: &[Beat]) -> [(&'static str, f64, [f64; 2]); 4] {
    let both = |f: &dyn Fn(&Beat, DVec3) -> f64| {
        let of = |pick: fn(&Beat) -> DVec3| -> Vec<f64> {
            beats.iter().map(|b| f(b, pick(b))).collect()
        };
        correlation(&of(|b| b.computed), &of(|b| b.measured))
    };
    let stroke = r2((-55.0_f64).to_radians());
    let normal = |b: &Beat, v: DVec3| (stroke.transpose() * (b.body.transpose() * v)).z;
    let dots = |f: fn(&Beat) -> f64| beats.iter().map(f).sum::<f64>();
    let scale = dots(|b| b.computed.dot(b.measured)) / dots(|b| b.computed.length_squared());
    let fixed = beats.iter().map(|b| b.body.transpose() * b.measured);
    let fixed = fixed.sum::<DVec3>() / beats.len() as f64;
    let blind = length(beats.iter().map(|b| b.body * fixed - b.measured));
    let wings = length(beats.iter().map(|b| scale * b.computed - b.measured));
    [
        (
            "correlation of magnitude",
            both(&|_, v| v.length()),
            [0.8, 1.0],
        ),
        (
            "correlation along the stroke-plane normal",
            both(&normal),
            [0.8, 1.0],
        ),
        (
            "rms residual after one scale, at most that of a body-fixed force [g]",
            wings,
            [0.0, blind],
        ),
        ("scale, measured over computed", scale, [0.8, 1.3]),
    ]
}

/// Judges what the folder holds; the number of criteria that are missed.
pub fn compare(folder: &Path, lattice: bool) -> Result<usize, AirError> {
    let read = |name: &str| match std::fs::read_to_string(folder.join(name)) {
        Ok(text) => Some(text),
        Err(e) => {
            println!("skipped: {}: {e}", folder.join(name).display());
            None
        }
    };
    let Some(table) = read("wingbeats.csv").map(|text| Table::new(&text)) else {
        return Ok(0);
    };
    let mut missed = 0;
    for (name, files) in SEQUENCES {
        let texts: Option<Vec<String>> = files.iter().map(|f| read(f)).collect();
        let Some(texts) = texts else { continue };
        let mut track = Track::default();
        texts.iter().for_each(|text| track.add(text));
        let forces = match lattice {
            true => track.lattice_forces()?,
            false => track.blade_forces(),
        };
        let beats = beats(name, &table, &track, forces);
        println!("{name}: {} wingbeats", beats.len());
        for (quantity, value, [least, most]) in judge(&beats) {
            let passes = (least..=most).contains(&value);
            missed += usize::from(!passes);
            let word = if passes { "pass" } else { "miss" };
            println!("  {quantity}: {value:.3} ({least:.2} to {most:.3}: {word})");
        }
    }
    Ok(missed)
}

fn main() -> std::process::ExitCode {
    use std::process::ExitCode;
    let args: Vec<String> = std::env::args().skip(1).collect();
    let (folder, lattice) = match args.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [folder] => (folder, false),
        [folder, "lattice"] => (folder, true),
        [] => {
            println!("skipped: give the folder with wingbeats.csv and the sequences");
            return ExitCode::SUCCESS;
        }
        _ => {
            println!("free_flight takes a folder and, to fly the lattice, the word lattice");
            return ExitCode::FAILURE;
        }
    };
    match compare(Path::new(folder), lattice) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(missed) => {
            println!("{missed} criteria missed");
            ExitCode::FAILURE
        }
        Err(e) => {
            println!("{e}");
            ExitCode::FAILURE
        }
    }
}
