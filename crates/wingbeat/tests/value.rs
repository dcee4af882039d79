//! A flight as a value: what of it is written, and when a whole result directory is refused.

use std::path::PathBuf;

use wingbeat::prelude::*;
use wingbeat::results::{Outcome, ResultDir, Summary};

/// A place in the temporary folder where nothing is yet.
fn place(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("wingbeat-value-{name}-{}", std::process::id()))
}

fn short() -> Flight {
    let keys = [
        "time.beats=0.2",
        "output.figures=false",
        "output.page=false",
    ];
    Flight::preset_with("fruit-fly-blade", &keys).expect("a preset")
}

#[test]
fn behaves_written_case_flies_the_same() {
    let dir = place("case");
    let run = short().fly_to(&dir).expect("a flight of a preset");
    let case = ResultDir::read(&dir)
        .and_then(|d| d.case())
        .expect("a case");
    let again = Flight::from(case).fly().expect("the same flight");
    assert_eq!(again.records, run.records);
    std::fs::remove_dir_all(&dir).expect("it was just written");
}

/// What a flight writes is flown by the command line to the last bit.
fn repeats(name: &str, flight: &Flight) -> Run {
    let dir = place(name);
    let run = flight.fly_to(dir.join("rust")).expect("a flight");
    let out = std::process::Command::new(env!("CARGO_BIN_EXE_wingbeat"))
        .current_dir(&dir)
        .args(["run", "rust/case.toml", "--out", "again", "--quiet"])
        .output()
        .expect("the program");
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{name}: {said}");
    let history = |of: &str| std::fs::read(dir.join(of).join("history.csv")).expect("a history");
    assert!(history("rust") == history("again"), "{name}: same bytes");
    std::fs::remove_dir_all(&dir).expect("it was just written");
    run
}

/// The flight as it was set up and as its case has it: the same path and the same loads to round-off.
fn agrees_with_itself(name: &str, flight: &Flight) {
    let [set_up, written] = [flight.fly().expect("a flight"), repeats(name, flight)];
    let weight = set_up.setup.animal.mass() * 9.81;
    let both = set_up.records.iter().zip(&written.records);
    let mut apart = [0.0_f64; 2];
    for (a, b) in both {
        let fall = 9.81 * a.time.max(1e-4).powi(2);
        apart[0] = apart[0].max((a.mass_centre - b.mass_centre).length() / fall);
        let loads = a.air.iter().zip(&b.air);
        let largest = loads.map(|(a, b)| (a.force - b.force).length());
        apart[1] = largest.fold(apart[1], |m, gap| m.max(gap / weight));
    }
    println!("{name}: {apart:?}");
    let close = apart[0] < PATH && apart[1] < LOADS;
    assert!(close, "{name}: {apart:?}");
}

/// Rounding of positions over a fall of some micrometres: 2e-12 of it for a bird.
const PATH: f64 = 1e-11;
/// Rounding of angles and inertias, 1e-16 of each.
const LOADS: f64 = 1e-15;

#[test]
fn agrees_case_of_changed_presets() {
    let mut lighter = short();
    lighter.setup.gravity.z *= 0.5;
    agrees_with_itself("lighter", &lighter);
    let faster = short().frequency_hz(233.0);
    agrees_with_itself("faster", &faster);
    let gust = Gust {
        amplitude: DVec3::new(0.0, 0.3, 0.1),
        start: 1e-4,
        slowness: DVec3::new(0.5, 0.0, 0.0),
        shape: GustShape::Table(vec![(0.0, 0.0), (1e-3, 1.0)]),
    };
    let gusty = short().gust(gust).expect("air with wind");
    agrees_with_itself("gusty", &gusty);
    let keys = [
        "time.beats=0.1",
        "output.figures=false",
        "output.page=false",
    ];
    for (preset, factor) in [("bird-cruise", 0.9), ("fruit-fly-tethered", 1.0)] {
        let mut flight = Flight::preset_with(preset, &keys).expect("a preset");
        for wing in &mut flight.setup.animal.wings {
            wing.mass = wing.mass.scaled(factor);
            wing.motion.phase += 0.01;
        }
        agrees_with_itself(preset, &flight);
    }
}

