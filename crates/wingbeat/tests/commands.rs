//! The analysing commands and the kinds of air, through the program.

mod flutter;
mod trims;

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{Scratch, column, refused, said, wingbeat};

/// The value at the end of the line that begins with `name`.
fn figure(text: &str, name: &str) -> String {
    let line = text.lines().find(|l| l.trim_start().starts_with(name));
    let line = line.unwrap_or_else(|| panic!("no line `{name}` in\n{text}"));
    line.trim_start()[name.len()..].trim().to_owned()
}

#[test]
fn refuses_speeds_with_a_unit_for_the_unit() {
    let scratch = Scratch::new("speed-unit");
    let with_unit = refused(&scratch.0, 2, &["trim", "--forward", "5m/s"]);
    assert!(
        with_unit.contains("a number alone, without a unit"),
        "{with_unit}"
    );
    let fast = refused(&scratch.0, 2, &["trim", "--forward", "1e6"]);
    assert!(
        fast.contains("below that of sound") && !fast.contains("without a unit"),
        "{fast}"
    );
}

#[test]
fn refuses_bounds_that_are_none_and_reports_trims_outside() {
    let scratch = Scratch::new("bounds");
    let dir = &scratch.0;
    for (bound, what) in [
        ("stroke_amplitude=0.2..-0.2", "FROM below TO"),
        ("lift=0..1", "stroke_amplitude"),
        ("stroke_plane=0..1", "not among the unknowns"),
        (
            "stroke_amplitude=-20..20",
            "parts of 1, not percent, above -1",
        ),
        ("frequency=-1..0.5", "parts of 1, not percent, above -1"),
        ("stroke_amplitude_difference=-5..5", "above -2 and below 2"),
    ] {
        let problem = refused(dir, 2, &["trim", "--bound", bound]);
        assert!(problem.contains(what), "{problem}");
    }
    let out = wingbeat(
        dir,
        &["trim", "--steps", "40", "--bound", "body_pitch=0..30"],
    );
    let text = String::from_utf8_lossy(&out.stdout);
    assert_eq!(out.status.code(), Some(1));
    assert!(
        text.contains("OUTSIDE its bound") && text.contains("NOT within"),
        "{text}"
    );
}

/// An option behind one that takes a number is not its value: that one has none. Negative numbers are values.
#[test]
fn refuses_options_in_place_of_values() {
    let scratch = Scratch::new("no-value");
    let dir = &scratch.0;
    for (args, option, taken) in [
        (
            &["trim", "--forward", "--json"][..],
            "--forward <SPEED>",
            "--json",
        ),
        (
            &["trim", "--turn-rate", "--set=time.beats=1"],
            "--turn-rate <DEG_S>",
            "--set=time.beats=1",
        ),
        (
            &["new", "--mass", "--species", "moth"],
            "--mass <MASS>",
            "--species",
        ),
        (&["plot", "r", "--from", "-h"], "--from <TIME>", "-h"),
        (
            &["velocity", "r", "--point", "--help"],
            "--point <X,Y,Z>",
            "--help",
        ),
    ] {
        let told = refused(dir, 2, args);
        let missing = format!("a value is required for '{option}' but none was supplied");
        assert!(told.contains(&missing), "{told}");
        assert!(
            told.contains(&format!("{taken} is an option itself")),
            "{told}"
        );
    }
    let told = refused(dir, 2, &["trim", "--forward", "-inf"]);
    assert!(!told.contains("is an option itself"), "{told}");
}

/// Averages over a beat need motions that are known beforehand: what cannot be had is named before the work is
/// done, and what can be had is given.
#[test]
fn refuses_averages_of_free_joints_and_gives_their_modes() {
    let scratch = Scratch::new("averages");
    let dir = &scratch.0;
    let robot = [
        "robobee",
        "--steps",
        "40",
        "--set",
        "air.model=\"blade_element\"",
    ];
    let text = said(dir, &[&["stability"][..], &robot].concat());
    assert!(
        text.contains("No averaged model: joint `hinge-left`")
            && !text.contains("wingbeat stability"),
        "{text}"
    );
    assert!(
        text.contains("(Floquet)") && text.contains("joints 1.00"),
        "{text}"
    );
    for command in [&["derivatives"][..], &["stability", "--write", "x.toml"]] {
        let out = wingbeat(dir, &[command, &robot].concat());
        let (told, error) = (out.stdout, String::from_utf8_lossy(&out.stderr));
        assert!(!out.status.success() && told.is_empty(), "{command:?}");
        assert!(
            error.contains("hinge-left") && error.contains("Floquet"),
            "{error}"
        );
    }
    assert!(!dir.join("x.toml").exists());
    // Segments that move as prescribed become part of the rigid body.
    let fly = [
        "fruit-fly-abdomen",
        "--steps",
        "40",
        "--set",
        "air.model=\"blade_element\"",
    ];
    said(
        dir,
        &[&["stability", "--write", "fly.toml"][..], &fly].concat(),
    );
    let text = said(dir, &["stability", "fly.toml"]);
    assert!(text.contains("unstable oscillation"), "{text}");
}

