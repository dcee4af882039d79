//! Files: nothing that exists is written over unasked, nothing of a run is ever replaced by
//! something of another kind, and what cannot be written whole is not left behind.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::refused_untouched as refused;
use crate::support::{Scratch, contents, flown, quick_case};

/// Folder with a case, a run with its checkpoint, and a file of the user.
fn with_run(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    let dir = &scratch.0;
    let small = [
        "run",
        "rectangular-wing",
        "--quiet",
        "--out",
        "r",
        "--set",
        "time.steps=3",
        "--set",
        "output.keep_checkpoint=true",
    ];
    flown(dir, &small);
    quick_case(dir);
    fs::write(dir.join("mine.txt"), "mine").unwrap();
    scratch
}

const VELOCITY: [&str; 4] = ["velocity", "r", "--point", "0,0,0.1"];
const TABLE: [&str; 2] = ["stability", "table1-sun-2007"];

#[test]
fn refuses_to_write_over_a_file_unasked() {
    let scratch = with_run("over");
    let dir = &scratch.0;
    let velocity = |file| [&VELOCITY[..], &["--out", file]].concat();
    let exists = "exists already and is left untouched";
    refused(dir, &velocity("mine.txt"), exists);
    refused(dir, &velocity("r"), "it is a directory");
    refused(dir, &velocity("nowhere/v.csv"), "cannot write");
    refused(dir, &[&TABLE[..], &["--out", "mine.txt"]].concat(), exists);
    // Before the work, which would take minutes.
    for option in ["--write", "--out"] {
        refused(dir, &["trim", "hawkmoth-blade", option, "mine.txt"], exists);
        refused(
            dir,
            &["stability", "hawkmoth-blade", option, "mine.txt"],
            exists,
        );
    }
    refused(
        dir,
        &["stabilise", "--beats", "90000", "--figure", "mine.txt"],
        exists,
    );
    // Nobody writes there, root neither.
    if cfg!(target_os = "linux") {
        let there = ["trim", "hawkmoth-blade", "--write", "/proc/trimmed.toml"];
        refused(dir, &there, "cannot write `/proc/trimmed.toml`");
    }
    refused(dir, &["new", "benchmark-1", "mine.txt"], exists);
    refused(dir, &["trim", "--overwrite"], "replaces nothing");
    // Asked, it is replaced.
    flown(dir, &[&velocity("mine.txt")[..], &["--overwrite"]].concat());
    assert!(
        fs::read_to_string(dir.join("mine.txt"))
            .unwrap()
            .starts_with("x_m,")
    );
    flown(dir, &["new", "benchmark-1", "mine.txt", "--overwrite"]);
    assert!(
        fs::read_to_string(dir.join("mine.txt"))
            .unwrap()
            .contains("format = 1")
    );
}

