//! Never lose a run: killed at any moment or out of disk, it goes on bit for bit; what cannot be
//! gone on from is refused with the reason.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[path = "resume/lost_frames.rs"]
mod lost_frames;
mod support;

use support::{Scratch, refused_untouched, wingbeat};
use wingbeat::case::LoadedCase;
use wingbeat::flight::Simulation;
use wingbeat::results::{History, Manifest, Outcome, ResultDir, RunWriter};
use wingbeat::results::{checkpoint, saver};

/// A short flight with wakes of rings and particles: held at first, then free.
const CASE: [&str; 16] = [
    "fruit-fly-hover",
    "--quiet",
    "--set",
    "time.beats=0.75",
    "--set",
    "wing.right.mesh.spanwise=6",
    "--set",
    "flight.held_beats=0.2",
    "--set",
    "air.shed=[\"trailing\"]",
    "--set",
    "air.particles={after_rows=8,radius_m=2.5e-4}",
    "--set",
    "air.body=false",
    "--set",
    "output.checkpoint_every=3",
];

fn fly(dir: &Path, out: &str) -> PathBuf {
    let args = [&["run", "--out", out][..], &CASE].concat();
    let done = wingbeat(dir, &args);
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    dir.join(out)
}

fn manifest(dir: &Path) -> Manifest {
    ResultDir::open(dir).unwrap().manifest().unwrap()
}

/// Everything the flight itself left behind: history, frames, index, numbers of the summary.
fn remains(dir: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files: Vec<PathBuf> = fs::read_dir(dir.join("frames"))
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    files.extend(["history.csv", "flight.pvd", "case.toml", "summary.json"].map(|f| dir.join(f)));
    files.sort();
    let name = |f: &PathBuf| f.strip_prefix(dir).unwrap().to_owned();
    files
        .iter()
        .map(|f| (name(f), fs::read(f).unwrap()))
        .collect()
}

fn assert_same(killed: &Path, whole: &Path, what: &str) {
    let (a, b) = (remains(killed), remains(whole));
    let names = |r: &[(PathBuf, Vec<u8>)]| r.iter().map(|f| f.0.clone()).collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b), "{what}");
    for ((name, x), (_, y)) in a.iter().zip(&b) {
        assert!(x == y, "{what}: {} differs", name.display());
    }
}

/// Kills `wingbeat ARGS` after `delay`, unless it is done before.
fn kill_after(dir: &Path, args: &[&str], signal: &str, delay: Duration) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    command.current_dir(dir).args(args);
    let mut child = command
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(delay);
    if child.try_wait().unwrap().is_none() {
        let id = child.id().to_string();
        Command::new("kill").args([signal, &id]).status().unwrap();
    }
    child.wait().unwrap();
}

/// Flies and is killed until `n` kills have met a flight, at moments spread evenly but without order
/// (multiples of the golden ratio), each time gone on with to the end.
#[cfg(unix)]
fn kills(n: usize) {
    let scratch = Scratch::new(&format!("kills-{n}"));
    let begun = Instant::now();
    let whole = fly(&scratch.0, "whole");
    let duration = begun.elapsed();
    let (mut resumed, mut k) = (0, 0);
    while resumed < n {
        assert!(k < 10 * n, "only {resumed} of {k} kills met a flight");
        let moment = (k as f64 * 0.618_033_988_749_895 + 0.35).fract();
        let signal = ["-KILL", "-TERM", "-INT"][k % 3];
        k += 1;
        let out = format!("killed-{k}");
        let args = [&["run", "--out", &out][..], &CASE].concat();
        kill_after(&scratch.0, &args, signal, duration.mul_f64(moment));
        let dir = scratch.0.join(&out);
        if !dir.join("case.toml").is_file() {
            fly(&scratch.0, &format!("{out}/again")); // killed before there was anything
            continue;
        }
        assert!(prefix_is_readable(&dir), "kill {k}: no readable prefix");
        resumed += usize::from(manifest(&dir).outcome != Outcome::Finished);
        let again = ["resume", &out, "--quiet"];
        if k % 5 == 4 {
            kill_after(&scratch.0, &again, "-KILL", duration.mul_f64(0.5)); // killed twice
        }
        let done = wingbeat(&scratch.0, &again);
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert!(done.status.success(), "kill {k} ({signal}): {said}");
        assert_same(&dir, &whole, &format!("kill {k} ({signal} at {moment:.2})"));
        assert!(!dir.join("checkpoint.bin").exists());
        fs::remove_dir_all(&dir).unwrap();
    }
    println!("{k} kills, {resumed} of them in the middle of the flight, all histories the same");
}

