//! What every analysis says: words or one JSON object, on the standard output or in a file.

use std::fs;

use crate::support::{Scratch, flown, quick_case, refused, said, wingbeat};
use serde_json::Value;

/// Every command that analyses, with a name that its JSON has.
const ANALYSES: [(&[&str], &str); 13] = [
    (&["check", "case.toml"], "mass_kg"),
    (&["show", "r"], "summary"),
    (&["compare", "r", "s"], "keys"),
    (&["presets"], "species"),
    (&["trim", "--steps", "20"], "unknowns"),
    (
        &[
            "trim", "--steps", "20", "--sweep", "0", "0.4", "--points", "3",
        ],
        "flights",
    ),
    (&["stability", "--steps", "20"], "floquet_modes"),
    (&["derivatives", "--steps", "20"], "control_derivatives"),
    (&["power", "--steps", "20"], "power"),
    (
        &["ensemble", "fruit-fly-blade", "--members", "2"],
        "ensemble",
    ),
    (&["stabilise", "--steps", "20", "--beats", "2"], "beats"),
    (&["velocity", "v", "--point", "0,0,0"], "points"),
    (&["stability", "table1-sun-2007"], "modes"),
];

/// Standard output of a command that succeeds.
/// Without the cost, which is measured and never the same.
fn steady(text: &str) -> String {
    let lines = text.lines().filter(|l| !l.starts_with("cost"));
    lines.collect::<Vec<_>>().join("\n")
}

fn object(text: &str) -> Value {
    let mut value: Value = serde_json::from_str(text).unwrap();
    value.as_object_mut().expect("an object").remove("cost");
    value
}

#[test]
fn behaves_every_analysis_has_words_and_json_and_a_file_for_them() {
    let scratch = Scratch::new("reports");
    let dir = &scratch.0;
    quick_case(dir);
    for (out, beats) in [("r", "time.beats=0.2"), ("s", "time.beats=0.1")] {
        flown(
            dir,
            &["run", "case.toml", "--quiet", "--out", out, "--set", beats],
        );
    }
    let steps = [
        "--set",
        "time.steps=3",
        "--set",
        "output.keep_checkpoint=true",
    ];
    flown(
        dir,
        &[&["run", "benchmark-2", "--quiet", "--out", "v"], &steps[..]].concat(),
    );
    for (k, (args, name)) in ANALYSES.into_iter().enumerate() {
        let with = |more: &[&str]| said(dir, &[args, more].concat());
        let (words, json) = (with(&[]), with(&["--json"]));
        assert!(!words.is_empty() && json.lines().count() == 1, "{args:?}");
        let value = object(&json);
        assert!(!value[name].is_null(), "{args:?}: {json}");

        let [text, data] = ["txt", "json"].map(|end| format!("{k}.{end}"));
        assert_eq!(with(&["--out", &text]), "", "{args:?}");
        assert_eq!(with(&["--json", "--out", &data]), "", "{args:?}");
        let read = |file: &str| fs::read_to_string(dir.join(file)).unwrap();
        assert_eq!(steady(&read(&text)), steady(&words), "{args:?}");
        assert_eq!(object(&read(&data)), value, "{args:?}");
        assert_eq!(steady(&with(&["--out", "-"])), steady(&words), "{args:?}");

        let again = wingbeat(dir, &[args, &["--out", &text]].concat());
        assert_eq!(again.status.code(), Some(2), "{args:?}");
        with(&["--out", &text, "--overwrite"]);
        let idle = wingbeat(dir, &[args, &["--overwrite"]].concat());
        assert_eq!(idle.status.code(), Some(2), "{args:?}");
    }
}

/// Wingbeats that change are not steady; those that scatter are not known to be.
#[test]
fn agrees_compare_with_show_on_whether_beats_are_steady() {
    let scratch = Scratch::new("reports-steady");
    let dir = &scratch.0;
    let fly = |out: &str, mode: &str| {
        let args = ["run", "fruit-fly-blade", "--quiet", "--out", out];
        let sets = ["--set", "time.beats=7", "--set", mode];
        flown(dir, &[&args[..], &sets].concat());
        let shown = object(&said(dir, &["show", out, "--json"]));
        let means = &shown["summary"]["means"];
        ["is_steady", "is_known"].map(|key| means[key].as_bool().unwrap())
    };
    // Free it falls out of its hover; held its beats are all alike.
    assert_eq!(fly("free", "flight.mode=free"), [false, true]);
    assert_eq!(fly("held", "flight.mode=tethered"), [true, true]);
    let compared = said(dir, &["compare", "free", "held"]);
    assert!(
        compared.contains("the beats of the first flight are not steady"),
        "{compared}"
    );
    assert!(
        !compared.contains("known") && !compared.contains("second flight are"),
        "{compared}"
    );
}

#[test]
fn behaves_the_verification_suite_has_json() {
    let scratch = Scratch::new("reports-verify");
    let dir = &scratch.0;
    let list = object(&said(dir, &["verify", "--list", "--json"]));
    let words = said(dir, &["verify", "--list"]);
    assert_eq!(
        list["cases"].as_array().unwrap().len(),
        words.lines().count()
    );
    let one = ["verify", "--only", "biot-savart-filament", "--json"];
    let told = object(&said(dir, &one));
    assert_eq!(told["rows"]["fail"], 0);
    assert!(told["rows"]["pass"].as_u64().unwrap() > 0);
    assert!(dir.join(told["report"].as_str().unwrap()).is_file());
}

