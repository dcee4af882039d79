//! Points that are flown again: damaged results, files that changed or are gone.

use std::fs;
use std::path::Path;

use crate::support::{QUICK, Scratch, flown, wingbeat};
use crate::{blade, column, merged, numbers, write};

/// A damaged result is found, and its point flown again.
#[test]
fn behaves_damaged_results_are_flown_again() {
    let scratch = Scratch::new("campaign-damage");
    let dir = &scratch.0;
    write(dir, &blade(4));
    flown(dir, &["campaign", "run", "c.toml", "--out", "a", "--quiet"]);
    let whole = merged(dir, "a");
    let folders = fs::read_dir(dir.join("a/points")).unwrap();
    let files = folders.flat_map(|f| fs::read_dir(f.unwrap().path()).unwrap());
    let mut files: Vec<_> = files.map(|f| f.unwrap().path()).collect();
    files.sort();
    fs::write(&files[0], "").unwrap(); // as after a power failure
    let text = fs::read_to_string(&files[1]).unwrap();
    fs::write(&files[1], text.replacen("values", "value5", 1)).unwrap();
    fs::remove_file(&files[2]).unwrap();
    let out = wingbeat(dir, &["campaign", "merge", "c.toml", "--out", "a"]);
    let report = String::from_utf8(out.stderr).unwrap();
    assert_eq!(out.status.code(), Some(2), "{report}");
    assert!(
        report.contains("3 of 12 points have no result yet"),
        "{report}"
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "a", "--quiet"]);
    assert!(merged(dir, "a") == whole);
}

/// A campaign of two motions from files.
pub const NAMED: &str = r#"case = "case.toml"
keep = ["end.wing_right_prescribed_phi_rad"]
[parameter."wing.right.motion.phi.table.file"]
list = ["a.csv", "Flügel schlag.csv"]
[parameter."motion.frequency_hz"]
list = [90, 100]
"#;

/// The campaign, and a case whose stroke is a table.
pub fn write_named(dir: &Path, text: &str) {
    write(dir, text);
    let (head, _) = QUICK.split_once("[wing.right.motion.phi.fourier]").unwrap();
    let table = "[wing.right.motion.phi.table]\nfile = \"a.csv\"\n";
    fs::write(dir.join("case.toml"), format!("{head}{table}")).unwrap();
}

/// A table of a stroke with this amplitude [deg].
pub fn stroke(angle: i32) -> String {
    format!("phase,angle,other\n0,{angle},1\n0.25,0,2\n0.5,-{angle},3\n0.75,0,2\n1,{angle},1\n")
}

/// A file that a value names is part of the point: what is in it counts, not its name. Points that name none
/// keep theirs.
#[test]
fn behaves_a_changed_file_that_a_value_names_is_flown_again() {
    let scratch = Scratch::new("campaign-named");
    let dir = &scratch.0;
    write_named(dir, &NAMED.replace("Flügel schlag", "b"));
    let fly = || {
        let args = ["campaign", "run", "c.toml", "--out", "r", "--jobs", "1"];
        let out = wingbeat(dir, &args);
        assert!(
            out.status.success(),
            "{}",
            String::from_utf8_lossy(&out.stderr)
        );
        merged(dir, "r");
        let said = String::from_utf8(out.stderr).unwrap();
        (said, numbers(dir, "r", "end.wing_right_prescribed_phi_rad"))
    };
    fs::write(dir.join("a.csv"), stroke(40)).unwrap();
    fs::write(dir.join("b.csv"), stroke(50)).unwrap();
    let (_, before) = fly();
    assert_ne!(before[0], before[2]);
    fs::write(dir.join("b.csv"), stroke(60)).unwrap();
    let (said, after) = fly();
    assert!(said.contains("4 points, 2 of them done"), "{said}");
    assert_eq!(before[..2], after[..2]);
    assert!(before[2] != after[2] && before[3] != after[3]);
    fs::write(dir.join("b.csv"), stroke(50)).unwrap();
    let (said, again) = fly();
    assert!(said.contains("4 points, 4 of them done"), "{said}");
    assert_eq!(before, again);
    // A column of a file that the case names: only what is read of it stands in the resolved case.
    let columns = "case = \"case.toml\"\nkeep = [\"end.wing_right_prescribed_phi_rad\"]\n[parameter.\"wing.right.motion.phi.table.angle_column\"]\nlist = [\"angle\", \"other\"]\n";
    fs::write(dir.join("c.toml"), columns).unwrap();
    let (_, before) = fly();
    fs::write(dir.join("a.csv"), stroke(40).replace(",3\n", ",9\n")).unwrap();
    let (_, after) = fly();
    assert_eq!(before[0], after[0]);
    assert_ne!(before[1], after[1]);
}

