//! Trims and averaged models, through the program.

use std::fs;

use crate::support::{Scratch, column, refused, said, wingbeat};

#[test]
fn agrees_a_written_table_of_derivatives_with_the_averaged_model() {
    let scratch = Scratch::new("table");
    let dir = &scratch.0;
    let full = said(dir, &["stability", "--write", "table.toml"]);
    let table = said(dir, &["stability", "table.toml"]);
    // Growth and frequency of every mode, printed with four decimals.
    let modes = |text: &str| -> Vec<Vec<String>> {
        let section = text.split("Modes").nth(1).unwrap();
        let rows = section.lines().filter(|l| {
            let l = l.trim_start();
            l.starts_with("longitudinal") || l.starts_with("lateral")
        });
        let words = |l: &str| -> Vec<String> {
            let numbers = l.split_whitespace().filter_map(|w| w.parse::<f64>().ok());
            // Zeros have no sign.
            numbers.take(2).map(|x| format!("{:.4}", x + 0.0)).collect()
        };
        rows.map(words).collect()
    };
    assert_eq!(modes(&full).len(), 7);
    assert_eq!(modes(&full), modes(&table));
    // So it does of flights with sideslip, whose bodies roll, and in a stream.
    for flight in [
        ["--sideslip", "0.4"],
        ["--set", "air.stream_m_s=[-0.3,0,0]"],
    ] {
        let write = ["stability", "--write", "other.toml", "--overwrite"];
        let full = said(dir, &[&write[..], &flight].concat());
        let table = said(dir, &["stability", "other.toml"]);
        assert_eq!(modes(&full), modes(&table), "{flight:?}");
    }
    // The table's flight stays in its trimmed state.
    said(
        dir,
        &[
            "run",
            "table.toml",
            "--quiet",
            "--out",
            "r",
            "--set",
            "time.beats=2",
        ],
    );
    let z = column(&dir.join("r"), "body_z_m");
    // The mean loads of the swaying orbit and of its mean differ by a hundredth of the weight.
    assert!(z[z.len() - 1].abs() < 0.01 * 2.5e-3, "{}", z[z.len() - 1]);
}

/// Gravity need not follow n3: the attitude and the velocity of the written flight are in inertial axes all the same.
#[test]
fn balances_a_written_table_whose_gravity_is_oblique() {
    let scratch = Scratch::new("oblique");
    let dir = &scratch.0;
    let oblique = ["--set", "gravity_m_s2=[1,0,9.7]", "--forward", "0.3"];
    let out = wingbeat(
        dir,
        &[&["stability", "--write", "t.toml"][..], &oblique].concat(),
    );
    assert!(out.status.success());
    let check = wingbeat(dir, &["check", "t.toml"]);
    let said = [check.stdout, check.stderr].concat();
    assert!(!String::from_utf8_lossy(&said).contains("from behind"));
    let fly = ["run", "t.toml", "--quiet", "--out", "r"];
    assert!(
        wingbeat(dir, &[&fly[..], &["--set", "time.beats=1"]].concat())
            .status
            .success()
    );
    let r = dir.join("r");
    let beat = 5e-3;
    for (name, wanted) in [
        ("body_x_m", 0.3 * beat),
        ("body_y_m", 0.0),
        ("body_z_m", 0.0),
    ] {
        let way = column(&r, name);
        // A fall over the beat is 0.12 mm; loads of the mean state and of the orbit differ by a hundredth of it.
        let off = way[way.len() - 1] - way[0] - wanted;
        assert!(off.abs() < 5e-6, "{name}: {off}");
    }
}

/// Tables without lateral derivatives: v, p, r, roll and heading have no motion of their own, five eigenvalues of zero,
/// whatever pairs rounding makes of them.
#[test]
fn exact_a_table_without_lateral_derivatives_has_five_neutral_motions() {
    let scratch = Scratch::new("neutral");
    for table in ["table1-sun-2007", "table1-sun-xiong-2005"] {
        let text = said(&scratch.0, &["stability", table]);
        let lines = text
            .lines()
            .filter(|l| l.contains("lateral") && l.contains("neutral"));
        assert_eq!(lines.count(), 5, "{table}: {text}");
    }
}

