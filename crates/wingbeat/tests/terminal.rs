//! What is said and where: exit codes are true when a print fails, flights outlive their readers,
//! ignored signals stay ignored. Linux only: /dev/full, /proc.
#![cfg(target_os = "linux")]

use std::fs::{self, File};
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

mod support;

use support::{Scratch, flown, quick_case, wingbeat};
use wingbeat::results::{Outcome, ResultDir};

/// The program with its output into `out`; exit code and what it complains of.
fn into(dir: &Path, out: Stdio, args: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    let child = command.current_dir(dir).args(args).stdout(out);
    let done = child.stderr(Stdio::piped()).output().unwrap();
    (done.status.code(), String::from_utf8(done.stderr).unwrap())
}

fn full() -> Stdio {
    File::options()
        .write(true)
        .open("/dev/full")
        .unwrap()
        .into()
}

/// A pipe whose reader has gone.
fn closed() -> Stdio {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    writer.into()
}

/// Commands that only print.
const PRINTING: [&[&str]; 12] = [
    &["show", "r"],
    &["show", "r", "--json"],
    &["compare", "r", "r"],
    &["compare", "r", "r", "--json"],
    &["check", "case.toml"],
    &["presets"],
    &["schema"],
    &["verify", "--list"],
    &["--help"],
    &["--version"],
    &["run", "--help"],
    &["stability", "table1-sun-2007"],
];

#[test]
fn behaves_a_failed_print_is_a_failure_and_a_closed_pipe_is_none() {
    let scratch = Scratch::new("print");
    let dir = &scratch.0;
    quick_case(dir);
    flown(dir, &["run", "case.toml", "--quiet", "--out", "r"]);
    for args in PRINTING {
        let (code, said) = into(dir, full(), args);
        assert_eq!(code, Some(1), "{args:?}: {said}");
        assert!(said.contains("cannot be written"), "{args:?}: {said}");
        let (code, said) = into(dir, closed(), args);
        // What is doubted of the case stands on the other stream.
        let mut others = said.lines().filter(|l| !l.starts_with("warning: "));
        assert_eq!((code, others.next()), (Some(0), None), "{args:?}: {said}");
    }
}

#[test]
fn behaves_a_file_is_written_whoever_reads_the_words() {
    let scratch = Scratch::new("write-unread");
    let dir = &scratch.0;
    for (k, (out, wanted)) in [(full(), 1), (closed(), 0)].into_iter().enumerate() {
        let file = format!("hover-{k}.toml");
        let (code, said) = into(dir, out, &["trim", "--steps", "20", "--write", &file]);
        assert_eq!(code, Some(wanted), "{said}");
        assert!(
            fs::read_to_string(dir.join(file))
                .unwrap()
                .contains("trimmed")
        );
    }
    let (code, _) = into(dir, full(), &["new", "benchmark-1"]);
    assert_eq!(
        (code, dir.join("benchmark-1.toml").is_file()),
        (Some(1), true)
    );
}

#[test]
fn behaves_a_flight_outlives_those_who_listen() {
    let scratch = Scratch::new("unheard");
    let dir = &scratch.0;
    quick_case(dir);
    let ways: [(&str, &[&str], Stdio, i32); 4] = [
        ("a", &["--json"], full(), 1),
        ("b", &["--json"], closed(), 0),
        ("c", &[], full(), 1),
        ("d", &[], closed(), 0),
    ];
    for (name, extra, out, wanted) in ways {
        let args = [&["run", "case.toml", "--out", name], extra].concat();
        let (code, said) = into(dir, out, &args);
        assert_eq!(code, Some(wanted), "{name}: {said}");
        let run = ResultDir::read(&dir.join(name)).unwrap();
        let manifest = run.manifest().unwrap();
        assert_eq!((manifest.outcome, manifest.steps), (Outcome::Finished, 8));
        assert!(run.join("summary.txt").is_file());
    }
    // Nor does it need anyone to read its complaints.
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    let command = command
        .current_dir(dir)
        .args(["run", "case.toml", "--out", "e"]);
    let done = command.stdout(Stdio::null()).stderr(full()).status();
    assert_eq!(done.unwrap().code(), Some(1));
    let manifest = ResultDir::read(&dir.join("e")).unwrap().manifest().unwrap();
    assert_eq!(manifest.outcome, Outcome::Finished);
}

/// Who watches a campaign whose points are never done ends with the reader.
#[test]
fn behaves_a_watch_ends_with_its_reader() {
    let scratch = Scratch::new("watch");
    let dir = &scratch.0;
    let text = "case = \"fruit-fly-blade\"\nkeep = [\"power_watt\"]\n[set]\n\"time.beats\" = 1\n[parameter.\"motion.frequency_hz\"]\nlist = [200, 210]\n";
    fs::write(dir.join("c.toml"), text).unwrap();
    flown(
        dir,
        &["campaign", "run", "c.toml", "--quiet", "--points", "0..1"],
    );
    for (out, wanted) in [(closed(), 0), (full(), 1)] {
        let mut command = Command::new("timeout");
        command.args(["60", env!("CARGO_BIN_EXE_wingbeat")]);
        command.args(["campaign", "status", "c.toml", "--watch"]);
        let done = command.current_dir(dir).stdout(out).stderr(Stdio::null());
        assert_eq!(done.status().unwrap().code(), Some(wanted));
    }
}

