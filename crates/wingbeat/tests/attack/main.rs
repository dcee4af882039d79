//! Bad input by the hundred. Whatever is asked: no panic, no abort, no silence of more than ten
//! seconds, no file changed, and never an exit code of success.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

mod support;

use support::{QUICK, Scratch, contents, flown};

/// Bytes of memory that an attack may take [kB]: what is refused is refused before it is made.
const MEMORY: usize = 4_000_000;
/// Nothing is silent for longer.
const PATIENCE: Duration = Duration::from_secs(10);

/// How an attack may end.
#[derive(Clone, Copy, PartialEq)]
enum Wanted {
    /// Refused with a reason, exit code 2, nothing written.
    Refused,
    /// Not wrong in itself: any true exit code, but no panic and no file changed.
    Survived,
}

/// A folder with a case, a run and files of the user; attacked one by one.
struct Field {
    scratch: Scratch,
    before: BTreeMap<PathBuf, Vec<u8>>,
    count: usize,
    failures: Vec<String>,
}

impl Field {
    fn new(name: &str) -> Self {
        let scratch = Scratch::new(name);
        let dir = scratch.0.clone();
        fs::write(dir.join("case.toml"), QUICK).unwrap();
        fs::write(dir.join("mine.txt"), "mine").unwrap();
        fs::create_dir(dir.join("folder")).unwrap();
        flown(&dir, &["run", "case.toml", "--quiet", "--out", "r"]);
        Self {
            before: contents(&dir),
            scratch,
            count: 0,
            failures: vec![],
        }
    }

    fn dir(&self) -> &Path {
        &self.scratch.0
    }

    /// A file that the attacks need, before the first of them.
    fn file(&mut self, name: &str, text: impl AsRef<[u8]>) {
        fs::write(self.dir().join(name), text).unwrap();
        self.before = contents(self.dir());
    }

    /// One attack; what is wrong with its end is noted.
    fn attack(&mut self, wanted: Wanted, args: &[&str]) {
        self.count += 1;
        let limit = format!("ulimit -v {MEMORY}; exec \"$0\" \"$@\"");
        let mut command = Command::new("sh");
        command
            .args(["-c", &limit, env!("CARGO_BIN_EXE_wingbeat")])
            .args(args);
        command.current_dir(self.dir()).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let began = Instant::now();
        let mut child = command.spawn().unwrap();
        let pid = child.id();
        // What it says fits into a pipe, or it is read by nobody and time runs out.
        while child.try_wait().unwrap().is_none() && began.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_millis(2));
        }
        let late = began.elapsed() >= PATIENCE;
        if late {
            child.kill().unwrap();
        }
        let out = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        let mut problems = vec![];
        if late {
            problems.push("too long".to_owned());
        } else if let Some(signal) = out.status.signal() {
            problems.push(format!("ended by signal {signal}"));
        }
        if said.contains("panicked") || said.contains("overflowed its stack") {
            problems.push("a panic".to_owned());
        }
        let code = out.status.code();
        if wanted == Wanted::Refused && !late && code != Some(2) {
            problems.push(format!("exit code {code:?}"));
        }
        if code.is_some_and(|c| c != 0) && said.trim().is_empty() {
            problems.push("no reason".to_owned());
        }
        if let Some(word) = rust_words(&said) {
            problems.push(format!("speaks Rust: {word}"));
        }
        let after = contents(self.dir());
        if self.before != after {
            problems.push("files changed".to_owned());
            self.before = after;
        }
        if !problems.is_empty() {
            let args: Vec<String> = args.iter().map(|a| a.chars().take(80).collect()).collect();
            let said: String = said.chars().take(400).collect();
            self.failures
                .push(format!("[{pid}] {args:?}: {}\n{said}", problems.join(", ")));
        }
    }

    fn refused(&mut self, args: &[&str]) {
        self.attack(Wanted::Refused, args);
    }

    /// Ends the attacks: there were at least so many, and all were withstood.
    fn end(self, at_least: usize) {
        assert!(self.count >= at_least, "{} attacks only", self.count);
        let failed = self.failures.len();
        let list = self.failures.join("\n");
        assert!(failed == 0, "{failed} of {}:\n{list}", self.count);
    }
}

