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
/// In 20 steps a beat 8e-3, in 10 some per cent, in 4, in which lift is 11 % off, 0.3.
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
            r if r > 0.1 => Verdict::Red,
            r if r > 1e-2 => Verdict::Amber,
            _ => Verdict::Green,
        };
        assert_eq!(of_momentum, verdict, "{residual:e}");
        assert!(summary.verdict >= verdict);
    }
}

/// Wings that pass through each other are named by every air, and so is a lift that no animal has.
#[test]
fn behaves_impossible_motions_and_lifts_are_named_without_a_lattice() {
    let summary = flown(&preset("hawkmoth-blade", &["time.beats=1"]));
    let crosses = "wings `left` and `right` pass through each other in 21 % of the beat";
    assert!(says(&summary, crosses), "{:?}", summary.warnings);
    assert_eq!(summary.verdict, Verdict::Amber);
    let sound = flown(&preset("fruit-fly-blade", &["time.beats=1"]));
    assert!(!says(&sound, "impossible"), "{:?}", sound.warnings);
    let set = [
        "flight.mode=tethered",
        "time.beats=1",
        "motion.frequency_hz=800",
    ];
    let strong = flown(&preset("fruit-fly-blade", &set));
    assert!(says(
        &strong,
        "weights in beat 1 is more than any animal carries"
    ));
}

/// A stroke as a camera sees it, with noise of a degree, in fewer steps than samples; a fit of its harmonics is
/// good again.
#[test]
fn behaves_noise_in_angles_is_named_and_a_fit_takes_it_out() {
    let wave = |x: f64| 70.0 * (std::f64::consts::TAU * x).cos();
    let noise = |k: usize| 1.2 * (1.0 + 7.1 * k as f64 * k as f64).sin(); // no harmonic of the beat
    let rows = (0..200).map(|k| {
        format!(
            "[{}, {}]",
            k as f64 / 200.0,
            wave(k as f64 / 200.0) + noise(k)
        )
    });
    let rows = rows.chain([format!("[1.0, {}]", 70.0 + noise(0))]);
    let rows = rows.collect::<Vec<_>>().join(", ");
    let table = |more: &str| format!("wing.right.motion.phi={{table={{rows_deg=[{rows}]{more}}}}}");
    let held = "wing.right.motion.psi={fourier={sine_deg=[45.0]}}";
    let fly = |phi: &str| flown(&preset("fruit-fly-blade", &[phi, held, "time.beats=0.1"]));
    let noisy = fly(&table(""));
    let text = "the samples of motion.phi scatter by some";
    assert!(says(&noisy, text), "{:?}", noisy.warnings);
    assert!(says(
        &noisy,
        "100 steps per wingbeat do not even follow (400 at least)"
    ));
    assert!(says(&noisy, "`harmonics = 1` in this table"));
    assert!(noisy.verdict >= Verdict::Amber);
    assert!(
        noisy.warnings[0].starts_with("Angles that scatter"),
        "{:?}",
        noisy.warnings
    );
    assert!(!says(&noisy, "take smaller steps"), "{:?}", noisy.warnings);
    let fitted = fly(&table(", harmonics=1"));
    assert!(!says(&fitted, "scatter"), "{:?}", fitted.warnings);
}

/// The verdict and its numbers are of all steps, however thin the history is; read back they are what was written.
/// Bodies without wings have no sections, strips or measured coefficients to speak of.
#[test]
fn behaves_notes_of_the_air_of_bodies_are_about_bodies() {
    let flown = |air: &str| {
        let text = format!(
            "format = 1\n[time]\nstep_s = 1e-3\nsteps = 10\n[flight]\nmode = \"tethered\"\nvelocity_m_s = [1, 0, 0]\n\
             [output]\nframes_every = 0\n[body.part.b]\nlength_m = 0.1\ndiameter_m = 0.02\nmass_kg = 0.01\n[air]\n{air}"
        );
        let base = std::path::Path::new("");
        flown(&LoadedCase::from_text("body", &text, base, &[]).unwrap())
    };
    let lattice = flown("model = \"vortex_lattice\"");
    assert!(says(&lattice, "bodies leave no wakes") && !says(&lattice, "sections"));
    let drag = flown(
        "model = \"blade_element\"\nblade.body_drag = { area_m2 = 3e-4, along = 0.4, across = 1 }",
    );
    assert!(says(&drag, "drag of the body alone") && !says(&drag, "coefficients"));
}

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
    let whole = flown(&case);
    let path = std::env::temp_dir().join(format!("wingbeat-summary-{}-on", std::process::id()));
    let mut writer = RunWriter::new(ResultDir::overwrite(&path).unwrap(), &case, 1).unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    writer.write(flight.record(), || flight.snapshot()).unwrap();
    while flight.state().step < 16 {
        flight.step().unwrap();
        writer.write(flight.record(), || flight.snapshot()).unwrap();
    }
    writer.save(flight.state()).unwrap();
    drop(writer);
    let saved = saver::read(&path).unwrap();
    let (header, state) = saved.checkpoint.unwrap();
    let mut flight = Simulation::resume(case.setup.clone(), state).unwrap();
    let dir = ResultDir::open(&path).unwrap();
    let mut writer = RunWriter::resume(dir, &case, &header, saved.manifest, 1).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
        writer.write(flight.record(), || flight.snapshot()).unwrap();
    }
    let resumed = writer.finish(Outcome::Finished, |_, _, _| Ok(())).unwrap();
    std::fs::remove_dir_all(path).unwrap();
    assert_eq!(resumed, whole);
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
    let limits = [
        "control.amplitude_limit=1e-6",
        "control.angle_limit_deg=1e-6",
        "control.hold=start", // strokes that lift 1.25 weights
    ];
    let lost = fly("time.beats=60", &limits);
    let departures = lost.departures.as_ref().expect("feedback");
    assert!(departures.limited > 0.5);
    assert!(
        says(&lost, "under feedback: commands stood at their limits"),
        "{:?}",
        lost.warnings
    );
    assert_eq!(lost.verdict, Verdict::Amber);
}

