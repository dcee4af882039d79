//! `wingbeat flutter` about static divergence: what is neutral is named, what is missing, too; and at one speed.

use std::fs;

use crate::support::{Scratch, said, strips, wingbeat};

/// A soft wing of strips with wakes; static divergence at 10.34 m/s.
fn soft() -> String {
    let case = strips(
        "step_s = 0.002
steps = 200",
        "density_kg_m3 = 1.225
stream_m_s = [-10, 0, 0]",
        "motion.psi.constant_deg = 0.05
[wing.right.planform.outline]
leading_m = [[0, 0.05], [1.0, 0.05]]
trailing_m = [[0, -0.15], [1.0, -0.15]]
[wing.right.mesh]
chordwise = 1
spanwise = 12
[wing.right.structure]
spectral_radius = 1.0
[wing.right.structure.beam]
axis_fraction = 0.4
mass_fraction = 0.4
elements = 8
flap_newton_m2 = [2.0, 2.0]
torsion_newton_m2 = [1.0, 1.0]
lag_newton_m2 = [200.0, 200.0]
mass_kg_per_m = [0.2, 0.2]
inertia_kg_m = [7e-4, 7e-4]
[output]
frames_every = 0
figures = false
page = false",
    );
    format!("name = \"soft\"\n{case}")
}

#[test]
fn behaves_growth_without_vibration_that_is_neutral_stands_in_the_table() {
    let scratch = Scratch::new("flutter-neutral");
    fs::write(scratch.0.join("soft.toml"), soft()).unwrap();
    let text = said(
        &scratch.0,
        &[
            "flutter",
            "soft.toml",
            "--speeds",
            "10.6:11:2",
            "--periods",
            "1",
            "--modes",
            "1",
            "--set",
            "wing.right.motion.psi.constant_deg=0",
        ],
    );
    let rows = text.lines().filter(|l| l.contains(" none "));
    assert_eq!(rows.count(), 2, "{text}");
    assert!(text.contains("are neutral within what is known"), "{text}");
}

#[test]
fn behaves_json_of_speeds_that_fail_says_what_is_missing() {
    let scratch = Scratch::new("flutter-missing");
    fs::write(scratch.0.join("soft.toml"), soft()).unwrap();
    let asked = ["flutter", "soft.toml", "--speeds", "8:11:2", "--modes", "1"];
    let rest = ["--periods", "0.7", "--json"];
    let out = wingbeat(&scratch.0, &[&asked[..], &rest].concat());
    assert_eq!(out.status.code(), Some(1));
    let found: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    assert_eq!(found["complete"], false);
    assert_eq!(found["missing_speeds_m_s"], serde_json::json!([11.0]));
    let error = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(
        error.contains("at 11 m/s no steady state was found")
            && error.contains("static divergence"),
        "{error}"
    );
}

/// Goland's wing in strips: an onset between far speeds is the zero of a straight line, and it is said so.
#[test]
fn behaves_an_onset_between_far_speeds_asks_for_closer_ones() {
    let scratch = Scratch::new("flutter-wide");
    let text = include_str!("../../../wingbeat-verify/data/goland-strips.toml");
    fs::write(scratch.0.join("goland.toml"), text).unwrap();
    let told = |speeds: &str| {
        let coarse = "wing.right.mesh.spanwise=8";
        let asked = ["flutter", "goland.toml", "--speeds", speeds];
        let rest = ["--modes", "2", "--set", coarse];
        let text = said(&scratch.0, &[&asked[..], &rest].concat());
        assert!(text.contains("Flutter begins at 137."), "{text}");
        text.contains("--speeds 120:160:5 looks closer")
    };
    assert!(told("120:160:2"));
    assert!(!told("132:142:2"));
}

#[test]
fn behaves_one_speed_has_its_modes_and_what_grows() {
    let scratch = Scratch::new("flutter-one-speed");
    fs::write(scratch.0.join("soft.toml"), soft()).unwrap();
    let rest = ["--modes", "1", "--periods", "0.7"];
    for speed in ["8", "8:8:1"] {
        let asked = ["flutter", "soft.toml", "--speeds", speed];
        let text = said(&scratch.0, &[&asked[..], &rest].concat());
        assert!(
            text.contains("At 8.000 m/s no growth is positive")
                && text.contains("--speeds FROM:TO:N")
                && !text.contains("at any of these speeds"),
            "{text}"
        );
    }
    for wrong in ["8:9:1", "8:8:2", "9:8:2", "8:9", "0"] {
        let asked = ["flutter", "soft.toml", "--speeds", wrong];
        let out = wingbeat(&scratch.0, &[&asked[..], &rest].concat());
        assert_eq!(out.status.code(), Some(2), "{wrong}");
        let error = String::from_utf8_lossy(&out.stderr).into_owned();
        assert!(error.contains("or one speed alone"), "{error}");
    }
}