#[test]
fn balances_trim_reaches_forward_flight_and_says_when_it_fails() {
    let scratch = Scratch::new("trim-forward");
    let dir = &scratch.0;
    let text = said(
        dir,
        &[
            "trim",
            "--forward",
            "0.4",
            "--climb",
            "0.1",
            "--steps",
            "60",
        ],
    );
    assert!(text.contains("trim to 0.400 m/s forward, 0.100 m/s up"));
    // Ten times the weight: no stroke of this wing carries that. Exit code 1, best point shown.
    let heavy = ["trim", "--steps", "40", "--set", "gravity_m_s2=[0,0,98.1]"];
    let out = wingbeat(dir, &heavy);
    assert_eq!(out.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&out.stdout).contains("NOT trimmed; the best point found"));
    let problem = refused(
        dir,
        2,
        &["trim", "--unknowns", "body_pitch", "lift", "frequency"],
    );
    assert!(problem.contains("stroke_amplitude"), "{problem}");
}

#[test]
fn behaves_a_sweep_draws_power_against_speed_and_says_where_flight_ends() {
    let scratch = Scratch::new("trim-sweep");
    let dir = &scratch.0;
    let sweep = ["trim", "bumblebee-blade", "--steps", "40", "--sweep"];
    let text = said(
        dir,
        &[
            &sweep[..],
            &["0", "3", "--points", "4", "--figure", "s.svg"],
        ]
        .concat(),
    );
    // Power hardly changes up to 2 m/s and rises then.
    let least = figure(&text, "least power (storage) at");
    assert!(
        least.starts_with("0.000 m/s, the end of what was swept"),
        "{text}"
    );
    let svg = fs::read_to_string(dir.join("s.svg")).unwrap();
    assert!(svg.contains("speed forward [m/s]"));
    let flies = [
        "trim", "--steps", "40", "--sweep", "0.3", "0.9", "--points", "3",
    ];
    let text = said(dir, &flies);
    // That of the fly falls from hover and rises again.
    let least = figure(&text, "least power (storage) at");
    assert!(
        least.starts_with("0.600 m/s of these; between them"),
        "{text}"
    );
    let crossing = "warning: wings pass through each other from 0.600 to 0.900 m/s";
    assert!(text.contains(crossing), "{text}");
    let out = wingbeat(dir, &[&sweep[..], &["2", "8", "--points", "3"]].concat());
    let told = String::from_utf8_lossy(&out.stdout);
    assert_eq!(out.status.code(), Some(1), "{told}");
    assert!(told.contains("NOT trimmed at 5.000 m/s"), "{told}");
    assert!(told.contains("the range ends before it"), "{told}");
    for (args, reason) in [
        (&["trim", "--sweep", "1", "1"][..], "the same speed"),
        (
            &["trim", "fruit-fly-hover", "--sweep", "0", "1"],
            "--sweep has no effect here",
        ),
        (
            &["trim", "--sweep", "0", "1", "--write", "x.toml"],
            "--write",
        ),
        (&["trim", "--points", "4"], "--sweep"),
    ] {
        let problem = refused(dir, 2, args);
        assert!(problem.contains(reason), "{args:?}: {problem}");
    }
}

#[test]
fn published_structure_of_longitudinal_modes_of_all_insects() {
    // One unstable oscillation, one fast and one slow subsidence [Sun & Xiong 2005; Sun, Wang &
    // Xiong 2007], averaged and by Floquet's theory.
    let scratch = Scratch::new("modes");
    for preset in [
        "fruit-fly-blade",
        "bumblebee-blade",
        "hoverfly-blade",
        "hawkmoth-blade",
    ] {
        let text = said(&scratch.0, &["stability", preset, "--steps", "60"]);
        let names: Vec<&str> = text
            .lines()
            .filter_map(|l| l.trim_start().strip_prefix("longitudinal "))
            .map(|l| l.trim_start().split("   ").next().unwrap().trim())
            .collect();
        let structure = ["unstable oscillation", "slow subsidence", "fast subsidence"];
        assert_eq!(names, [structure, structure].concat(), "{preset}");
    }
}