#[test]
fn refuses_a_file_of_a_run_even_when_asked() {
    let scratch = with_run("reserved");
    let dir = &scratch.0;
    fs::create_dir(dir.join("deep")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(dir.join("r"), dir.join("link")).unwrap();
    let places = [
        "r/case.toml",
        "r/checkpoint.bin",
        "r/history.csv",
        "r/manifest.json",
        "r/flight.html",
        "r/flight.h5", // not there yet
        "r/frames/surfaces_000000.vtp",
        "r/frames/new.csv",
        "r/figures/forces.svg",
        "deep/../r/case.toml",
        "link/case.toml",
    ];
    for place in places {
        let over = [&VELOCITY[..], &["--out", place, "--overwrite"]].concat();
        refused(dir, &over, "is the place of a file of a run");
        refused(
            dir,
            &["new", "benchmark-1", place, "--overwrite"],
            "of a file of a run",
        );
    }
    for option in ["--write", "--out"] {
        let over = ["trim", option, "r/case.toml", "--overwrite"];
        refused(dir, &over, "is the place of a file of a run");
    }
    // A file of the user's own beside them is no trouble.
    flown(dir, &[&VELOCITY[..], &["--out", "r/velocity.csv"]].concat());
}

#[test]
fn behaves_exports_and_figures_replace_only_when_asked() {
    let scratch = with_run("exports");
    let dir = &scratch.0;
    flown(dir, &["run", "case.toml", "--quiet", "--out", "other"]);
    fs::create_dir(dir.join("out")).unwrap();
    let formats = [
        ("hdf5", "flight.h5"),
        ("vtkhdf", "wakes.vtkhdf"),
        ("parquet", "history.parquet"),
        ("gltf", "flight.glb"),
    ];
    for (format, file) in formats {
        fs::write(dir.join("out").join(file), "mine").unwrap();
        let export = ["export", "r", "--format", format, "--out", "out"];
        refused(dir, &export, "exists already and is left untouched");
        flown(dir, &[&export[..], &["--overwrite"]].concat());
        assert!(fs::read(dir.join("out").join(file)).unwrap().len() > 100);
        for folder in ["r/frames", "other", "other/figures", "other/frames"] {
            let export = [
                "export",
                "r",
                "--format",
                format,
                "--out",
                folder,
                "--overwrite",
            ];
            refused(dir, &export, "is the place of a file of a run");
        }
    }
    fs::write(dir.join("out/wake.svg"), "mine").unwrap();
    let plot = ["plot", "r", "wake", "--out", "out"];
    refused(dir, &plot, "exists already and is left untouched");
    flown(dir, &[&plot[..], &["--overwrite"]].concat());
    flown(dir, &plot); // the same figure again is no loss
    refused(
        dir,
        &["plot", "r", "wake", "--out", "other"],
        "of a file of a run",
    );
}

#[test]
fn behaves_overwriting_a_run_takes_only_what_is_its_own() {
    let scratch = with_run("own");
    let dir = &scratch.0;
    let mine = [
        "r/notes.txt",
        "r/frames/mine.vtp",
        "r/frames/surfaces_first.vtp",
        "r/figures/mine.svg",
    ];
    for file in mine {
        fs::write(dir.join(file), "mine").unwrap();
    }
    fs::write(dir.join("r/frames/surfaces_000099.vtp"), "of a longer run").unwrap();
    flown(
        dir,
        &["run", "case.toml", "--quiet", "--out", "r", "--overwrite"],
    );
    for file in mine {
        assert_eq!(
            fs::read_to_string(dir.join(file)).unwrap(),
            "mine",
            "{file}"
        );
    }
    assert!(!dir.join("r/frames/surfaces_000099.vtp").exists());
    assert!(!dir.join("r/checkpoint.bin").exists());
    // A manifest of another program is no run.
    fs::create_dir(dir.join("app")).unwrap();
    fs::write(dir.join("app/manifest.json"), "{\"name\": \"app\"}").unwrap();
    fs::write(dir.join("app/case.toml"), "mine").unwrap();
    let over = ["run", "case.toml", "--out", "app", "--overwrite"];
    refused(dir, &over, "exists already and is left untouched");
    flown(dir, &["new", "benchmark-1", "app/case.toml", "--overwrite"]);
}

#[test]
fn behaves_a_report_is_replaced_only_when_asked() {
    let scratch = Scratch::new("report");
    let dir = &scratch.0;
    fs::create_dir(dir.join("v")).unwrap();
    fs::write(dir.join("v/verification.csv"), "mine").unwrap();
    let verify = ["verify", "--only", "benchmark", "--out", "v"];
    refused(dir, &verify, "exists already and is left untouched");
    fs::write(dir.join("v/verification.json"), "{}").unwrap();
    refused(
        dir,
        &[&verify[..], &["--resume"]].concat(),
        "is no verification report",
    );
    // A list writes no report.
    for option in [&["--out", "w"][..], &["--resume"], &["--overwrite"]] {
        let list = [&["verify", "--list"], option].concat();
        refused(dir, &list, "cannot be used with");
    }
}

/// Runs where no file may grow beyond `blocks` of 512 bytes, as on a full disk.
#[cfg(unix)]
fn on_a_full_disk(dir: &Path, blocks: usize, args: &[&str]) -> std::process::Output {
    let program = env!("CARGO_BIN_EXE_wingbeat");
    let script = format!("ulimit -f {blocks}; exec \"{program}\" \"$@\"");
    let mut command = Command::new("sh");
    let command = command.args(["-c", &script, "sh"]).args(args);
    command.current_dir(dir).output().unwrap()
}

#[cfg(unix)]
#[test]
fn behaves_a_full_disk_leaves_nothing_behind() {
    let scratch = with_run("full");
    let dir = &scratch.0;
    let line = [
        "--line", "200", "--corner", "0,0,0.1", "--corner", "1,0,0.1",
    ];
    let writes: [Vec<&str>; 8] = [
        vec!["new", "fruit-fly-hover"],
        vec!["trim", "--steps", "20", "--write", "hover.toml"],
        [&["velocity", "r"], &line[..], &["--out", "v.csv"]].concat(),
        vec!["export", "r", "--format", "hdf5", "--out", "."],
        vec!["export", "r", "--format", "parquet", "--out", "."],
        vec!["export", "r", "--format", "gltf", "--out", "."],
        vec!["export", "r", "--format", "vtkhdf", "--out", "."],
        vec!["plot", "r", "animation", "--out", "."],
    ];
    let before = contents(dir);
    for args in writes {
        let out = on_a_full_disk(dir, 1, &args);
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(matches!(out.status.code(), Some(1 | 2)), "{args:?}: {said}");
        assert!(said.contains("cannot"), "{args:?}: {said}");
        let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&before), names(&contents(dir)), "{args:?}");
    }
    // With space again, nothing is in the way.
    flown(dir, &["new", "fruit-fly-hover"]);
}

