//! Ensembles of which members fail, and such that go on after a kill.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::ops::ControlFlow::{Break, Continue};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::Mutex;

use serde_json::Value;
use wingbeat::prelude::*;
use wingbeat::{ensemble, ensemble_watched, members_kept};

use crate::support::{Scratch, wingbeat};

/// A fruit fly of three wingbeats that a shell script commands, in four flights one after the other; `kept` where.
fn commanded(dir: &Path, script: &str, kept: &str) -> Output {
    let command = serde_json::json!(["sh", "-c", script]);
    let external = format!("control.external={{command={command},timeout_s=60}}");
    let args = [
        "ensemble",
        "fruit-fly-blade",
        "--members=4",
        "--threads=1",
        "--json",
        "--keep",
        kept,
        "--set=time.beats=3",
        "--set=control.controller=external",
        "--set",
        &external,
    ];
    wingbeat(dir, &args)
}

fn report(out: &Output) -> Value {
    let said = String::from_utf8_lossy(&out.stderr);
    serde_json::from_slice(&out.stdout).unwrap_or_else(|e| panic!("{e}: {said}"))
}

/// Commands nothing, look by look.
const CALM: &str = r#"while read -r line; do echo '{"wings":[{},{}]}'; done"#;

/// A member that cannot go on took all others with it. Now they fly, the report names it with step and reason, and
/// the same command flies that one alone: the same numbers as of an ensemble in which none failed.
#[test]
fn behaves_members_that_fail_are_named_and_flown_again() {
    let scratch = Scratch::new("members");
    let dir = &scratch.0;
    // The second flight has its second look answered by an error, the third its first.
    let script = format!(
        r#"echo >> begun; lost='{{"error":"I am lost"}}'; case $(wc -l < begun) in 2) read -r line; echo '{{"wings":[{{}},{{}}]}}'; read -r line; echo "$lost";; 3) read -r line; echo "$lost";; *) {CALM};; esac"#
    );
    let first = commanded(dir, &script, "kept");
    let said = String::from_utf8_lossy(&first.stderr);
    assert_eq!(first.status.code(), Some(1), "{said}");
    assert!(
        said.contains("2 of 4 flights could not go on") && said.contains("kept in kept"),
        "{said}"
    );
    let told = report(&first);
    assert_eq!(told["complete"], false);
    assert_eq!(told["members_of_means"], serde_json::json!([1, 4]));
    assert_eq!(told["unfinished_members"], serde_json::json!([]));
    assert_eq!(told["ensemble"]["members"], 2);
    let failed = &told["failed_members"];
    assert_eq!(failed.as_array().unwrap().len(), 2);
    let number = |k: usize, key: &str| failed[k][key].as_u64().unwrap();
    assert_eq!([0, 1].map(|k| number(k, "member")), [2, 3]);
    assert_eq!(number(1, "step"), 0);
    assert!((1..120).contains(&number(0, "step")), "{failed}");
    let why = failed[0]["why"].as_str().unwrap();
    assert!(why.contains("I am lost"), "{why}");

    let second = commanded(dir, &script, "kept");
    let said = String::from_utf8_lossy(&second.stderr);
    assert!(second.status.success(), "{said}");
    assert!(said.contains("goes on with 2 of 4 flights done"), "{said}");
    assert_eq!(fs::read_to_string(dir.join("begun")).unwrap().len(), 6);
    assert!(!dir.join("kept").exists(), "nothing is missing any more");
    let whole = commanded(dir, CALM, "other");
    assert_eq!(report(&second)["ensemble"], report(&whole)["ensemble"]);
    assert_eq!(report(&whole)["failed_members"], serde_json::json!([]));

    // Where all fail there is nothing to report.
    let lost =
        r#"read -r line; echo '{"wings":[{},{}]}'; read -r line; echo '{"error":"I am lost"}'"#;
    let none = commanded(dir, lost, "none");
    let said = String::from_utf8_lossy(&none.stderr);
    assert_eq!(none.status.code(), Some(1), "{said}");
    assert!(
        said.contains("error: ") && said.contains("I am lost"),
        "{said}"
    );
    assert!(!dir.join("none").exists());
}

/// What no flight can begin with, or has no wingbeat, is refused at once.
#[test]
fn refuses_ensembles_that_can_have_no_means_before_they_are_flown() {
    let none = |_: usize, _: &Simulation| -> std::ops::ControlFlow<()> { panic!("it flies") };
    let flight = Flight::preset_with("fruit-fly-blade", &["time.beats=0.9"]).unwrap();
    let mut beatless = flight.clone();
    beatless.setup.time.period = None;
    for (flight, members, reason) in [
        (&flight, 4, "time.beats of 1 or more"),
        (&flight.clone().beats(2.0), 1, "two members or more"),
        (&beatless, 4, "no wingbeat frequency"),
    ] {
        let refused = ensemble_watched(flight, members, 1, None, none);
        let said = refused.map(drop).unwrap_err().to_string();
        assert!(said.contains(reason), "{said}");
    }
    let mut wrong = flight.beats(2.0);
    wrong.setup.corrector.max_passes = 0;
    let refused = ensemble_watched(&wrong, 50, 2, None, none);
    let said = refused.map(drop).unwrap_err().to_string();
    assert!(said.contains("corrector.max_passes"), "{said}");
}

