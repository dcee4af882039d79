//! The animation (.glb): the animal, its wakes and its bent wings are where history and frames have them.

use std::fs;
use std::path::Path;

use wingbeat::math::{DQuat, DVec3};
use wingbeat::results::ResultDir;
use wingbeat::results::frames::Frame;

use super::{CASE, assert_validated};
use crate::support::{Scratch, flown};

/// Numbers of a key in the JSON of a .glb, and its binary part.
fn glb(path: &Path) -> (serde_json::Value, Vec<u8>) {
    let bytes = fs::read(path).unwrap();
    let length = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(length(8), bytes.len());
    let json = length(12);
    let head = serde_json::from_slice(&bytes[20..20 + json]).unwrap();
    (head, bytes[20 + json + 8..].to_vec())
}

#[test]
fn exact_the_animation_is_where_the_animal_is() {
    let scratch = Scratch::new("gltf");
    flown(&scratch.0, &CASE);
    flown(
        &scratch.0,
        &["export", "run", "--format", "gltf", "--out", "elsewhere"],
    );
    let (head, binary) = glb(&scratch.0.join("elsewhere/flight.glb"));
    let history = wingbeat::results::History::read(&scratch.0.join("run/history.csv")).unwrap();
    let animation = &head["animations"][0];
    let sampler = animation["channels"][0]["sampler"].as_u64().unwrap() as usize;
    assert_eq!(animation["channels"][0]["target"]["path"], "translation");
    let output = animation["samplers"][sampler]["output"].as_u64().unwrap() as usize;
    let view = head["accessors"][output]["bufferView"].as_u64().unwrap() as usize;
    let at = head["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize;
    let number = |k: usize| f32::from_le_bytes(binary[at + 4 * k..][..4].try_into().unwrap());
    for row in 0..history.rows() {
        let of = |name: &str| history.column(name)[row] as f32;
        // x forward, y up, z right
        let expected = [of("body_x_m"), -of("body_z_m"), of("body_y_m")];
        assert_eq!([0, 1, 2].map(|k| number(3 * row + k)), expected);
    }
    // A wingbeat takes a second; the whole is magnified by a node over all others.
    let input = animation["samplers"][sampler]["input"].as_u64().unwrap() as usize;
    let end = head["accessors"][input]["max"][0].as_f64().unwrap();
    let flight = *history.column("time_s").last().unwrap();
    let slower = head["extras"]["times_slower"].as_f64().unwrap();
    assert!((end - flight * slower).abs() < 1e-6 * end, "{end}");
    let root = head["scenes"][0]["nodes"][0].as_u64().unwrap() as usize;
    assert_eq!(
        head["nodes"][root]["scale"][0],
        head["extras"]["times_larger"]
    );
    let attributes = &head["meshes"][0]["primitives"][0]["attributes"];
    let normal = attributes["NORMAL"].as_u64().unwrap() as usize;
    let view = head["accessors"][normal]["bufferView"].as_u64().unwrap() as usize;
    let at = head["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize;
    let count = head["accessors"][normal]["count"].as_u64().unwrap() as usize;
    for k in 0..count {
        let c =
            |c: usize| f32::from_le_bytes(binary[at + 12 * k + 4 * c..][..4].try_into().unwrap());
        let size = (c(0) * c(0) + c(1) * c(1) + c(2) * c(2)).sqrt();
        assert!((size - 1.0).abs() < 1e-6, "a normal of length {size}");
    }
}

/// What an accessor of a .glb counts, and its bytes.
fn accessor<'a>(
    head: &serde_json::Value,
    binary: &'a [u8],
    k: &serde_json::Value,
) -> (usize, &'a [u8]) {
    let number = |v: &serde_json::Value| v.as_u64().unwrap() as usize;
    let accessor = &head["accessors"][number(k)];
    let view = &head["bufferViews"][number(&accessor["bufferView"])];
    let at = number(&view["byteOffset"]);
    (
        number(&accessor["count"]),
        &binary[at..at + number(&view["byteLength"])],
    )
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    let words = bytes.as_chunks::<4>().0.iter();
    words.map(|w| f32::from_le_bytes(*w)).collect()
}

#[test]
fn exact_one_wake_is_seen_at_a_time_and_it_is_that_of_the_frame() {
    let scratch = Scratch::new("gltf-wake");
    flown(&scratch.0, &CASE);
    flown(&scratch.0, &["export", "run", "--format", "gltf"]);
    let (head, binary) = glb(&scratch.0.join("run/flight.glb"));
    let slower = head["extras"]["times_slower"].as_f64().unwrap();
    let run = scratch.0.join("run");
    let case = wingbeat::results::ResultDir::open(&run)
        .unwrap()
        .case()
        .unwrap();
    let steps = wingbeat::results::frames::steps(&run).unwrap();
    let animation = &head["animations"][0];
    let (mut seen, mut opaque) = (vec![0; steps.len()], vec![0; steps.len()]);
    for channel in animation["channels"].as_array().unwrap() {
        if channel["target"]["path"] != "scale" {
            continue;
        }
        let sampler = &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize];
        let times = floats(accessor(&head, &binary, &sampler["input"]).1);
        let scales = floats(accessor(&head, &binary, &sampler["output"]).1);
        let at = |t: f64| {
            times
                .iter()
                .rposition(|x| f64::from(*x) <= t)
                .map_or(0.0, |k| scales[3 * k])
        };
        let node = &head["nodes"][channel["target"]["node"].as_u64().unwrap() as usize];
        for (k, step) in steps.iter().enumerate() {
            let time = (*step as f64 + 1e-3) * case.setup.time.step * slower;
            if at(time) == 0.0 {
                continue;
            }
            seen[k] += 1;
            // Nodes of the youngest rows stand where the frame has them: x forward, y up, z right.
            let mesh = &head["meshes"][node["mesh"].as_u64().unwrap() as usize];
            let attributes = &mesh["primitives"][0]["attributes"];
            let points = floats(accessor(&head, &binary, &attributes["POSITION"]).1);
            let wakes = wingbeat::results::frames::Frame::read(&run, *step)
                .unwrap()
                .wakes;
            for (p, q) in points.as_chunks::<3>().0.iter().zip(&wakes.points) {
                assert_eq!(*p, [q[0] as f32, q[2] as f32, -q[1] as f32]);
            }
            assert_eq!(
                points.len(),
                3 * wakes.points.len(),
                "a wake of one beat is there whole"
            );
            let (count, colours) = accessor(&head, &binary, &attributes["COLOR_0"]);
            assert_eq!((4 * count, 3 * count), (colours.len(), points.len()));
            let opacity = colours.as_chunks::<4>().0.iter().map(|c| c[3]);
            opaque[k] = opacity.max().unwrap();
        }
    }
    // The strokes begin smoothly: what is shed first is too weak to be seen.
    assert!(opaque[3..].iter().all(|a| *a > 0), "{opaque:?}");
    assert!(opaque[opaque.len() - 1] > 100, "{opaque:?}");
    assert_eq!(seen[0], 0, "no wake yet");
    assert!(seen[1..].iter().all(|n| *n == 1), "{seen:?}");
}