/// A flight of some minutes, begun; nothing is drawn of it at its end.
fn long_flight(dir: &Path, ignored: &str) -> Child {
    let program = env!("CARGO_BIN_EXE_wingbeat");
    let script = format!("trap '' {ignored}; exec \"{program}\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, "sh", "run", "case.toml", "--out", "r"]);
    for set in [
        "time.beats=100000",
        "output.page=false",
        "output.figures=false",
    ] {
        command.args(["--set", set]);
    }
    let command = command.current_dir(dir).stdout(Stdio::null());
    let child = command.stderr(Stdio::piped()).spawn().unwrap();
    let began = Instant::now();
    let flying = || fs::metadata(dir.join("r/history.csv")).is_ok_and(|f| f.len() > 20_000);
    while !flying() {
        assert!(began.elapsed() < Duration::from_secs(60), "it does not fly");
        std::thread::sleep(Duration::from_millis(20));
    }
    child
}

fn signal(child: &Child, name: &str) {
    let pid = child.id().to_string();
    let sent = Command::new("kill")
        .args([&format!("-{name}"), &pid])
        .status();
    assert!(sent.unwrap().success());
}

#[test]
fn behaves_ignored_signals_stay_ignored_and_others_end_the_flight() {
    let scratch = Scratch::new("nohup");
    let dir = &scratch.0;
    quick_case(dir);
    let mut child = long_flight(dir, "HUP INT");
    let length = || fs::metadata(dir.join("r/history.csv")).unwrap().len();
    for name in ["HUP", "INT"] {
        signal(&child, name);
        std::thread::sleep(Duration::from_millis(300));
        let before = length();
        std::thread::sleep(Duration::from_millis(300));
        assert!(
            child.try_wait().unwrap().is_none() && length() > before,
            "SIG{name} ended it"
        );
    }
    signal(&child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let manifest = || ResultDir::read(&dir.join("r")).unwrap().manifest().unwrap();
    assert_eq!(manifest().outcome, Outcome::Interrupted);
    fs::remove_dir_all(dir.join("r")).unwrap();
    // Without anything ignored a hang-up is heeded.
    let mut child = long_flight(dir, "USR1");
    signal(&child, "HUP");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(manifest().outcome, Outcome::Interrupted);
}

#[test]
fn behaves_a_killed_run_is_interrupted_and_a_living_one_is_running() {
    let scratch = Scratch::new("killed");
    let dir = &scratch.0;
    quick_case(dir);
    let mut child = long_flight(dir, "USR1");
    let shown = |what: &str| {
        let out = wingbeat(dir, &["show", "r"]);
        let text = String::from_utf8(out.stdout).unwrap();
        let lines: Vec<&str> = text.lines().take(2).collect();
        assert!(lines[0].starts_with("amber: it "), "{text}");
        assert!(lines[1].starts_with(&format!("good {what}")), "{text}");
    };
    shown("is running");
    child.kill().unwrap();
    child.wait().unwrap();
    let mut said = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut said)
        .unwrap();
    shown("was interrupted");
}

/// A sweep tells of each speed, and what an interruption leaves of it is reported and drawn, with its exit code.
#[test]
fn behaves_an_interrupted_sweep_has_what_is_done() {
    let scratch = Scratch::new("sweep-stopped");
    let args = "trim bumblebee-blade --steps 40 --sweep 0 1 --points 900 --json --figure s.svg";
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    let command = command.current_dir(&scratch.0).args(args.split(' '));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = child.spawn().unwrap();
    let mut errors = BufReader::new(child.stderr.take().unwrap()).lines();
    let first = errors.find_map(|l| l.ok().filter(|l| l.contains("m/s trimmed")));
    let first = first.expect("it tells of a speed");
    assert!(
        first.ends_with("0.000 m/s trimmed, 1 of 900 speeds"),
        "{first}"
    );
    signal(&child, "INT");
    let rest: Vec<String> = errors.map(Result::unwrap).collect();
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.code(), Some(130), "{rest:?}");
    assert!(
        rest.iter()
            .any(|l| l.starts_with("interrupted: this speed is finished")),
        "{rest:?}"
    );
    let report: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    let length = |name: &str| report[name].as_array().unwrap().len();
    assert_eq!(report["complete"], false);
    let [flown, left] = ["flights", "not_tried_forward_m_s"].map(length);
    assert!(
        flown >= 1 && left >= 1 && flown + left == 900,
        "{flown} {left}"
    );
    let told = format!("interrupted: {left} of 900 speeds were not tried");
    assert!(rest.contains(&told), "{rest:?}");
    assert!(scratch.0.join("s.svg").is_file());
}

/// An ensemble that is interrupted reports the flights that reached their end, and which did not, with the exit
/// code of an interruption.
#[test]
fn behaves_an_interrupted_ensemble_has_the_flights_that_are_done() {
    let scratch = Scratch::new("ensemble-stopped");
    let args = "ensemble fruit-fly-blade --members 9000 --threads 2 --json --set time.beats=1";
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    let command = command.current_dir(&scratch.0).args(args.split(' '));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = child.spawn().unwrap();
    let mut errors = BufReader::new(child.stderr.take().unwrap()).lines();
    let third = errors.find(|l| l.as_ref().is_ok_and(|l| l.contains(": 3 of 9000 flights")));
    assert!(third.is_some(), "it tells of each flight");
    signal(&child, "INT");
    let rest: Vec<String> = errors.map(Result::unwrap).collect();
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.code(), Some(130), "{rest:?}");
    let told = "interrupted: the flights end after this step";
    assert!(rest.iter().any(|l| l.starts_with(told)), "{rest:?}");
    let report: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    let length = |name: &str| report[name].as_array().unwrap().len();
    assert_eq!(report["complete"], false);
    let [flown, left] = ["members_of_means", "unfinished_members"].map(length);
    assert!(
        flown >= 3 && left >= 1 && flown + left == 9000,
        "{flown} {left}"
    );
    assert_eq!(report["ensemble"]["members"], flown);
    let told = format!("interrupted: {left} of 9000 flights were not flown to their end");
    assert!(rest.contains(&told), "{rest:?}");
}