/// Names of Rust's types that a user should never read.
fn rust_words(said: &str) -> Option<&'static str> {
    let words = [
        "struct ",
        "enum ",
        "usize",
        "u32",
        "f64",
        "variant ",
        "Option<",
        "Vec<",
        "tuple",
        "untagged",
        "newtype",
        "Case,",
        "::",
        "18446744073709551615]",
    ];
    words.into_iter().find(|w| said.contains(w))
}

/// No number of any kind.
const NO_NUMBERS: [&str; 8] = ["nan", "inf", "-inf", "1e999", "", "two", "1,5", "0x10"];

#[test]
fn refuses_bad_numbers_in_every_option() {
    let mut field = Field::new("attack-options");
    let counts: [(&[&str], &str); 9] = [
        (&["run", "case.toml", "--out", "new"], "--threads"),
        (&["resume", "r"], "--threads"),
        (&["trim"], "--steps"),
        (&["trim"], "--hold"),
        (&["stabilise"], "--beats"),
        (&["stabilise"], "--latency"),
        (&["stabilise"], "--sample"),
        (
            &["velocity", "r", "--corner", "0,0,0", "--corner", "1,0,0"],
            "--line",
        ),
        (&["plot", "r"], "--step"),
    ];
    let no_counts = [
        "-1",
        "1.5",
        "18446744073709551616",
        "99999999999999999999999",
    ];
    let too_many = ["0", "18446744073709551615", "1000000000"];
    for (command, option) in counts {
        for value in no_counts.into_iter().chain(NO_NUMBERS) {
            field.refused(&[command, &[&format!("{option}={value}")]].concat());
        }
        let whole = ["--latency", "--step"].contains(&option);
        for value in too_many.into_iter().filter(|v| !whole || *v != "0") {
            field.refused(&[command, &[&format!("{option}={value}")]].concat());
        }
    }
    let numbers: [(&[&str], &str, &[&str]); 8] = [
        (&["plot", "r"], "--from", &[]),
        (&["plot", "r"], "--to", &[]),
        (&["plot", "r"], "--beats", &["0", "-1"]),
        (&["trim"], "--forward", &["340", "-1e308", "1e308"]),
        (&["stability"], "--climb", &["340", "-1e308", "1e308"]),
        (&["power"], "--muscle", &["0", "-0.3", "1.01", "1e308"]),
        (
            &["view", "r", "--no-open"],
            "--size",
            &["0", "-1", "1e308", "1e5"],
        ),
        (
            &["velocity", "r"],
            "--point",
            &["0,0", "0,0,0,0", "nan,0,0", "1e308,0,0", ",,", "0;0;0"],
        ),
    ];
    for (command, option, bad) in numbers {
        for value in bad.iter().copied().chain(NO_NUMBERS) {
            field.refused(&[command, &[&format!("{option}={value}")]].concat());
        }
    }
    for plane in [
        "100000x100000",
        "1x1",
        "0x5",
        "5",
        "5x5x5",
        "x",
        "4294967296x4294967296",
        "-2x2",
    ] {
        field.refused(&["velocity", "r", "--plane", plane, "--corner", "0,0,0"]);
    }
    for tilt in [
        ["nan", "0", "0"],
        ["0", "inf", "0"],
        ["0", "0", "181"],
        ["a", "0", "0"],
    ] {
        field.refused(&[&["stabilise", "--tilt"], &tilt[..]].concat());
    }
    field.end(180);
}

