//! The summary's judgement: alarms where something is wrong, none where nothing is.

use crate::flights::{flown, preset, says};
use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_case::raw::{AirCase, AirModel, BodyCase, Case, FlightCase, OutputCase, TimeCase};
use wingbeat_flight::{Record, Simulation};
use wingbeat_results::summary::Verdict;
use wingbeat_results::{Outcome, ResultDir, RunWriter, Summary, saver};

/// A body alone, without weight, turning at `rate` [deg/s].
fn rigid(name: &str, rate: [f64; 3]) -> LoadedCase {
    let case = Case {
        name: Some(name.to_owned()),
        gravity_m_s2: [0.0; 3],
        time: TimeCase {
            step_s: Some(0.01),
            steps: Some(50),
            ..TimeCase::default()
        },
        flight: FlightCase {
            angular_velocity_deg_s: rate,
            ..FlightCase::default()
        },
        air: AirCase {
            model: AirModel::None,
            ..AirCase::default()
        },
        output: OutputCase {
            frames_every: 0,
            ..OutputCase::default()
        },
        body: BodyCase {
            mass_kg: Some(1.0),
            inertia_about_centre_kg_m2: Some([1.0, 2.0, 2.5, 0.0, 0.0, 0.0]),
            ..BodyCase::default()
        },
        ..Case::default()
    };
    LoadedCase::new(case).unwrap()
}

/// The kinetic energy of a free body does not change: its residual is no part of a change, but of the
/// energy itself.
#[test]
fn conserves_energy_of_a_free_rigid_body_without_an_alarm() {
    let summary = flown(&rigid("spinning", [100.0, 20.0, 300.0]));
    println!("{:.1e}", summary.energy_residual_relative);
    // Tolerance 1e-10 a step.
    assert!(summary.energy_residual_relative < 1e-9);
    assert!(!says(&summary, "balance"), "{:?}", summary.warnings);
    assert_eq!(
        summary.verdict,
        Verdict::Green,
        "{}",
        summary.verdict_reason
    );
    let still = flown(&rigid("resting", [0.0; 3]));
    assert_eq!(still.energy_residual_relative, 0.0);
    assert!(!says(&still, "balance"), "{:?}", still.warnings);
}

/// Without weight the momenta of two wings cancel but for roundings, which are measured by what
/// cancels.
#[test]
fn conserves_momentum_without_weight_without_an_alarm() {
    let case = preset(
        "fruit-fly-vacuum",
        &["gravity_m_s2=[0,0,0]", "time.beats=1"],
    );
    let summary = flown(&case);
    println!("{:.1e}", summary.momentum_residual_relative);
    assert!(summary.momentum_residual_relative < 1e-12);
    assert!(!says(&summary, "balance"), "{:?}", summary.warnings);
}

/// The momentum of a tethered animal is prescribed: what is open there is how ill the steps follow the motion.
/// In 20 steps a beat 0.03, in 10 0.24, in 4, in which lift is 16 % off, 1.5.
#[test]
fn behaves_the_momentum_of_tethered_flights_tells_of_strokes_that_steps_do_not_follow() {
    for (steps, verdict) in [
        (40, Verdict::Green),
        (10, Verdict::Amber),
        (4, Verdict::Red),
    ] {
        let steps = format!("time.steps_per_beat={steps}");
        let set = ["flight.mode=tethered", "time.beats=3", &steps];
        let summary = flown(&preset("fruit-fly-blade", &set));
        let residual = summary.momentum_residual_relative;
        let is_open = says(&summary, "The momentum balance does not close");
        assert_eq!(is_open, verdict > Verdict::Green);
        let of_momentum = match residual {
            r if r > 0.4 => Verdict::Red,
            r if r > 0.04 => Verdict::Amber,
            _ => Verdict::Green,
        };
        assert_eq!(of_momentum, verdict, "{residual:e}");
        assert!(summary.verdict >= verdict);
    }
}

/// The verdict and its numbers are of all steps, however thin the history is; read back they are what was written.
#[test]
fn invariant_the_verdict_does_not_depend_on_what_the_history_holds() {
    let fly = |every: usize| {
        let every = format!("output.history_every={every}");
        let set = ["time.beats=1", "time.steps_per_beat=20", &every];
        flown(&preset("fruit-fly-blade", &set))
    };
    let whole = fly(1);
    for thinned in [fly(7), fly(1000)] {
        assert_eq!(thinned.verdict, whole.verdict);
        assert_eq!(
            thinned.energy_residual_relative,
            whole.energy_residual_relative
        );
        assert_eq!(
            thinned.momentum_residual_relative,
            whole.momentum_residual_relative
        );
        assert_eq!(thinned.corrector_passes_mean, whole.corrector_passes_mean);
        assert_eq!(thinned.alternating_steps, whole.alternating_steps);
        assert!(says(&thinned, "What is said here is of all steps"));
    }
}

