//! What `show`, `view`, `compare` and `ensemble` say of results.

use std::fs;

use crate::support::{Scratch, flown, wingbeat};

/// Without a directory the latest run in `results` is meant, and named.
#[test]
fn behaves_show_and_view_take_the_latest_run() {
    let scratch = Scratch::new("latest");
    for command in ["show", "view"] {
        let out = wingbeat(&scratch.0, &[command]);
        let said = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{said}");
        assert!(said.contains("there is none in results/ here"), "{said}");
    }
    for steps in ["time.steps=4", "time.steps=6"] {
        let args = ["run", "benchmark-2", "--quiet", "--set", steps];
        flown(&scratch.0, &args);
    }
    let named = wingbeat(&scratch.0, &["show", "results/benchmark-2-2"]);
    let latest = wingbeat(&scratch.0, &["show"]);
    let path = String::from_utf8_lossy(&latest.stderr);
    assert!(path.trim().ends_with("benchmark-2-2"), "{path}");
    assert!(named.stdout == latest.stdout && !named.stdout.is_empty());
    let page = wingbeat(&scratch.0, &["view", "--no-open"]);
    let wrote = String::from_utf8_lossy(&page.stdout);
    assert!(wrote.contains("benchmark-2-2"), "{wrote}");
}

/// Where the page of a run cannot be written, the one that lies there is the page, else a new one elsewhere.
#[test]
fn behaves_view_needs_no_place_in_the_folder_of_the_run() {
    let scratch = Scratch::new("view-elsewhere");
    let run = ["run", "benchmark-2", "--out", "r", "--quiet", "--set"];
    flown(&scratch.0, &[&run[..], &["time.steps=4"]].concat());
    let there = scratch.0.join("r/flight.html");
    flown(&scratch.0, &["view", "r", "--no-open"]);
    let page = fs::read_to_string(&there).unwrap();
    // A folder in its place: it cannot be written, whoever asks.
    fs::remove_file(&there).unwrap();
    fs::create_dir(&there).unwrap();
    fs::write(there.join("mine.txt"), "mine").unwrap();
    let out = wingbeat(&scratch.0, &["view", "r", "--no-open"]);
    let said = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    let path = said
        .trim()
        .strip_prefix("wrote ")
        .unwrap_or_else(|| panic!("{said}"));
    assert_eq!(fs::read_to_string(path).unwrap(), page);
    fs::remove_file(path).unwrap();
    assert!(there.join("mine.txt").is_file());
}

#[test]
fn exact_show_and_compare_say_what_the_summary_says() {
    let scratch = Scratch::new("show");
    for (out, steps) in [("one", "time.steps=4"), ("two", "time.steps=6")] {
        let args = [
            "run",
            "benchmark-2",
            "--out",
            out,
            "--quiet",
            "--set",
            steps,
        ];
        flown(&scratch.0, &args);
    }
    let said = |args: &[&str]| {
        let out = wingbeat(&scratch.0, args);
        assert!(
            out.status.success(),
            "{}",
            String::from_utf8_lossy(&out.stderr)
        );
        String::from_utf8(out.stdout).unwrap()
    };
    let summary = fs::read_to_string(scratch.0.join("one/summary.txt")).unwrap();
    assert!(said(&["show", "one"]).starts_with(&summary));
    let json: serde_json::Value = serde_json::from_str(&said(&["show", "one", "--json"])).unwrap();
    let written = fs::read_to_string(scratch.0.join("one/summary.json")).unwrap();
    let written: serde_json::Value = serde_json::from_str(&written).unwrap();
    assert_eq!(json["summary"], written);
    assert_eq!(json["manifest"]["steps"], 4);
    let compared = said(&["compare", "one", "two"]);
    let lines = compared.lines().filter(|l| !l.is_empty());
    let differ: Vec<&str> = lines.take_while(|l| !l.contains("of the first")).collect();
    assert_eq!(differ[0], "one and two: cases that differ in");
    let words: Vec<&str> = differ[1].split_whitespace().collect();
    assert_eq!(words, ["time.steps", "4", "6"]);
    assert_eq!(differ.len(), 2, "only that key differs: {compared}");
    assert!(said(&["compare", "one", "one"]).contains("the same case"));
    let compared: serde_json::Value =
        serde_json::from_str(&said(&["compare", "one", "two", "--json"])).unwrap();
    let key = serde_json::json!({ "key": "time.steps", "first": "4", "second": "6" });
    assert_eq!(compared["keys"], serde_json::json!([key]));
    let steps = compared["numbers"]
        .as_array()
        .unwrap()
        .iter()
        .find(|r| r["what"] == "steps")
        .unwrap();
    assert_eq!(
        (&steps["first"], &steps["second"]),
        (&4.0.into(), &6.0.into())
    );
}