#[test]
fn refuses_bad_words_on_the_command_line() {
    let mut field = Field::new("attack-words");
    let long = "x".repeat(100_000);
    let commands = [
        "",
        "rnu",
        "runn",
        "--run",
        "-x",
        "fruit-fly-hover",
        "case.toml",
        "RUN",
        "run ",
        "..",
        &long,
    ];
    for command in commands {
        field.refused(&[command]);
    }
    let all = [
        "run",
        "resume",
        "view",
        "plot",
        "export",
        "show",
        "compare",
        "check",
        "trim",
        "stability",
        "derivatives",
        "power",
        "stabilise",
        "velocity",
        "verify",
        "presets",
        "new",
        "schema",
    ];
    for command in all {
        field.refused(&[command, "--no-such-option"]);
        field.refused(&[command, "a", "b", "c", "d"]);
    }
    let flies = [
        "run",
        "check",
        "trim",
        "stability",
        "derivatives",
        "power",
        "stabilise",
    ];
    let names = [
        "",
        " ",
        "no-such-case",
        "fruit-fly-hoover",
        "folder",
        "r",
        "/dev/null",
        "/dev/zero",
        "/",
        "mine.txt",
        "case.toml/",
        "nowhere/case.toml",
        &long,
    ];
    for command in flies {
        for name in names {
            field.refused(&[command, name]);
        }
    }
    for command in ["resume", "view", "plot", "show", "velocity"] {
        for name in [
            "",
            "nowhere",
            "folder",
            "mine.txt",
            "/dev/null",
            "case.toml",
            "/",
            &long,
        ] {
            field.refused(&[command, name]);
        }
    }
    let lines: [&[&str]; 22] = [
        &["run", "case.toml", "--quiet", "--json"],
        &["run", "case.toml", "--overwrite"],
        &["run", "case.toml", "--out", ""],
        &["run", "case.toml", "--out", "mine.txt"],
        &["run", "case.toml", "--out", "mine.txt/r"],
        &["run", "case.toml", "--out", "mine.txt", "--overwrite"],
        &["run", "case.toml", "--out", "folder"],
        &["run", "case.toml", "--out", "/dev/null/r"],
        &["plot", "r", "smoke"],
        &["plot", "r", "--style", "loud"],
        &["plot", "r", "--format", "bmp"],
        &["export", "r"],
        &["export", "r", "--format", "docx"],
        &["new"],
        &["new", "no-such-preset"],
        &["new", "benchmark-1", "folder"],
        &["new", "benchmark-1", "/dev/null"],
        &["trim", "--unknowns", "body_pitch", "body_pitch", "luck"],
        &["stability", "table1-sun-2007", "--forward", "1"],
        &["trim", "fruit-fly-blade", "--hold", "3"],
        &["stabilise", "--controller", "free", "--latency", "1"],
        &["verify", "--only", "no such case"],
    ];
    for line in lines {
        field.refused(line);
    }
    field.end(180);
}

/// Numbers of a case by their keys.
const NUMBERS: [&str; 24] = [
    "time.beats",
    "time.steps_per_beat",
    "motion.frequency_hz",
    "motion.phase",
    "gravity_m_s2",
    "animal.scale",
    "corrector.tolerance",
    "corrector.max_passes",
    "corrector.relaxation",
    "air.density_kg_m3",
    "air.stream_m_s",
    "flight.pitch_deg",
    "flight.held_beats",
    "flight.velocity_m_s",
    "output.frames_every",
    "output.checkpoint_every",
    "output.checkpoint_interval_s",
    "body.part.thorax.length_m",
    "body.part.thorax.mass_kg",
    "body.part.thorax.stations",
    "wing.right.mass_kg",
    "wing.right.hinge_m",
    "wing.right.mesh.spanwise",
    "wing.right.planform.rectangle.span_m",
];