/// Commands, cases, keys, options, their values and species: the nearest that is known.
#[test]
fn behaves_a_slip_of_the_finger_is_answered_with_what_was_meant() {
    let scratch = Scratch::new("reports-slips");
    let dir = &scratch.0;
    quick_case(dir);
    flown(dir, &["run", "case.toml", "--quiet", "--out", "r"]);
    let slips: [(&[&str], &str); 12] = [
        (&["rnu"], "'run'"),
        (&["prests"], "'presets'"),
        (&["run", "fruit-fly-hoover"], "`fruit-fly-hover`"),
        (&["check", "bumbleebee-blade"], "`bumblebee-blade`"),
        (&["new", "dragnofly"], "`dragonfly`"),
        (&["new", "--species", "hawkmoht"], "`hawkmoth`"),
        (&["check", "case.toml", "--set", "time.beets=3"], "`beats`"),
        (
            &["check", "case.toml", "--set", "wing.right.mas_kg=3"],
            "`mass_kg`",
        ),
        (&["check", "case.toml", "--jsn"], "'--json'"),
        (&["export", "r", "--format", "hdf"], "`hdf5`"),
        (&["plot", "r", "anglse"], "`angles`"),
        (&["completions", "bahs"], "'bash'"),
    ];
    for (args, meant) in slips {
        let out = wingbeat(dir, args);
        assert_eq!(out.status.code(), Some(2), "{args:?}");
        let problem = String::from_utf8(out.stderr).unwrap();
        assert!(problem.contains(meant), "{args:?}: {problem}");
    }
}

#[test]
fn behaves_check_tells_the_cost_in_numbers() {
    let scratch = Scratch::new("reports-cost");
    let dir = &scratch.0;
    let cost = |args: &[&str]| -> Value {
        let text = said(dir, &[&["check", "--json"], args].concat());
        serde_json::from_str::<Value>(&text).unwrap()["cost"].clone()
    };
    let tried = cost(&["rectangular-wing"]);
    for key in ["time_s", "threads", "trial_steps", "wake_elements_at_end"] {
        let number = tried[key].as_f64();
        assert!(number.is_some_and(|x| x > 0.0), "{key}: {tried}");
    }
    let large = [
        "wing.right.mesh.spanwise=100",
        "wing.right.mesh.chordwise=60",
    ];
    let large = large.map(|set| ["--set", set]).concat();
    let untried = cost(&[&["fruit-fly-hover"], &large[..]].concat());
    let unknowns = untried["unknowns"].as_f64().unwrap();
    assert!(unknowns > 4000.0, "{untried}");
    assert_eq!(untried["matrix_byte"], 8.0 * unknowns * unknowns);
    let why = untried["not_tried"].as_str().unwrap();
    assert!(why.contains("--trial"), "{why}");
}

/// A fly's powers are microwatts, a hawkmoth's milliwatts; as numbers they are watts.
#[test]
fn behaves_powers_are_in_the_unit_that_suits_them() {
    let scratch = Scratch::new("reports-power");
    for (case, unit, scale) in [
        ("fruit-fly-blade", "uW", 1e6),
        ("hawkmoth-blade", "mW", 1e3),
    ] {
        let args = ["power", case, "--steps", "40"];
        let text = said(&scratch.0, &args);
        assert!(text.contains(&format!("{unit}  W/kg total")), "{text}");
        let line = text.lines().find(|l| l.contains("no elastic storage"));
        let words = line.unwrap().split_whitespace().rev();
        let shown: f64 = words.take(3).last().unwrap().parse().unwrap();
        let json = said(&scratch.0, &[&args[..], &["--json"]].concat());
        let value = &serde_json::from_str::<Value>(&json).unwrap()["power"];
        let watt = value["no_storage"]["watt"].as_f64().unwrap();
        assert!((shown - scale * watt).abs() < 6e-4, "{shown} {watt}"); // three places
    }
}

/// What takes minutes was announced, and refused after that: joints that move freely beside wakes of strips, a turn.
#[test]
fn refuses_trims_with_a_memory_before_they_are_announced() {
    let scratch = Scratch::new("announced");
    let jones = [
        "--set=air.model=blade_element",
        "--set=air.blade.unsteady=jones",
    ];
    for command in ["trim", "stability", "power"] {
        let freely = [&[command, "fruit-fly-abdomen-spring"], &jones[..]].concat();
        let turning = [command, "hawkmoth-elastic", "--turn-rate", "10"];
        for (args, why) in [
            (&freely[..], "joints move freely"),
            (&turning[..], "a steady turn"),
        ] {
            let said = refused(&scratch.0, 2, args);
            assert!(said.contains(why) && !said.contains("trimming"), "{said}");
        }
    }
}

/// `check` counts the looks that are made.
#[test]
fn exact_check_counts_the_looks_that_are_made() {
    let scratch = Scratch::new("looks");
    for (every, words) in [
        ("1", "a look every 100 steps, acting a look later"),
        ("3", "a look every 300 steps, acting 100 steps later"),
    ] {
        let every = format!("--set=control.every_beats={every}");
        let check = [
            "check",
            "fruit-fly-blade",
            "--set=control.latency_beats=1",
            "--set=time.beats=10",
            "--set=time.steps_per_beat=100",
            &every,
        ];
        let text = said(&scratch.0, &check);
        assert!(text.contains(words), "{text}");
    }
}