/// Whether history.csv is readable as far as it goes; it may be empty at the very start.
fn prefix_is_readable(dir: &Path) -> bool {
    let path = dir.join("history.csv");
    let rows = fs::read_to_string(&path).map_or(0, |t| t.lines().count());
    rows < 2 || History::read(&path).is_ok()
}

#[cfg(unix)]
#[test]
fn exact_killed_runs_go_on_bit_for_bit() {
    kills(5);
}

#[cfg(unix)]
#[test]
#[ignore = "slow: fifty flights"]
fn exact_fifty_killed_runs_go_on_bit_for_bit() {
    kills(50);
}

/// Flies in this process up to `step`, saves, writes `more` steps, and drops everything.
fn abandon(dir: &Path, case: &LoadedCase, step: usize, more: usize) {
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut writer = RunWriter::new(ResultDir::create(dir).unwrap(), case, 1).unwrap();
    writer.write(flight.record(), || flight.snapshot()).unwrap();
    for k in 0..=step + more {
        if k == step {
            writer.save(flight.state()).unwrap();
        }
        if !flight.finished() {
            flight.step().unwrap();
            writer.write(flight.record(), || flight.snapshot()).unwrap();
        }
    }
}

#[test]
fn exact_every_step_can_be_gone_back_to() {
    let scratch = Scratch::new("steps");
    let set = [
        "wing.right.mesh.chordwise=2",
        "wing.right.mesh.spanwise=4",
        "time.beats=0.3",
        "flight.held_beats=0.125",
        "air.body=false",
        "air.shed=[\"trailing\"]",
    ];
    let set: Vec<String> = set.map(str::to_owned).into();
    let case = LoadedCase::find("fruit-fly-hover", &set).unwrap();
    let steps = case.setup.time.steps;
    abandon(&scratch.0.join("whole"), &case, steps, 0);
    let whole = fs::read(scratch.0.join("whole/history.csv")).unwrap();
    for step in 0..=steps {
        let dir = scratch.0.join(format!("cut-{step}"));
        abandon(&dir, &case, step, step % 4);
        let saved = saver::read(&dir).unwrap();
        let (header, state) = saved.checkpoint.unwrap();
        assert_eq!((header.step, state.step), (step, step));
        let mut flight = Simulation::resume(case.setup.clone(), state).unwrap();
        let again = ResultDir::open(&dir).unwrap();
        let mut writer = RunWriter::resume(again, &case, &header, saved.manifest, 1).unwrap();
        while !flight.finished() {
            flight.step().unwrap();
            writer.write(flight.record(), || flight.snapshot()).unwrap();
        }
        assert!(
            fs::read(dir.join("history.csv")).unwrap() == whole,
            "from step {step}"
        );
    }
}

/// A run that was interrupted after a few steps, with its checkpoint.
fn interrupted(dir: &Path) -> Vec<u8> {
    let set: Vec<String> = CASE[2..]
        .iter()
        .filter(|a| a.contains('='))
        .map(|a| a.to_string())
        .collect();
    let case = LoadedCase::find(CASE[0], &set).unwrap();
    abandon(dir, &case, 2, 1);
    fs::read(dir.join("checkpoint.bin")).unwrap()
}

fn refused(dir: &Path, reason: &str) {
    refused_untouched(dir, &["resume", ".", "--quiet"], reason);
}