/// Leading edges that shed one sign more than the other while roots hold: with strokes unlike back and forth,
/// not in hover.
#[test]
fn behaves_summaries_tell_of_leading_edges_that_shed_one_sign() {
    let shed = r#"air.shed=["trailing", "tip", "leading"]"#;
    for (name, told) in [("dragonfly", true), ("fruit-fly-tethered", false)] {
        let summary = flown(&preset(name, &["time.beats=0.05", shed]));
        let says = says(&summary, "is left over of one sign in every beat");
        assert_eq!(says, told, "{name}: {:?}", summary.warnings);
        assert!(!told || summary.verdict >= Verdict::Amber);
    }
}

/// Wings whose roots are inside the trunk, with and without it in the air. What has left edges that shed by the
/// step before alternates; where all motion is prescribed nothing is wrong with that.
#[test]
fn behaves_alternating_forces_of_prescribed_motion_are_no_fault() {
    let text = r#"
        format = 1
        gravity_m_s2 = [0, 0, 0]
        time = { step_s = 1.6666667e-3, steps = 90 }
        flight = { mode = "tethered", pitch_deg = 20 }
        air = { density_kg_m3 = 1.0, stream_m_s = [-10, 0, 0], body = false, leading_edge = "suction" }
        body = { mass_kg = 0.1, inertia_about_centre_kg_m2 = [1e-4, 1e-4, 1e-4, 0, 0, 0] }
        [wing.right]
        hinge_m = [0, 0, 0]
        mass_kg = 0.01
        joined = true
        planform.rectangle = { chord_m = 0.1, span_m = 0.05, axis_fraction = 0.25 }
        mesh = { chordwise = 6, spanwise = 5 }
    "#;
    let case = LoadedCase::from_text("plate", text, Path::new(""), &[]).unwrap();
    let summary = flown(&case);
    assert!(
        summary.alternating_steps > 6,
        "{}",
        summary.alternating_steps
    );
    assert!(says(&summary, "Forces alternate") && says(&summary, "read means"));
    assert_eq!(summary.verdict, Verdict::Amber, "{:?}", summary.warnings); // for the one sign of what is shed
}

#[test]
fn behaves_summaries_tell_of_wings_inside_parts_of_the_body() {
    for (body, told) in [("true", true), ("false", false)] {
        let body = format!("air.body={body}");
        let summary = flown(&preset("bird-cruise", &["time.beats=0.05", &body]));
        let says = says(
            &summary,
            "are inside the body part `trunk` in 100 % of the beat",
        );
        assert_eq!(says, told, "{:?}", summary.warnings);
        // Two steps are red for their balances, too.
        let is_reason = summary.verdict_reason.contains("cannot both be surfaces");
        assert!(is_reason == told && summary.verdict == Verdict::Red);
    }
}

/// Wings whose roots lie on a part of the body, with and without it in the air.
#[test]
fn behaves_summaries_tell_of_wings_on_bodies() {
    for (body, told) in [("true", true), ("false", false)] {
        let body = format!("air.body={body}");
        let on_the_side = "wing.right.hinge_m=[0, 0.04, 0]";
        let set = [
            "time.beats=0.05",
            "wing.right.joined=false",
            on_the_side,
            &body,
        ];
        let summary = flown(&preset("bird-cruise", &set));
        let told_of = "panels of the body part `trunk` are 0.6 chords long";
        assert_eq!(says(&summary, told_of), told, "{:?}", summary.warnings);
    }
}

/// Wings that pass through each other: their forces mean nothing in a lattice.
#[test]
fn behaves_wings_that_cross_make_a_lattice_red() {
    let set = [
        "time.beats=0.05",
        "air.model=vortex_lattice",
        "air.body=false",
    ];
    let summary = flown(&preset("hawkmoth-blade", &set));
    assert_eq!(summary.verdict, Verdict::Red);
    let reason = &summary.verdict_reason;
    assert!(
        reason.contains("pass through each other in 21 %"),
        "{reason}"
    );
    assert!(says(&summary, "have no meaning, nor have the means"));
}

/// Feathering against the stroke lifts, with the other sign it pushes down: 1.1 and -0.8 weights.
#[test]
fn behaves_wings_that_push_the_body_down_are_named() {
    for (sine, told) in [(50, false), (-50, true)] {
        let law = format!(
            "wing.right.motion={{phi={{fourier={{cosine_deg=[70]}}}},psi={{fourier={{sine_deg=[{sine}]}}}}}}"
        );
        let summary = flown(&preset(
            "fruit-fly-blade",
            &["time.beats=1", "motion.data=", &law],
        ));
        let lift = summary.beats[0].mean.lift_over_weight.unwrap();
        assert_eq!(lift < 0.0, told, "{lift}");
        assert_eq!(says(&summary, "push the body down"), told);
        assert!(!told || summary.verdict >= Verdict::Amber);
    }
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
/// A flyer whose waist is free keeps its momentum to second order in the step where its wings are elastic.
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
