//! Trims that are written as cases: flown, they are where they were trimmed.

use std::fs;
use std::path::Path;

use super::figure;
use crate::support::{Scratch, column, refused, said};

#[test]
fn balances_a_trimmed_case_flies_where_it_is() {
    let scratch = Scratch::new("trimmed");
    let dir = &scratch.0;
    let text = said(dir, &["trim", "--write", "hover.toml"]);
    assert!(text.contains("trimmed after"), "{text}");
    said(
        dir,
        &[
            "run",
            "hover.toml",
            "--quiet",
            "--out",
            "r",
            "--set",
            "time.beats=1",
        ],
    );
    let run = dir.join("r");
    let angles = ["body_phi", "body_theta", "body_psi"];
    assert_returns(&run, 0, [1e-6 * 2.5e-3, 1e-3], &angles);
    // The file is not written over; it is trimmed already.
    let again = refused(dir, 2, &["trim", "--write", "hover.toml"]);
    assert!(again.contains("hover.toml"), "{again}");
    let text = said(dir, &["trim", "hover.toml"]);
    let left: f64 = figure(&text, "stroke_amplitude")
        .trim_end_matches(" %")
        .parse()
        .unwrap();
    assert!(left.abs() < 0.001, "{text}");
}

/// A run of a trimmed beat ends where it was `from` steps after its start: the body to the first `within` \[m\], these
/// angles to the second \[deg\]. In blade elements trims close to 1e-9; the file holds all digits.
fn assert_returns(run: &Path, from: usize, within: [f64; 2], angles: &[&str]) {
    for axis in ["x", "y", "z"] {
        let x = column(run, &format!("body_{axis}_m"));
        let gone = x[x.len() - 1] - x[from];
        assert!(gone.abs() < within[0], "{axis}: {gone}");
    }
    for angle in angles {
        let q = column(run, &format!("{angle}_rad"));
        let turned = q[q.len() - 1] - q[from];
        assert!(turned.abs().to_degrees() < within[1], "{angle}: {turned}");
    }
}

/// The command that the page on flight mechanics gives for a trim in a few seconds, word for word.
#[test]
fn balances_the_documented_trim_in_the_lattice_closes_its_orbit() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/flight-mechanics.md");
    let page = fs::read_to_string(page).unwrap();
    let start = "wingbeat trim fruit-fly-hover --set";
    let at = page.find(start).expect("the page has the command");
    let command = page[at..].split("\n```").next().unwrap();
    let command = command.replace('\\', " ");
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    let scratch = Scratch::new("trim-lattice");
    let dir = &scratch.0;
    let text = said(dir, &words);
    assert!(text.contains("trimmed after"), "{text}");
    // As many as are announced.
    let flights = text.lines().find(|l| l.contains(" flights of ")).unwrap();
    let flights: usize = flights.split_whitespace().next().unwrap().parse().unwrap();
    assert!((10..=30).contains(&flights), "{text}");
    said(dir, &["run", "trimmed.toml", "--quiet", "--out", "r"]);
    // Held for two beats of 24 steps, then free for one: residuals are below 2e-3, drift in wing lengths and
    // pitch in rad among them.
    let angles = ["body_phi", "body_theta", "body_psi"];
    assert_returns(&dir.join("r"), 48, [2e-3 * 2.5e-3, 0.115], &angles);
}

#[test]
fn balances_a_robot_with_passive_hinges_returns_to_its_place() {
    let scratch = Scratch::new("trimmed-robot");
    let dir = &scratch.0;
    let blade = ["--set", "air.model=\"blade_element\""];
    let trim = ["trim", "robobee", "--steps", "60", "--write", "hover.toml"];
    let text = said(dir, &[&trim[..], &blade].concat());
    assert!(text.contains("trimmed after"), "{text}");
    let run = ["run", "hover.toml", "--quiet", "--out", "r"];
    said(dir, &[&run[..], &["--set", "time.beats=1"]].concat());
    let joints = ["left", "right"].map(|side| format!("joint_hinge_{side}_rotation"));
    let angles = ["body_phi", "body_theta", "body_psi", &joints[0], &joints[1]];
    assert_returns(&dir.join("r"), 0, [1e-6 * 15e-3, 1e-3], &angles);
}

/// A smooth start makes wings late and joints that are driven in time not: the trimmed case, which begins
/// within the beat, has the wings at the phase at which they were trimmed.
#[test]
fn balances_a_trimmed_fly_with_a_driven_abdomen_returns_to_its_place() {
    let scratch = Scratch::new("trimmed-abdomen");
    let dir = &scratch.0;
    let blade = ["--set", "air.model=\"blade_element\""];
    for (name, beats) in [("half", "1"), ("part", "0.6")] {
        let (file, start) = (
            format!("{name}.toml"),
            format!("motion.start_beats={beats}"),
        );
        let trim = [
            "trim",
            "fruit-fly-abdomen",
            "--steps",
            "60",
            "--write",
            &file,
        ];
        said(dir, &[&trim[..], &blade, &["--set", &start]].concat());
        let run = ["run", &file, "--quiet", "--out", name];
        said(dir, &[&run[..], &["--set", "time.beats=1"]].concat());
        let angles = ["body_phi", "body_theta", "body_psi"];
        assert_returns(&dir.join(name), 0, [1e-6 * 2.5e-3, 1e-3], &angles);
    }
}

