//! Every command that opens a result says what is wrong with a damaged one: exit code 2, a
//! sentence that names the file, no panic, nothing changed.

use std::fs;
use std::path::{Path, PathBuf};

mod support;

use support::{Scratch, flown, wingbeat};

/// A short flight with wakes.
const CASE: [&str; 12] = [
    "run",
    "fruit-fly-hover",
    "--quiet",
    "--out",
    "run",
    "--set=time.beats=0.2",
    "--set=wing.right.mesh.spanwise=4",
    "--set=wing.right.mesh.chordwise=2",
    "--set=air.shed=[\"trailing\"]",
    "--set=air.body=false",
    "--set=output.page=false",
    "--set=output.figures=false",
];

/// What opens the result `run`, and whether it needs the frames.
const COMMANDS: [(&[&str], bool); 12] = [
    (&["show", "run"], false),
    (&["show", "run", "--json"], false),
    (&["compare", "run", "run"], false),
    (&["view", "run", "--no-open"], true),
    (&["plot", "run", "forces", "--out", "drawn"], false),
    (&["plot", "run", "lollipop", "--out", "drawn"], false),
    (
        &["plot", "run", "wake", "--step", "4", "--out", "drawn"],
        true,
    ),
    (&["plot", "run", "animation", "--out", "drawn"], true),
    (
        &["export", "run", "--format", "hdf5", "--out", "exported"],
        true,
    ),
    (
        &["export", "run", "--format", "vtkhdf", "--out", "exported"],
        true,
    ),
    (
        &["export", "run", "--format", "parquet", "--out", "exported"],
        false,
    ),
    (
        &["export", "run", "--format", "gltf", "--out", "exported"],
        false,
    ),
];

/// What happened: exit code and everything said.
fn outcome(dir: &Path, args: &[&str]) -> (i32, String) {
    let out = wingbeat(dir, args);
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    let code = out.status.code();
    assert!(!said.contains("panicked"), "{args:?} panicked:\n{said}");
    (
        code.unwrap_or_else(|| panic!("{args:?} was killed: {said}")),
        said,
    )
}

fn refused(dir: &Path, args: &[&str], file: &str) {
    let (code, said) = outcome(dir, args);
    assert_eq!(code, 2, "{args:?}: {said}");
    assert!(said.starts_with("error: "), "{args:?}: {said}");
    assert!(said.contains(file), "{args:?} does not name {file}: {said}");
    let leftovers = ["drawn", "exported"].map(|f| files(&dir.join(f)));
    let part = leftovers
        .iter()
        .flatten()
        .find(|f| f.extension().is_some_and(|e| e == "part"));
    assert!(part.is_none(), "{args:?} left {part:?}");
}

fn files(dir: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(dir).into_iter().flatten();
    let mut list: Vec<PathBuf> = entries
        .map(|e| e.unwrap().path())
        .filter(|p| p.is_file())
        .collect();
    list.sort();
    list
}

fn clear(dir: &Path) {
    for folder in ["drawn", "exported"] {
        let _ = fs::remove_dir_all(dir.join(folder));
    }
}

/// All commands on a result of which one file was made into something else.
fn with_damage(dir: &Path, file: &str, damage: &[u8], frames_only: bool, names: &str) {
    let path = dir.join("run").join(file);
    let whole = fs::read(&path).unwrap();
    fs::write(&path, damage).unwrap();
    for (args, framed) in COMMANDS {
        clear(dir);
        if framed || !frames_only {
            refused(dir, args, names);
        }
    }
    fs::write(&path, whole).unwrap();
}

