//! Numbers that only some points have, and means over more wingbeats than are flown.

use std::fs;

use crate::support::{Scratch, flown, wingbeat};
use crate::{column, numbers, write};

/// Two controllers, one of which there is not: commands are columns of the points that have them.
const CONTROLLED: &str = r#"case = "fruit-fly-blade"
keep = ["end.command_wing_left_stroke_amplitude_dimensionless", "lift_over_weight"]
[set]
"time.beats" = 1
"time.steps_per_beat" = 40
[parameter."control.controller"]
list = ["none", "stabiliser"]
"#;

#[test]
fn behaves_numbers_that_only_a_varied_key_brings_are_kept() {
    let scratch = Scratch::new("campaign-union");
    let dir = &scratch.0;
    write(dir, CONTROLLED);
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    flown(dir, &["campaign", "merge", "c.toml", "--out", "r"]);
    assert_eq!(column(dir, "r", "success"), ["1", "1"]);
    let name = "end.command_wing_left_stroke_amplitude_dimensionless";
    let commands = column(dir, "r", name);
    assert_eq!(commands[0], "", "{commands:?}");
    assert!(commands[1].parse::<f64>().is_ok(), "{commands:?}");
    let out = wingbeat(dir, &["campaign", "numbers", "c.toml"]);
    assert!(String::from_utf8(out.stdout).unwrap().contains(name));
}

#[test]
fn refuses_means_over_more_wingbeats_than_any_point_flies() {
    let scratch = Scratch::new("campaign-short");
    let dir = &scratch.0;
    let short = CONTROLLED.replace("[set]", "mean_beats = 10\n[set]");
    write(dir, &short);
    let out = wingbeat(dir, &["campaign", "check", "c.toml"]);
    let said = String::from_utf8(out.stderr).unwrap();
    assert_eq!(out.status.code(), Some(2), "{said}");
    assert!(
        said.contains("mean_beats") && said.contains("flights of 1 whole ones"),
        "{said}"
    );
    let line = 1 + short
        .lines()
        .position(|l| l.starts_with("mean_beats"))
        .unwrap();
    assert!(said.contains(&format!("c.toml:{line}")), "{said}");
}

/// The program that commands the wings belongs to a point as its values do.
#[test]
fn behaves_a_changed_program_is_another_point() {
    let scratch = Scratch::new("campaign-program");
    let dir = &scratch.0;
    let text = r#"case = "fruit-fly-blade"
keep = ["lift_over_weight"]
[set]
"control.controller" = "external"
"control.external" = { command = ["python3", "wings.py"] }
[parameter."time.beats"]
list = [1, 2]
"#;
    write(dir, text);
    let hashes = |program: &str| {
        fs::write(dir.join("wings.py"), program).unwrap();
        let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
        assert!(
            out.status.success(),
            "{}",
            String::from_utf8_lossy(&out.stderr)
        );
        String::from_utf8(out.stdout).unwrap()
    };
    let programs = ["pass", "pass # other", "pass"];
    let [first, second, again] = programs.map(hashes);
    assert_ne!(first, second);
    assert_eq!(first, again);
    // Also where a value is a word of the command.
    let word = "[parameter.\"control.external.command[1]\"]\nlist = [\"wings.py\"]\n";
    fs::write(dir.join("c.toml"), format!("{text}{word}")).unwrap();
    let [first, second, again] = programs.map(hashes);
    assert_ne!(first, second);
    assert_eq!(first, again);
}

/// A program that writes a file which its command names makes other points of all of them: the run says which file.
#[test]
fn behaves_a_file_that_a_program_writes_is_named() {
    let scratch = Scratch::new("campaign-written");
    let dir = &scratch.0;
    let text = r#"case = "fruit-fly-blade"
keep = ["lift_over_weight"]
[set]
"control.controller" = "external"
"control.external" = { command = ["python3", "wings.py", "log.txt"] }
[parameter."time.beats"]
list = [1, 2]
"#;
    write(dir, text);
    fs::write(
        dir.join("wings.py"),
        "import sys\nopen(sys.argv[1], 'a').write('x')\n",
    )
    .unwrap();
    let out = wingbeat(dir, &["campaign", "run", "c.toml", "--out", "r"]);
    let report = String::from_utf8_lossy(&out.stderr);
    assert!(
        report.contains("`log.txt` was changed while the points were flown"),
        "{report}"
    );
    assert!(!report.contains("`wings.py`"), "{report}");
}

/// The tables of a campaign are not those of another one that is merged into its directory by mistake.
#[test]
fn refuses_to_merge_into_the_directory_of_another_campaign() {
    let scratch = Scratch::new("campaign-other");
    let dir = &scratch.0;
    write(
        dir,
        "case = \"case.toml\"\nkeep = [\"end.mass_centre_n3_m\"]\n[parameter.\"motion.frequency_hz\"]\nlist = [90, 100]\n",
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    flown(dir, &["campaign", "merge", "c.toml", "--out", "r"]);
    let tables = fs::read(dir.join("r/points.csv")).unwrap();
    let text = fs::read_to_string(dir.join("c.toml")).unwrap();
    fs::write(dir.join("b.toml"), text.replace("90, 100", "90, 110")).unwrap();
    let merge = ["campaign", "merge", "b.toml", "--out", "r", "--partial"];
    let out = wingbeat(dir, &merge);
    let report = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(2), "{report}");
    for word in [
        "another campaign",
        "campaign run b.toml --out r`",
        "--overwrite",
    ] {
        assert!(report.contains(word), "{word}: {report}");
    }
    assert!(fs::read(dir.join("r/points.csv")).unwrap() == tables);
    flown(dir, &[&merge[..], &["--overwrite"]].concat());
    assert!(fs::read(dir.join("r/points.csv")).unwrap() != tables);
}

