//! What the commands say of a flyer in which nothing beats.

use std::fs;
use std::path::Path;

use serde_json::Value;

use wingbeat::flight::MotionMode;

use crate::support::{Scratch, case_of, refused, said};

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
    // Written in other steps, it flies as long as before.
    let write = ["trim", "g.toml", "--steps", "40", "--write", "w.toml"];
    said(dir, &[&write[..], &wakes].concat());
    let text = fs::read_to_string(dir.join("w.toml")).unwrap();
    let (time, mode) = {
        let setup = case_of("w", &text, &[]).setup;
        (setup.time, setup.mode)
    };
    let MotionMode::Free(start) = mode else {
        panic!("{text}");
    };
    let flown = (time.steps - start.held_steps) as f64 * time.step;
    assert!((flown - 1.0).abs() < time.step, "{flown} in {}", time.step);
    // What parts right from left in a glide.
    let error = refused(dir, 2, &["trim", "g.toml", "--turn-rate", "5"]);
    assert!(error.contains("feathering_offset_difference"), "{error}");
}

/// A has the modes: sums of powers of its eigenvalues are traces of its powers. B has Newton's law: the masses of flyer
/// and air times the rates that a control makes are the force that it makes.
#[test]
fn exact_the_linear_model_in_json_has_modes_and_forces() {
    let scratch = Scratch::new("linear-model");
    let dir = &scratch.0;
    let stability = object(dir, &["stability", "fruit-fly-blade", "--json"]);
    let found = object(dir, &["derivatives", "fruit-fly-blade", "--json"]);
    let rows = |value: &Value| -> Vec<Vec<f64>> { serde_json::from_value(value.clone()).unwrap() };
    let (model, other) = (&stability["linear_model"], &found["linear_model"]);
    assert_eq!(model["a"], other["a"]);
    assert_eq!(model["states"][7], "theta");
    assert_eq!(model["state_units"][0], "m s-1");
    assert_eq!(other["inputs"][0], "stroke_amplitude left");
    assert_eq!(other["input_units"][0], "1");
    let a = rows(&model["a"]);
    let product = |x: &[Vec<f64>], y: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let entry = |i: usize, j: usize| (0..9).map(|k| x[i][k] * y[k][j]).sum();
        (0..9)
            .map(|i| (0..9).map(|j| entry(i, j)).collect())
            .collect()
    };
    let mut power = a.clone();
    let modes = stability["averaged_modes"].as_array().unwrap();
    for n in 1..=4 {
        let trace: f64 = (0..9).map(|i| power[i][i]).sum();
        let of = |m: &Value| {
            let [growth, frequency] =
                ["growth_per_s", "frequency_rad_per_s"].map(|k| m[k].as_f64().unwrap());
            let pair = if frequency == 0.0 { 1.0 } else { 2.0 };
            let (size, angle) = (growth.hypot(frequency), frequency.atan2(growth));
            let value = size.powi(n);
            [pair * value * (f64::from(n) * angle).cos(), pair * value]
        };
        let sums = modes
            .iter()
            .map(of)
            .fold([0.0; 2], |s, x| [s[0] + x[0], s[1] + x[1]]);
        assert!(
            (trace - sums[0]).abs() < 1e-9 * sums[1],
            "{n}: {trace} {sums:?}"
        );
        power = product(&power, &a);
    }
    let b = rows(&other["b"]);
    let added = rows(&stability["added_mass_si_by_rates_of_u_v_w_p_q_r"]);
    let mass = object(dir, &["check", "fruit-fly-blade", "--json"])["mass_kg"]
        .as_f64()
        .unwrap();
    let controls = found["control_derivatives"].as_array().unwrap();
    assert_eq!(b[0].len(), controls.len());
    for (k, control) in controls.iter().enumerate() {
        for (i, row) in added[..3].iter().enumerate() {
            let carried: f64 = (0..6).map(|j| row[j] * b[j][k]).sum();
            let force = control["force_newton_per_unit"][i].as_f64().unwrap();
            let made = mass * b[i][k] + carried;
            assert!(
                (made - force).abs() < 1e-9 * (mass * 9.81),
                "{k} {i}: {made} {force}"
            );
        }
    }
}