/// Files of every so many points: a campaign that grows flies those again that have none yet, and a point whose
/// files were removed is flown again.
#[test]
fn behaves_points_without_the_files_they_keep_are_flown_again() {
    let scratch = Scratch::new("campaign-files");
    let dir = &scratch.0;
    let text = |list: &str| {
        format!(
            "case = \"case.toml\"\nkeep = [\"end.mass_centre_n3_m\"]\nfiles = [\"history\", \"page\", \"figures\", \"summary\"]\n[retention]\nevery = 2\n[parameter.\"motion.frequency_hz\"]\nlist = [{list}]\n"
        )
    };
    let fly = |list: &str| {
        write(dir, &text(list));
        let args = ["campaign", "run", "c.toml", "--out", "r", "--jobs", "1"];
        let out = wingbeat(dir, &args);
        let said = String::from_utf8(out.stderr).unwrap();
        assert!(out.status.success(), "{said}");
        let kept = fs::read_dir(dir.join("r/files")).unwrap();
        let kept: Vec<_> = kept.map(|f| f.unwrap().path()).collect();
        (said, kept)
    };
    let (_, kept) = fly("90, 100, 110");
    assert_eq!(kept.len(), 2);
    let (said, kept) = fly("80, 90, 100, 110");
    assert!(said.contains("4 points, 2 of them done"), "{said}");
    // 80 and 100 keep theirs now; those of 90 and 110 are left where they are.
    assert_eq!(kept.len(), 4);
    let (said, _) = fly("80, 90, 100, 110");
    assert!(said.contains("4 points, 4 of them done"), "{said}");
    for name in [
        "history.csv",
        "flight.html",
        "summary.json",
        "manifest.json",
        "figures",
    ] {
        for folder in &kept {
            let path = folder.join(name);
            let removed = match path.is_dir() {
                true => fs::remove_dir_all(&path),
                false => fs::remove_file(&path),
            };
            removed.unwrap();
        }
        let (said, _) = fly("80, 90, 100, 110");
        assert!(said.contains("4 points, 2 of them done"), "{name}: {said}");
        let there = kept.iter().filter(|k| k.join(name).exists());
        assert_eq!(there.count(), 2, "{name}");
    }
}

/// Which files are kept is no part of a point: its results stay, and only points that lack files are flown again.
#[test]
fn invariant_points_do_not_depend_on_the_files_that_are_kept() {
    let scratch = Scratch::new("campaign-more-files");
    let dir = &scratch.0;
    let fly = |files: &str| {
        write(
            dir,
            &format!(
                "case = \"case.toml\"\nkeep = [\"end.mass_centre_n3_m\"]\n{files}[parameter.\"motion.frequency_hz\"]\nlist = [80, 90, 100, 110]\n"
            ),
        );
        let plan = wingbeat(dir, &["campaign", "plan", "c.toml"]).stdout;
        let args = ["campaign", "run", "c.toml", "--out", "r", "--jobs", "1"];
        let out = wingbeat(dir, &args);
        let said = String::from_utf8(out.stderr).unwrap();
        assert!(out.status.success(), "{said}");
        (plan, said)
    };
    let (plan, _) = fly("");
    let (same, said) = fly("files = [\"history\"]\n[retention]\nevery = 2\n");
    assert!(plan == same, "the hashes changed");
    assert!(said.contains("4 points, 2 of them done"), "{said}");
    assert_eq!(fs::read_dir(dir.join("r/files")).unwrap().count(), 2);
    let (_, said) = fly("files = [\"history\"]\n");
    assert!(said.contains("4 points, 2 of them done"), "{said}");
    assert_eq!(fs::read_dir(dir.join("r/files")).unwrap().count(), 4);
    let (_, said) = fly("");
    assert!(said.contains("4 points, 4 of them done"), "{said}");
}

/// Nor do verdicts depend on them, as of a controller that looks but once, nor what a thinned history holds.
#[test]
fn invariant_verdicts_do_not_depend_on_the_files_that_are_kept() {
    let scratch = Scratch::new("campaign-verdicts");
    let dir = &scratch.0;
    let text = r#"case = "fruit-fly-blade"
keep = ["end.euler_regularity_dimensionless", "summary.warnings"]
files = ["history"]
retention.every = 2
[set]
"time.beats" = 2
"time.steps_per_beat" = 40
"output.history_every" = 7
"control.controller" = "stabiliser"
"control.hold" = "start"
"control.every_beats" = 4
[parameter."body.mass_kg"]
list = [0.93e-6, 0.9300001e-6]
"#;
    write(dir, text);
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    assert_eq!(fs::read_dir(dir.join("r/files")).unwrap().count(), 1);
    assert_eq!(column(dir, "r", "verdict"), ["amber"; 2]);
    for name in ["end.euler_regularity_dimensionless", "summary.warnings"] {
        let [kept, other] = numbers(dir, "r", name)[..] else {
            panic!("two points")
        };
        assert!((kept - other).abs() < 1e-3, "{name}: {kept} {other}");
    }
}

