//! What is flown, what is not flown again, what the tables hold.

use std::fs;
use std::process::Command;

use wingbeat::Flight;

use crate::again::{NAMED, stroke, write_named};
use crate::support::{Scratch, flown, readers, required, wingbeat};
use crate::{TABLES, blade, column, merged, numbers, write};

#[test]
fn exact_points_are_the_flights_of_their_cases() {
    let scratch = Scratch::new("campaign-exact");
    let dir = &scratch.0;
    write(dir, &blade(2));
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    let [frequency, mass] = ["motion.frequency_hz", "body.mass_kg"].map(|c| numbers(dir, "r", c));
    assert_eq!(frequency, [190.0, 190.0, 200.0, 200.0, 210.0, 210.0]);
    assert_eq!(
        mass[0], mass[2],
        "the same samples at every point of the grid"
    );
    for k in [0, 3] {
        let keys = [
            "time.beats=1".to_owned(),
            "time.steps_per_beat=40".to_owned(),
            format!("motion.frequency_hz={}", frequency[k]),
            format!("body.mass_kg={:?}", mass[k]),
        ];
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        let run = Flight::preset_with("fruit-fly-blade", &keys)
            .unwrap()
            .fly()
            .unwrap();
        let beat = run.beats()[0];
        let own = |name: &str| numbers(dir, "r", name)[k];
        assert_eq!(own("lift_over_weight"), beat.lift_over_weight); // to the bit
        assert_eq!(own("power_watt"), beat.power_watt);
        let last = run.records.last().unwrap().mass_centre.z;
        assert_eq!(own("end.mass_centre_n3_m"), last);
    }
}

/// Shards, ranges and numbers of processes: the same tables. More samples fly only the new ones, other numbers all.
#[test]
fn invariant_tables_do_not_tell_who_flew_what_and_reruns_fly_what_is_new() {
    let scratch = Scratch::new("campaign-shards");
    let dir = &scratch.0;
    write(dir, &blade(10));
    flown(
        dir,
        &[
            "campaign", "run", "c.toml", "--out", "a", "--jobs", "1", "--quiet",
        ],
    );
    for part in [
        ["--shard", "2/3"],
        ["--points", "0..4"],
        ["--shard", "1/3"],
        ["--shard", "3/3"],
    ] {
        flown(
            dir,
            &[
                &["campaign", "run", "c.toml", "--out", "b", "--quiet"],
                &part[..],
            ]
            .concat(),
        );
    }
    assert!(merged(dir, "a") == merged(dir, "b"));
    let files = || {
        let folders = fs::read_dir(dir.join("a/points")).unwrap();
        let files = folders.flat_map(|f| fs::read_dir(f.unwrap().path()).unwrap());
        let times = files
            .map(|f| f.unwrap())
            .map(|f| (f.path(), f.metadata().unwrap().modified().unwrap()));
        times.collect::<std::collections::BTreeMap<_, _>>()
    };
    let before = files();
    write(dir, &blade(12));
    flown(dir, &["campaign", "run", "c.toml", "--out", "a", "--quiet"]);
    let after = files();
    assert_eq!((before.len(), after.len()), (30, 36));
    assert!(
        before
            .iter()
            .all(|(path, time)| after.get(path) == Some(time)),
        "an old point was flown again"
    );
    let out = wingbeat(
        dir,
        &["campaign", "status", "c.toml", "--out", "a", "--json"],
    );
    let status: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    assert_eq!(
        (&status["points"], &status["done"], &status["failed"]),
        (&36.into(), &36.into(), &0.into())
    );
}