/// The turn of the page on flight mechanics, flown by `run` for ten wingbeats: on its circle to the last digits.
#[test]
fn balances_a_trimmed_turn_flies_its_circle() {
    let scratch = Scratch::new("turn");
    let dir = &scratch.0;
    let turn = ["--forward", "0.3", "--turn-rate", "300"];
    let text = said(
        dir,
        &[&["trim", "--write", "turn.toml"][..], &turn].concat(),
    );
    assert!(text.contains("turning right by 300.00 deg/s"), "{text}");
    let beats = ["--set", "time.beats=10", "--quiet", "--out", "r"];
    said(dir, &[&["run", "turn.toml"][..], &beats].concat());
    let gone = |axis: &str| {
        let x = column(&dir.join("r"), &format!("mass_centre_{axis}_m"));
        x[x.len() - 1] - x[0]
    };
    let (rate, time) = (300_f64.to_radians(), 0.05);
    let radius = 0.3 / rate;
    let on_circle = [(rate * time).sin(), 1.0 - (rate * time).cos(), 0.0].map(|x| radius * x);
    for (axis, x) in ["n1", "n2", "n3"].into_iter().zip(on_circle) {
        // Trimmed to 1e-9 wing lengths a beat, which grows by half in ten.
        assert!((gone(axis) - x).abs() < 1e-10, "{axis}: {} {x}", gone(axis));
    }
    said(dir, &[&["power", "--steps", "40"][..], &turn].concat());
    let modes = said(dir, &[&["stability", "--steps", "40"][..], &turn].concat());
    assert!(
        modes.contains("No averaged model") && modes.contains("neutral"),
        "{modes}"
    );
    for command in ["derivatives", "stabilise"] {
        let problem = refused(dir, 2, &[&[command][..], &turn].concat());
        assert!(problem.contains("--turn-rate"), "{problem}");
    }
}

/// Feedback is laid out for flights that are alike on both sides: a turn that was trimmed is written without
/// it, and flies.
#[test]
fn behaves_a_turn_is_written_without_feedback() {
    let scratch = Scratch::new("turn-without");
    let dir = &scratch.0;
    let trim = [
        "trim",
        "fruit-fly-controlled",
        "--set",
        "air.model=blade_element",
        "--forward",
        "0.3",
    ];
    let turn = ["--turn-rate", "300", "--write", "turn.toml"];
    let text = said(dir, &[&trim[..], &turn].concat());
    assert!(text.contains("without its feedback"), "{text}");
    said(dir, &["check", "turn.toml"]);
    let straight = said(dir, &[&trim[..], &["--write", "straight.toml"]].concat());
    assert!(!straight.contains("without its feedback"), "{straight}");
    let read = |name: &str| std::fs::read_to_string(dir.join(name)).unwrap();
    let [turning, straight] = ["turn.toml", "straight.toml"].map(read);
    assert!(turning.contains("# Without its feedback") && !turning.contains("[control"));
    assert!(straight.contains("[control") && !straight.contains("# Without"));
    said(dir, &["check", "straight.toml"]);
}

/// The help of trim names all unknowns, that of feedback no option that only wakes have.
#[test]
fn behaves_help_of_trims_has_what_they_take() {
    let scratch = Scratch::new("help-of-trims");
    let dir = &scratch.0;
    let help = said(dir, &["trim", "--help"]);
    for (_, name) in wingbeat::analysis::UNKNOWNS {
        assert!(help.contains(name), "{name}: {help}");
    }
    let help = said(dir, &["stabilise", "--help"]);
    assert!(
        help.contains("--bound") && !help.contains("--hold"),
        "{help}"
    );
    let help = said(dir, &["derivatives", "--help"]);
    assert!(help.contains("gliders in the vortex lattice"), "{help}");
}

/// Wings on motors have no stroke of their own: a sweep tells how the voltage changes.
#[test]
fn behaves_a_sweep_of_motors_has_their_drive_in_place_of_strokes() {
    const MOTOR: &str = include_str!("../../../wingbeat-case/tests/data/motor.toml");
    let scratch = Scratch::new("motor-sweep");
    let dir = &scratch.0;
    fs::write(dir.join("m.toml"), MOTOR).unwrap();
    let args = "trim m.toml --sweep 0 0.1 --points 2 --out s.txt";
    said(dir, &args.split(' ').collect::<Vec<_>>());
    let text = fs::read_to_string(dir.join("s.txt")).unwrap();
    assert!(
        text.contains(" drive  ") && !text.contains("stroke deg"),
        "{text}"
    );
    let row = text
        .lines()
        .find(|l| l.trim_start().starts_with("0.000"))
        .unwrap();
    let drive = row.split_whitespace().nth(4).unwrap();
    let changed: f64 = drive.parse().unwrap();
    assert!(drive.starts_with(['+', '-']) && changed != 0.0, "{text}");
}