/// A ball of 1 g in free fall.
const BALL: &str = r#"
format = 1
[time]
step_s = 0.01
steps = 100
[body]
mass_kg = 1e-3
centre_m = [0, 0, 0]
inertia_about_centre_kg_m2 = [1e-8, 1e-8, 1e-8, 0, 0, 0]
[output]
frames_every = 0
figures = false
"#;

/// Fall speed after a second with drag `c v`: `m g / c (1 - exp(-c t / m))`, c / m = 2 / s.
fn fall_speed() -> f64 {
    9.81 / 2.0 * (1.0 - (-2.0_f64).exp())
}

#[test]
fn exact_fall_in_derivative_air() {
    let scratch = Scratch::new("derivative-fall");
    let dir = &scratch.0;
    let air = "[air]\nmodel = \"derivatives\"\n[air.derivatives]\nforce_newton = [0, 0, 0]\nforce_by_velocity_newton_s_m = [[-2e-3, 0, 0], [0, -2e-3, 0], [0, 0, -2e-3]]\n";
    fs::write(dir.join("ball.toml"), format!("{BALL}{air}")).unwrap();
    said(dir, &["run", "ball.toml", "--quiet", "--out", "r"]);
    let v = *column(&dir.join("r"), "body_z_rate_m_per_s")
        .last()
        .unwrap();
    // Fourth order: (0.02)^4 / 100 or so.
    assert!((v - fall_speed()).abs() < 1e-8, "{v} {}", fall_speed());
    let problem = refused(
        dir,
        2,
        &["run", "fruit-fly-blade", "--set", "air.model=derivatives"],
    );
    assert!(problem.contains("air.derivatives"), "{problem}");
}

#[test]
fn exact_fall_in_the_air_of_a_partner_program() {
    let scratch = Scratch::new("external-fall");
    let dir = &scratch.0;
    let program = Path::new(env!("CARGO_BIN_EXE_wingbeat"));
    let partner = program.parent().unwrap().join("examples/partner");
    assert!(
        partner.exists(),
        "build the example first: cargo build -p wingbeat --example partner"
    );
    let partner = partner.to_str().unwrap();
    let case = |command: &str| {
        let air = format!("[air]\nmodel = \"external\"\n[air.external]\ncommand = {command}\n");
        fs::write(dir.join("ball.toml"), format!("{BALL}{air}")).unwrap();
    };
    case(&format!("[{partner:?}, \"2e-3\"]"));
    said(dir, &["run", "ball.toml", "--quiet", "--out", "r"]);
    let v = *column(&dir.join("r"), "body_z_rate_m_per_s")
        .last()
        .unwrap();
    assert!((v - fall_speed()).abs() < 1e-8, "{v} {}", fall_speed());
    // A partner that complains, one that does not speak, one that is not there.
    case(&format!("[{partner:?}, \"syrup\"]"));
    let problem = refused(dir, 2, &["run", "ball.toml", "--out", "a"]);
    assert!(problem.contains("COEFFICIENT"), "{problem}");
    case("[\"true\"]");
    let problem = refused(dir, 2, &["run", "ball.toml", "--out", "b"]);
    assert!(problem.contains("`true`"), "{problem}");
    case("[\"no-such-program-anywhere\"]");
    let problem = refused(dir, 2, &["run", "ball.toml", "--out", "c"]);
    assert!(problem.contains("cannot be started"), "{problem}");
}

#[test]
fn behaves_tumbles_follow_from_their_seeds() {
    let scratch = Scratch::new("tumbles");
    let dir = &scratch.0;
    let words = "stabilise --steps 40 --latency 1 --tumbles 24 --beats 60 --json --seed";
    let fly = |seed: &str| {
        let args: Vec<&str> = words.split(' ').chain([seed]).collect();
        let told: Value = serde_json::from_str(&said(dir, &args)).expect("JSON");
        told
    };
    let (told, later) = (fly("3"), fly("4"));
    let flights = told["flights"].as_array().expect("flights");
    assert_eq!(flights.len(), 24);
    // The next seeds are the same flights, whatever threads they came to.
    let shifted = later["flights"].as_array().expect("flights");
    assert_eq!(flights[1..], shifted[..23]);
    let rows = told["tumbles"].as_array().expect("rows");
    let recovered = |row: &Value| row["recovered"].as_f64().expect("a share");
    let all = rows.last().expect("all");
    assert!(recovered(&rows[0]) >= recovered(all) && recovered(all) > 0.0);
    let problem = refused(
        dir,
        2,
        &["stabilise", "--tumbles", "4", "--tilt", "1", "2", "3"],
    );
    assert!(
        problem.contains("--tumbles") && problem.contains("--tilt"),
        "{problem}"
    );
}

