//! Bad input, one test each: the report names file, line, key, value and remedy, the exit code is
//! 2, and nothing is written.

use std::fs;
use std::path::PathBuf;

use crate::support::{Scratch, refused_with, says, wingbeat};

/// A vacuum case that is fine and quick.
const GOOD: &str = r#"format = 1
name = "good"

[time]
steps_per_beat = 40
beats = 0.2

[motion]
frequency_hz = 100.0

[dynamics]
formulation = "momentum"

[flight]
yaw_deg = 0.0

[air]
model = "none"

[body]
[body.part.thorax]
length_m = 1e-3
diameter_m = 1e-3
mass_kg = 1e-6

[wing.right]
hinge_m = [0, 0.5e-3, 0]
mass_kg = 1e-8
[wing.right.planform.rectangle]
chord_m = 1e-3
span_m = 2e-3
[wing.right.mesh]
chordwise = 2
spanwise = 3
[wing.right.motion.phi.table]
rows_deg = [[0.0, 10.0], [0.25, 40.0], [0.5, 10.0], [0.75, -40.0], [1.0, 10.0]]
"#;

/// Writes the case into the folder.
fn case_in(scratch: &Scratch, text: &str) -> PathBuf {
    let path = scratch.0.join("case.toml");
    fs::write(&path, text).unwrap();
    path
}

/// As [`refused_with`], of the good case; the report says what is allowed and what to try.
fn refused(name: &str, from: &str, to: &str, at: &str, wanted: &[&str]) {
    let report = refused_with(GOOD, name, [from, to], at, wanted);
    says(&report, "allowed: ");
    says(&report, "try: ");
}

#[test]
fn exact_the_good_case_flies() {
    let scratch = Scratch::new("good");
    case_in(&scratch, GOOD);
    let out = wingbeat(&scratch.0, &["run", "case.toml", "--out", "run", "--quiet"]);
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    assert!(out.stdout.is_empty() && out.stderr.is_empty());
    let history = fs::read_to_string(scratch.0.join("run/history.csv")).unwrap();
    assert_eq!(history.lines().count(), 1 + 9); // header, step 0, and 8 steps: 0.2 beats of 40
}

#[test]
fn exact_unknown_key() {
    refused(
        "key",
        "mass_kg = 1e-8",
        "mas_kg = 1e-8",
        "mas_kg",
        &[
            "wing.right.mas_kg = 1e-8: unknown key `mas_kg`",
            "hinge_m, planform, mesh, mass_kg",
            "did you mean `mass_kg`?",
        ],
    );
}

/// Columns are named after wings: `a+b` and `a;b` would give the same ones twice.
#[test]
fn refuses_wings_whose_columns_would_have_the_same_names() {
    let second = GOOD.split("[wing.right]").nth(1).unwrap();
    for (first, other) in [
        ("a+b right", "a;b right"),
        ("x-right", "x-right_prescribed"),
    ] {
        let both = second.replace("[wing.right", &format!("[wing.\"{other}\""));
        let text = GOOD.replace("[wing.right", &format!("[wing.\"{first}\""));
        let text = format!("{text}\n[wing.\"{other}\"]{both}");
        let scratch = Scratch::new(&format!("alike-{}", first.len()));
        case_in(&scratch, &text);
        let out = wingbeat(&scratch.0, &["check", "case.toml"]);
        let said = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{said}");
        for part in [
            "its columns in the history could not be told from those of `wing.",
            "give one of the two another name",
        ] {
            assert!(said.contains(part), "{said}\ndoes not say: {part}");
        }
    }
}

/// A line end would end a line to another program, a comma shifts columns, a dot ends a part of a key.
#[test]
fn refuses_names_of_parts_with_characters_of_keys_and_tables() {
    for name in [
        r"a\nb right",
        "a,b right",
        "fore.right",
        "a[0]-right",
        r#"a\"right"#,
        "a=right",
        " ",
    ] {
        let text = GOOD.replace("[wing.right", &format!("[wing.\"{name}\""));
        let scratch = Scratch::new("names-of-parts");
        case_in(&scratch, &text);
        let out = wingbeat(&scratch.0, &["check", "case.toml"]);
        let said = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{name}: {said}");
        for part in ["wing", "name", "letters, digits, - and _"] {
            assert!(said.contains(part), "{said}\ndoes not say: {part}");
        }
    }
}

#[test]
fn exact_wrong_unit() {
    refused(
        "unit",
        "mass_kg = 1e-8",
        "mass_mg = 0.01",
        "mass_mg",
        &[
            "wing.right.mass_mg = 0.01: unknown key `mass_mg`",
            "`mass_kg`: the unit is part of the key, convert the value",
        ],
    );
}

#[test]
fn exact_wrong_type() {
    refused(
        "type",
        "mass_kg = 1e-8",
        "mass_kg = \"10 ug\"",
        "10 ug",
        &[
            "wing.right.mass_kg = \"10 ug\": wrong type",
            "allowed: a number",
            "write the number without quotes and without a unit",
        ],
    );
}

