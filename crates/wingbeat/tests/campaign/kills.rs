//! Workers and masters that are killed, at any time: the tables are those of an undisturbed run.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use wingbeat::math::SplitMix64;

use crate::support::{Scratch, flown, wingbeat};
use crate::{blade, merged, numbers, write};

fn start(dir: &Path, out: &str, part: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_wingbeat"))
        .args([
            "campaign", "run", "c.toml", "--out", out, "--quiet", "--jobs", "2",
        ])
        .args(part)
        .current_dir(dir)
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Processes that a process has started.
fn workers(master: &Child) -> Vec<u32> {
    let id = master.id();
    let text = fs::read_to_string(format!("/proc/{id}/task/{id}/children")).unwrap_or_default();
    text.split_whitespace()
        .filter_map(|n| n.parse().ok())
        .collect()
}

fn kill(process: u32) {
    let kill = format!("kill -9 {process}");
    Command::new("sh")
        .args(["-c", &kill])
        .stderr(Stdio::null())
        .status()
        .unwrap();
}

/// Numbers that look random, the same ones in every run.
struct Chance(SplitMix64);

impl Chance {
    fn below(&mut self, n: u64) -> u64 {
        self.0.bits() % n
    }
}

/// Two masters on the same points, killed so many times, they or their workers; ends when all points are done.
fn disturbed(dir: &Path, kills: usize, pause: u64) {
    let mut chance = Chance(SplitMix64::new(11));
    let mut masters = [start(dir, "b", &[]), start(dir, "b", &[])];
    let begun = Instant::now();
    let mut killed = 0;
    loop {
        assert!(
            begun.elapsed() < Duration::from_secs(300),
            "it does not end"
        );
        std::thread::sleep(Duration::from_millis(20 + chance.below(pause)));
        for master in &mut masters {
            match master.try_wait().unwrap() {
                Some(end) if !end.success() => *master = start(dir, "b", &[]),
                _ => {}
            }
        }
        let ended = masters.each_mut().map(|m| m.try_wait().unwrap());
        if ended.iter().all(|e| e.is_some_and(|e| e.success())) {
            break;
        }
        if killed == kills {
            continue;
        }
        let master = &masters[chance.below(2) as usize];
        let workers = workers(master);
        let victim = match chance.below(3) {
            0 => Some(master.id()),
            _ => workers.get(chance.below(2) as usize).copied(),
        };
        if let Some(victim) = victim {
            kill(victim);
            killed += 1;
        }
    }
    println!("{killed} kills");
    assert!(killed > kills / 2, "only {killed} kills before the end");
}

#[test]
fn invariant_kills_leave_no_trace_in_the_tables() {
    let scratch = Scratch::new("campaign-kills");
    let dir = &scratch.0;
    write(dir, &blade(80));
    flown(
        dir,
        &[
            "campaign", "run", "c.toml", "--out", "a", "--quiet", "--jobs", "1",
        ],
    );
    disturbed(dir, 8, 80);
    assert!(merged(dir, "a") == merged(dir, "b"));
    assert!(numbers(dir, "b", "success").iter().all(|s| *s == 1.0));
}

/// The histories that are kept.
fn histories(dir: &Path, out: &str) -> BTreeMap<OsString, Vec<u8>> {
    let folders = fs::read_dir(dir.join(out).join("files")).unwrap();
    let read = |f: fs::DirEntry| {
        let history = fs::read(f.path().join("history.csv")).unwrap();
        (f.file_name(), history)
    };
    folders.map(|f| read(f.unwrap())).collect()
}

/// Flights in the vortex lattice go on from their checkpoints after a kill, bit for bit.
#[test]
fn invariant_a_killed_flight_in_the_lattice_goes_on_bit_for_bit() {
    let scratch = Scratch::new("campaign-lattice");
    let dir = &scratch.0;
    write(
        dir,
        r#"case = "fruit-fly-hover"
keep = ["end.mass_centre_n3_m"]
files = ["history"]
[set]
"time.beats" = 1
"wing.right.mesh.spanwise" = 3
"wing.right.mesh.chordwise" = 2
"output.checkpoint_every" = 2
[budget]
attempts = 50
[parameter."motion.frequency_hz"]
list = [200, 210]
"#,
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "a", "--quiet"]);
    // Every flight is killed within: its first checkpoint is there, and it has not ended.
    let mut resumed = 0;
    for _ in 0..3 {
        let mut master = start(dir, "b", &[]);
        let begun = Instant::now();
        let saved = || {
            let folders = fs::read_dir(dir.join("b/work"))
                .into_iter()
                .flatten()
                .flatten();
            folders
                .filter(|f| f.path().join("checkpoint.bin").is_file())
                .count()
        };
        while saved() == 0 && master.try_wait().unwrap().is_none() {
            assert!(begun.elapsed() < Duration::from_secs(120));
            std::thread::sleep(Duration::from_millis(5));
        }
        resumed += usize::from(saved() > 0);
        let workers = workers(&master);
        kill(master.id());
        workers.into_iter().for_each(kill);
        master.wait().unwrap();
    }
    assert!(resumed > 0, "no flight was killed within");
    flown(dir, &["campaign", "run", "c.toml", "--out", "b", "--quiet"]);
    assert!(merged(dir, "a") == merged(dir, "b"));
    assert_eq!(histories(dir, "a").len(), 2);
    assert!(
        histories(dir, "a") == histories(dir, "b"),
        "histories differ"
    );
}