#[test]
fn refuses_bad_values_in_cases() {
    let mut field = Field::new("attack-values");
    for key in NUMBERS {
        for value in [
            "nan",
            "-inf",
            "\"5\"",
            "[]",
            "[[1]]",
            "{}",
            "true",
            "1979-05-27",
        ] {
            let set = format!("{key}={value}");
            field.refused(&["check", "case.toml", "--set", &set]);
        }
        for value in [
            "1e308",
            "-1e308",
            "1e-308",
            "0",
            "9223372036854775807",
            "-1",
        ] {
            let set = format!("{key}={value}");
            let args = ["check", "case.toml", "--set", &set];
            field.attack(Wanted::Survived, &args);
        }
    }
    let deep = |n: usize| vec!["a"; n].join(".") + "=1";
    let lists = |n: usize| format!("gravity_m_s2={}{}", "[".repeat(n), "]".repeat(n));
    let sets = [
        deep(33),
        deep(30_000),
        lists(30_000),
        lists(100),
        "=".into(),
        "=1".into(),
        "a".into(),
        "a.=1".into(),
        ".a=1".into(),
        "load[0].x=1".into(),
        "load[99999999999]=1".into(),
        "load[=1".into(),
        "name=".into(),
        "name=../../x".into(),
        "name=\"a/b\"".into(),
        "wing=1".into(),
        "wing.right=[]".into(),
        "format=2".into(),
        "format=-1".into(),
        "time.steps=5".into(),
        "air.model=\"external\"".into(),
        "air.model=".into(),
        format!("name=\"{}\"", "x".repeat(100_000)),
    ];
    for set in &sets {
        field.refused(&["check", "case.toml", "--set", set]);
    }
    field.end(300);
}

#[test]
fn refuses_cases_beyond_all_size() {
    let mut field = Field::new("attack-size");
    let parts: String = (0..3000)
        .map(|k| format!("[body.part.p{k}]\nlength_m = 1e-3\ndiameter_m = 1e-3\nmass_kg = 1e-9\n"))
        .collect();
    let lattice = QUICK.replace("\"none\"", "\"vortex_lattice\"");
    field.file("parts.toml", lattice.clone() + &parts);
    let segments: String = (0..500)
        .map(|k| format!("[segment.s{k}]\nmass_kg = 1e-9\ncentre_m = [0, 0, 0]\ninertia_about_centre_kg_m2 = [1e-15, 1e-15, 1e-15, 0, 0, 0]\n[joint.j{k}]\nkind = \"spherical\"\nparent = \"body\"\nchild = \"s{k}\"\nat_m = [0, 0, 0]\n"))
        .collect();
    field.file("segments.toml", QUICK.to_owned() + &segments);
    let wings: String = (0..150)
        .map(|k| format!("[wing.right{k}]\nhinge_m = [0, 0, 0]\nmass_kg = 1e-9\n[wing.right{k}.planform.rectangle]\nchord_m = 1e-3\nspan_m = 1e-3\n"))
        .collect();
    field.file("wings.toml", QUICK.to_owned() + &wings);
    let fine = [
        "--set",
        "wing.right.mesh.chordwise=100",
        "--set",
        "wing.right.mesh.spanwise=101",
    ];
    field.refused(&["check", "parts.toml"]);
    field.refused(&["run", "parts.toml", "--out", "new"]);
    field.refused(&["check", "segments.toml"]);
    field.refused(&["check", "wings.toml"]);
    field.refused(&[&["check", "case.toml"], &fine[..]].concat());
    let huge = "wing.right.mesh.spanwise=9223372036854775807";
    field.refused(&["check", "case.toml", "--set", huge]);
    for steps in [
        "time.beats=1e9",
        "time.steps_per_beat=1000000000000",
        "time.beats=1e300",
    ] {
        field.refused(&["check", "case.toml", "--set", steps]);
    }
    field.refused(&["trim", "--steps", "1000000000"]);
    field.end(10);
}