#[test]
fn refuses_damaged_foreign_and_outdated_checkpoints() {
    let scratch = Scratch::new("damage");
    let dir = scratch.0.join("run");
    let whole = interrupted(&dir);
    let path = dir.join("checkpoint.bin");
    for cut in [0, 1, 30, 100, whole.len() / 2, whole.len() - 1] {
        fs::write(&path, &whole[..cut]).unwrap();
        refused(
            &dir,
            if cut < 100 {
                "not a checkpoint of wingbeat"
            } else {
                "checksum is wrong"
            },
        );
    }
    for at in [3, 21, 40, 90, 200, whole.len() / 2, whole.len() - 1] {
        let mut flipped = whole.clone();
        flipped[at] ^= 0x10;
        fs::write(&path, &flipped).unwrap();
        refused(&dir, "checkpoint.bin");
    }
    let case_sha256 = manifest(&dir).case_sha256;
    let (header, state) = checkpoint::decode(&path, &whole, &case_sha256).unwrap();
    let old = checkpoint::Header {
        version: "0.0.9".to_owned(),
        ..header.clone()
    };
    fs::write(&path, checkpoint::encode(&old, &state)).unwrap();
    refused(&dir, "written by wingbeat 0.0.9, this is");
    let other = checkpoint::Header {
        case_sha256: "0".repeat(64),
        ..header.clone()
    };
    fs::write(&path, checkpoint::encode(&other, &state)).unwrap();
    refused(&dir, "belongs to another case");
    let late = checkpoint::Header { step: 3, ..header };
    fs::write(&path, checkpoint::encode(&late, &state)).unwrap();
    refused(&dir, "does not fit the header");
    fs::write(&path, &whole).unwrap();
    fs::write(dir.join("history.csv"), "step_count,time_s\n0,0\n").unwrap();
    refused(&dir, "it was cut or changed");
}

#[test]
fn refuses_directories_that_cannot_be_gone_on_with() {
    let scratch = Scratch::new("foreign");
    refused(&scratch.0, "not a result directory of wingbeat");
    let dir = scratch.0.join("run");
    interrupted(&dir);
    let case = fs::read_to_string(dir.join("case.toml")).unwrap();
    fs::write(dir.join("case.toml"), format!("{case}\n# changed\n")).unwrap();
    refused(&dir, "belongs to another case");
    fs::remove_file(dir.join("checkpoint.bin")).unwrap();
    refused(&dir, "the case was changed after the run began");
    fs::remove_file(dir.join("case.toml")).unwrap();
    refused(&dir, "case.toml is missing");
    fs::write(dir.join("manifest.json"), "{").unwrap();
    refused(&dir, "the manifest cannot be read");
}

/// Exports and figures show the part that was flown before: what goes on removes them, and nothing else. Where there is
/// no checkpoint, that is what is said, whether it was lost or never written.
#[test]
fn behaves_going_on_removes_exports_and_figures_of_the_part_before() {
    let scratch = Scratch::new("exports");
    let dir = scratch.0.join("run");
    interrupted(&dir);
    fs::create_dir_all(dir.join("figures")).unwrap();
    let [old, own] = [
        ["flight.h5", "figures/forces.svg"],
        ["notes.txt", "figures/own.svg"],
    ]
    .map(|names| names.map(|name| dir.join(name)));
    for path in old.iter().chain(&own) {
        fs::write(path, "before").unwrap();
    }
    let done = wingbeat(&dir, &["resume", ".", "--quiet"]);
    assert!(done.status.success(), "{done:?}");
    assert!(!old[0].exists());
    let drawn = fs::read_to_string(&old[1]); // again, at the end of the flight
    assert!(drawn.is_ok_and(|text| text.contains("<svg")));
    assert!(own.iter().all(|path| path.exists()));
    let other = scratch.0.join("other");
    interrupted(&other);
    fs::remove_file(other.join("checkpoint.bin")).unwrap();
    fs::write(other.join("flight.h5"), "before").unwrap();
    let done = wingbeat(&other, &["resume", ".", "--quiet"]);
    assert!(!other.join("flight.h5").exists());
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(
        said.contains("it has no checkpoint (checkpoint.bin): it is flown from the start"),
        "{said}"
    );
}

/// What processes that were killed left of a run's files, of its exports and figures.
#[cfg(unix)]
#[test]
fn behaves_going_on_removes_what_dead_processes_left() {
    let scratch = Scratch::new("left");
    let left = [
        "checkpoint.bin.4711.part",
        "flight.glb.4711.part",
        "figures/animation.gif.4711-1.part",
        "frames/wakes_000000.vtp.4711.part",
    ];
    // Before the first checkpoint, after it, at the end; another process writes an export meanwhile.
    for (name, is_saved) in [("start", false), ("middle", true)] {
        let dir = scratch.0.join(name);
        interrupted(&dir);
        if !is_saved {
            fs::remove_file(dir.join("checkpoint.bin")).unwrap();
        }
        fs::create_dir_all(dir.join("figures")).unwrap();
        let writing = dir.join("flight.h5.4712.part");
        let file = fs::File::create(&writing).unwrap();
        file.lock().unwrap();
        for _ in 0..2 {
            for name in left {
                fs::write(dir.join(name), "half").unwrap();
            }
            let done = wingbeat(&dir, &["resume", ".", "--quiet"]);
            let said = String::from_utf8_lossy(&done.stderr);
            assert!(done.status.success(), "{said}");
            assert!(!left.iter().any(|name| dir.join(name).exists()), "{name}");
            assert!(writing.exists());
        }
    }
}

