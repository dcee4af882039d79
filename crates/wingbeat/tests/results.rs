//! Result directories: complete, rerunnable bit for bit, readable when a run is cut.

mod read;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use wingbeat::case::LoadedCase;
use wingbeat::flight::Simulation;
use wingbeat::results::{self, History, Manifest, Outcome};

use crate::support::{Scratch, array, flown};

fn manifest(dir: &Path) -> Manifest {
    serde_json::from_str(&fs::read_to_string(dir.join("manifest.json")).unwrap()).unwrap()
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
    // As a process that was killed leaves them.
    let left = [
        "manifest.json.4711.part",
        "checkpoint.bin.4711.part",
        "frames/wakes_000010.vtp.4711.part",
        "flight.glb.4711.part",
        "figures/animation.gif.4711-1.part",
    ];
    for name in left {
        fs::write(scratch.0.join("run").join(name), "half").unwrap();
    }
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
    assert!(
        !left
            .iter()
            .any(|name| scratch.0.join("run").join(name).exists())
    );
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
        for drawn in ["flight.html", "figures/angles.svg"] {
            assert!(scratch.0.join("run").join(drawn).is_file(), "{drawn}");
        }
    }
}