#[test]
fn refuses_damaged_results_in_every_command() {
    let scratch = Scratch::new("damage-all");
    let dir = &scratch.0;
    flown(dir, &CASE);
    for (args, _) in COMMANDS {
        clear(dir);
        assert_eq!(outcome(dir, args).0, 0, "{args:?} on a whole result");
    }
    let read = |file: &str| fs::read(dir.join("run").join(file)).unwrap();
    let cut = |file: &str| read(file)[..read(file).len() / 2].to_vec();
    let flipped = |file: &str, at: usize, to: u8| {
        let mut bytes = read(file);
        bytes[at] = to;
        bytes
    };
    let history = read("history.csv").len();
    with_damage(
        dir,
        "manifest.json",
        &cut("manifest.json"),
        false,
        "manifest.json",
    );
    with_damage(dir, "case.toml", &cut("case.toml"), false, "case.toml");
    with_damage(dir, "case.toml", b"\xff\xfe\x00", false, "case.toml");
    with_damage(dir, "history.csv", b"", false, "history.csv");
    with_damage(dir, "history.csv", b"a,b\n1,2\n", false, "history.csv");
    let letter = flipped("history.csv", history - 40, b'x');
    with_damage(dir, "history.csv", &letter, false, "history.csv");
    let wakes = "frames/wakes_000004.vtp";
    with_damage(dir, wakes, &cut(wakes), true, "wakes_000004.vtp");
    with_damage(
        dir,
        wakes,
        &flipped(wakes, read(wakes).len() / 2, b'!'),
        true,
        "wakes_000004.vtp",
    );
    with_damage(dir, wakes, b"", true, "wakes_000004.vtp");
    let foreign = read("frames/wakes_000008.vtp");
    let surfaces = "frames/surfaces_000004.vtp";
    with_damage(dir, surfaces, &foreign, true, "surfaces_000004.vtp");
}

#[test]
fn refuses_missing_files_and_foreign_directories_in_every_command() {
    let scratch = Scratch::new("damage-missing");
    let dir = &scratch.0;
    flown(dir, &CASE);
    let away = dir.join("away");
    for (file, frames_only) in [
        ("frames/wakes_000004.vtp", true),
        ("frames/surfaces_000004.vtp", true),
        ("history.csv", false),
        ("case.toml", false),
        ("manifest.json", false),
    ] {
        let path = dir.join("run").join(file);
        fs::rename(&path, &away).unwrap();
        for (args, framed) in COMMANDS {
            clear(dir);
            if framed || !frames_only {
                refused(dir, args, file.rsplit('/').next().unwrap());
            }
        }
        fs::rename(&away, &path).unwrap();
    }
    fs::rename(dir.join("run"), &away).unwrap();
    for (args, _) in COMMANDS {
        refused(dir, args, "not a result directory of wingbeat");
    }
    fs::create_dir(dir.join("run")).unwrap();
    fs::write(dir.join("run/notes.txt"), "mine").unwrap();
    for (args, _) in COMMANDS.iter().chain(&[(&["resume", "run"][..], false)]) {
        refused(dir, args, "not a result directory of wingbeat");
    }
    assert_eq!(files(&dir.join("run")), [dir.join("run/notes.txt")]);
}

/// One byte of each file of a result changed at a time: whatever is done, nothing panics.
#[test]
fn refuses_or_reads_flipped_bytes_without_panic() {
    let scratch = Scratch::new("damage-flips");
    let dir = &scratch.0;
    flown(dir, &CASE);
    let names = ["manifest.json", "case.toml", "history.csv", "flight.pvd"];
    let frames = ["frames/surfaces_000004.vtp", "frames/wakes_000004.vtp"];
    let mut turn = 0_usize;
    for file in names.into_iter().chain(frames) {
        let path = dir.join("run").join(file);
        let whole = fs::read(&path).unwrap();
        for k in 0..8 {
            // Spread without order: multiples of the golden ratio.
            turn += 1;
            let part = (turn as f64 * 0.618_033_988_749_895).fract();
            let mut bytes = whole.clone();
            bytes[(part * whole.len() as f64) as usize] ^= 1 << k;
            fs::write(&path, &bytes).unwrap();
            clear(dir);
            let (args, _) = COMMANDS[turn % COMMANDS.len()];
            let (code, said) = outcome(dir, args);
            assert!(code == 0 || code == 2, "{file}, {args:?}: {said}");
        }
        fs::write(&path, &whole).unwrap();
    }
}