#[test]
fn exact_unknown_choice() {
    refused(
        "choice",
        "\"none\"",
        "\"non\"",
        "\"non\"",
        &[
            "air.model = \"non\": unknown choice `non`",
            "vortex_lattice, blade_element, derivatives, external, none",
            "did you mean `none`?",
        ],
    );
}

#[test]
fn exact_missing_key() {
    refused(
        "missing",
        "chord_m = 1e-3\n",
        "",
        "[wing.right.planform.rectangle]",
        &[
            "wing.right.planform.rectangle.chord_m: this key is missing",
            "add `chord_m = ...`",
        ],
    );
}

#[test]
fn exact_negative_mass() {
    refused(
        "mass",
        "mass_kg = 1e-8",
        "mass_kg = -1e-8",
        "-1e-8",
        &[
            "wing.right.mass_kg = -1e-8: this must not be negative",
            "a finite number >= 0",
            "remove the minus sign",
        ],
    );
}

#[test]
fn exact_hinge_far_outside_the_body() {
    refused(
        "hinge",
        "[0, 0.5e-3, 0]",
        "[0, 0.5, 0]",
        "[0, 0.5, 0]",
        &[
            "wing.right.hinge_m = [0, 0.5, 0]: the hinge of wing `left` lies",
            "within half the extent",
            "a millimetre is 1e-3",
        ],
    );
}

#[test]
fn exact_zero_panels() {
    refused(
        "panels",
        "spanwise = 3",
        "spanwise = 0",
        "spanwise = 0",
        &[
            "wing.right.mesh.spanwise = 0: this is too small",
            "a whole number >= 1",
        ],
    );
}

#[test]
fn exact_nan_in_a_table() {
    refused(
        "nan",
        "[0.25, 40.0]",
        "[0.25, nan]",
        "nan",
        &[
            "wing.right.motion.phi.table.rows_deg[1][1] = NaN: this is not a finite number",
            "finite numbers everywhere",
        ],
    );
}

#[test]
fn exact_table_that_is_not_periodic() {
    refused(
        "table",
        "[1.0, 10.0]",
        "[1.0, 12.0]",
        "[1.0, 12.0]",
        &[
            "wing.right.motion.phi.table.rows_deg[4] = [1.0, 12.0]",
            "the last row one beat after the first with the same angle",
            "repeat the first angle",
        ],
    );
}

#[test]
fn exact_singular_attitude_in_euler_form() {
    let euler = "formulation = \"euler\"\n\n[flight]\nyaw_deg = 90.0";
    let momentum = "formulation = \"momentum\"\n\n[flight]\nyaw_deg = 0.0";
    refused(
        "singular",
        momentum,
        euler,
        "yaw_deg = 90.0",
        &[
            "flight.yaw_deg = 90.0",
            "within 3 degrees of +-90, where Euler angles are singular",
            "set dynamics.formulation = \"momentum\"",
        ],
    );
}

#[test]
fn exact_broken_toml() {
    let scratch = Scratch::new("toml");
    case_in(&scratch, &GOOD.replace("name = \"good\"", "name = \"good"));
    let out = wingbeat(&scratch.0, &["check", "case.toml"]);
    let report = String::from_utf8(out.stderr).unwrap();
    assert_eq!(out.status.code(), Some(2));
    assert!(
        report.contains("this is not TOML") && report.contains("case.toml:2:"),
        "{report}"
    );
    assert!(report.contains("wingbeat new"), "{report}");
    for (lacking, whole) in [("-.1", "-0.1"), ("5.", "5.0"), (".5", "0.5")] {
        let number = format!("[flight]\nyaw_deg = {lacking}");
        case_in(&scratch, &GOOD.replace("[flight]", &number));
        let out = wingbeat(&scratch.0, &["check", "case.toml"]);
        let report = String::from_utf8(out.stderr).unwrap();
        assert!(report.contains("no numbers like .5"), "{report}");
        assert!(report.contains(&format!("write {whole}")), "{report}");
    }
}

#[test]
fn exact_bad_override_says_where_it_came_from() {
    let scratch = Scratch::new("set");
    case_in(&scratch, GOOD);
    let set = ["check", "case.toml", "--set", "wing.right.mass_kg=-1"];
    let out = wingbeat(&scratch.0, &set);
    let report = String::from_utf8(out.stderr).unwrap();
    assert_eq!(out.status.code(), Some(2));
    assert!(
        report.contains("wing.right.mass_kg = -1: this must not be negative"),
        "{report}"
    );
    assert!(
        report.contains("wing.right.mass_kg=-1 (set on top of case.toml)"),
        "{report}"
    );
    let out = wingbeat(&scratch.0, &["check", "case.toml", "--set", "nonsense"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&out.stderr).contains("`nonsense` has no `=`"));
}