/// An empty directory, or a link to one, is taken for a run without being asked to replace anything.
#[cfg(unix)]
#[test]
fn behaves_an_empty_directory_is_taken() {
    let scratch = with_run("empty");
    let dir = &scratch.0;
    let run = |out| ["run", "case.toml", "--quiet", "--out", out];
    for name in ["empty", "linked"] {
        fs::create_dir(dir.join(name)).unwrap();
    }
    std::os::unix::fs::symlink("linked", dir.join("link")).unwrap();
    for (out, place) in [("empty", "empty"), ("link", "linked")] {
        flown(dir, &run(out));
        assert!(dir.join(place).join("history.csv").is_file());
        refused(dir, &run(out), "take this one with --overwrite");
    }
}

/// Paths are what the file system has, whether they are Unicode or not.
#[cfg(target_os = "linux")]
#[test]
fn behaves_paths_need_not_be_unicode() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let scratch = Scratch::new("bytes");
    quick_case(&scratch.0);
    let [case, run, figures, report] =
        [&b"c\xff.toml"[..], b"r\xff", b"f\xff", b"o\xff"].map(OsStr::from_bytes);
    fs::rename(scratch.0.join("case.toml"), scratch.0.join(case)).unwrap();
    let done = |command: &[&str], more: &[&OsStr], rest: &[&str]| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
        program.current_dir(&scratch.0);
        let out = program.args(command).args(more).args(rest).output();
        let out = out.unwrap();
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(out.status.success(), "{command:?}: {said}");
    };
    let out = OsStr::new("--out");
    done(&["run"], &[case, out, run], &["--json"]);
    done(&["resume"], &[run], &[]);
    done(&["check"], &[case, out, report], &["--json"]);
    done(&["plot"], &[run, out, figures], &["angles"]);
    done(&["export"], &[run, out, figures], &["--format", "parquet"]);
    done(
        &["new", "fruit-fly-blade"],
        &[OsStr::from_bytes(b"n\xff")],
        &[],
    );
    for file in [
        &b"r\xff/flight.html"[..],
        b"o\xff",
        b"f\xff/angles.svg",
        b"f\xff/history.parquet",
        b"n\xff",
    ] {
        assert!(
            scratch.0.join(OsStr::from_bytes(file)).is_file(),
            "{file:?}"
        );
    }
}
