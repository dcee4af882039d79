//! Every command that opens a result says what is wrong with a damaged one: exit code 2, a
//! sentence that names the file, no panic, nothing changed.

use std::fs;
use std::path::{Path, PathBuf};

use wingbeat::results::{checkpoint, manifest::sha256};

use crate::support::{Scratch, flown, wingbeat};

/// A short flight with wakes.
const CASE: [&str; 14] = [
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
    "--set=output.keep_checkpoint=true",
    "--set=air.particles={after_rows=4,radius_m=2.5e-4}",
];

/// What opens the result `run`, and whether it needs the frames.
const COMMANDS: [(&[&str], bool); 13] = [
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
    (&VELOCITY, false),
];

/// Reads the checkpoint, too.
const VELOCITY: [&str; 4] = ["velocity", "run", "--point", "0.002,0.001,0"];

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

/// The last line of a text.
fn last_row(text: &[u8]) -> Vec<u8> {
    let mut lines = text.split_inclusive(|b| *b == b'\n');
    lines.next_back().unwrap_or_default().to_vec()
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
    let again = "fly the case.toml of this result again";
    with_damage(dir, "manifest.json", b"\xff\xfe", false, again);
    with_damage(dir, "manifest.json", b"{}", false, again);
    with_damage(dir, "case.toml", &cut("case.toml"), false, "case.toml");
    with_damage(dir, "case.toml", b"\xff\xfe\x00", false, "case.toml");
    with_damage(dir, "history.csv", b"", false, "history.csv");
    with_damage(dir, "history.csv", b"a,b\n1,2\n", false, "history.csv");
    let letter = flipped("history.csv", history - 40, b'x');
    with_damage(dir, "history.csv", &letter, false, "history.csv");
    // A row that the finished flight did not write; half of one, too.
    for extra in [last_row(&read("history.csv")), b"41,".to_vec()] {
        let longer = [read("history.csv"), extra].concat();
        with_damage(dir, "history.csv", &longer, false, "history.csv");
        let path = dir.join("run/history.csv");
        let whole = read("history.csv");
        fs::write(&path, longer).unwrap();
        refused(dir, &["resume", "run"], "history.csv");
        fs::write(&path, whole).unwrap();
    }
    // A damaged index is blamed itself, not the frames it names wrongly.
    let index = "flight.pvd";
    with_damage(dir, index, &cut(index), true, "flight.pvd`: ");
    let at = read(index).len() / 2;
    let digit = flipped(index, at, b'7');
    with_damage(dir, index, &digit, true, "flight.pvd`: ");
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
    let particles = "frames/particles_000004.vtp";
    with_damage(
        dir,
        particles,
        &cut(particles),
        true,
        "particles_000004.vtp",
    );
    with_damage(dir, particles, &foreign, true, "particles_000004.vtp");
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
        ("frames/particles_000004.vtp", true),
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
                let said = outcome(dir, args).1;
                assert!(said.contains("put it back"), "{args:?}: {said}");
                assert!(said.contains("again"), "{args:?}: {said}");
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

#[test]
fn agrees_velocity_of_the_air_with_the_flight_and_refuses_damage() {
    let scratch = Scratch::new("damage-velocity");
    let dir = &scratch.0;
    flown(dir, &CASE);
    let case = dir.join("run/case.toml");
    let case = wingbeat::case::LoadedCase::from_file(&case, &[]).unwrap();
    let mut flight = wingbeat::flight::Simulation::new(case.setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let place = wingbeat::math::DVec3::new(0.002, 0.001, 0.0);
    let places = [place].into_iter().collect();
    let velocity = flight.air_velocity(&places).unwrap().unwrap().get(0);
    let out = wingbeat(dir, &VELOCITY);
    let table = String::from_utf8(out.stdout).unwrap();
    let row = table.lines().nth(1).unwrap();
    let numbers: Vec<f64> = row.split(',').map(|x| x.parse().unwrap()).collect();
    let wanted = [&place.to_array()[..], &velocity.to_array(), &[1.0]].concat();
    assert_eq!(numbers, wanted);
    let path = dir.join("run/checkpoint.bin");
    let whole = fs::read(&path).unwrap();
    let damage = |bytes: &[u8], reason: &str| {
        fs::write(&path, bytes).unwrap();
        refused(dir, &VELOCITY, "checkpoint.bin");
        let said = outcome(dir, &VELOCITY).1;
        assert!(said.contains(reason), "{said}");
    };
    damage(b"", "this is not a checkpoint");
    damage(&whole[..whole.len() / 2], "the checksum is wrong");
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 1;
    damage(&flipped, "the checksum is wrong");
    damage(b"wingbeat-checkpoint 999 \nmore", "another format");
    fs::remove_file(&path).unwrap();
    refused(dir, &VELOCITY, "output.keep_checkpoint=true");
    fs::write(&path, &whole).unwrap();
    // A flight without a wake has no air to ask.
    flown(
        dir,
        &[
            "run",
            "fruit-fly-vacuum",
            "--quiet",
            "--out",
            "bare",
            "--set=time.beats=0.1",
            "--set=output.keep_checkpoint=true",
        ],
    );
    refused(
        dir,
        &["velocity", "bare", "--point", "0,0,0"],
        "no vortex lattice",
    );
}

/// Writes a history into the result as another build would have: its checksums in the manifest and in the checkpoint.
fn put_history(run: &Path, history: &str) {
    let sum = sha256(history.as_bytes());
    let path = run.join("manifest.json");
    let mut manifest: serde_json::Value =
        serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    manifest["history_bytes"] = history.len().into();
    manifest["history_sha256"] = sum.clone().into();
    fs::write(path, manifest.to_string()).unwrap();
    let path = run.join("checkpoint.bin");
    let case = manifest["case_sha256"].as_str().unwrap();
    let (header, state) = checkpoint::decode(&path, &fs::read(&path).unwrap(), case).unwrap();
    let header = checkpoint::Header {
        history_bytes: history.len() as u64,
        history_sha256: sum,
        ..header
    };
    fs::write(path, checkpoint::encode(&header, &state)).unwrap();
    fs::write(run.join("history.csv"), history).unwrap();
}

/// Results of other builds, whole by their own checksums: of another format, with a column under another name, without
/// one. Whatever reads them says the same.
#[test]
fn refuses_results_of_other_builds_in_every_command() {
    const AGAIN: &str =
        "another build of wingbeat wrote this result; fly the case.toml of this result again";
    let scratch = Scratch::new("other-build");
    let dir = &scratch.0;
    flown(dir, &CASE);
    let run = dir.join("run");
    let manifest = fs::read_to_string(run.join("manifest.json")).unwrap();
    for (change, found) in [
        (["\"format\"", "\"mode\""], "the result has no format"),
        (
            ["\"format\": 1", "\"format\": 0"],
            "the result has format 0",
        ),
    ] {
        fs::write(
            run.join("manifest.json"),
            manifest.replacen(change[0], change[1], 1),
        )
        .unwrap();
        for args in COMMANDS.iter().map(|c| c.0).chain([&["resume", "run"][..]]) {
            clear(dir);
            refused(dir, args, found);
            refused(dir, args, AGAIN);
        }
    }
    let manifest = manifest.replacen("\"finished\"", "\"interrupted\"", 1);
    fs::write(run.join("manifest.json"), manifest).unwrap();
    let text = fs::read_to_string(run.join("history.csv")).unwrap();
    let rows = text.lines().map(|row| row.rsplit_once(',').unwrap());
    let removed: String = rows.map(|(rest, _)| format!("{rest}\n")).collect();
    let renamed = text.replacen("hinge_work_joule", "hinge_work_calorie", 1);
    for (history, found) in [
        (removed, "is missing"),
        (renamed, "`hinge_work_joule` is missing"),
    ] {
        put_history(&run, &history);
        let readers = COMMANDS
            .iter()
            .map(|c| c.0)
            .filter(|args| *args != VELOCITY); // reads the state alone
        for args in readers.chain([&["resume", "run"][..]]) {
            clear(dir);
            refused(dir, args, "history.csv");
            refused(dir, args, found);
            refused(dir, args, AGAIN);
        }
    }
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