#[test]
fn exact_gaps_and_numbers_that_are_none_in_a_table_file() {
    let scratch = Scratch::new("file");
    let rows = GOOD.lines().find(|l| l.starts_with("rows_deg")).unwrap();
    case_in(&scratch, &GOOD.replace(rows, "file = \"phi.csv\""));
    let checked = |cell: &str| {
        let table = format!("phase,phi\n0,10\n0.25,40\n0.4,20\n0.5,{cell}\n0.75,-40\n1,10\n");
        fs::write(scratch.0.join("phi.csv"), table).unwrap();
        let out = wingbeat(&scratch.0, &["check", "case.toml"]);
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (out.status.code(), text(out.stdout), text(out.stderr))
    };
    let (code, _, report) = checked("inf");
    assert_eq!(code, Some(2));
    assert!(
        report.contains("line 5: `inf` is not a finite number"),
        "{report}"
    );
    assert!(
        report.contains("case.toml:") && report.contains("table.file"),
        "{report}"
    );
    let (code, told, report) = checked("nan");
    assert_eq!(code, Some(0), "{report}");
    assert!(
        told.contains(".phi.table: 1 of 6 rows have no angle"),
        "{told}"
    );
}

#[test]
fn exact_output_directory_that_exists() {
    let scratch = Scratch::new("exists");
    case_in(&scratch, GOOD);
    let precious = scratch.0.join("run/precious.txt");
    fs::create_dir_all(scratch.0.join("run")).unwrap();
    fs::write(&precious, "mine").unwrap();
    for extra in [&[][..], &["--overwrite"][..]] {
        let args = [&["run", "case.toml", "--out", "run"][..], extra].concat();
        let out = wingbeat(&scratch.0, &args);
        let report = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{report}");
        assert!(
            report.contains("`run` exists already and is left untouched"),
            "{report}"
        );
        assert!(report.contains("choose another directory"), "{report}");
        assert_eq!(fs::read_to_string(&precious).unwrap(), "mine");
        assert_eq!(fs::read_dir(scratch.0.join("run")).unwrap().count(), 1);
    }
}

#[test]
fn exact_output_directory_that_cannot_be_written() {
    let scratch = Scratch::new("write");
    case_in(&scratch, GOOD);
    fs::write(scratch.0.join("file"), "mine").unwrap();
    let out = wingbeat(&scratch.0, &["run", "case.toml", "--out", "file/run"]);
    let report = String::from_utf8(out.stderr).unwrap();
    assert_eq!(out.status.code(), Some(2), "{report}");
    assert!(
        report.contains("cannot make the result directory `file/run`"),
        "{report}"
    );
    assert!(
        report.contains("choose a place you may write to with --out DIR"),
        "{report}"
    );
    assert_eq!(fs::read_to_string(scratch.0.join("file")).unwrap(), "mine");
}

#[test]
fn exact_no_such_case_and_no_overwriting_by_new() {
    let scratch = Scratch::new("new");
    let out = wingbeat(&scratch.0, &["run", "fruit-fly-hoover"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&out.stderr).contains("did you mean `fruit-fly-hover`?"));
    assert!(
        wingbeat(&scratch.0, &["new", "benchmark-1"])
            .status
            .success()
    );
    fs::write(scratch.0.join("benchmark-1.toml"), "mine").unwrap();
    let out = wingbeat(&scratch.0, &["new", "benchmark-1"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&out.stderr).contains("exists already and is left untouched"));
    assert_eq!(
        fs::read_to_string(scratch.0.join("benchmark-1.toml")).unwrap(),
        "mine"
    );
}

/// A hinge far too stiff for the steps fails on trial with a message of numbers; what is implausible is said before it.
#[test]
fn refuses_flights_that_fail_on_trial_with_their_doubts_first() {
    let scratch = Scratch::new("doubts-first");
    let hinge = "joint.hinge-right.element=[{stiffness_newton_m_per_rad=1e5}]";
    let set = ["--set", "air.model=blade_element", "--set", hinge];
    let out = wingbeat(&scratch.0, &[&["check", "robobee"][..], &set].concat());
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(!out.status.success(), "{said}");
    let doubt = said.find("is the stiffness in N m/rad?");
    let error = said.find("error: ");
    assert!(doubt.is_some() && doubt < error, "{said}");
}

/// Cores of an animal made smaller that are not: thirty panels wide, so that all panels feel the same.
#[test]
fn refuses_cores_wider_than_panels_by_their_key() {
    let scratch = Scratch::new("cores");
    let small = "--set=animal.scale=0.001";
    let args = [
        "run",
        "fruit-fly-tethered",
        small,
        "--set=time.beats=0.2",
        "--out=small",
    ];
    let out = wingbeat(&scratch.0, &args);
    let report = String::from_utf8(out.stderr).unwrap();
    for words in [
        "air.bound_core",
        "singular",
        "animal.scale makes the animal smaller and leaves all lengths of [air]",
    ] {
        assert!(report.contains(words), "{words}: {report}");
    }
}

/// Less than half a step is none, and is not made one.
#[test]
fn exact_flights_of_less_than_a_step() {
    refused(
        "no-step",
        "beats = 0.2",
        "beats = 0.01",
        "beats = 0.01",
        &[
            "time.beats = 0.01: this is 4.00e-1 of a step, and not one is flown",
            "a step or more: 2.500e-2 wingbeats are one",
            "give `steps` in place of `beats`",
        ],
    );
}