/// A point that kills whoever flies it is given up after so many attempts, the others are flown.
#[test]
fn behaves_a_point_that_kills_its_process_is_quarantined() {
    let scratch = Scratch::new("campaign-deadly");
    let dir = &scratch.0;
    let text = blade(1).replace("attempts = 20", "attempts = 2").replace(
        "range = { from = 190, to = 210, count = 3 }",
        "list = [200, 205, 210, 215]",
    );
    write(dir, &text);
    // The lease of a process that died while it flew point 2, for the second time.
    flown(
        dir,
        &[
            "campaign", "run", "c.toml", "--out", "b", "--quiet", "--points", "0..1",
        ],
    );
    let plan = wingbeat(dir, &["campaign", "plan", "c.toml"]);
    let plan = String::from_utf8(plan.stdout).unwrap();
    let hash = plan.lines().nth(3).unwrap().split(',').nth(1).unwrap();
    fs::create_dir_all(dir.join("b/attempts")).unwrap();
    fs::write(
        dir.join("b/attempts").join(hash),
        r#"{"deaths":1,"step":0}"#,
    )
    .unwrap();
    let leases = fs::read_dir(dir.join("b/leases"))
        .unwrap()
        .next()
        .unwrap()
        .unwrap()
        .path();
    let mut gone = Command::new("true").spawn().unwrap();
    gone.wait().unwrap();
    let own = fs::read_to_string("/proc/sys/kernel/random/boot_id").unwrap();
    let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap();
    let space = fs::read_link("/proc/self/ns/pid").unwrap();
    let machine = format!("{}/{}/{}", host.trim(), own.trim(), space.display());
    fs::write(
        leases.join("00000002.0"),
        format!("{machine} {} 1\n000000000002\n", gone.id()),
    )
    .unwrap();
    flown(dir, &["campaign", "run", "c.toml", "--out", "b", "--quiet"]);
    let tables = merged(dir, "b");
    assert_eq!(numbers(dir, "b", "success"), [1.0, 1.0, 0.0, 1.0]);
    let failed = String::from_utf8(tables["failed.csv"].clone()).unwrap();
    assert!(
        failed.contains("was killed or died 2 times") && failed.contains("frequency_hz=210"),
        "{failed}"
    );
}

/// Where a process cannot be started the run fails, and ends only after those that were: none flies on by itself.
#[test]
fn refuses_more_processes_than_can_be_started_and_waits_for_the_others() {
    let scratch = Scratch::new("campaign-unstarted");
    let dir = &scratch.0;
    write(dir, &blade(200));
    // Two files for each process.
    let few = format!(
        "ulimit -n 40; exec '{}' campaign run c.toml --out few --jobs 64 2> said",
        env!("CARGO_BIN_EXE_wingbeat")
    );
    let end = Command::new("sh")
        .args(["-c", &few])
        .current_dir(dir)
        .status();
    let said = fs::read_to_string(dir.join("said")).unwrap();
    assert_eq!(end.unwrap().code(), Some(2), "{said}");
    assert!(said.contains("cannot start a process"), "{said}");
    let here = |p: &Path| fs::read_link(p.join("cwd")).is_ok_and(|cwd| cwd == *dir);
    let left = fs::read_dir("/proc").unwrap().flatten();
    let left: Vec<_> = left.map(|p| p.path()).filter(|p| here(p)).collect();
    assert!(left.is_empty(), "{left:?} of this run go on");
}