#[test]
fn refuses_a_second_writer() {
    let scratch = Scratch::new("second");
    let dir = scratch.0.join("run");
    interrupted(&dir);
    let held = fs::File::open(dir.join("history.csv")).unwrap();
    held.lock().unwrap();
    refused(&dir, "another wingbeat is writing it right now");
    let over = [
        "run",
        "benchmark-1",
        "--out",
        "run",
        "--overwrite",
        "--quiet",
    ];
    let done = wingbeat(&scratch.0, &over);
    assert_eq!(done.status.code(), Some(2));
    drop(held);
    let done = wingbeat(&dir, &["resume", ".", "--quiet"]);
    assert!(done.status.success());
    let done = wingbeat(&dir, &["resume", "."]);
    assert!(String::from_utf8_lossy(&done.stdout).contains("has already finished"));
    let done = wingbeat(&dir, &["resume", ".", "--json"]);
    let line: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let written = fs::read(dir.join("summary.json")).unwrap();
    let written: serde_json::Value = serde_json::from_slice(&written).unwrap();
    assert_eq!(line["summary"], written);
}

/// No file may grow beyond `blocks` of 512 bytes: the system then answers as on a full disk.
#[cfg(unix)]
fn with_quota(dir: &Path, blocks: usize, args: &[&str]) -> std::process::Output {
    let program = env!("CARGO_BIN_EXE_wingbeat");
    let script = format!("ulimit -f {blocks}; exec \"{program}\" \"$@\"");
    let mut command = Command::new("sh");
    command
        .current_dir(dir)
        .args(["-c", &script, "sh"])
        .args(args);
    command.output().unwrap()
}

fn assert_stopped(done: &std::process::Output, what: &str) {
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{what}: {said}");
    for part in [
        "cannot write",
        "free some space",
        "wingbeat resume",
        "bit for bit",
    ] {
        assert!(said.contains(part), "{what}: {said}\ndoes not say: {part}");
    }
}

#[cfg(unix)]
#[test]
fn exact_a_run_that_met_a_quota_goes_on_after_it() {
    let scratch = Scratch::new("quota");
    let whole = fly(&scratch.0, "whole");
    for kilobytes in [32, 45] {
        let out = format!("quota-{kilobytes}");
        let args = [&["run", "--out", &out][..], &CASE].concat();
        assert_stopped(&with_quota(&scratch.0, 2 * kilobytes, &args), &out);
        let dir = scratch.0.join(&out);
        let history = History::read(&dir.join("history.csv")).unwrap();
        assert!(history.rows() > 1 && history.rows() < 31);
        let again = wingbeat(&scratch.0, &["resume", &out, "--quiet"]);
        let said = String::from_utf8_lossy(&again.stderr);
        assert!(again.status.success() && said.is_empty(), "{said}");
        assert_same(&dir, &whole, &out);
    }
}

/// On a file system of its own that is too small; needs leave to mount one.
#[cfg(target_os = "linux")]
#[test]
fn exact_a_run_that_met_a_full_disk_goes_on_after_it() {
    let scratch = Scratch::new("disk");
    let disk = scratch.0.join("disk");
    fs::create_dir(&disk).unwrap();
    let mount = |options: &str| {
        let mut command = Command::new("mount");
        command
            .args(["-t", "tmpfs", "-o", options, "tmpfs"])
            .arg(&disk);
        command
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|s| s.success())
    };
    if !mount("size=200k") {
        println!("skipped: a small file system cannot be mounted here");
        return;
    }
    let whole = fly(&scratch.0, "whole");
    let args = [&["run", "--out", "disk/run"][..], &CASE].concat();
    let stopped = wingbeat(&scratch.0, &args);
    let freed = mount("remount,size=64m");
    let again = wingbeat(&scratch.0, &["resume", "disk/run", "--quiet"]);
    let compared = std::panic::catch_unwind(|| {
        assert_stopped(&stopped, "full disk");
        assert!(
            freed && again.status.success(),
            "{}",
            String::from_utf8_lossy(&again.stderr)
        );
        assert_same(&disk.join("run"), &whole, "full disk");
    });
    Command::new("umount").arg(&disk).status().unwrap();
    compared.unwrap();
}