#[test]
fn balances_stabilised_hover_is_drawn() {
    let scratch = Scratch::new("stabilise");
    let dir = &scratch.0;
    let args = [
        "stabilise",
        "--steps",
        "60",
        "--beats",
        "100",
        "--figure",
        "s.svg",
    ];
    let text = said(dir, &args);
    for words in [
        "disturbed by 10.00 deg, 100 wingbeats under feedback: at most",
        "within 1 deg of its attitude from beat",
        "commands at their limits in",
        "wrote s.svg",
    ] {
        assert!(text.contains(words), "no `{words}` in {text}");
    }
    let rows: Vec<Vec<f64>> = text
        .lines()
        .map(|l| l.split(',').map_while(|w| w.parse().ok()).collect())
        .filter(|r: &Vec<f64>| r.len() == 10)
        .collect();
    assert_eq!(rows.len(), 101);
    assert_eq!(rows[0][5], 10.0); // degrees of pitch at the start
    assert!(rows[100][5].abs() < 0.01);
    // Within one wing length (2.5 mm) of the start all along.
    assert!(rows.iter().all(|r| r[1].hypot(r[2]).hypot(r[3]) < 2.5));
    assert!(
        fs::read_to_string(dir.join("s.svg"))
            .unwrap()
            .contains("wing lengths")
    );
}

/// Right and left command the same against a pitch, and a tail between them in the order of names has no say.
#[test]
fn invariant_commands_of_a_flyer_with_a_tail_are_those_of_its_wings() {
    const BIRD: &str = include_str!("../../wingbeat-case/tests/data/bird.toml");
    let scratch = Scratch::new("stabilised-bird");
    let dir = &scratch.0;
    fs::write(dir.join("b.toml"), BIRD).unwrap();
    let args = "stabilise b.toml --forward 8 --steps 40 --beats 3 --json";
    let args: Vec<&str> = args.split(' ').collect();
    let told: Value = serde_json::from_str(&said(dir, &args)).expect("JSON");
    let last = &told["beats"][3];
    let amplitudes = &last["stroke_amplitude_change_left_right"];
    let [left, right] = [0, 1].map(|k| amplitudes[k].as_f64().unwrap());
    assert!(left.abs() > 1e-3 && (left - right).abs() < 1e-12, "{last}"); // 1e-13: roundings
    assert!(
        last["stroke_offset_rad"].as_f64().unwrap().abs() > 1e-3,
        "{last}"
    );
}

#[test]
fn limit_massless_wings_are_a_rigid_aircraft() {
    // Without wing mass the inertial power of the wings is nothing.
    let scratch = Scratch::new("massless");
    let rigid = ["power", "--steps", "60", "--set", "dynamics.wings=massless"];
    let text = said(&scratch.0, &rigid);
    let inertial = figure(&text, "inertial, positive part");
    let first: f64 = inertial.split_whitespace().next().unwrap().parse().unwrap();
    assert!(first < 1e-3, "{text}"); // microwatts, of 14 against the air
}

#[test]
fn invariant_control_derivatives_mirror() {
    let scratch = Scratch::new("derivatives");
    let text = said(&scratch.0, &["derivatives", "--steps", "60"]);
    let row = |control: &str, wing: &str| -> Vec<f64> {
        let line = text.lines().find(|l| {
            let words: Vec<&str> = l.split_whitespace().collect();
            words.len() == 8 && words[0] == control && words[1] == wing
        });
        let words = line.unwrap().split_whitespace().skip(2);
        words.map(|w| w.parse().unwrap()).collect()
    };
    let (l, r) = (
        row("stroke_amplitude", "left"),
        row("stroke_amplitude", "right"),
    );
    for (k, sign) in [1.0, -1.0, 1.0, -1.0, 1.0, -1.0].into_iter().enumerate() {
        assert_eq!(l[k], sign * r[k], "component {k}");
    }
}
