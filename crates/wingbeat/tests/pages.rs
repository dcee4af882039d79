//! Pages of docs: their files are what they say, their commands run, and the numbers beside them are theirs.

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;

use support::{Scratch, said};
use wingbeat::results::History;

fn page(name: &str) -> String {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    fs::read_to_string(docs.join(name)).unwrap()
}

/// The blocks of a page in a language.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let start = format!("```{language}\n");
    let rest = page.split(&start[..]).skip(1);
    rest.map(|b| b.split("```").next().unwrap()).collect()
}

/// Runs a line of a page in a shell.
fn run(dir: &Path, line: &str) {
    let program = Path::new(env!("CARGO_BIN_EXE_wingbeat")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    let out = shell.args(["-c", line]).current_dir(dir).env("PATH", &path);
    let out = out.output().unwrap();
    let problem = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{line}\n{problem}");
}

#[test]
fn behaves_the_case_that_is_read_line_by_line_flies_as_its_page_says() {
    let page = page("case-file.md");
    let scratch = Scratch::new("case-file");
    let dir = &scratch.0;
    fs::write(dir.join("moth.toml"), blocks(&page, "toml")[0]).unwrap();
    let lines = blocks(&page, "sh");
    lines
        .iter()
        .flat_map(|b| b.lines())
        .for_each(|l| run(dir, l));
    assert!(said(dir, &["check", "moth.toml"]).contains("0.99 weights"));
    let shown = said(dir, &["show", "results/paper-moth"]);
    assert!(
        shown.starts_with("green") && shown.contains("0.994"),
        "{shown}"
    );
    assert!(shown.contains("81.19"), "{shown}");
}

/// The strokes of Fry, Sayaman & Dickinson, rounded to a degree, fly as those of the set do: 1.255 weights.
#[test]
fn agrees_the_recording_of_the_page_on_measured_angles_with_the_set_that_it_is_of() {
    let page = page("measured-angles.md");
    let scratch = Scratch::new("measured-angles");
    let dir = &scratch.0;
    fs::write(dir.join("tracked.csv"), blocks(&page, "csv")[0]).unwrap();
    let commands = blocks(&page, "sh");
    let mut lines = commands.iter().flat_map(|b| b.lines());
    run(dir, lines.next().unwrap());
    let file = dir.join("my-fly.toml");
    let preset = fs::read_to_string(&file).unwrap();
    let kept = preset
        .lines()
        .filter(|l| !l.starts_with("data = \"fry-hover\""));
    let without: String = kept.map(|l| format!("{l}\n")).collect();
    assert!(without.len() < preset.len());
    let angles = blocks(&page, "toml")[0];
    fs::write(&file, format!("{without}\n{angles}")).unwrap();
    lines.for_each(|l| run(dir, l));
    let check = said(dir, &["check", "my-fly.toml"]);
    assert!(check.contains("1.26 weights") && check.contains("stroke 143.8"));
    assert!(
        check.contains("0.235") && !check.contains("angles"),
        "{check}"
    );
    let shown = said(dir, &["show", "tethered"]);
    assert!(
        shown.contains("1.264") && shown.contains("24.95"),
        "{shown}"
    );
}

/// Tables of a left wing that has the strokes of the right one fly as its mirror image; with the sign of a right wing
/// `check` says what is wrong, as it does of tables beside the laws of another preset.
#[test]
fn invariant_a_left_wing_of_the_page_on_measured_angles_is_the_image_of_the_right_one() {
    let page = page("measured-angles.md");
    let scratch = Scratch::new("left-angles");
    let dir = &scratch.0;
    fs::write(dir.join("tracked.csv"), blocks(&page, "csv")[0]).unwrap();
    said(dir, &["new", "fruit-fly-blade", "my-fly.toml"]);
    let file = dir.join("my-fly.toml");
    let preset = fs::read_to_string(&file).unwrap();
    let preset = preset.replace("data = \"fry-hover\"", "");
    let tables = blocks(&page, "toml");
    let check = |left: &str| {
        fs::write(&file, format!("{preset}\n{}\n{left}", tables[0])).unwrap();
        let out = support::wingbeat(dir, &["check", "my-fly.toml"]);
        let [told, warned] = [out.stdout, out.stderr].map(|o| String::from_utf8(o).unwrap());
        told + &warned
    };
    let lift = |said: &str| {
        let line = said.lines().find(|l| l.starts_with("lift"));
        line.map(str::to_owned)
    };
    let [alone, both] = ["", tables[1]].map(check);
    assert!(lift(&alone).is_some_and(|l| l.contains("1.26")), "{alone}");
    assert_eq!(lift(&alone), lift(&both));
    assert!(!both.contains("against each other"), "{both}");
    let wrong = check(&tables[1].replacen("factor = -1", "factor = 1", 1));
    let says = "look at sign and phase of motion.phi, whose sign on a left wing is opposite";
    assert!(wrong.contains(says), "{wrong}");
    said(dir, &["new", "hawkmoth-blade", "moth.toml"]);
    let file = dir.join("moth.toml");
    let moth = fs::read_to_string(&file).unwrap();
    fs::write(&file, format!("{moth}\n{}", tables[0])).unwrap();
    let refused = support::refused(dir, 2, &["check", "moth.toml"]);
    let says = "delete wing.right.motion.phi.fourier to keep `table`";
    assert!(refused.contains(says), "{refused}");
}

/// Tables of stroke and feathering beside a set that is left in the case: the deviation stays that of the set, and
/// `check` says so.
#[test]
fn behaves_check_says_which_angles_come_from_a_set() {
    let page = page("measured-angles.md");
    let scratch = Scratch::new("mixed-angles");
    let dir = &scratch.0;
    fs::write(dir.join("tracked.csv"), blocks(&page, "csv")[0]).unwrap();
    said(dir, &["new", "fruit-fly-blade", "my-fly.toml"]);
    let file = dir.join("my-fly.toml");
    let preset = fs::read_to_string(&file).unwrap();
    let tables = blocks(&page, "toml")[0];
    let (phi, rest) = tables.split_once("[wing.right.motion.theta").unwrap();
    let (_, psi) = rest.split_once("[wing.right.motion.psi").unwrap();
    fs::write(&file, format!("{preset}\n{phi}[wing.right.motion.psi{psi}")).unwrap();
    let mixed = "`right`: theta from motion.data = \"fry-hover\", phi and psi given";
    let check = said(dir, &["check", "my-fly.toml"]);
    assert!(
        check.contains(mixed) && check.contains("1.26 weights"),
        "{check}"
    );
    let json = said(dir, &["check", "my-fly.toml", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["mixed_angles"][0]["from_set"][0], "theta");
    let alone = said(dir, &["check", "my-fly.toml", "--set", "motion.data="]);
    assert!(
        !alone.contains("fry-hover") && alone.contains("1.02 weights"),
        "{alone}"
    );
    assert!(!said(dir, &["check", "fruit-fly-blade"]).contains("angles"));
}

/// The first elastic wing of the page, without its flight.
#[test]
fn behaves_the_first_elastic_wing_of_the_page_is_what_it_says() {
    let page = page("flexible-wings.md");
    let scratch = Scratch::new("first-elastic");
    let dir = &scratch.0;
    said(dir, &["new", "flapping-rectangles", "my-wing.toml"]);
    let file = dir.join("my-wing.toml");
    let rigid = fs::read_to_string(&file).unwrap();
    fs::write(&file, format!("{rigid}\n{}", blocks(&page, "toml")[0])).unwrap();
    let check = said(dir, &["check", "my-wing.toml"]);
    assert!(check.contains("20.1 Hz, 5.03 times"), "{check}");
    let modes = said(dir, &["modes", "my-wing.toml"]);
    assert!(modes.contains("20.1206"), "{modes}");
}

/// The foil in plane flow has Garrick's thrust [NACA TR 567], `pi (k h)^2 abs(C)^2` of 1/2 rho U^2 c for a plunge by h half
/// chords, and gives as much more power to the water as its wake takes: `pi (k h)^2 Re C`.
#[test]
fn agrees_the_foil_of_the_page_on_settings_with_garrick() {
    let page = page("lattice-settings.md");
    let scratch = Scratch::new("foil");
    let dir = &scratch.0;
    let is_foil = |b: &&str| b.contains("name = \"foil\"");
    let case = blocks(&page, "toml").into_iter().find(is_foil).unwrap();
    fs::write(dir.join("foil.toml"), case).unwrap();
    assert!(page.contains("wingbeat run foil.toml --out foil"));
    run(dir, "wingbeat run foil.toml --out foil");
    let history = fs::read_to_string(dir.join("foil/history.csv")).unwrap();
    let mut lines = history.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|l| l.split(',').collect()).collect();
    let column = |name: &str| {
        let c = names.iter().position(|n| *n == name).unwrap();
        let last = &rows[rows.len() - 81..];
        last.iter()
            .map(|r| r[c].parse().unwrap())
            .collect::<Vec<f64>>()
    };
    let forward = column("air_wing_right_force_n1_newton");
    let mean = forward[1..].iter().sum::<f64>() / 80.0;
    let work = column("applied_work_joule");
    let power = (work[80] - work[0]) * 1.2732;
    let (pressure, speed) = (0.5 * 1000.0 * 0.4 * 0.4, 0.4);
    let friction = 2.656 / (0.4 * 0.1 / 1e-6_f64).sqrt();
    let thrust = mean / pressure + friction;
    let power = power / (pressure * speed);
    let [real, imaginary] = [0.5394, -0.1003]; // Theodorsen's function at k = 1
    let scale = std::f64::consts::PI * 0.2 * 0.2;
    let garrick = scale * (real * real + imaginary * imaginary);
    println!(
        "thrust {thrust} for {garrick}, power {power} for {}",
        scale * real
    );
    // Cores of 0.01 chords take 2 % of the velocity of what is shed; the friction is that along the strip.
    assert!((thrust / garrick - 1.0).abs() < 0.05, "{thrust} {garrick}");
    assert!((power / (scale * real) - 1.0).abs() < 0.05, "{power}");
    let shown = said(dir, &["show", "foil"]);
    assert!(shown.starts_with("green"), "{shown}");
}

/// What the motor of the page takes from its battery is what heats its windings and what its shaft gives; the shaft's is
/// the power of the summary.
#[test]
fn balances_the_battery_of_the_page_on_motors() {
    let page = page("motors.md");
    let scratch = Scratch::new("motor");
    let dir = &scratch.0;
    let [case, volts, left] = blocks(&page, "toml")[..] else {
        panic!("two files and a side of its own")
    };
    fs::write(dir.join("motor.toml"), case).unwrap();
    fs::write(dir.join("volts.toml"), volts).unwrap();
    let lines = blocks(&page, "sh");
    lines
        .iter()
        .flat_map(|b| b.lines())
        .for_each(|l| run(dir, l));
    let [ohm, volt_second, volt] = [2.0, 0.02, 3.0];
    let means = |name: &str| {
        let history = History::read(&dir.join(name).join("history.csv")).unwrap();
        let last = history.rows() - 200..history.rows();
        let column = |name: &str| history.column(name)[last.clone()].to_vec();
        let rate = column("joint_right_rotation_1_rate_rad_per_s");
        let (mut battery, mut heat) = (0.0, 0.0);
        for (t, rate) in column("time_s").iter().zip(&rate) {
            let voltage = volt * (std::f64::consts::TAU * 20.0 * t).cos();
            let current = (voltage - volt_second * rate) / ohm;
            battery += 2.0 * voltage * current / 200.0;
            heat += 2.0 * ohm * current * current / 200.0;
        }
        let angle = |k: usize| {
            let angles = column(&format!("joint_right_rotation_{k}_rad"));
            angles
                .iter()
                .fold(0.0_f64, |m, q| m.max(q.abs()))
                .to_degrees()
        };
        let text = fs::read_to_string(dir.join(name).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        let last = &summary["beats"][7];
        let of = |key: &str| last[key].as_f64().unwrap();
        let shaft = of("power_watt");
        // Both are sums over the same steps of a periodic motion: what is left of the start decides.
        assert!(
            (battery - heat - shaft).abs() < 1e-5 * shaft,
            "{battery} {heat} {shaft}"
        );
        (
            [battery, heat, shaft, of("lift_over_weight")],
            [angle(1), angle(2)],
        )
    };
    let (of_motor, angles) = means("motor");
    println!(
        "{of_motor:?} {angles:?} {:?} {:?}",
        means("soft").0,
        means("stiff").0
    );
    let said = |number: f64, digits: usize| {
        assert!(page.contains(&format!("{number:.digits$}")), "{number}")
    };
    of_motor[..3].iter().for_each(|x| said(*x, 3));
    angles.iter().for_each(|x| said(*x, 1));
    for name in ["soft", "stiff"] {
        let ([battery, heat, _, lift], _) = means(name);
        let row = format!("| {lift:.3} | {battery:.3} W | {heat:.3} W |");
        assert!(page.contains(&row), "{row}");
    }
    // A left joint of its own with the voltage of the right one is the mirror image.
    let like = left.replace("[0.025]", "[0.03]");
    fs::write(dir.join("sides.toml"), format!("{case}\n{like}")).unwrap();
    run(dir, "wingbeat run sides.toml --out sides");
    assert_eq!(means("sides"), means("motor"));
    let points = fs::read_to_string(dir.join("volts/points.csv")).unwrap();
    let rows: Vec<Vec<&str>> = points
        .lines()
        .skip(1)
        .map(|l| l.split(',').collect())
        .collect();
    let number = |row: &Vec<&str>, c: usize| row[c].parse::<f64>().unwrap();
    let [a, b, c] = [0, 1, 2].map(|k| [number(&rows[k], 4), number(&rows[k], 5)]);
    let sentence = format!(
        "{:.2}, {:.2} and {:.2} weights for {:.3}, {:.3} and {:.3} W",
        a[0], b[0], c[0], a[1], b[1], c[1]
    );
    assert!(page.contains(&sentence), "{sentence}");
}

/// Rows of a table of a page whose second column is a sum of columns: of each row the names, as [beginning, end].
fn sums(page: &str, row: &str) -> Vec<[String; 2]> {
    let line = page.lines().find(|l| l.starts_with(&format!("| {row}")));
    let names = line.unwrap_or_else(|| panic!("{row}")).split('`');
    let names = names.skip(1).step_by(2);
    let parts = names.map(|n| n.split_once("...").unwrap_or((n, "")));
    parts.map(|(a, b)| [a.to_owned(), b.to_owned()]).collect()
}

/// Lift, thrust and power of the rows of a history by the sums of the page on results have the means of the summary,
/// where wings feather on springs, too.
#[test]
fn agrees_lift_and_power_over_time_of_the_page_on_results_with_the_means_of_beats() {
    let page = page("results.md");
    let scratch = Scratch::new("sums");
    let dir = &scratch.0;
    let set = "--set air.model=blade_element --set time.beats=2 --set output.figures=false";
    run(dir, &format!("wingbeat run robobee {set} --out r"));
    let history = History::read(&dir.join("r/history.csv")).unwrap();
    let text = fs::read_to_string(dir.join("r/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    let steps = (history.rows() - 1) / 2;
    let mean = |x: &[f64]| {
        let inner: f64 = x[steps + 1..2 * steps].iter().sum();
        (inner + 0.5 * (x[steps] + x[2 * steps])) / steps as f64
    };
    let sum = |[begins, ends]: &[String; 2]| {
        mean(&history.sum(|n| n.starts_with(&begins[..]) && n.ends_with(&ends[..])))
    };
    let lift = -sum(&sums(&page, "lift")[0]);
    let thrust = sum(&sums(&page, "thrust")[0]);
    let of_power = sums(&page, "power");
    let (given, passive) = of_power.split_at(3);
    let power = given.iter().map(sum).sum::<f64>() - sum(&passive[0]);
    assert!(sum(&passive[0]).abs() > 0.0);
    // The mean power of a beat is its work, which is not the trapezoidal rule of the powers: 4e-4 at 80 steps.
    for (key, found, within) in [
        ("lift_newton", lift, 1e-9 * lift),
        ("thrust_newton", thrust, 1e-9 * lift),
        ("power_watt", power, 2e-3 * power),
    ] {
        let mean = summary["beats"][1][key].as_f64().unwrap();
        assert!((found - mean).abs() < within, "{key}: {found} {mean}");
    }
}

/// Two wingbeats that are alike, flown as one beat as the page says of wingbeats that differ, have the forces of the
/// wingbeats one by one.
#[test]
fn exact_wingbeats_of_the_page_on_measured_angles_fly_as_one_beat() {
    let page = page("measured-angles.md");
    let scratch = Scratch::new("long-beat");
    let dir = &scratch.0;
    let csv = blocks(&page, "csv")[0];
    fs::write(dir.join("tracked.csv"), csv).unwrap();
    let rows = csv
        .lines()
        .filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
    // Frame 25 ends the first and begins the second.
    let second = rows.skip(1).map(|row| {
        let (frame, angles) = row.split_once(',').unwrap();
        format!("{},{angles}\n", frame.parse::<usize>().unwrap() + 25)
    });
    let both = format!("{}\n{}", csv.trim_end(), second.collect::<String>());
    fs::write(dir.join("two.csv"), both).unwrap();
    said(dir, &["new", "fruit-fly-blade", "my-fly.toml"]);
    let preset = fs::read_to_string(dir.join("my-fly.toml")).unwrap();
    let preset = preset.replace("data = \"fry-hover\"", "");
    let tables = blocks(&page, "toml")[0];
    let long = tables.replace("tracked.csv", "two.csv");
    let long = long.replace("beats_per_unit = 0.04", "beats_per_unit = 0.02");
    let long = long.replace("harmonics = 6", "harmonics = 12");
    let lifts = |name: &str, tables: &str, set: &str| {
        fs::write(dir.join("my-fly.toml"), format!("{preset}\n{tables}")).unwrap();
        let set = format!("{set} --set flight.mode=tethered --set output.figures=false");
        run(dir, &format!("wingbeat run my-fly.toml {set} --out {name}"));
        let text = fs::read_to_string(dir.join(name).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        let beats = summary["beats"].as_array().unwrap().clone();
        let lifts = beats.iter().map(|b| b["lift_newton"].as_f64().unwrap());
        lifts.collect::<Vec<_>>()
    };
    let once = "--set motion.frequency_hz=200 --set time.steps_per_beat=100 --set time.beats=4";
    let twice = "--set motion.frequency_hz=100 --set time.steps_per_beat=200 --set time.beats=2";
    let once = lifts("once", tables, once);
    let twice = lifts("twice", &long, twice);
    let mean = 0.5 * (once[2] + once[3]);
    assert!((twice[1] / mean - 1.0).abs() < 1e-9, "{twice:?} {once:?}");
}

/// The glider of the page on flight mechanics: its commands run, flown it comes to the glide that trim finds, by the
/// phugoid that stability finds, and the numbers of the page are these.
#[test]
fn agrees_the_glider_of_the_page_on_flight_mechanics_with_its_trim() {
    let page = page("flight-mechanics.md");
    let scratch = Scratch::new("glider");
    let dir = &scratch.0;
    let is_glider = |b: &&&str| b.contains("name = \"glider\"");
    let files = blocks(&page, "toml");
    fs::write(
        dir.join("glider.toml"),
        files.iter().find(is_glider).unwrap(),
    )
    .unwrap();
    let commands = blocks(&page, "sh");
    let of_glider: Vec<&str> = (commands.into_iter())
        .filter(|b| b.contains("glider.toml"))
        .collect();
    let [alone, lattice, beating] = of_glider[..] else {
        panic!("three blocks of commands")
    };
    alone.lines().for_each(|l| run(dir, l));
    run(dir, beating);
    // Its trim by tows takes minutes here; that the case is one is checked.
    let trim = lattice.split_once(" --write").unwrap().0;
    run(dir, &trim.replacen("wingbeat trim", "wingbeat check", 1));
    let object = |command: &str| -> serde_json::Value {
        serde_json::from_str(&said(dir, &[command, "glider.toml", "--json"])).unwrap()
    };
    let power = object("power");
    let [forward, climb, lost] =
        ["forward_m_s", "climb_m_s", "height_lost_watt"].map(|k| power[k].as_f64().unwrap());
    let stability = object("stability");
    let modes = stability["floquet_modes"].as_array().unwrap();
    let phugoid = modes
        .iter()
        .find(|m| m["name"] == "stable phugoid")
        .unwrap();
    let [growth, rate] =
        ["growth_per_s", "frequency_rad_per_s"].map(|k| phugoid[k].as_f64().unwrap());
    let history = History::read(&dir.join("glide/history.csv")).unwrap();
    let [ahead, sink] = ["n1", "n3"].map(|n| {
        let momentum = history.column(&format!("momentum_{n}_kg_m_per_s"));
        momentum.iter().map(|p| p / 0.03).collect::<Vec<f64>>()
    });
    // What is left of the phugoid after 40 s, of some 0.7 m/s.
    let left = 0.7 * (growth * 40.0).exp();
    let last = sink.len() - 1;
    assert!((ahead[last] - forward).abs() < 2.0 * left, "{forward}");
    assert!((sink[last] + climb).abs() < 2.0 * left, "{climb}");
    let times = history.column("time_s");
    let tops = (1..last).filter(|&k| sink[k] > sink[k - 1] && sink[k] >= sink[k + 1]);
    let tops: Vec<[f64; 2]> = tops.map(|k| [times[k], sink[k] + climb]).collect();
    let [first, fourth] = [tops[1], tops[4]];
    let period = (fourth[0] - first[0]) / 3.0;
    let decay = (first[1] / fourth[1]).ln() / (fourth[0] - first[0]);
    // Rows are 0.02 s apart.
    assert!((period * rate / std::f64::consts::TAU - 1.0).abs() < 5e-3);
    assert!((decay / -growth - 1.0).abs() < 1e-2, "{decay} {growth}");
    for said in [
        format!("{forward:.3} m/s forward, {:.3} m/s down", -climb),
        format!("phugoid {growth:.4} 1/s, {rate:.4} rad/s"),
        format!("{:.1} mW", 1e3 * lost),
        format!("a period of {period:.2} s"),
        format!("by {decay:.3} 1/s"),
    ] {
        assert!(page.contains(&said), "{said}");
    }
}