#[test]
fn agrees_frequency_with_that_of_the_case() {
    let keys = ["time.beats=0.2", "motion.frequency_hz=220"];
    for preset in ["fruit-fly-blade", "fruit-fly-abdomen"] {
        let flight = Flight::preset_with(preset, &keys[..1]).unwrap();
        let [a, b] = [
            flight.frequency_hz(220.0),
            Flight::preset_with(preset, &keys).unwrap(),
        ]
        .map(|flight| flight.fly().unwrap().records);
        let last = |records: &[wingbeat::flight::Record]| records.last().unwrap().mass_centre;
        let apart = last(&a).distance(last(&b)) / last(&a).length();
        assert!(a.len() == b.len() && apart < 1e-9, "{preset}: {apart:e}");
    }
}

#[test]
fn refuses_a_frequency_of_zero_and_steps_without_length() {
    let still = short().frequency_hz(0.0).fly();
    assert!(still.unwrap_err().to_string().contains("time.step = inf"));
}

#[test]
fn agrees_case_of_flights_built_in_rust() {
    use wingbeat::model::species::{FlyOptions, drosophila_melanogaster};
    let options = FlyOptions {
        scale: 1.5,
        frequency: 150.0,
        wing_rows: 2,
        wing_cols: 4,
        ..FlyOptions::default()
    };
    let insect = drosophila_melanogaster(&options).expect("an insect");
    let start = StartState {
        angles: DVec3::new(0.8, 0.1, -0.2),
        velocity: DVec3::new(0.1, 0.0, 0.0),
        angular_velocity: DVec3::new(0.0, 3.0, 0.0),
        ..StartState::default()
    };
    let airs = [
        AirModel::None,
        AirModel::BladeElement(BladeOptions::insect(1.225)),
        AirModel::VortexLattice(AirOptions::insect(1.225, 1.5e-5, 1.05e-3)),
    ];
    for air in airs {
        let name = air.name().replace(' ', "-");
        let flight = Flight::new("insect", insect.clone(), air);
        agrees_with_itself(&name, &flight.start(start.clone()).beats(0.2));
    }
}

#[test]
fn refuses_whole_results_of_what_no_case_says() {
    let dir = place("refused");
    let mut swapped = short();
    swapped.setup.animal.wings.reverse();
    let mut robot = Flight::preset("robobee").expect("a preset");
    robot.setup.joints[0].model.elements.clear();
    let mut uneven = short();
    uneven.setup.animal.wings[0].motion.frequency *= 1.1;
    let refused = [
        (swapped, "order of the wings"),
        (robot, "joints"),
        (uneven, "motion of the wings"),
    ];
    for (flight, part) in refused {
        let refused = flight.fly_to(&dir).expect_err("no case gives it");
        let said = refused.to_string();
        assert!(
            said.contains(&format!("no keys for its {part}: ")),
            "{said}"
        );
        assert!(!dir.exists(), "nothing is written");
    }
}

#[test]
fn behaves_flight_of_rust_leaves_history_and_summary() {
    let dir = place("rust");
    let mut flight = short();
    flight.setup.gravity.z *= 0.5;
    let run = flight.fly().expect("a flight");
    run.write(&dir).expect("a new folder");
    let text = std::fs::read_to_string(dir.join("summary.txt")).expect("a summary");
    assert_eq!(text, run.summary().to_text());
    let refused = run.write(&dir).expect_err("nothing is overwritten");
    assert!(refused.to_string().contains("exists already"), "{refused}");
    std::fs::remove_dir_all(&dir).expect("it was just written");
}

#[test]
fn behaves_flight_that_fails_leaves_what_was_flown() {
    let dir = place("failed");
    let keys = [
        "dynamics.integrator=hamming",
        "corrector.max_passes=3", // enough at first, too few in the second wingbeat
        "motion.start=smooth",
        "motion.start_beats=1",
        "time.beats=2",
        "output.figures=false",
        "output.page=false",
    ];
    let flight = Flight::preset_with("fruit-fly-blade", &keys).expect("a preset");
    let failed = flight.fly_to(&dir).expect_err("it cannot converge");
    assert!(matches!(failed, Error::Flight(_)), "{failed}");
    let read = ResultDir::read(&dir).expect("a result");
    let outcome = read.manifest().expect("a manifest").outcome;
    assert_eq!(outcome, Outcome::Failed(failed.to_string()));
    let case = read.case().expect("a case");
    let summary = Summary::read(&case, &read.join("history.csv"), &outcome).expect("a summary");
    assert_eq!(summary.beats.len(), 1, "the first wingbeat is there");
    std::fs::remove_dir_all(&dir).expect("it was just written");
}