/// Killed outright, the same command flies those that are missing only, with the numbers of an ensemble that was not
/// killed; another case, or another number of flights, begins from its start.
#[test]
fn exact_a_killed_ensemble_goes_on_with_the_missing_members() {
    let scratch = Scratch::new("killed-ensemble");
    let dir = &scratch.0;
    let args = "ensemble fruit-fly-blade --members 40 --threads 2 --json --set time.beats=20";
    let args: Vec<&str> = args.split(' ').collect();
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    let command = command.current_dir(dir).args(&args);
    let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
    let mut errors = BufReader::new(child.stderr.take().unwrap()).lines();
    let fourth = errors.find(|l| l.as_ref().is_ok_and(|l| l.contains(": 4 of 40 flights")));
    assert!(fourth.is_some());
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = dir.join("results/fruit-fly-blade-ensemble");
    let points = || walk(&kept.join("points"));
    let before = points();
    // A flight is told of at its last step and written right after it: two may be under way.
    assert!((2..40).contains(&before), "{before}");

    // Neither is taken for another: none of these is there.
    let beats = Flight::preset_with("fruit-fly-blade", &["time.beats=20"]).unwrap();
    assert_eq!(members_kept(&beats, 40, &kept).unwrap(), before);
    assert_eq!(members_kept(&beats, 39, &kept).unwrap(), 0);
    let changed = Flight::preset_with("fruit-fly-blade", &["time.beats=21"]).unwrap();
    assert_eq!(members_kept(&changed, 40, &kept).unwrap(), 0);

    let rest = wingbeat(dir, &args);
    let said = String::from_utf8_lossy(&rest.stderr).into_owned();
    assert!(rest.status.success(), "{said}");
    assert!(
        said.contains(&format!("goes on with {before} of 40 flights done")),
        "{said}"
    );
    assert!(!kept.exists());
    let whole = wingbeat(dir, &[&args[..], &["--keep", "elsewhere"]].concat());
    assert_eq!(rest.stdout, whole.stdout);
}

/// Files in a folder, and in those within.
fn walk(folder: &Path) -> usize {
    let entries = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    entries.map(|p| if p.is_dir() { walk(&p) } else { 1 }).sum()
}

/// The library: members that were flown before are not flown again, and the means are those of one that was not stopped.
#[test]
fn exact_an_ensemble_that_was_stopped_flies_the_missing_members() {
    let scratch = Scratch::new("kept-members");
    let folder = scratch.0.join("kept");
    let flight = Flight::preset_with("fruit-fly-blade", &["time.beats=2"]).unwrap();
    let until = |member: usize, _: &Simulation| if member < 3 { Continue(()) } else { Break(()) };
    let first = ensemble_watched(&flight, 4, 1, Some(&folder), until).unwrap();
    assert_eq!((first.members, first.unfinished), (vec![1, 2], vec![3, 4]));
    assert_eq!(members_kept(&flight, 4, &folder).unwrap(), 2);
    // A record that was changed is flown again.
    let damaged = first_file(&folder.join("points"));
    fs::write(
        &damaged,
        fs::read_to_string(&damaged)
            .unwrap()
            .replace("beat\":1", "beat\":7"),
    )
    .unwrap();
    let flown = Mutex::new(vec![]);
    let each = |member: usize, f: &Simulation| {
        if f.state().step == 1 {
            flown.lock().unwrap().push(member);
        }
        Continue(())
    };
    let second = ensemble_watched(&flight, 4, 1, Some(&folder), each).unwrap();
    let flown = flown.into_inner().unwrap();
    assert!(flown.len() == 3 && flown.ends_with(&[3, 4]), "{flown:?}");
    assert!(second.is_complete() && !folder.exists());
    assert_eq!(second.ensemble, Some(ensemble(&flight, 4, 2).unwrap()));
    // What is something else stays what it is.
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("notes.txt"), "mine").unwrap();
    let refused = ensemble_watched(&flight, 4, 1, Some(&folder), until);
    let said = refused.map(drop).unwrap_err().to_string();
    assert!(said.contains("--keep"), "{said}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

fn first_file(folder: &Path) -> std::path::PathBuf {
    let inner = fs::read_dir(folder)
        .unwrap()
        .next()
        .unwrap()
        .unwrap()
        .path();
    fs::read_dir(inner).unwrap().next().unwrap().unwrap().path()
}
