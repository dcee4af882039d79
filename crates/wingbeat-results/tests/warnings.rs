//! What summaries say of motions, wings and bodies that are not as they should be.

use crate::flights::{flown, preset, says};
use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_flight::{DoubtKind, Simulation};
use wingbeat_results::summary::Verdict;
use wingbeat_results::{Outcome, Summary};

/// Wings that pass through each other are named by every air, and so is a lift that no animal has.
#[test]
fn behaves_impossible_motions_and_lifts_are_named_without_a_lattice() {
    let summary = flown(&preset("hawkmoth-blade", &["time.beats=1"]));
    let crosses = "wings `left` and `right` pass through each other in 24 % of the beat";
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

/// How far the wake of a beat lies goes by the air where the flight starts, be that written as a stream or as a shear.
#[test]
fn invariant_what_cores_take_from_a_wake_is_said_of_a_stream_as_of_a_shear() {
    let said = |stream: &str, shear: &str| {
        let set = [
            "time.beats=0.125",
            "wing.right.mesh.chordwise=2",
            "wing.right.mesh.spanwise=4",
            "air.wake_core.lamb_oseen.radius_m=0.05",
            "flight.position_m=[0,0,-2]",
            stream,
            shear,
        ];
        let summary = flown(&preset("bird-cruise", &set));
        let of_cores = |w: &&String| w.contains("what is shed in a period");
        summary.warnings.iter().find(of_cores).cloned()
    };
    let one = said(
        "air.stream_m_s=[-12,0,0]",
        "air.shear_1_s=[[0,0,1e-300],[0,0,0],[0,0,0]]",
    );
    let other = said(
        "air.stream_m_s=[0,0,0]",
        "air.shear_1_s=[[0,0,6],[0,0,0],[0,0,0]]",
    );
    assert!(one.is_some());
    assert_eq!(one, other);
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

/// Whatever is doubted of a setup before it is flown stands in its summary, too; what makes no number worse leaves the
/// verdict as it is.
#[test]
fn behaves_summaries_say_what_is_doubted_of_the_setup() {
    let angle = |k: i32| 60.0 * (std::f64::consts::TAU * f64::from(k % 200) / 200.0).sin();
    let rows = (0..=200).filter(|k| !(51..=99).contains(k));
    let rows: Vec<String> =
        (rows.map(|k| format!("[{}, {}]", f64::from(k) / 200.0, angle(k)))).collect();
    let gap = format!(
        "wing.right.motion.phi={{table={{rows_deg=[{}]}}}}",
        rows.join(",")
    );
    let gust = "air.gust=[{ amplitude_m_s = [0, 0, 0.1], duration_s = 1, start_s = 100 }]";
    let plain = flown(&preset("fruit-fly-blade", &["time.beats=0.1"])).verdict;
    for (change, kind, is_limit) in [
        (&gap[..], DoubtKind::GapsInAngles, true),
        (gust, DoubtKind::LateGusts, false),
        ("motion.start=smooth", DoubtKind::LongStart, false),
        (
            "control={controller=\"regulator\", hold=\"start\", latency_beats=20}",
            DoubtKind::LateCommands,
            true,
        ),
        (
            "air.blade.rotation=\"sane_dickinson\"",
            DoubtKind::JumpingRotation,
            false,
        ),
    ] {
        let case = preset("fruit-fly-blade", &[change, "time.beats=0.1"]);
        let doubts = case.setup.doubts();
        assert!(doubts.iter().any(|d| d.kind == kind), "{doubts:?}");
        let summary = flown(&case);
        for doubt in doubts {
            assert!(
                says(&summary, &doubt.said),
                "{doubt:?}: {:?}",
                summary.warnings
            );
        }
        let least = if is_limit { Verdict::Amber } else { plain };
        assert_eq!(summary.verdict, least.max(plain), "{:?}", summary.warnings);
    }
}

/// Bodies without wings have no sections, strips or measured coefficients to speak of.
#[test]
fn behaves_notes_of_the_air_of_bodies_are_about_bodies() {
    let flown = |air: &str| {
        let text = format!(
            "format = 1\n[time]\nstep_s = 1e-3\nsteps = 10\n[flight]\nmode = \"tethered\"\nvelocity_m_s = [1, 0, 0]\n\
             [output]\nframes_every = 0\n[body.part.b]\nlength_m = 0.1\ndiameter_m = 0.02\nmass_kg = 0.01\n[air]\n{air}"
        );
        let base = Path::new("");
        flown(&LoadedCase::from_text("body", &text, base, &[]).unwrap())
    };
    let lattice = flown("model = \"vortex_lattice\"");
    assert!(says(&lattice, "bodies leave no wakes") && !says(&lattice, "sections"));
    let drag = flown(
        "model = \"blade_element\"\nblade.body_drag = { area_m2 = 3e-4, along = 0.4, across = 1 }",
    );
    assert!(says(&drag, "drag of the body alone") && !says(&drag, "coefficients"));
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
        reason.contains("pass through each other in 24 %"),
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

/// Wings whose roots lie on one line and feather while they flap pass through each other there by 2 % of
/// a chord: that is said, and that they may be joined; with the hinges just apart nothing is.
#[test]
fn behaves_wings_that_graze_are_amber_and_may_be_joined() {
    let fly = |hinge: f64| {
        let text = format!(
            r#"
            format = 1
            gravity_m_s2 = [0, 0, 0]
            time = {{ steps_per_beat = 40, beats = 0.25 }}
            flight = {{ mode = "tethered" }}
            air = {{ density_kg_m3 = 1.2, stream_m_s = [-5, 0, 0], shed = ["trailing"], body = false }}
            body = {{ mass_kg = 1, inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0] }}
            motion.frequency_hz = 10
            [wing.right]
            hinge_m = [0, {hinge}, 0]
            mass_kg = 0.005
            motion = {{ phi.fourier.sine_deg = [15], psi.constant_deg = 3 }}
            planform.rectangle = {{ chord_m = 0.06, span_m = 0.2, axis_fraction = 0.25 }}
            mesh = {{ chordwise = 3, spanwise = 6 }}
        "#
        );
        flown(&LoadedCase::from_text("pair", &text, Path::new(""), &[]).unwrap())
    };
    let grazes = fly(0.0);
    assert_eq!(grazes.verdict, Verdict::Amber, "{:?}", grazes.warnings);
    assert!(says(
        &grazes,
        "by up to 2.0 % of a mean chord: join them at their roots"
    ));
    assert!(!says(&grazes, "have no meaning"));
    let apart = fly(1e-3);
    assert!(!says(&apart, "graze"), "{:?}", apart.warnings);
}

/// Starting steps whose residual is above the tolerance of the corrector are named with both, and are no solution above
/// the loosest that a case may ask for.
#[test]
fn behaves_starting_steps_that_have_not_converged_are_named() {
    let case = preset("fruit-fly-blade", &["time.beats=0.05"]);
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        records.push(flight.step().unwrap().clone());
    }
    let mut summary = |residual: f64| {
        records[1].corrector_residual = residual;
        Summary::of(&case.setup, &records, &Outcome::Finished)
    };
    let words = "The starting steps have not converged";
    assert!(!says(&summary(1e-10), words));
    let doubted = summary(2e-7);
    assert!(says(&doubted, words) && says(&doubted, "by 2.0e-7 from one sweep"));
    assert!(says(&doubted, "corrector.tolerance is 1.0e-10"));
    assert_eq!(doubted.verdict, Verdict::Amber);
    assert_eq!(summary(2e-3).verdict, Verdict::Red);
}

/// What constant loads carry is no lift of the air: a tenth of the weight of 0.94 mg.
#[test]
fn behaves_what_loads_carry_is_said() {
    let hang = "load=[{ frame = \"inertial\", force_newton = [0, 0, -9.2e-7] }]";
    let said = |set: &[&str]| says(&flown(&preset("fruit-fly-blade", set)), "carry 0.10");
    assert!(said(&[hang, "time.beats=0.1"]));
    assert!(!says(
        &flown(&preset("fruit-fly-blade", &["time.beats=0.1"])),
        "of the weight; the lift"
    ));
}

/// Of the place a stabiliser holds the altitude alone: carried along by a wind that stays it is not lost, as a
/// regulator would be.
#[test]
fn exact_stabilised_flyer_is_where_it_is_to_be_at_its_altitude() {
    let case = preset(
        "fruit-fly-controlled",
        &[
            "air.model=blade_element",
            "control.hold=trim",
            "control.controller=stabiliser",
            "control.latency_beats=0",
            "motion.adjust={}",
            "flight={ pitch_deg = 47.5 }",
            "time={ steps_per_beat = 40, beats = 100 }",
            "wing.right.mesh={ chordwise = 5, spanwise = 10 }",
            "air.gust=[{ amplitude_m_s = [-0.3, 0, 0], table = [[0, 0], [0.05, 1], [9, 1]] }]",
            "output.page=false",
        ],
    );
    let summary = flown(&case);
    let departures = summary.departures.as_ref().unwrap();
    let place = departures.place_wing_lengths.unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let [from, mut to] = [flight.record().mass_centre; 2];
    while !flight.finished() {
        to = flight.step().unwrap().mass_centre;
    }
    let length = case.setup.animal.wing_length();
    let [away, down] = [(to - from).length(), (to - from).z.abs()].map(|x| x / length);
    println!("{away} wing lengths away, {down} of them down");
    assert!(away > 20.0, "{away}");
    assert!((place.last - down).abs() < 1e-9, "{place:?} {down}");
    assert!(
        !says(&summary, "lost under feedback"),
        "{:?}",
        summary.warnings
    );
}
