//! Result directories: complete, rerunnable bit for bit, readable when a run is cut.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

mod support;

use support::{Scratch, array, flown, wingbeat};
use wingbeat::case::{LoadedCase, presets::PRESETS};
use wingbeat::flight::Simulation;
use wingbeat::results::{self, History, Manifest, Outcome};

fn manifest(dir: &Path) -> Manifest {
    serde_json::from_str(&fs::read_to_string(dir.join("manifest.json")).unwrap()).unwrap()
}

#[test]
fn exact_every_preset_flies_a_few_steps() {
    for preset in PRESETS {
        let case = LoadedCase::find(preset.name, &[]).unwrap_or_else(|e| panic!("{e}"));
        let mut flight =
            Simulation::new(case.setup).unwrap_or_else(|e| panic!("{}: {e}", preset.name));
        for _ in 0..6 {
            flight
                .step()
                .unwrap_or_else(|e| panic!("{}: {e}", preset.name));
        }
        assert_eq!(flight.record().step, 6);
    }
}

#[test]
fn exact_a_result_directory_recreates_its_run_bit_for_bit() {
    let scratch = Scratch::new("again");
    let short = ["--set", "time.beats=0.25"];
    let first = [
        &["run", "fruit-fly-hover", "--out", "one", "--quiet"][..],
        &short,
    ]
    .concat();
    flown(&scratch.0, &first);
    flown(
        &scratch.0,
        &[
            "run",
            "one/case.toml",
            "--out",
            "two",
            "--threads",
            "1",
            "--quiet",
        ],
    );
    let read = |name: &str| fs::read(scratch.0.join(name)).unwrap();
    assert!(
        read("one/history.csv") == read("two/history.csv"),
        "histories differ"
    );
    assert!(
        read("one/case.toml") == read("two/case.toml"),
        "resolved cases differ"
    );
    assert!(read("one/frames/wakes_000010.vtp") == read("two/frames/wakes_000010.vtp"));
    let manifest = manifest(&scratch.0.join("two"));
    assert_eq!(manifest.outcome, Outcome::Finished);
    assert_eq!((manifest.steps, manifest.threads), (10, 1));
    assert_eq!(
        manifest.case_sha256,
        results::manifest::sha256(&read("two/case.toml"))
    );
    for figure in [
        "forces",
        "trajectory",
        "angles",
        "balances",
        "lollipop",
        "phase",
    ] {
        let svg = fs::read_to_string(scratch.0.join(format!("one/figures/{figure}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    }
}

#[test]
fn exact_history_holds_every_number_of_the_last_record() {
    let scratch = Scratch::new("history");
    let set = [
        "time.beats=0.2".to_owned(),
        "air.shed=[\"trailing\"]".to_owned(),
    ];
    flown(
        &scratch.0,
        &[
            "run",
            "fruit-fly-tethered",
            "--out",
            "run",
            "--quiet",
            "--set",
            &set[0],
            "--set",
            &set[1],
        ],
    );
    let history = History::read(&scratch.0.join("run/history.csv")).unwrap();
    let case = LoadedCase::find("fruit-fly-tethered", &set).unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let record = flight.record();
    // 18 coordinates, 18 rates, 12 multipliers for the body and two wings.
    assert_eq!(
        (
            record.coordinates.len(),
            record.rates.len(),
            record.multipliers.len()
        ),
        (18, 18, 12)
    );
    let bodies = results::columns::column_stems(&case.setup.animal);
    assert_eq!(bodies, ["body", "wing_left", "wing_right"]);
    let columns = results::columns::Columns::of(&case.setup, record).unwrap();
    let names: Vec<String> = columns.iter().map(|c| c.name.clone()).collect();
    let mut values = vec![];
    columns.values(record, &mut columns.blank(), &mut values);
    assert_eq!(names, history.names());
    for (name, value) in names.iter().zip(&values) {
        let read = history.column(name).last().copied().unwrap();
        assert_eq!(
            read.to_bits(),
            value.to_bits(),
            "{name}: {read} is not {value}"
        );
    }
    const UNITS: [&str; 20] = [
        "_m",
        "_m_per_s2",
        "_rad_per_s2",
        "_newton_s",
        "_s",
        "_rad",
        "_m_per_s",
        "_rad_per_s",
        "_newton",
        "_newton_m",
        "_watt",
        "_joule",
        "_kg_m_per_s",
        "_kg_m2_per_s",
        "_dimensionless",
        "_count",
        "_x_m",
        "_y_m",
        "_z_m",
        "_hz",
    ];
    for name in &names {
        assert!(
            UNITS.iter().any(|u| name.ends_with(u)),
            "`{name}` does not end in a unit"
        );
    }
    let distinct: std::collections::BTreeSet<_> = names.iter().collect();
    assert_eq!(distinct.len(), names.len());
}

#[test]
fn exact_frames_read_back() {
    let scratch = Scratch::new("frames");
    flown(
        &scratch.0,
        &[
            "run",
            "benchmark-2",
            "--out",
            "run",
            "--quiet",
            "--set",
            "time.steps=5",
        ],
    );
    let case = LoadedCase::find("benchmark-2", &["time.steps=5".to_owned()]).unwrap();
    let mut flight = Simulation::new(case.setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let snapshot = flight.snapshot();
    let text = fs::read_to_string(scratch.0.join("run/frames/surfaces_000005.vtp")).unwrap();
    let points: Vec<f64> = array(&text, "points")
        .into_iter()
        .map(f64::from_le_bytes)
        .collect();
    let surface = &snapshot.surfaces[0];
    for (node, p) in surface.nodes.iter().zip(points.chunks(3)) {
        assert_eq!([node.x, -node.y, -node.z], [p[0], p[1], p[2]]);
    }
    let gamma: Vec<f64> = array(&text, "circulation_m2_per_s")
        .into_iter()
        .map(f64::from_le_bytes)
        .collect();
    // Right-handed about the corners; the lattice counts lift along the normal.
    let right_handed: Vec<f64> = surface.circulation.iter().map(|g| -g).collect();
    assert_eq!(gamma, right_handed);
    let corners: Vec<usize> = array(&text, "connectivity")
        .into_iter()
        .map(|b| i64::from_le_bytes(b) as usize)
        .collect();
    assert_eq!(corners, surface.quads.concat());
    let wakes = fs::read_to_string(scratch.0.join("run/frames/wakes_000005.vtp")).unwrap();
    let count: usize = snapshot.wakes.iter().map(|w| w.nodes.len()).sum();
    assert_eq!(array(&wakes, "points").len(), 3 * count);
    let index = fs::read_to_string(scratch.0.join("run/flight.pvd")).unwrap();
    for step in 0..=5 {
        assert!(index.contains(&format!("frames/surfaces_{step:06}.vtp")));
    }
}

#[test]
fn exact_a_history_cut_in_its_last_row_is_read_up_to_it() {
    let scratch = Scratch::new("cut");
    flown(
        &scratch.0,
        &["run", "benchmark-1", "--out", "run", "--quiet"],
    );
    let path = scratch.0.join("run/history.csv");
    let whole = History::read(&path).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, &text[..text.len() - 40]).unwrap();
    let cut = History::read(&path).unwrap();
    assert_eq!(cut.rows() + 1, whole.rows());
    assert_eq!(cut.column("time_s"), &whole.column("time_s")[..cut.rows()]);
    fs::write(&path, "not a history\n").unwrap();
    assert!(
        History::read(&path)
            .unwrap_err()
            .to_string()
            .contains("not a history of wingbeat")
    );
}

#[test]
fn exact_overwrite_replaces_an_earlier_run_only() {
    let scratch = Scratch::new("overwrite");
    flown(
        &scratch.0,
        &["run", "benchmark-1", "--out", "run", "--quiet"],
    );
    fs::write(scratch.0.join("run/notes.txt"), "mine").unwrap();
    let again = [
        "run",
        "benchmark-2",
        "--out",
        "run",
        "--overwrite",
        "--quiet",
        "--set",
        "time.steps=3",
    ];
    flown(&scratch.0, &again);
    assert_eq!(manifest(&scratch.0.join("run")).case, "benchmark-2");
    assert!(!scratch.0.join("run/frames/wakes_000010.vtp").exists());
    assert_eq!(
        fs::read_to_string(scratch.0.join("run/notes.txt")).unwrap(),
        "mine"
    );
}

#[test]
fn exact_default_directories_are_numbered() {
    let scratch = Scratch::new("number");
    for _ in 0..2 {
        flown(&scratch.0, &["run", "benchmark-1", "--quiet"]);
    }
    assert!(
        scratch
            .0
            .join("results/benchmark-1/manifest.json")
            .is_file()
    );
    assert!(
        scratch
            .0
            .join("results/benchmark-1-2/manifest.json")
            .is_file()
    );
}

#[cfg(unix)]
#[test]
fn exact_ctrl_c_and_sigterm_end_a_run_with_everything_written() {
    for signal in ["-INT", "-TERM"] {
        let scratch = Scratch::new(&format!("signal{signal}"));
        let args = [
            "run",
            "fruit-fly-tethered",
            "--out",
            "run",
            "--set",
            "time.beats=500",
        ];
        let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
        let mut child = command
            .current_dir(&scratch.0)
            .args(args)
            .args([
                "--set",
                "air.shed=[\"trailing\"]",
                "--set",
                "air.max_wake_rows=5",
            ])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let history = scratch.0.join("run/history.csv");
        let rows = || fs::read_to_string(&history).map_or(0, |t| t.lines().count());
        while rows() < 4 {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        let id = child.id().to_string();
        assert!(
            Command::new("kill")
                .args([signal, &id])
                .status()
                .unwrap()
                .success()
        );
        let code = child.wait().unwrap().code();
        assert_eq!(code, Some(130), "{signal}");
        let manifest = manifest(&scratch.0.join("run"));
        assert_eq!(manifest.outcome, Outcome::Interrupted);
        assert_eq!(History::read(&history).unwrap().rows(), manifest.steps + 1);
        let summary = fs::read_to_string(scratch.0.join("run/summary.txt")).unwrap();
        assert!(summary.contains("was interrupted; everything up to there is written"));
    }
}

/// Without a directory the latest run in `results` is meant, and named.
#[test]
fn behaves_show_and_view_take_the_latest_run() {
    let scratch = Scratch::new("latest");
    for command in ["show", "view"] {
        let out = wingbeat(&scratch.0, &[command]);
        let said = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{said}");
        assert!(said.contains("there is none in results/ here"), "{said}");
    }
    for steps in ["time.steps=4", "time.steps=6"] {
        let args = ["run", "benchmark-2", "--quiet", "--set", steps];
        flown(&scratch.0, &args);
    }
    let named = wingbeat(&scratch.0, &["show", "results/benchmark-2-2"]);
    let latest = wingbeat(&scratch.0, &["show"]);
    let path = String::from_utf8_lossy(&latest.stderr);
    assert!(path.trim().ends_with("benchmark-2-2"), "{path}");
    assert!(named.stdout == latest.stdout && !named.stdout.is_empty());
    let page = wingbeat(&scratch.0, &["view", "--no-open"]);
    let wrote = String::from_utf8_lossy(&page.stdout);
    assert!(wrote.contains("benchmark-2-2"), "{wrote}");
}

#[test]
fn exact_show_and_compare_say_what_the_summary_says() {
    let scratch = Scratch::new("show");
    for (out, steps) in [("one", "time.steps=4"), ("two", "time.steps=6")] {
        let args = [
            "run",
            "benchmark-2",
            "--out",
            out,
            "--quiet",
            "--set",
            steps,
        ];
        flown(&scratch.0, &args);
    }
    let said = |args: &[&str]| {
        let out = wingbeat(&scratch.0, args);
        assert!(
            out.status.success(),
            "{}",
            String::from_utf8_lossy(&out.stderr)
        );
        String::from_utf8(out.stdout).unwrap()
    };
    let summary = fs::read_to_string(scratch.0.join("one/summary.txt")).unwrap();
    assert!(said(&["show", "one"]).starts_with(&summary));
    let json: serde_json::Value = serde_json::from_str(&said(&["show", "one", "--json"])).unwrap();
    let written = fs::read_to_string(scratch.0.join("one/summary.json")).unwrap();
    let written: serde_json::Value = serde_json::from_str(&written).unwrap();
    assert_eq!(json["summary"], written);
    assert_eq!(json["manifest"]["steps"], 4);
    let compared = said(&["compare", "one", "two"]);
    let lines = compared.lines().filter(|l| !l.is_empty());
    let differ: Vec<&str> = lines.take_while(|l| !l.contains("of the first")).collect();
    assert_eq!(differ[0], "one and two: cases that differ in");
    let words: Vec<&str> = differ[1].split_whitespace().collect();
    assert_eq!(words, ["time.steps", "4", "6"]);
    assert_eq!(differ.len(), 2, "only that key differs: {compared}");
    assert!(said(&["compare", "one", "one"]).contains("the same case"));
    let compared: serde_json::Value =
        serde_json::from_str(&said(&["compare", "one", "two", "--json"])).unwrap();
    let key = serde_json::json!({ "key": "time.steps", "first": "4", "second": "6" });
    assert_eq!(compared["keys"], serde_json::json!([key]));
    let steps = compared["numbers"]
        .as_array()
        .unwrap()
        .iter()
        .find(|r| r["what"] == "steps")
        .unwrap();
    assert_eq!(
        (&steps["first"], &steps["second"]),
        (&4.0.into(), &6.0.into())
    );
}

/// In pitch the air that moves with the wings has half the inertia of such a body.
#[test]
fn limit_a_flyer_that_is_light_in_pitch_does_not_alternate() {
    let scratch = Scratch::new("alternating");
    let dir = &scratch.0;
    // Free, light in pitch: the air that its wings carry along has half its inertia.
    let coarse = [
        "flight.mode=free",
        "body.inertia_about_centre_kg_m2=[1e-3, 4e-5, 1e-3, 0, 0, 0]",
        "wing.right.mass_kg=1e-6",
        "wing.right.mesh.chordwise=3",
        "wing.right.mesh.spanwise=6",
        "air.scheme=accurate",
        "time.beats=1.5",
        "output.page=false",
        "output.frames_every=0",
    ];
    let sets: Vec<&str> = coarse.iter().flat_map(|s| ["--set", s]).collect();
    let run = |more: &[&str], out: &str| {
        let args = [
            &["run", "flapping-rectangles", "--quiet", "--out", out],
            &sets[..],
            more,
        ]
        .concat();
        wingbeat(dir, &args);
        let text = fs::read_to_string(dir.join(out).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        let warnings = summary["warnings"].to_string();
        (summary["alternating_steps"].as_u64().unwrap(), warnings)
    };
    // By differences over steps alone hamming let them alternate.
    for integrator in ["hamming", "bdf"] {
        let set = format!("dynamics.integrator={integrator}");
        let (steps, warnings) = run(&["--set", &set], integrator);
        assert!(
            steps < 5 && !warnings.contains("alternate"),
            "{integrator}: {steps} {warnings}"
        );
    }
}

#[test]
fn behaves_an_ensemble_parts_and_is_the_same_on_any_number_of_threads() {
    let scratch = Scratch::new("ensemble");
    let dir = &scratch.0;
    let fly = |more: &[&str]| {
        let coarse = [
            "ensemble",
            "fruit-fly-tethered",
            "--members",
            "3",
            "--json",
            "--set=time.beats=4",
            "--set=time.steps_per_beat=20",
            "--set=wing.right.mesh.chordwise=2",
            "--set=wing.right.mesh.spanwise=4",
        ];
        wingbeat(dir, &[&coarse[..], more].concat())
    };
    let one = fly(&["--threads", "1"]);
    assert!(
        one.status.success(),
        "{}",
        String::from_utf8_lossy(&one.stderr)
    );
    assert_eq!(one.stdout, fly(&["--threads", "2"]).stdout);
    let told: serde_json::Value = serde_json::from_slice(&one.stdout).unwrap();
    let spread = |k: usize| told["ensemble"]["beats"][k]["spread"].as_f64().unwrap();
    // A millionth of the wings' speed changes forces by some millionths; separated flow makes more of it, beat by beat.
    assert!(spread(0) > 0.0 && spread(0) < 1e-4, "{}", spread(0));
    assert!(spread(3) > spread(0), "{told}");
    // They differ by far less than their beats do: they are one flight yet, and of two beats its mean has no error.
    assert!(spread(3) < 0.01, "{}", spread(3));
    assert_eq!(told["ensemble"]["members_are"], "one_flight");
    assert!(told["ensemble"]["means"]["lift_newton"]["standard_error"].is_null());
    let remark = told["remark"].as_str().unwrap_or_default();
    assert!(
        remark.contains("have not parted") && remark.contains("fly longer"),
        "{remark}"
    );
    let refused = fly(&["--set=air.model=none"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(
        said.contains("a breath of wind in a vortex lattice"),
        "{said}"
    );
}
