//! What the commands say of a flyer in which nothing beats.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{Scratch, refused, said};

const GLIDER: &str = include_str!("../../wingbeat-case/tests/data/glider.toml");

/// The glider at rest: its trim begins from a guess.
fn write(dir: &Path) {
    let at_rest = GLIDER.replace("flight = { velocity_m_s = [6, 0, 0.7] }\n", "");
    assert!(!at_rest.contains("flight"));
    fs::write(dir.join("g.toml"), at_rest).unwrap();
}

fn object(dir: &Path, args: &[&str]) -> Value {
    serde_json::from_str(&said(dir, args)).unwrap()
}

#[test]
fn balances_height_pays_for_the_drag_of_a_glide() {
    let scratch = Scratch::new("glides");
    let dir = &scratch.0;
    write(dir);
    let power = object(dir, &["power", "g.toml", "--json"]);
    let number = |key: &str| power[key].as_f64().unwrap();
    let sink = -number("climb_m_s");
    let lost = number("height_lost_watt");
    // The trim is found to residuals of 1e-9.
    assert!((lost / (0.03 * 9.81 * sink) - 1.0).abs() < 1e-8, "{lost}");
    assert!((number("forward_m_s") / sink / number("glide_ratio") - 1.0).abs() < 1e-8);
    let peak = power["power"]["peak"]["watt"].as_f64().unwrap();
    assert!(peak.abs() < 1e-9 * lost, "{peak:e}");
    // At the speed of that glide the elevator stays where it is.
    let forward = power["forward_m_s"].to_string();
    let args = ["trim", "g.toml", "--json", "--forward", &forward];
    let elevator = object(dir, &args)["unknowns"]["tail_incidence_deg"].clone();
    assert!(elevator.as_f64().unwrap().abs() < 1e-6, "{elevator}");
    let modes = object(dir, &["stability", "g.toml", "--json"]);
    let names = modes["floquet_modes"].as_array().unwrap().iter();
    let names: Vec<&str> = names.map(|m| m["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"stable phugoid") && names.contains(&"stable short period"));
}

#[test]
fn behaves_a_sweep_of_a_glider_has_its_polar_and_no_figure_of_power() {
    let scratch = Scratch::new("polar");
    let dir = &scratch.0;
    write(dir);
    let sweep = ["trim", "g.toml", "--sweep", "5", "7", "--points", "3"];
    let polar = object(dir, &[&sweep[..], &["--json"]].concat());
    let flights = polar["flights"].as_array().unwrap();
    assert_eq!(flights.len(), 3);
    for flight in flights {
        let [forward, climb, ratio] =
            ["forward_m_s", "climb_m_s", "glide_ratio"].map(|k| flight[k].as_f64().unwrap());
        assert!((forward / -climb / ratio - 1.0).abs() < 1e-8);
        assert!(flight["unknowns"]["tail_incidence_deg"].is_number());
    }
    let error = refused(dir, 2, &[&sweep[..], &["--figure", "p.svg"]].concat());
    assert!(error.contains("sink rates"), "{error}");
}

/// Strips with wakes: the glide, what height pays and the modes as without them; no sweep.
#[test]
fn agrees_the_commands_of_a_glider_with_wakes_with_those_without() {
    let scratch = Scratch::new("glides-with-wakes");
    let dir = &scratch.0;
    fs::write(dir.join("g.toml"), GLIDER).unwrap();
    let wakes = ["--set", "air.blade.unsteady=\"jones\""];
    let both = |args: &[&str]| [args, &[args, &wakes[..]].concat()].map(|args| object(dir, args));
    let [plain, with] = both(&["power", "g.toml", "--json"]);
    for key in [
        "forward_m_s",
        "climb_m_s",
        "glide_ratio",
        "height_lost_watt",
    ] {
        let [a, b] = [&plain, &with].map(|p| p[key].as_f64().unwrap());
        // Residuals of 1e-6.
        assert!((a / b - 1.0).abs() < 1e-4, "{key}: {a} {b}");
    }
    let [plain, with] = both(&["stability", "g.toml", "--json"]);
    assert!(
        plain["neutral_point_behind_mass_centre_m"]
            .as_f64()
            .unwrap()
            > 0.05
    );
    let names = with["floquet_modes"].as_array().unwrap().iter();
    assert!(names.map(|m| &m["name"]).any(|n| n == "stable phugoid"));
    let sweep = [&["trim", "g.toml", "--sweep", "5", "7"][..], &wakes].concat();
    let error = refused(dir, 2, &sweep);
    assert!(error.contains("--sweep has no effect here"), "{error}");
}