/// Wings of inertia I that swing by A sin(w t) in a vacuum take I A^2 w^3 / (2 pi) each while they gain speed, and
/// give it back while they lose it.
#[test]
fn exact_positive_power_of_wings_in_a_vacuum() {
    let keys = [
        "flight={mode=\"tethered\"}",
        "motion={frequency_hz=200,start=\"impulsive\"}",
        "wing.right.motion={phi={fourier={sine_deg=[60]}},theta={constant_deg=0},psi={constant_deg=0}}",
        "time={beats=2,steps_per_beat=400}",
    ];
    let run = Flight::preset_with("fruit-fly-vacuum", &keys).and_then(|f| f.fly());
    let run = run.expect("a flight");
    let wings = &run.setup.animal.wings;
    let inertia: f64 = wings.iter().map(|w| w.mass.inertia.x_axis.x).sum();
    let (amplitude, rate) = (60f64.to_radians(), 2.0 * std::f64::consts::PI * 200.0);
    let exact = inertia * amplitude.powi(2) * rate.powi(3) / (2.0 * std::f64::consts::PI);
    let beat = run.beats()[1];
    let error = beat.positive_power_watt / exact - 1.0;
    assert!(error.abs() < 5e-5, "{error:e}"); // the trapezoidal rule leaves (2 pi / 400)^2 / 3 / 4
    assert!(
        beat.power_watt.abs() < 1e-9 * exact,
        "{:e}",
        beat.power_watt
    );
}

/// Rectangular wings, from r0 to R from the root, that swing by A sin(w t) in air at rest and feather besides:
/// the mean of 1/2 rho int U^2 dA is rho c A^2 w^2 (R^3 - r0^3) / 6 for the two together.
#[test]
fn exact_coefficients_of_flapping_rectangles() {
    let flown = |air: &str| {
        let keys = [
            "flight={mode=\"tethered\"}",
            "motion={frequency_hz=200,start=\"impulsive\"}",
            "wing.right.motion={phi={fourier={sine_deg=[60]}},theta={constant_deg=0},psi={fourier={cosine_deg=[40]}}}",
            "wing.right.planform={rectangle={chord_m=1e-3,span_m=2e-3,root_offset_m=4e-4,axis_fraction=0.25}}",
            "wing.right.mesh={chordwise=2,spanwise=10}",
            "time={beats=2,steps_per_beat=40}",
            air,
        ];
        let run = Flight::preset_with("fruit-fly-blade", &keys).and_then(|f| f.fly());
        run.expect("a flight")
    };
    for air in [
        "air.model=\"blade_element\"",
        "air.model=\"vortex_lattice\"",
    ] {
        let run = flown(air);
        let rho = run.setup.air.density().expect("a density");
        let rate = 60f64.to_radians() * 2.0 * std::f64::consts::PI * 200.0;
        let (chord, [root, tip], width) = (1e-3, [4e-4, 2.4e-3], 2e-4f64);
        // Ten strips, each with the speed of its middle, leave out c (R - r0) dr^2 / 12 of the second moment.
        let moment = chord
            * ((f64::powi(tip, 3) - f64::powi(root, 3)) / 3.0
                - (tip - root) * width.powi(2) / 12.0);
        let still = 0.5 * rho * rate.powi(2) * moment;
        let [first, last] = [40, 80].map(|k| &run.records[k]);
        let mean = (last.dynamic_impulse - first.dynamic_impulse) * 200.0;
        assert!(
            (mean / still - 1.0).abs() < 1e-12,
            "{air}: {mean:e} N, {still:e} N"
        );
        let beat = run.beats()[1];
        let lift = -(last.air_impulse - first.air_impulse).z * 200.0;
        assert!((beat.lift_coefficient * still / lift - 1.0).abs() < 1e-12);
    }
}

/// Wings in a stream have half its density times its square times their area, whatever their incidence.
#[test]
fn exact_dynamic_pressure_of_a_stream() {
    let keys = [
        "time.steps=4",
        "wing.right.motion={psi={constant_deg=20},phi={constant_deg=10}}",
    ];
    let run = Flight::preset_with("rectangular-wing", &keys).and_then(|f| f.fly());
    let run = run.expect("a flight");
    let last = run.records.last().expect("rows");
    let exact = 0.5 * 1.225 * 10f64.powi(2) * 0.08 * last.time;
    let error = last.dynamic_impulse / exact - 1.0;
    assert!(error.abs() < 1e-13, "{error:e}");
}
