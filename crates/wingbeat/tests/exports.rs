//! Exports are read by the programs they are made for: VTK, h5py, xarray, pyarrow and the Khronos
//! glTF validator, which the test installs beside itself.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

mod support;

use support::{Scratch, flown, required, wingbeat};

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

fn readers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers")
}

/// Where the readers are installed, once.
fn store(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("readers-{name}"))
}

fn works(command: &mut Command) -> Result<String, String> {
    let out = command.output().map_err(|e| format!("{command:?}: {e}"))?;
    let said = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    match out.status.success() {
        true => Ok(said(&out.stdout)),
        false => Err(format!(
            "{command:?}: {}{}",
            said(&out.stdout),
            said(&out.stderr)
        )),
    }
}

/// A Python with the readers.
fn python() -> Result<PathBuf, String> {
    let store = store("python");
    let python = store.join("bin/python");
    let list = readers().join("requirements.txt");
    let wanted = fs::read_to_string(&list).map_err(|e| e.to_string())?;
    if fs::read_to_string(store.join("ready")).ok().as_ref() != Some(&wanted) {
        works(Command::new("python3").args(["-m", "venv"]).arg(&store))?;
        let install = [
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "-r",
        ];
        works(Command::new(&python).args(install).arg(list))?;
        fs::write(store.join("ready"), &wanted).map_err(|e| e.to_string())?;
    }
    Ok(python)
}

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
    match validator() {
        Err(problem) => required(&format!("no glTF validator: {problem}")),
        Ok(folder) => {
            let mut node = Command::new("node");
            node.arg(readers().join("validate.js"))
                .arg(folder)
                .arg(run.join("flight.glb"));
            let said = works(&mut node).unwrap_or_else(|e| panic!("{e}"));
            assert!(said.contains("\"drawCallCount\":3"), "{said}");
        }
    }
}

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

#[test]
fn refuses_exports_of_what_is_not_there() {
    let scratch = Scratch::new("no-export");
    let refused = |args: &[&str], reason: &str| {
        let out = wingbeat(&scratch.0, args);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(2), "{said}");
        assert!(said.contains(reason), "{said}\ndoes not say: {reason}");
    };
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