#[test]
fn behaves_a_trim_beyond_half_a_turn_is_warned_of() {
    let scratch = Scratch::new("beyond");
    let warned = |forward: &str| {
        let out = wingbeat(
            &scratch.0,
            &["trim", "fruit-fly-blade", "--forward", forward],
        );
        assert!(out.status.success());
        String::from_utf8(out.stderr)
            .unwrap()
            .contains("wings pass through each other")
    };
    assert!(warned("2") && !warned("0.2"));
}

/// The strokes of the case are those of the preset inside out; the trim turns them back, by less than -100 %.
#[test]
fn behaves_a_trim_that_turns_strokes_inside_out_is_none() {
    let scratch = Scratch::new("inside-out");
    let turned = "motion.adjust.stroke_amplitude=-2";
    let out = wingbeat(&scratch.0, &["trim", "fruit-fly-blade", "--set", turned]);
    assert_eq!(out.status.code(), Some(1));
    let said = String::from_utf8(out.stderr).unwrap();
    assert!(said.contains("a stroke is turned inside out"), "{said}");
}

/// What a trim cannot keep of the start of its case is refused by its key, and what it can is kept.
#[test]
fn refuses_a_roll_and_a_heading_that_the_trimmed_flight_does_not_have() {
    let dir = &Scratch::new("start").0;
    let fly = |set: &'static str| ["trim", "fruit-fly-blade", "--steps", "40", "--set", set];
    for (set, key) in [
        (
            "flight.roll_deg=10",
            "a roll of 10 degrees (flight.roll_deg)",
        ),
        ("flight.yaw_deg=30", "a yaw of 30 degrees (flight.yaw_deg)"),
    ] {
        let said = refused(dir, 2, &fly(set));
        assert!(said.contains(key), "{said}");
    }
    let six = "--unknowns body_pitch stroke_amplitude stroke_offset stroke_offset_difference stroke_amplitude_difference stroke_plane_difference --sideslip 0.1";
    let six: Vec<&str> = six.split(' ').collect();
    let kept = |set| said(dir, &[&fly(set)[..], &six].concat());
    assert_ne!(kept("flight.roll_deg=2"), kept("flight.roll_deg=3"));
    let oblique = ["--set", "gravity_m_s2=[1,0,9.7]", "--turn-rate", "300"];
    let turn = refused(dir, 2, &[&fly("time.beats=2")[..], &oblique].concat());
    assert!(
        turn.contains("gravity_m_s2 = [1, 0, 9.7]") && !turn.contains("stream"),
        "{turn}"
    );
}

/// A bound of the mass centre is in wing lengths, and so is what is found, beside millimetres.
#[test]
fn agrees_a_mass_centre_in_millimetres_with_one_in_wing_lengths() {
    let dir = &Scratch::new("forward").0;
    let unknowns = "trim fruit-fly-blade --steps 40 --unknowns mass_centre stroke_amplitude body_pitch --bound mass_centre=-0.5..0.5 --json";
    let unknowns: Vec<&str> = unknowns.split(' ').collect();
    let told: serde_json::Value = serde_json::from_str(&said(dir, &unknowns)).unwrap();
    let found = &told["unknowns"];
    let number = |key: &str| found[key].as_f64().unwrap();
    let [metres, lengths] =
        ["mass_centre_forward_m", "mass_centre_forward_wing_lengths"].map(number);
    // A wing of 2.5 mm.
    assert!(
        (metres / lengths / 2.5e-3 - 1.0).abs() < 0.05,
        "{metres} {lengths}"
    );
}

