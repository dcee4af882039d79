//! Exports are read by the programs they are made for: VTK, h5py, xarray, pyarrow and the Khronos
//! glTF validator, which the test installs beside itself.

mod animation;
mod circulations;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::readers::{python, readers, store, works};
use crate::support::{Scratch, flown, refused_untouched, required, wingbeat};

const CASE: [&str; 15] = [
    "run",
    "fruit-fly-hover",
    "--quiet",
    "--out",
    "run",
    "--set",
    "time.beats=0.5",
    "--set",
    "wing.right.mesh.spanwise=6",
    "--set",
    "wing.right.mesh.chordwise=3",
    "--set",
    "air.shed=[\"trailing\"]",
    "--set=air.particles={after_rows=8,radius_m=2.5e-4}",
    "--set=output.page=false",
];

/// The folder of the glTF validator.
fn validator() -> Result<PathBuf, String> {
    let store = store("node");
    if !store.join("ready").is_file() {
        fs::create_dir_all(&store).map_err(|e| e.to_string())?;
        let install = [
            "install",
            "--silent",
            "--no-audit",
            "--no-fund",
            "gltf-validator@2.0.0-dev.3.10",
        ];
        works(
            Command::new("npm")
                .args(install)
                .arg("--prefix")
                .arg(&store),
        )?;
        fs::write(store.join("ready"), "").map_err(|e| e.to_string())?;
    }
    Ok(store)
}

fn exported(scratch: &Scratch) -> PathBuf {
    flown(&scratch.0, &CASE);
    for format in ["hdf5", "vtkhdf", "parquet", "gltf"] {
        flown(&scratch.0, &["export", "run", "--format", format]);
    }
    scratch.0.join("run")
}

#[test]
fn agrees_real_readers_read_every_number_back() {
    let scratch = Scratch::new("readers");
    let run = exported(&scratch);
    match python() {
        Err(problem) => required(&format!("no Python with the readers: {problem}")),
        Ok(python) => {
            let read = works(
                Command::new(python)
                    .arg(readers().join("read.py"))
                    .arg(&run),
            );
            let said = read.unwrap_or_else(|e| panic!("{e}"));
            assert!(said.contains("21 rows, 11 frames: all equal"), "{said}");
        }
    }
    // Three bodies, ten frames with a wake, of which the last six have particles, too.
    assert_validated(&run, "\"drawCallCount\":19");
}

/// The glTF validator finds the animation of a run right, and says this of it.
fn assert_validated(run: &Path, part: &str) {
    match validator() {
        Err(problem) => required(&format!("no glTF validator: {problem}")),
        Ok(folder) => {
            let mut node = Command::new("node");
            node.arg(readers().join("validate.js"))
                .arg(folder)
                .arg(run.join("flight.glb"));
            let said = works(&mut node).unwrap_or_else(|e| panic!("{e}"));
            assert!(said.contains(part), "{said}");
        }
    }
}

#[test]
fn refuses_exports_of_what_is_not_there() {
    let scratch = Scratch::new("no-export");
    let refused = |args: &[&str], reason: &str| refused_untouched(&scratch.0, args, reason);
    refused(
        &["export", ".", "--format", "hdf5"],
        "not a result directory of wingbeat",
    );
    let args = [
        "run",
        "fruit-fly-vacuum",
        "--quiet",
        "--out",
        "run",
        "--set",
        "time.beats=0.1",
    ];
    flown(&scratch.0, &args);
    refused(
        &["export", "run", "--format", "vtkhdf"],
        "there are no frames to export",
    );
    // The folder that it would have gone into is not left behind.
    let into = ["export", "run", "--format", "vtkhdf", "--out", "into"];
    refused(&into, "there are no frames to export");
    assert!(!scratch.0.join("into").exists());
    refused(
        &["export", "run", "--format", "xlsx"],
        "hdf5, vtkhdf, parquet, gltf",
    );
    let path = scratch.0.join("run/history.csv");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replacen("0,", "zero,", 3)).unwrap();
    refused(
        &["export", "run", "--format", "parquet"],
        "it was cut or changed",
    );
    assert!(!scratch.0.join("run/history.parquet").exists());
    assert!(!scratch.0.join("run/history.parquet.part").exists());
}

/// Exports and figures remove what others that were killed left in their folder, whatever format those had.
#[cfg(unix)]
#[test]
fn behaves_the_next_writer_removes_what_dead_processes_left() {
    let scratch = Scratch::new("left-behind");
    flown(&scratch.0, &CASE);
    let left =
        ["flight.glb.4711.part", "wakes.vtkhdf.4711-1.part"].map(|f| scratch.0.join("run").join(f));
    let drawn = scratch.0.join("run/figures/animation.gif.4711.part");
    let mine = scratch.0.join("run/notes.txt.4711.part");
    fs::create_dir_all(scratch.0.join("run/figures")).unwrap();
    for file in left.iter().chain([&drawn, &mine]) {
        fs::write(file, "half").unwrap();
    }
    flown(&scratch.0, &["export", "run", "--format", "parquet"]);
    assert!(!left.iter().any(|f| f.exists()) && drawn.exists() && mine.exists());
    flown(&scratch.0, &["plot", "run", "forces", "--overwrite"]);
    assert!(!drawn.exists() && mine.exists());
}

/// A head of 0.84 mm whose middle lies 0.21 mm behind the nose, before a body held level, above a ground 5 mm below.
#[test]
fn exact_points_within_the_body_and_below_the_ground_are_not_in_the_air() {
    let scratch = Scratch::new("in-air");
    let run = [
        "run",
        "fruit-fly-tethered",
        "--quiet",
        "--out=run",
        "--set=time.beats=0.05",
        "--set=flight.pitch_deg=0",
        "--set=air.ground={point_m=[0,0,5e-3],normal=[0,0,-1]}",
        "--set=body.origin=as_given",
        "--set=output.keep_checkpoint=true",
        "--set=output.page=false",
    ];
    flown(&scratch.0, &run);
    let points = [
        ("-0.21e-3,0,0", 0),
        ("-0.21e-3,0,0.40e-3", 0),
        ("-0.21e-3,0,0.43e-3", 1),
        ("-0.21e-3,0.43e-3,0", 1),
        ("-1.945e-3,0,0.4e-3", 0),
        ("0.1e-3,0,0", 1),
        ("0,0,4.9e-3", 1),
        ("0,0,5.1e-3", 0),
    ];
    let asked: Vec<String> = points.iter().map(|(x, _)| format!("--point={x}")).collect();
    let args: Vec<&str> = asked.iter().map(String::as_str).collect();
    let out = wingbeat(&scratch.0, &[&["velocity", "run"], &args[..]].concat());
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(said.contains("warning: 4 of 8 points"), "{said}");
    let table = String::from_utf8_lossy(&out.stdout);
    let marks = table
        .lines()
        .skip(1)
        .map(|row| row.rsplit(',').next().unwrap());
    for ((point, wanted), found) in points.iter().zip(marks) {
        assert_eq!(found, wanted.to_string(), "{point}: {table}");
    }
}