/// What is doubtful of the case or of a point that is tried is said before anything is flown, once.
#[test]
fn behaves_a_check_tells_what_is_doubtful() {
    let scratch = Scratch::new("campaign-doubts");
    let dir = &scratch.0;
    let text = r#"case = "fruit-fly-blade"
keep = ["lift_over_weight"]
[set]
"time.beats" = 1
"time.steps_per_beat" = 40
[parameter."body.mass_kg"]
list = [0.93e-6, 0.93e-3, 0.94e-3]
"#;
    write(dir, text);
    let out = wingbeat(dir, &["campaign", "check", "c.toml"]);
    let said = String::from_utf8(out.stderr).unwrap();
    assert!(said.contains("warning: "), "{said}");
    let warnings: Vec<&str> = said
        .lines()
        .filter(|l| l.starts_with("warning: "))
        .collect();
    let mut unique = warnings.clone();
    unique.dedup();
    assert_eq!(unique, warnings);
}

/// A history that leaves steps out changes nothing of verdict and summary, which are of all steps; means of its
/// columns are refused, also where only a varied key leaves steps out.
#[test]
fn invariant_verdict_and_summary_are_of_all_steps() {
    let scratch = Scratch::new("campaign-thinned");
    let dir = &scratch.0;
    let text = r#"case = "fruit-fly-blade"
keep = ["lift_over_weight", "summary.energy_residual_relative", "summary.corrector_passes_mean", "summary.verdict"]
files = ["history"]
[set]
"time.beats" = 2
"time.steps_per_beat" = 60
[parameter."output.history_every"]
list = [1, 7]
"#;
    write(dir, text);
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    flown(dir, &["campaign", "merge", "c.toml", "--out", "r"]);
    let names = [
        "lift_over_weight",
        "summary.energy_residual_relative",
        "summary.corrector_passes_mean",
        "summary.verdict",
    ];
    for name in names {
        let [whole, thinned] = numbers(dir, "r", name)[..] else {
            panic!("two points")
        };
        // The summary of a thinned history is read back from its text: a bit of the last digit may differ.
        let difference = (thinned - whole).abs();
        assert!(
            difference <= 1e-14 * whole.abs(),
            "{name}: {whole} {thinned}"
        );
    }
    let verdicts = column(dir, "r", "verdict");
    assert_eq!(verdicts[0], verdicts[1]);
    for part in ["", "max."] {
        let kept = format!("\"{part}mass_centre_n3_m\", \"lift_over_weight\"");
        write(dir, &text.replace("\"lift_over_weight\"", &kept));
        let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
        let said = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{said}");
        assert!(
            said.contains("c.toml:2:") && said.contains("leaves steps out"),
            "{said}"
        );
    }
}

/// Means of campaigns leave out the wingbeats that a smooth start reaches into: they are those of the beats after it, a
/// point with fewer has failed, and a campaign without one that flies enough is refused.
#[test]
fn exact_means_of_campaigns_leave_out_smooth_starts() {
    let scratch = Scratch::new("campaign-starts");
    let dir = &scratch.0;
    let text = r#"case = "fruit-fly-blade"
keep = ["lift_over_weight", "max.air_wing_right_force_n3_newton"]
mean_beats = 2
[set]
"time.beats" = 4
"time.steps_per_beat" = 40
"motion.start" = "smooth"
[parameter."motion.start_beats"]
list = [1.5, 2.5]
"#;
    write(dir, text);
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    flown(dir, &["campaign", "merge", "c.toml", "--out", "r"]);
    assert_eq!(column(dir, "r", "reason"), ["", "short"]);
    let set = [
        "time.beats=4",
        "time.steps_per_beat=40",
        "motion.start=smooth",
        "motion.start_beats=1.5",
    ];
    let set: Vec<String> = set.map(str::to_owned).into();
    let case = wingbeat::case::LoadedCase::find("fruit-fly-blade", &set).unwrap();
    let beats = wingbeat::Flight::from(case).fly().unwrap().summary().beats;
    let last: Vec<f64> = beats[2..]
        .iter()
        .filter_map(|b| b.mean.lift_over_weight)
        .collect();
    let mean = last.iter().sum::<f64>() / 2.0;
    assert_eq!(numbers(dir, "r", "lift_over_weight")[0], mean);
    let failed = fs::read_to_string(dir.join("r/failed.csv")).unwrap();
    for part in [
        "means over 2 wingbeats, and 1 are left of 4 whole ones that were flown",
        "(motion.start_beats, flight.tether.start_s)",
        "(time.beats = 5 or more)",
    ] {
        assert!(failed.contains(part), "{part} not in\n{failed}");
    }
    write(dir, &text.replace("1.5, 2.5", "2.5, 3"));
    let out = wingbeat(dir, &["campaign", "check", "c.toml"]);
    let said = String::from_utf8(out.stderr).unwrap();
    assert_eq!(out.status.code(), Some(2), "{said}");
    assert!(
        said.contains("flights of 4 whole ones, of which means leave out")
            && said.contains("a whole number from 1 to 1"),
        "{said}"
    );
    // A grid of which the last point alone flies enough, as no value does beside the first of the other axis.
    let grid = text
        .replace("\"time.beats\" = 4\n", "")
        .replace("mean_beats = 2", "mean_beats = 3");
    let grid = grid.replace(
        "1.5, 2.5]",
        "2, 1]\n[parameter.\"time.beats\"]\nlist = [2, 4]",
    );
    write(dir, &grid);
    flown(dir, &["campaign", "check", "c.toml"]);
}