/// Refusals before anything is flown have exit code 2.
#[test]
fn refuses_what_has_no_map_of_a_beat() {
    let dir = &Scratch::new("map").0;
    for (command, case, says) in [
        (
            "derivatives",
            "fruit-fly-hover",
            "air.model = vortex_lattice",
        ),
        ("stabilise", "fruit-fly-hover", "air.model = vortex_lattice"),
        ("trim", "fruit-fly-vacuum", "there is no air"),
    ] {
        let said = refused(dir, 2, &[command, case]);
        assert!(said.contains(says), "{command}: {said}");
    }
}

#[test]
fn behaves_a_flight_that_is_never_released_says_so() {
    let scratch = Scratch::new("held");
    let dir = &scratch.0;
    let fly = |out: &str, held: &str| {
        let held = format!("flight.held_beats={held}");
        let set = ["--set", "time.beats=2", "--set", &held];
        said(
            dir,
            &[
                &["run", "fruit-fly-blade", "--quiet", "--out", out][..],
                &set,
            ]
            .concat(),
        );
        fs::read_to_string(dir.join(out).join("summary.txt")).unwrap()
    };
    let words = "the body has not been released";
    assert!(fly("held", "9").contains(words) && !fly("free", "1").contains(words));
}

/// Flights that are compared have means with errors, and verdicts.
#[test]
fn agrees_compare_tells_means_with_their_errors_from_chance() {
    let scratch = Scratch::new("means");
    let dir = &scratch.0;
    for (out, hertz) in [("slow", "180"), ("fast", "220")] {
        let frequency = format!("motion.frequency_hz={hertz}");
        let set = ["--set=flight.mode=tethered", "--set=time.beats=5", "--set"];
        let run = ["run", "fruit-fly-blade", "--quiet", "--out", out];
        said(dir, &[&run[..], &set, &[frequency.as_str()]].concat());
    }
    let json: serde_json::Value =
        serde_json::from_str(&said(dir, &["compare", "slow", "fast", "--json"])).unwrap();
    let lift = &json["means"][1];
    assert_eq!(lift["what"], "lift [N]");
    for (which, out) in [("first", "slow"), ("second", "fast")] {
        let text = std::fs::read_to_string(dir.join(out).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(lift[which], summary["means"]["lift_newton"]);
    }
    assert_eq!(lift["is_beyond_errors"], true);
    assert_eq!(json["verdicts"].as_array().unwrap().len(), 2);
    let same = said(dir, &["compare", "slow", "slow"]);
    assert!(
        same.contains("within twice its error") && !same.contains("beyond"),
        "{same}"
    );
    assert!(same.lines().any(|l| l.starts_with("second  ")), "{same}");
}

#[test]
fn exact_compare_gives_differences_over_the_first() {
    let scratch = Scratch::new("over");
    let dir = &scratch.0;
    for (out, hertz) in [("slow", "180"), ("fast", "220")] {
        let frequency = format!("motion.frequency_hz={hertz}");
        let set = ["--set", "time.beats=1", "--set", &frequency];
        let run = ["run", "fruit-fly-blade", "--quiet", "--out", out];
        said(dir, &[&run[..], &set].concat());
    }
    for runs in [["slow", "fast"], ["fast", "slow"]] {
        let text = said(dir, &[&["compare"][..], &runs].concat());
        let rows = text.lines().filter_map(|l| {
            let words: Vec<&str> = l.split_whitespace().rev().take(4).collect();
            let part: f64 = words.first()?.strip_suffix('%')?.parse().ok()?;
            let [difference, first] = [1, 3].map(|k| words[k].parse::<f64>().ok());
            Some((part, difference?, first?))
        });
        let rows: Vec<(f64, f64, f64)> = rows.collect();
        assert!(rows.len() > 5, "{text}");
        for (part, difference, first) in rows {
            let exact = 100.0 * difference / first.abs();
            // Six digits and two decimals are printed.
            assert!(
                (part - exact).abs() < 0.0051 + 2e-5 * exact.abs(),
                "{part} {exact}"
            );
        }
    }
}