/// What is taken out of the case is part of every point, also where its default is another value.
#[test]
fn behaves_another_removal_is_another_point() {
    let scratch = Scratch::new("campaign-removal");
    let dir = &scratch.0;
    let text = "case = \"case.toml\"\nkeep = [\"summary.energy_residual_relative\"]\n[parameter.\"air.model\"]\nlist = [\"blade_element\", \"none\"]\n";
    let case = QUICK.replace("\"none\"", "\"blade_element\"");
    let hashes = |head: &str| {
        write(dir, &format!("{head}{text}"));
        let integrator = "\n[dynamics]\nintegrator = \"hamming\"\n";
        fs::write(dir.join("case.toml"), format!("{case}{integrator}")).unwrap();
        let plan = wingbeat(dir, &["campaign", "plan", "c.toml"]).stdout;
        String::from_utf8(plan).unwrap()
    };
    let [whole, without] = ["", "remove = [\"dynamics.integrator\"]\n"].map(hashes);
    assert_eq!(whole.lines().count(), without.lines().count());
    for (a, b) in whole
        .lines()
        .zip(without.lines())
        .filter(|(a, _)| a.contains("blade_element"))
    {
        assert_ne!(a, b);
    }
}

/// A file of the case that is changed while the points are flown ends the run: no point of the new one is kept under
/// the name of the old one. One that is written again as it was changes nothing.
#[test]
fn refuses_a_data_file_that_is_changed_while_it_is_flown() {
    let scratch = Scratch::new("campaign-data");
    let dir = &scratch.0;
    let text = "case = \"case.toml\"\nkeep = [\"end.wing_right_prescribed_phi_rad\"]\n[parameter.\"motion.frequency_hz\"]\nlist = [90, 100]\n";
    write_named(dir, text);
    fs::write(dir.join("a.csv"), stroke(40)).unwrap();
    let campaign = wingbeat::campaign::Campaign::read(&dir.join("c.toml")).unwrap();
    let store = wingbeat::campaign::Store::open(&dir.join("r"), campaign.text()).unwrap();
    let stop = std::sync::atomic::AtomicBool::new(false);
    let work = || {
        let mut worker = wingbeat::campaign::Worker::new(&campaign, &store, 0..2).unwrap();
        worker.work(&stop, &mut || ())
    };
    fs::write(dir.join("a.csv"), stroke(50)).unwrap();
    let refused = work().unwrap_err().to_string();
    for part in ["a.csv", "was changed while the campaign was flown"] {
        assert!(refused.contains(part), "{refused}");
    }
    assert_eq!(store.done().unwrap().len(), 0);
    fs::write(dir.join("a.csv"), stroke(40)).unwrap();
    work().unwrap();
    assert_eq!(store.done().unwrap().len(), 2);
}

/// The directory of a flight that failed stays where that is asked for, in any air.
#[test]
fn behaves_directories_of_failed_flights_stay() {
    let scratch = Scratch::new("campaign-failed");
    let dir = &scratch.0;
    let text = r#"case = "fruit-fly-blade"
keep = ["lift_over_weight"]
mean_beats = 2
retention.failed = true
[set]
"time.steps_per_beat" = 40
[parameter."time.beats"]
list = [2, 1]
"#;
    write(dir, text);
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    assert_eq!(column(dir, "r", "reason"), ["", "short"]);
    let kept: Vec<_> = fs::read_dir(dir.join("r/work")).unwrap().collect();
    assert_eq!(kept.len(), 1);
    assert!(
        kept[0]
            .as_ref()
            .unwrap()
            .path()
            .join("history.csv")
            .is_file()
    );
}

/// A process that begins in a new directory while another one does is not in its way.
#[test]
fn behaves_jobs_may_begin_at_once() {
    let scratch = Scratch::new("campaign-at-once");
    let dir = &scratch.0;
    write(dir, &blade(1));
    fs::create_dir(dir.join("r")).unwrap();
    fs::write(dir.join("r/campaign.toml.4711.part"), "half").unwrap();
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    assert!(!dir.join("r/campaign.toml.4711.part").exists());
}

/// Points are counted in the order of the file: parameters that change places make another plan, with leases of
/// its own.
#[test]
fn behaves_another_order_of_parameters_is_another_plan() {
    let scratch = Scratch::new("campaign-order");
    let dir = &scratch.0;
    let frequency = "[parameter.\"motion.frequency_hz\"]\nlist = [90, 100]\n";
    let beats = "[parameter.\"time.beats\"]\nlist = [1, 2]\n";
    let head = "case = \"case.toml\"\nkeep = [\"summary.time_s\"]\n";
    for order in [[frequency, beats], [beats, frequency]] {
        write(dir, &format!("{head}{}", order.concat()));
        flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    }
    assert_eq!(fs::read_dir(dir.join("r/leases")).unwrap().count(), 2);
    merged(dir, "r");
    let beats = numbers(dir, "r", "time.beats");
    assert_eq!(beats, [1.0, 1.0, 2.0, 2.0], "the last one runs fastest");
}