/// Wings of this shape have no such root offset, and each value is one of the preset: the order of a list does not
/// make a mistake of that.
#[test]
fn behaves_values_that_are_refused_together_alone_are_results() {
    let scratch = Scratch::new("campaign-together");
    let dir = &scratch.0;
    write(
        dir,
        r#"case = "fruit-fly-blade"
keep = ["lift_over_weight"]
[set]
"time.beats" = 1
"time.steps_per_beat" = 40
[parameter."wing.right.planform.beta.r2_hat"]
list = [0.5, 0.6]
[parameter."wing.right.planform.beta.root_offset_m"]
list = [0.0, 0.0003]
"#,
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    let tables = merged(dir, "r");
    assert_eq!(column(dir, "r", "success"), ["1", "0", "1", "1"]);
    let failed = String::from_utf8(tables["failed.csv"].clone()).unwrap();
    assert!(failed.contains("out of reach"), "{failed}");
}

/// Points that cannot be flown are results too: their reason, case and command stand in failed.csv.
#[test]
fn behaves_points_that_fail_are_told_and_may_be_tried_again() {
    let scratch = Scratch::new("campaign-failed");
    let dir = &scratch.0;
    // Each key alone is fine; wings with a long root offset and a short length are refused.
    write(
        dir,
        r#"case = "fruit-fly-blade"
keep = ["lift_over_weight"]
[set]
"time.steps_per_beat" = 40
[parameter."time.beats"]
list = [0.5, 1]
"#,
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    let tables = merged(dir, "r");
    assert_eq!(column(dir, "r", "success"), ["0", "1"]);
    assert_eq!(column(dir, "r", "reason"), ["short", ""]);
    assert_eq!(column(dir, "r", "lift_over_weight")[0], "");
    let failed = String::from_utf8(tables["failed.csv"].clone()).unwrap();
    for part in [
        "means over 1 wingbeats, but only 0 whole ones were flown",
        "wingbeat run fruit-fly-blade --set time.steps_per_beat=40 --set time.beats=0.5",
        "[wing.right.planform.beta]",
    ] {
        assert!(failed.contains(part), "{part} not in\n{failed}");
    }
    flown(dir, &["campaign", "retry", "c.toml", "--out", "r"]);
    let status = || {
        let out = wingbeat(dir, &["campaign", "status", "c.toml", "--out", "r"]);
        String::from_utf8(out.stdout).unwrap()
    };
    assert!(
        status().contains("1 of 2 points done, 0 failed"),
        "{}",
        status()
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    assert!(
        status().contains("2 of 2 points done, 1 failed"),
        "{}",
        status()
    );
    assert!(merged(dir, "r") == tables);
}

/// The command of a point names the case as the folder has it in which the campaign is run.
#[test]
fn behaves_the_command_of_a_point_flies_its_case_from_where_the_campaign_is_run() {
    let scratch = Scratch::new("campaign-folder");
    let dir = &scratch.0;
    fs::create_dir(dir.join("sub")).unwrap();
    let case = include_str!("../../../wingbeat-case/presets/fruit-fly-blade.toml");
    fs::write(dir.join("sub/own.toml"), case).unwrap();
    let text = "case = \"own.toml\"\nkeep = [\"lift_over_weight\"]\n[set]\n\"time.steps_per_beat\" = 40\n[parameter.\"time.beats\"]\nlist = [0.5, 1]\n";
    fs::write(dir.join("sub/c.toml"), text).unwrap();
    let campaign = ["sub/c.toml", "--out", "r"];
    flown(
        dir,
        &[&["campaign", "run"][..], &campaign, &["--quiet"]].concat(),
    );
    flown(dir, &[&["campaign", "merge"][..], &campaign].concat());
    let failed = fs::read_to_string(dir.join("r/failed.csv")).unwrap();
    assert!(failed.contains("wingbeat run sub/own.toml"), "{failed}");
}

/// The command of a point that is trimmed begins with its trim, at the speed of the point.
#[test]
fn behaves_the_command_of_a_failed_trim_fails_as_the_point_does() {
    let scratch = Scratch::new("campaign-failed-trim");
    let dir = &scratch.0;
    write(
        dir,
        r#"case = "fruit-fly-blade"
keep = ["lift_over_weight"]
do = ["trim", "run"]
[set]
"time.beats" = 1
[trim]
steps_per_beat = 40
[parameter."trim.forward_m_s"]
list = [3]
"#,
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    let failed = String::from_utf8(merged(dir, "r")["failed.csv"].clone()).unwrap();
    let trim =
        "trim fruit-fly-blade --set time.beats=1 --forward 3 --steps 40 --write trimmed-0.toml";
    let whole = format!("wingbeat {trim} && wingbeat run trimmed-0.toml");
    assert!(failed.contains(&whole), "{whole} not in\n{failed}");
    let words: Vec<&str> = trim.split(' ').collect();
    let out = wingbeat(dir, &words);
    assert_eq!(out.status.code(), Some(1), "{out:?}");
    assert!(
        String::from_utf8_lossy(&out.stdout).contains("NOT trimmed"),
        "{out:?}"
    );
}

/// No file may grow, as on a full disk: a true exit code, nothing half-written, and it goes on.
#[cfg(unix)]
#[test]
fn behaves_a_full_disk_stops_the_workers_and_loses_nothing() {
    let scratch = Scratch::new("campaign-full");
    let dir = &scratch.0;
    write(dir, &blade(4));
    flown(dir, &["campaign", "run", "c.toml", "--out", "a", "--quiet"]);
    flown(
        dir,
        &[
            "campaign", "run", "c.toml", "--out", "b", "--quiet", "--points", "0..5",
        ],
    );
    let program = env!("CARGO_BIN_EXE_wingbeat");
    let script = format!("ulimit -f 0; exec \"{program}\" \"$@\"");
    let out = Command::new("sh")
        .args([
            "-c", &script, "sh", "campaign", "run", "c.toml", "--out", "b", "--quiet",
        ])
        .current_dir(dir)
        .output()
        .unwrap();
    let report = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(1), "{report}");
    assert!(report.contains("cannot write"), "{report}");
    flown(dir, &["campaign", "run", "c.toml", "--out", "b", "--quiet"]);
    assert!(merged(dir, "a") == merged(dir, "b"));
    let left = crate::support::contents(&dir.join("b"));
    let half = left
        .keys()
        .filter(|p| p.extension().is_some_and(|e| e == "part"));
    assert_eq!(half.count(), 0);
}

/// 40.0 is a whole number, as ranges in the logarithm and programs that know one kind of number give it; 40.5 is none.
#[test]
fn exact_whole_numbers_may_have_a_point() {
    let scratch = Scratch::new("campaign-whole");
    let dir = &scratch.0;
    let text = |way: &str| {
        format!(
            "case = \"fruit-fly-blade\"\nkeep = [\"summary.steps\"]\n[set]\n\"time.beats\" = 1\n[parameter.\"time.steps_per_beat\"]\n{way}\n"
        )
    };
    write(dir, &text("log_range = { from = 20, to = 80, count = 3 }"));
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    assert_eq!(numbers(dir, "r", "summary.steps"), [20.0, 40.0, 80.0]);
    for (list, word) in [("[20.0, 40.5]", "40.5"), ("[20.0, 1e300]", "1e300")] {
        write(dir, &text(&format!("list = {list}")));
        let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
        let report = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{report}");
        let fraction = report.contains("a number with a fraction");
        assert!(
            report.contains(word) && fraction == (word == "40.5"),
            "{report}"
        );
    }
}

/// Names that begin with a dash are no options, for workers, in the words of the program and in scripts.
#[test]
fn behaves_files_that_begin_with_a_dash_are_flown() {
    let scratch = Scratch::new("campaign-dash");
    let dir = &scratch.0;
    fs::write(dir.join("-c.toml"), blade(1)).unwrap();
    let out = wingbeat(dir, &["campaign", "run", "--out=-r", "--", "-c.toml"]);
    let report = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{report}");
    let said = String::from_utf8(out.stdout).unwrap();
    assert!(
        said.contains("campaign merge ./-c.toml --out ./-r`"),
        "{said}"
    );
    flown(dir, &["campaign", "merge", "./-c.toml", "--out=-r"]);
    assert_eq!(numbers(dir, "-r", "success"), [1.0; 3]);
    for engine in ["slurm", "snakemake"] {
        let out = wingbeat(dir, &["campaign", engine, "--out=-r", "--", "-c.toml"]);
        let script = String::from_utf8(out.stdout).unwrap();
        assert!(
            script.contains("campaign run ./-c.toml --out ./-r "),
            "{script}"
        );
    }
}

#[test]
fn exact_tables_are_read_by_xarray_and_pyarrow() {
    let scratch = Scratch::new("campaign-tables");
    let dir = &scratch.0;
    let zip = "[[zip]]\n\"air.density_kg_m3\" = [1.1, 1.2]\n\"dynamics.formulation\" = [\"momentum\", \"quaternion\"]\n";
    write(dir, &format!("{}{zip}", blade(2)));
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    assert!(TABLES.iter().all(|t| dir.join("r").join(t).is_file()));
    write_named(dir, NAMED);
    let names = ["a.csv", "Flügel schlag.csv"];
    for (name, angle) in names.iter().zip([40, 50]) {
        fs::write(dir.join(name), stroke(angle)).unwrap();
    }
    flown(
        dir,
        &["campaign", "run", "c.toml", "--out", "texts", "--quiet"],
    );
    merged(dir, "texts");
    match readers::python() {
        Err(problem) => required(&format!("no Python with the readers: {problem}")),
        Ok(python) => {
            let script = readers::readers().join("campaign.py");
            let read = readers::works(Command::new(python).arg(script).arg(dir.join("r")));
            read.unwrap_or_else(|e| panic!("{e}"));
        }
    }
}

/// Points that take too long fail as such; a directory that is too large stops the workers.
#[test]
fn behaves_budgets_are_kept() {
    let scratch = Scratch::new("campaign-budget");
    let dir = &scratch.0;
    let text = |budget: &str| blade(2).replace("attempts = 20", budget);
    write(dir, &text("time_per_point_s = 1e-6"));
    flown(
        dir,
        &["campaign", "run", "c.toml", "--out", "slow", "--quiet"],
    );
    merged(dir, "slow");
    assert_eq!(column(dir, "slow", "reason"), ["slow"; 6]);
    write(dir, &text("disk_mb = 1e-4"));
    let args = [
        "campaign", "run", "c.toml", "--out", "full", "--quiet", "--jobs", "1",
    ];
    let out = wingbeat(dir, &args);
    let report = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(1), "{report}");
    assert!(
        report.contains("more than budget.disk_mb allows"),
        "{report}"
    );
    write(dir, &text("disk_mb = 10.0"));
    flown(dir, &args);
    merged(dir, "full");
    assert_eq!(column(dir, "full", "success"), ["1"; 6]);
}

/// A table of points: texts, whole numbers and numbers go where they belong; its plan is that of the file.
#[test]
fn exact_points_of_a_table_are_flown() {
    let scratch = Scratch::new("campaign-csv");
    let dir = &scratch.0;
    write(
        dir,
        "case = \"fruit-fly-blade\"\nkeep = [\"power_watt\", \"summary.steps\"]\ntable = \"points.csv\"\n[set]\n\"time.beats\" = 1\n",
    );
    let table = "time.steps_per_beat,dynamics.formulation,motion.frequency_hz,air.buoyancy\n40,momentum,200.5,true\n60,quaternion,190,False\n";
    fs::write(dir.join("points.csv"), table).unwrap();
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    assert_eq!(numbers(dir, "r", "summary.steps"), [40.0, 60.0]);
    // A spreadsheet may part its columns by semicolons: the same points.
    let planned = |table: &str| {
        fs::write(dir.join("points.csv"), table).unwrap();
        let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
        (
            out.status.code(),
            String::from_utf8_lossy(&out.stdout).into_owned(),
        )
    };
    assert_eq!(planned(&table.replace(',', ";")), planned(table));
    let marked = format!("\u{feff}# of a spreadsheet\n{}", table.replace(',', "\t"));
    assert_eq!(planned(&marked), planned(table));
    let keys = [
        "time.beats=1",
        "time.steps_per_beat=60",
        "dynamics.formulation=quaternion",
        "motion.frequency_hz=190",
    ];
    let run = Flight::preset_with("fruit-fly-blade", &keys)
        .unwrap()
        .fly()
        .unwrap();
    assert_eq!(
        numbers(dir, "r", "power_watt")[1],
        run.beats()[0].power_watt
    ); // to the bit
    fs::write(dir.join("points.csv"), table.replace("190", "190 Hz")).unwrap();
    let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
    let report = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(2), "{report}");
    assert!(
        report.contains("c.toml:3:") && report.contains("motion.frequency_hz"),
        "{report}"
    );
}