/// Ctrl-C ends a run with its exit code, and the same command goes on.
#[test]
fn behaves_an_interrupted_run_goes_on() {
    let scratch = Scratch::new("campaign-interrupted");
    let dir = &scratch.0;
    write(dir, &blade(200));
    let mut master = start(dir, "b", &[]);
    let begun = Instant::now();
    while !dir.join("b/points").exists() {
        assert!(begun.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
    let interrupt = format!("kill -INT {}", master.id());
    Command::new("sh")
        .args(["-c", &interrupt])
        .status()
        .unwrap();
    let end = master.wait().unwrap();
    assert_eq!(end.code(), Some(130));
    let status = wingbeat(
        dir,
        &["campaign", "status", "c.toml", "--out", "b", "--json"],
    );
    let status: serde_json::Value = serde_json::from_slice(&status.stdout).unwrap();
    assert!(
        status["done"].as_u64().unwrap() < 600 && status["blocks_in_flight"] == 0,
        "{status}"
    );
    flown(
        dir,
        &[
            "campaign", "run", "c.toml", "--out", "b", "--quiet", "--points", "0..60",
        ],
    );
}

/// A worker that starts after the file was changed flies nothing of the new one: the run ends with what happened.
#[test]
fn refuses_a_file_that_is_changed_while_it_is_flown() {
    let scratch = Scratch::new("campaign-changed");
    let dir = &scratch.0;
    write(dir, &blade(200));
    let mut child = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    child
        .current_dir(dir)
        .stderr(Stdio::piped())
        .stdout(Stdio::null());
    child.args([
        "campaign", "run", "c.toml", "--out", "b", "--jobs", "2", "--quiet",
    ]);
    let master = child.spawn().unwrap();
    let begun = Instant::now();
    while !dir.join("b/points").exists() {
        assert!(begun.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
    fs::write(
        dir.join("c.toml"),
        blade(200).replace("seed = 3", "seed = 4"),
    )
    .unwrap();
    workers(&master).into_iter().for_each(kill);
    let out = master.wait_with_output().unwrap();
    let report = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(1), "{report}");
    assert!(
        report.contains("c.toml was changed while it was flown"),
        "{report}"
    );
    assert!(!report.contains("interrupted"), "{report}");
    let leases = fs::read_dir(dir.join("b/leases")).unwrap();
    assert_eq!(leases.count(), 1, "nothing of the new plan was flown");
}

/// The hash of point `i` of the campaign.
fn hash_of(dir: &Path, i: usize) -> String {
    let plan = wingbeat(dir, &["campaign", "plan", "c.toml"]);
    let plan = String::from_utf8(plan.stdout).unwrap();
    let hash = plan.lines().nth(i + 1).unwrap().split(',').nth(1).unwrap();
    hash.to_owned()
}

/// Two points that keep their histories.
const KEPT: &str = r#"case = "case.toml"
keep = ["end.mass_centre_n3_m"]
files = ["history"]
[parameter."motion.frequency_hz"]
list = [90, 100]
"#;

/// A point whose directory another process writes is waited for, and counts as no failure.
#[test]
fn behaves_a_point_that_is_flown_elsewhere_is_waited_for() {
    let scratch = Scratch::new("campaign-busy");
    let dir = &scratch.0;
    write(dir, KEPT);
    let work = dir.join("b/work").join(hash_of(dir, 0));
    fs::create_dir_all(&work).unwrap();
    fs::write(dir.join("b/campaign.toml"), KEPT).unwrap();
    let history = fs::File::create(work.join("history.csv")).unwrap();
    history.lock().unwrap();
    let mut master = start(dir, "b", &[]);
    let begun = Instant::now();
    while !dir.join("b/files").exists() {
        assert!(begun.elapsed() < Duration::from_secs(60), "the other point");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_secs(3)); // looks of 0.2 s each
    assert!(work.join("history.csv").exists(), "it was removed");
    assert!(!dir.join("b/attempts").exists(), "it counts as a failure");
    assert!(master.try_wait().unwrap().is_none(), "it has ended");
    drop(history);
    assert!(master.wait().unwrap().success());
    merged(dir, "b");
    assert_eq!(numbers(dir, "b", "success"), [1.0, 1.0]);
}

/// A disk that cannot be written for a second is tried again.
#[test]
fn behaves_a_point_survives_a_short_fault_of_the_disk() {
    let scratch = Scratch::new("campaign-fault");
    let dir = &scratch.0;
    write(dir, KEPT);
    fs::create_dir_all(dir.join("b")).unwrap();
    fs::write(dir.join("b/campaign.toml"), KEPT).unwrap();
    fs::write(dir.join("b/work"), "in the way").unwrap(); // no directory can be made there
    let mut master = start(dir, "b", &[]);
    let begun = Instant::now();
    while !dir.join("b/attempts").exists() {
        assert!(begun.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(300));
    fs::remove_file(dir.join("b/work")).unwrap();
    assert!(master.wait().unwrap().success());
    merged(dir, "b");
    assert_eq!(numbers(dir, "b", "success"), [1.0, 1.0]);
}