/// What was gathered goes on over a checkpoint: a residual that was largest before it is not lost.
#[test]
fn invariant_the_verdict_of_a_thinned_history_outlives_a_checkpoint() {
    let set = [
        "time.beats=1",
        "time.steps_per_beat=20",
        "output.history_every=7",
    ];
    let case = preset("fruit-fly-blade", &set);
    assert_eq!(stopped_at(16, &case), flown(&case));
}

/// The summary of a flight that was left at a checkpoint and gone on with.
fn stopped_at(step: usize, case: &LoadedCase) -> Summary {
    let name = format!("wingbeat-summary-{}-on-{}", std::process::id(), case.name);
    let path = std::env::temp_dir().join(name);
    let mut writer = RunWriter::new(ResultDir::overwrite(&path).unwrap(), case, 1).unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    writer.write(flight.record(), || flight.snapshot()).unwrap();
    while flight.state().step < step {
        flight.step().unwrap();
        writer.write(flight.record(), || flight.snapshot()).unwrap();
    }
    writer.save(flight.state()).unwrap();
    drop(writer);
    let saved = saver::read(&path).unwrap();
    let (header, state) = saved.checkpoint.unwrap();
    let mut flight = Simulation::resume(case.setup.clone(), state).unwrap();
    let dir = ResultDir::open(&path).unwrap();
    let mut writer = RunWriter::resume(dir, case, &header, saved.manifest, 1).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
        writer.write(flight.record(), || flight.snapshot()).unwrap();
    }
    let resumed = writer.finish(Outcome::Finished, |_, _, _| Ok(())).unwrap();
    std::fs::remove_dir_all(path).unwrap();
    resumed
}

/// The last part of a flight without wingbeats is that of all steps, however thin the history is, in memory, and
/// over a checkpoint on either side of where it begins (0.8 and 0.9 of 30 steps: 24 and 27).
#[test]
fn invariant_the_last_part_does_not_depend_on_what_the_history_holds() {
    let case = |every: usize| {
        let every = format!("output.history_every={every}");
        preset("rectangular-wing", &["time.steps=30", &every])
    };
    let whole = flown(&case(1)).last_part.expect("a last part");
    let of = |s: Summary| s.last_part.expect("a last part");
    for thinned in [case(7), case(1000)] {
        assert_eq!(of(flown(&thinned)), whole);
        assert_eq!(of(stopped_at(20, &thinned)), whole);
        assert_eq!(of(stopped_at(25, &thinned)), whole);
    }
    let case = case(7);
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        records.push(flight.step().unwrap().clone());
    }
    assert_eq!(
        of(Summary::of(&case.setup, &records, &Outcome::Finished)),
        whole
    );
}

/// A flyer whose commands do not suffice turns over; one at its ease stays where it is to be.
#[test]
fn behaves_flights_under_feedback_say_how_far_they_were_from_what_they_hold() {
    let fly = |beats: &str, limits: &[&str]| {
        let control = ["control.controller=regulator", beats];
        flown(&preset("fruit-fly-blade", &[&control, limits].concat()))
    };
    let held = fly("time.beats=10", &["control.hold=trim"]);
    assert!(
        says(&held, "Feedback: commands stood at their limits at"),
        "{:?}",
        held.warnings
    );
    let departures = held.departures.expect("feedback");
    assert!(departures.attitude_deg.largest < 90.0);
    // Released 18 deg nose up it comes back to the trimmed attitude, from which departures count.
    let set = [
        "control.hold=trim",
        "flight.pitch_deg=67.5",
        "time.steps_per_beat=40",
    ];
    let back = fly("time.beats=40", &set).departures.expect("feedback");
    let [most, last] = [back.attitude_deg.largest, back.attitude_deg.last];
    assert!(most > 17.0 && last < 0.1, "{most} {last}");
    let limits = [
        "control.amplitude_limit=1e-6",
        "control.angle_limit_deg=1e-6",
        "control.hold=start", // strokes that lift 1.25 weights
        "time.steps_per_beat=40",
    ];
    let lost = fly("time.beats=30", &limits);
    let departures = lost.departures.as_ref().expect("feedback");
    assert!(departures.limited > 0.5);
    assert!(
        says(&lost, "under feedback: commands stood at their limits"),
        "{:?}",
        lost.warnings
    );
    assert_eq!(lost.verdict, Verdict::Amber);
}

/// Flights in finer steps go from red to green: the residual of a fourth-order method falls with them. A
/// hawkmoth's wings meet.
#[test]
fn behaves_the_verdict_follows_the_balances() {
    for (steps, verdict, reason) in [
        (6, Verdict::Red, "The energy balance does not close"),
        (24, Verdict::Amber, "The energy balance does not close"),
        (400, Verdict::Green, "its balances close"),
    ] {
        let name = ["bumblebee-blade", "hawkmoth-blade"][usize::from(steps == 6)];
        let steps = format!("time.steps_per_beat={steps}");
        let summary = flown(&preset(name, &[&steps, "time.beats=1"]));
        println!("{steps}: {:.1e}", summary.energy_residual_relative);
        assert_eq!(summary.verdict, verdict, "{}", summary.verdict_reason);
        assert!(summary.verdict_reason.starts_with(reason));
        let line = format!("{}: {}.", verdict.word(), summary.verdict_reason);
        assert_eq!(summary.to_text().lines().next(), Some(&line[..]));
        let json: serde_json::Value = serde_json::from_str(&summary.to_json()).unwrap();
        assert_eq!(json["verdict"], verdict.word());
        assert_eq!(json["verdict_reason"], summary.verdict_reason);
    }
}