/// Nodes of the wings at the keys of their shapes: places at rest and weighted morph targets, turned and
/// carried as the node of the wing is, are those of the frames; with it the largest distance and that of the
/// shape at rest, over the length of the wing.
fn bent(head: &serde_json::Value, binary: &[u8], run: &Path, wing: usize) -> [f64; 2] {
    let number = |v: &serde_json::Value| v.as_u64().unwrap() as usize;
    let case = ResultDir::open(run).unwrap().case().unwrap();
    let report = &case.setup.animal.wing_reports()[wing];
    let slower = head["extras"]["times_slower"].as_f64().unwrap();
    let animation = &head["animations"][0];
    let node = head["nodes"].as_array().unwrap();
    let node = node.iter().position(|n| n["name"] == report.name).unwrap();
    let channel = |path: &str| -> [Vec<f32>; 2] {
        let channels = animation["channels"].as_array().unwrap();
        let is = |c: &&serde_json::Value| {
            number(&c["target"]["node"]) == node && c["target"]["path"] == path
        };
        let sampler = number(&channels.iter().find(is).unwrap()["sampler"]);
        ["input", "output"]
            .map(|k| floats(accessor(head, binary, &animation["samplers"][sampler][k]).1))
    };
    let mesh = &head["meshes"][number(&head["nodes"][node]["mesh"])];
    let primitive = &mesh["primitives"][0];
    let points = |k: &serde_json::Value| -> Vec<DVec3> {
        let all = floats(accessor(head, binary, k).1);
        let all = all.as_chunks::<3>().0.iter();
        all.map(|p| DVec3::from(p.map(f64::from))).collect()
    };
    let rest = points(&primitive["attributes"]["POSITION"]);
    let targets = primitive["targets"].as_array().unwrap();
    let targets: Vec<_> = targets.iter().map(|t| points(&t["POSITION"])).collect();
    let [times, weights] = channel("weights");
    let [rows, places] = channel("translation");
    let turns = channel("rotation")[1].clone();
    let steps = wingbeat::results::frames::steps(run).unwrap();
    let (mut off, mut unbent) = (0.0_f64, 0.0_f64);
    for step in steps {
        let time = (step as f64 * case.setup.time.step * slower) as f32;
        let nearest = |all: &[f32]| {
            let near = |t: &f32| (t - time).abs() < 1e-5;
            all.iter().position(near).unwrap()
        };
        let (key, row) = (nearest(&times), nearest(&rows));
        let weights = &weights[targets.len() * key..][..targets.len()];
        assert!(weights.iter().all(|w| w.abs() <= 1.0), "{weights:?}");
        let place = DVec3::from_array([0, 1, 2].map(|k| f64::from(places[3 * row + k])));
        let turn = DQuat::from_array([0, 1, 2, 3].map(|k| f64::from(turns[4 * row + k])));
        let frame = Frame::read(run, step).unwrap().surfaces.points;
        let before = case.setup.animal.wings[..wing].iter();
        let first: usize = before.map(|w| w.mesh.nodes.len()).sum();
        for (n, at_rest) in rest.iter().enumerate() {
            let moved = weights.iter().zip(&targets);
            let bent = *at_rest + moved.map(|(w, t)| f64::from(*w) * t[n]).sum::<DVec3>();
            let [x, y, z] = frame[first + n]; // picture axes: y to the left, z up
            let far = |p: DVec3| (place + turn * p).distance(DVec3::new(x, z, -y));
            off = off.max(far(bent) / report.length);
            unbent = unbent.max(far(*at_rest) / report.length);
        }
    }
    [off, unbent]
}