/// In pitch the air that moves with the wings has half the inertia of such a body.
#[test]
fn limit_a_flyer_that_is_light_in_pitch_does_not_alternate() {
    let scratch = Scratch::new("alternating");
    let dir = &scratch.0;
    // Free, light in pitch: the air that its wings carry along has half its inertia.
    let coarse = [
        "flight.mode=free",
        "body.inertia_about_centre_kg_m2=[1e-3, 4e-5, 1e-3, 0, 0, 0]",
        "wing.right.mass_kg=1e-6",
        "wing.right.mesh.chordwise=3",
        "wing.right.mesh.spanwise=6",
        "air.scheme=accurate",
        "time.beats=1.5",
        "output.page=false",
        "output.frames_every=0",
    ];
    let sets: Vec<&str> = coarse.iter().flat_map(|s| ["--set", s]).collect();
    let run = |more: &[&str], out: &str| {
        let args = [
            &["run", "flapping-rectangles", "--quiet", "--out", out],
            &sets[..],
            more,
        ]
        .concat();
        wingbeat(dir, &args);
        let text = fs::read_to_string(dir.join(out).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        let warnings = summary["warnings"].to_string();
        (summary["alternating_steps"].as_u64().unwrap(), warnings)
    };
    // By differences over steps alone hamming let them alternate.
    for integrator in ["hamming", "bdf"] {
        let set = format!("dynamics.integrator={integrator}");
        let (steps, warnings) = run(&["--set", &set], integrator);
        assert!(
            steps < 5 && !warnings.contains("alternate"),
            "{integrator}: {steps} {warnings}"
        );
    }
}

#[test]
fn behaves_an_ensemble_parts_and_is_the_same_on_any_number_of_threads() {
    let scratch = Scratch::new("ensemble");
    let dir = &scratch.0;
    let fly = |more: &[&str]| {
        let coarse = [
            "ensemble",
            "fruit-fly-tethered",
            "--members",
            "3",
            "--json",
            "--set=time.beats=4",
            "--set=time.steps_per_beat=20",
            "--set=wing.right.mesh.chordwise=2",
            "--set=wing.right.mesh.spanwise=4",
        ];
        wingbeat(dir, &[&coarse[..], more].concat())
    };
    let one = fly(&["--threads", "1"]);
    assert!(
        one.status.success(),
        "{}",
        String::from_utf8_lossy(&one.stderr)
    );
    assert_eq!(one.stdout, fly(&["--threads", "2"]).stdout);
    let told: serde_json::Value = serde_json::from_slice(&one.stdout).unwrap();
    let spread = |k: usize| told["ensemble"]["beats"][k]["spread"].as_f64().unwrap();
    // A millionth of the wings' speed changes forces by some millionths; separated flow makes more of it, beat by beat.
    assert!(spread(0) > 0.0 && spread(0) < 1e-4, "{}", spread(0));
    assert!(spread(3) > spread(0), "{told}");
    // They differ by far less than their beats do: they are one flight yet, and of two beats its mean has no error.
    assert!(spread(3) < 0.01, "{}", spread(3));
    assert_eq!(told["ensemble"]["members_are"], "one_flight");
    assert!(told["ensemble"]["means"]["lift_newton"]["standard_error"].is_null());
    let remark = told["remark"].as_str().unwrap_or_default();
    assert!(
        remark.contains("have not parted") && remark.contains("fly longer"),
        "{remark}"
    );
    let refused = fly(&["--set=air.model=none"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(
        said.contains("a small disturbance of the air in a vortex lattice"),
        "{said}"
    );
}