/// Numbers that are none in one step of a flight are a fault, whatever comes after them.
#[test]
fn behaves_balances_with_numbers_that_are_none_are_red() {
    let case = preset("fruit-fly-blade", &["time.beats=1"]);
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        records.push(flight.step().unwrap().clone());
    }
    let summary = |records: &[_]| Summary::of(&case.setup, records, &Outcome::Finished);
    assert!(!says(&summary(&records), "balance does not close"));
    let spoilt: [fn(&mut Record); 3] = [
        |r| r.energy_residual = f64::NAN,
        |r| r.kinetic_energy = f64::NAN,
        |r| r.momentum_residual.y = f64::NAN,
    ];
    for spoil in spoilt {
        let mut records = records.clone();
        spoil(&mut records[20]);
        let summary = summary(&records);
        assert!(says(&summary, "balance does not close: residual NaN"));
        assert_eq!(summary.verdict, Verdict::Red);
    }
}

/// A flyer whose waist is free keeps its momentum to second order in the step where its wings are elastic.
#[test]
fn behaves_elastic_wings_beside_a_free_waist_raise_no_alarm() {
    let text = include_str!("data/elastic-free-waist.toml");
    let case = LoadedCase::from_text("waist.toml", text, std::path::Path::new(""), &[]).unwrap();
    let summary = flown(&case);
    let residual = summary.momentum_residual_relative;
    assert!(residual > 1e-6, "the test is void: {residual:e}");
    assert!(
        !says(&summary, "momentum balance"),
        "{:?}",
        summary.warnings
    );
}

/// A front that travels acts on the wakes it goes through: nothing says that the vortex impulse is what surfaces gave.
#[test]
fn behaves_a_gust_that_travels_has_no_impulse_budget() {
    let gust = |front: &str| {
        format!("air.gust=[{{ amplitude_m_s = [0, 0, 0.3], duration_s = 0.01{front} }}]")
    };
    let flown = |front: &str| {
        let case = preset(
            "fruit-fly-tethered",
            &["air.shed=[\"trailing\"]", "time.beats=2", &gust(front)],
        );
        flown(&case)
    };
    let (everywhere, front) = (flown(""), flown(", front_m_s = [2, 0, 0]"));
    // Measured 0.015.
    let budget = everywhere.impulse_budget.expect("a budget");
    assert!(budget.residual_relative < 0.05, "{budget:?}");
    assert!(front.impulse_budget.is_none());
    assert!(!front.to_text().contains("impulse residual"));
}

/// Feedback of a body that is held to its end has nothing to say.
#[test]
fn behaves_feedback_of_a_held_body_is_not_judged() {
    let fly = |held: &str| flown(&preset("fruit-fly-controlled", &[held, "time.beats=2"]));
    assert!(!says(&fly("flight.held_beats=2"), "commands stood"));
    assert!(says(&fly("flight.held_beats=1"), "commands stood"));
}

#[test]
fn behaves_elastic_wings_that_gain_energy_in_a_fall_are_red() {
    // Two wings of 1 kg on a body of half a kilogram, let go: after four beats a tenth of what they turn over
    // is added to it, a thousandth of what the fall has.
    let text = "format = 1
gravity_m_s2 = [0, 0, 1.0]
motion.frequency_hz = 1.0
time = { steps_per_beat = 125, beats = 4 }
flight = { mode = \"free\", held_beats = 1 }
air.model = \"none\"
output = { frames_every = 0, figures = false, page = false }
body = { mass_kg = 0.5, inertia_about_centre_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0] }
[wing.right]
hinge_m = [0, 0, 0]
planform.rectangle = { chord_m = 0.1, span_m = 1.0, axis_fraction = 0.5 }
mesh = { chordwise = 2, spanwise = 20 }
[wing.right.structure.beam]
axis_fraction = 0.5
mass_fraction = 0.5
elements = 12
flap_newton_m2 = [1.0, 1.0]
torsion_newton_m2 = [1.0, 1.0]
lag_newton_m2 = [1e4, 1e4]
mass_kg_per_m = [1.0, 1.0]
inertia_kg_m = [1e-3, 1e-3]
";
    let case = LoadedCase::from_text("fall", text, Path::new("."), &[]).unwrap();
    let summary = flown(&case);
    assert_eq!(summary.verdict, Verdict::Red, "{:?}", summary.warnings);
    assert!(says(&summary, "dynamics.formulation = \"euler\""));
}