/// Elastic wings, and wings whose deformation is prescribed, bend in the file as they do in the frames.
#[test]
fn agrees_bent_wings_of_the_animation_with_those_of_the_frames() {
    let scratch = Scratch::new("gltf-bent");
    for (preset, least) in [("hawkmoth-elastic", 0.1), ("bird-cruise", 0.05)] {
        let run = scratch.0.join(preset);
        let set = ["--set=time.beats=1", "--set=output.page=false"];
        let fly = ["run", preset, "--quiet", "--out", preset];
        flown(&scratch.0, &[&fly[..], &set].concat());
        flown(&scratch.0, &["export", preset, "--format", "gltf"]);
        let (head, binary) = glb(&run.join("flight.glb"));
        for wing in 0..2 {
            let [off, unbent] = bent(&head, &binary, &run, wing);
            println!("{preset}: {off:.1e} of the wing's length, at rest {unbent:.1e}");
            // What a node may be off, and roundings of single precision.
            assert!(off < 1.001e-3, "{preset}: {off:e}");
            assert!(unbent > least, "{preset}: {unbent:e}");
        }
        assert_validated(&run, "\"hasMorphTargets\":true");
    }
}

/// Where no frames are written, elastic wings bend as the history tells, whatever their names; rigid ones have no morph
/// targets.
#[test]
fn behaves_wings_without_frames_bend_by_the_history() {
    let scratch = Scratch::new("gltf-rows");
    flown(&scratch.0, &["new", "hawkmoth-elastic", "fore-wings.toml"]);
    let case = scratch.0.join("fore-wings.toml");
    let text = std::fs::read_to_string(&case).unwrap();
    std::fs::write(&case, text.replace("wing.right", "wing.fore-right")).unwrap();
    for (preset, targets) in [
        ("hawkmoth-elastic", true),
        ("fore-wings.toml", true),
        ("fruit-fly-blade", false),
    ] {
        let out = preset.trim_end_matches(".toml");
        let set = ["--set=time.beats=0.2", "--set=output.frames_every=0"];
        let set = &set[..if targets { 2 } else { 1 }];
        let fly = [
            "run",
            preset,
            "--quiet",
            "--out",
            out,
            "--set=output.page=false",
        ];
        flown(&scratch.0, &[&fly[..], set].concat());
        flown(&scratch.0, &["export", out, "--format", "gltf"]);
        let (head, _) = glb(&scratch.0.join(out).join("flight.glb"));
        let meshes = head["meshes"].as_array().unwrap();
        let bends = |m: &serde_json::Value| m["primitives"][0]["targets"].is_array();
        assert_eq!(
            meshes.iter().filter(|m| bends(m)).count(),
            2 * usize::from(targets)
        );
    }
}
