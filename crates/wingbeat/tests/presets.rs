//! Every preset through the program: flown, drawn, put on a page, and read back.

use std::fs;
use std::path::Path;

use crate::support::{Scratch, flown};
use wingbeat::case::LoadedCase;
use wingbeat::case::presets::PRESETS;
use wingbeat::flight::AirModel;
use wingbeat::math::DVec3;
use wingbeat::results::ResultDir;
use wingbeat::results::frames::{self, Frame};
use wingbeat::results::poses::{Poses, picture};
use wingbeat::results::rows::Rows;

/// Steps that are flown: four start the multi-step method, the others are its own.
const STEPS: usize = 6;

/// Flies the beginning of a preset into a folder of its name, with page, figures and frames.
fn fly(dir: &Path, preset: &str) {
    let case = LoadedCase::find(preset, &[]).unwrap();
    let time = &case.setup.time;
    let length = match time.period.filter(|_| case.raw.time.beats.is_some()) {
        Some(period) => format!("time.beats={}", STEPS as f64 * time.step / period),
        None => format!("time.steps={STEPS}"),
    };
    let is_lattice = matches!(case.setup.air, AirModel::VortexLattice(_));
    let set = [
        length.as_str(),
        "output.page=true",
        "output.figures=true",
        "output.keep_checkpoint=true",
    ];
    let frames = is_lattice.then_some("output.frames_every=2");
    let set = set.into_iter().chain(frames).flat_map(|s| ["--set", s]);
    let args = ["run", preset, "--quiet", "--out", preset];
    flown(dir, &args.into_iter().chain(set).collect::<Vec<_>>());
}

/// Largest distance between nodes that were written and those the history tells, relative to the
/// size of the animal; none where nothing was written.
fn apart(run: &Path) -> Option<f64> {
    let case = ResultDir::open(run).unwrap().case().unwrap();
    let mut rows = Rows::open(&run.join("history.csv")).unwrap();
    let poses = Poses::new(&case.setup.animal, rows.names()).unwrap();
    let all = poses.surfaces.iter().flat_map(|s| &s.nodes);
    let size = all.map(|x| x.length()).fold(0.0, f64::max);
    let steps = frames::steps(run).unwrap();
    let mut largest = None;
    while let Some(row) = rows.next_row().unwrap() {
        let step = row[0] as usize;
        if !steps.contains(&step) {
            continue;
        }
        let written = Frame::read(run, step).unwrap().surfaces.points;
        let told = (0..poses.surfaces.len()).flat_map(|k| poses.nodes(row, k).map(picture));
        let told: Vec<[f64; 3]> = told.take(written.len()).collect();
        assert_eq!(told.len(), written.len());
        for (a, b) in told.iter().zip(&written) {
            let gap = (0..3).map(|c| (a[c] - b[c]).abs() / size);
            largest = gap.chain(largest).reduce(f64::max);
        }
    }
    largest
}

#[test]
fn agrees_every_preset_with_its_page_figures_and_frames() {
    let scratch = Scratch::new("presets");
    for preset in PRESETS {
        let run = scratch.0.join(preset.name);
        fly(&scratch.0, preset.name);
        let manifest = ResultDir::read(&run).unwrap().manifest().unwrap();
        assert_eq!(manifest.steps, STEPS, "{}", preset.name);
        assert!(run.join("flight.html").is_file(), "{}", preset.name);
        let figures = fs::read_dir(run.join("figures")).unwrap().count();
        assert!(figures >= 3, "{}: {figures} figures", preset.name);
        // How a wing bends stands in its frames alone.
        let bends = LoadedCase::find(preset.name, &[]).unwrap();
        let bends = bends.setup.animal.is_elastic();
        if let Some(gap) = apart(&run).filter(|_| !bends) {
            // Coordinates are the state's but for a few roundings in taking angles from rotations.
            assert!(gap < 1e-12, "{}: {gap:.1e} apart", preset.name);
            println!("{}: {gap:.1e}", preset.name);
        }
        let args = ["export", preset.name, "--format", "gltf"];
        flown(&scratch.0, &args);
    }
}

#[test]
fn exact_every_reader_takes_an_animal_with_joints() {
    let scratch = Scratch::new("joints");
    let preset = "fruit-fly-abdomen";
    fly(&scratch.0, preset);
    for format in ["hdf5", "vtkhdf", "parquet"] {
        flown(&scratch.0, &["export", preset, "--format", format]);
    }
    flown(&scratch.0, &["plot", preset, "--overwrite"]);
    flown(&scratch.0, &["plot", preset, "animation"]);
    flown(&scratch.0, &["show", preset]);
    flown(&scratch.0, &["view", preset, "--no-open"]);
    flown(&scratch.0, &["velocity", preset, "--point", "0.01,0,0"]);
    // In glTF every body has its name and its panels.
    flown(&scratch.0, &["export", preset, "--format", "gltf"]);
    let bytes = fs::read(scratch.0.join(preset).join("flight.glb")).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let head: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    let nodes = head["nodes"].as_array().unwrap();
    let names: Vec<&str> = nodes.iter().map(|n| n["name"].as_str().unwrap()).collect();
    // The node behind them magnifies them all.
    let (magnifier, bodies) = names.split_last().unwrap();
    let (bodies, wakes) = bodies.split_at(5);
    assert_eq!(bodies, ["body", "left", "right", "abdomen", "head"]);
    assert!(
        wakes.iter().all(|name| name.starts_with("wake at")),
        "{wakes:?}"
    );
    assert!(magnifier.ends_with("times larger"), "{magnifier}");
    assert!(nodes[..5].iter().all(|n| n["mesh"].is_number()));
}

/// A hovering fly whose edges shed, both halves computed: forces of the left wing are the mirror image of those
/// of the right one.
#[test]
fn invariant_left_and_right_wing_of_the_tethered_fly_over_two_separated_beats() {
    let keys = [
        "air.mirror=false",
        "air.summation=direct",
        "time.steps_per_beat=24",
        "time.beats=2",
    ];
    let flight = wingbeat::Flight::preset_with("fruit-fly-tethered", &keys).unwrap();
    let records = flight.fly().unwrap().records;
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for record in &records {
        let [one, other] = [1, 2].map(|body| record.air[body].force);
        apart = apart.max(((one - other) * DVec3::new(1.0, 0.0, 1.0)).length());
        apart = apart.max((one.y + other.y).abs());
        largest = largest.max(one.length());
    }
    // Rounding, 4e-14 measured; 7e-5 where a rounding of circulation decides how a node moves.
    assert!(apart < 4e-13 * largest, "{:e}", apart / largest);
}