#[test]
fn refuses_files_that_are_no_cases() {
    let mut field = Field::new("attack-files");
    let table = |rows: &str| {
        QUICK.replace(
            "phi.fourier]\ncosine_deg = [60.0]",
            &format!("phi.table]\n{rows}"),
        )
    };
    let part = |rows: &str| QUICK.replace("length_m = 1e-3\ndiameter_m = 1e-3\n", rows);
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("empty", vec![]),
        ("zeros", vec![0; 4096]),
        ("latin", b"name = \"caf\xe9\"".to_vec()),
        ("marks", b"\xef\xbb\xbf\xff\xfe".to_vec()),
        ("json", b"{\"format\": 1}".to_vec()),
        ("script", b"#!/bin/sh\necho hello\n".to_vec()),
        ("half", QUICK.as_bytes()[..200].to_vec()),
        ("twice", [QUICK, QUICK].concat().into()),
        (
            "dots",
            format!("format = 1\n{} = 1\n", vec!["a"; 20_000].join(".")).into(),
        ),
        (
            "headers",
            format!("format = 1\n[{}]\n", vec!["a"; 20_000].join(".")).into(),
        ),
        (
            "lists",
            format!("x = {}{}\n", "[".repeat(20_000), "]".repeat(20_000)).into(),
        ),
        (
            "tables",
            format!("x = {}1{}\n", "{a = ".repeat(20_000), "}".repeat(20_000)).into(),
        ),
        (
            "line",
            format!("name = \"{}\"", "x".repeat(5_000_000)).into(),
        ),
        ("format", QUICK.replace("format = 1", "format = 1.0").into()),
        ("no-rows", table("rows_deg = []").into()),
        ("no-file", table("file = \"nowhere.csv\"").into()),
        ("empty-csv", table("file = \"empty.csv\"").into()),
        ("header-csv", table("file = \"header.csv\"").into()),
        ("short-csv", table("file = \"short.csv\"").into()),
        ("device", table("file = \"/dev/zero\"").into()),
        ("folder-csv", table("file = \"folder\"").into()),
        ("own-csv", table("file = \"case.toml\"").into()),
        ("mesh", part("file = \"nowhere.obj\"\n").into()),
        ("mesh-empty", part("file = \"empty.obj\"\n").into()),
        ("mesh-index", part("file = \"index.obj\"\n").into()),
        ("mesh-format", part("file = \"mine.txt\"\n").into()),
        ("mesh-device", part("file = \"/dev/random\"\n").into()),
        ("mesh-stl", part("file = \"huge.stl\"\n").into()),
        (
            "quads",
            part("nodes_m = [[0,0,0]]\nquads = [[0, 1, 2, 9223372036854775807]]\n").into(),
        ),
    ];
    field.file("empty.csv", "");
    field.file("header.csv", "phase,phi\n");
    field.file("short.csv", "phase,phi\n0,1\n");
    field.file("empty.obj", "");
    field.file("index.obj", "v 0 0 0\nf 1 2 99999999999999999999\n");
    // A binary STL that promises four thousand million triangles.
    field.file("huge.stl", [&[0; 80][..], &[0xff; 4]].concat());
    let names: Vec<String> = files.iter().map(|f| format!("{}.toml", f.0)).collect();
    for ((_, text), name) in files.iter().zip(&names) {
        field.file(name, text);
    }
    for name in &names {
        field.refused(&["check", name]);
        field.refused(&["run", name, "--out", "new"]);
    }
    field.end(50);
}

#[test]
fn survives_flights_of_impossible_numbers() {
    let mut field = Field::new("attack-flights");
    let keys = [
        "gravity_m_s2=[0,0,1e300]",
        "gravity_m_s2=[1e154,1e154,1e154]",
        "flight.velocity_m_s=[1e200,0,0]",
        "flight.pitch_deg=1e300",
        "motion.frequency_hz=1e300",
        "motion.frequency_hz=1e-300",
        "animal.scale=1e60",
        "animal.scale=1e-60",
        "wing.right.mass_kg=1e300",
        "wing.right.mass_kg=1e-300",
        "body.part.thorax.mass_kg=1e-300",
        "body.part.thorax.mass_kg=1e300",
        "wing.right.motion.phi.fourier.cosine_deg=[1e300]",
        "corrector.tolerance=1e-300",
        "time.beats=1e-300",
        "dynamics.formulation=\"euler\"",
    ];
    for air in ["none", "blade_element", "vortex_lattice"] {
        for key in keys {
            let model = format!("air.model=\"{air}\"");
            let out = field
                .dir()
                .parent()
                .unwrap()
                .join(format!("attack-{}", std::process::id()));
            let out = out.to_str().unwrap().to_owned();
            let args = [
                "run",
                "case.toml",
                "--quiet",
                "--out",
                &out,
                "--set",
                &model,
                "--set",
                key,
            ];
            field.attack(Wanted::Survived, &args);
            let _ = fs::remove_dir_all(out);
        }
    }
    field.end(40);
}
