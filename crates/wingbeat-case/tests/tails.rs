//! Wings that stand still beside wings that beat: tails.

use std::path::Path;

use wingbeat_analysis::control::{adjustments, sides};
use wingbeat_analysis::{Beat, Level, TrimProblem, Unknown, control_derivatives, tail_wings, trim};
use wingbeat_case::{LoadedCase, trimmed_case};
use wingbeat_math::{DVec3, r2};
use wingbeat_model::AngleLaw;

/// A bird-sized flapper with a V-tail.
const BIRD: &str = include_str!("data/bird.toml");

fn bird(set: &[&str]) -> LoadedCase {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    LoadedCase::from_text("bird", BIRD, Path::new(""), &set).unwrap_or_else(|e| panic!("{e}"))
}

/// Angles phi, theta, psi of a wing at the start \[rad\].
fn angles(case: &LoadedCase, wing: &str) -> [f64; 3] {
    let wing = case
        .setup
        .animal
        .wings
        .iter()
        .find(|w| w.name == wing)
        .unwrap();
    wing.motion.angles(0.0).map(|angle| angle[0])
}

#[test]
fn exact_adjustments_leave_wings_that_stand_still_beside_those_that_beat() {
    let set = [
        "motion.adjust={ stroke_offset_deg = 7, feathering_offset_deg = 2, stroke_plane_deg = 3 }",
        "motion.difference={ stroke_offset_deg = 4, deviation_offset_deg = 1 }",
    ];
    let (plain, adjusted) = (bird(&[]), bird(&set));
    for wing in ["right_tail", "left_tail"] {
        let [a, b] = [&plain, &adjusted].map(|c| {
            c.setup
                .animal
                .wings
                .iter()
                .find(|w| w.name == wing)
                .unwrap()
                .motion
                .clone()
        });
        assert_eq!(a, b, "{wing}");
    }
    assert_ne!(angles(&plain, "right"), angles(&adjusted, "right"));
    let steered: Vec<bool> = sides(&plain.setup).iter().map(Option::is_some).collect();
    let is_tail = |name: &str| name.ends_with("tail");
    for (wing, steered) in plain.setup.animal.wings.iter().zip(&steered) {
        assert_eq!(*steered, !is_tail(&wing.name), "{}", wing.name);
    }
    let commands = adjustments(&[0.1, 0.1, 0.1, 0.1], &sides(&plain.setup));
    for (wing, command) in plain.setup.animal.wings.iter().zip(commands) {
        let is_none = command.numbers().iter().all(|n| n.1 == 0.0);
        assert_eq!(is_none, is_tail(&wing.name));
    }
    // Where all wings stand still, they are set as before.
    let twist = "deformation.twist = [{ linear_deg = [0, 12], fourier.cosine = [-1] }]\n";
    let still = BIRD
        .replace(twist, "")
        .replace("phi.fourier.sine_deg = [25]", "phi.constant_deg = 0");
    let only = [set[0].to_owned()];
    let glider = LoadedCase::from_text("bird", &still, Path::new(""), &only).unwrap();
    let tail = angles(&glider, "right_tail");
    assert!((tail[0] - (-3f64).to_radians()).abs() < 1e-15, "{tail:?}");
}

#[test]
fn balances_a_bird_is_trimmed_by_its_wings_with_the_tail_that_it_has() {
    let case = bird(&[]);
    let problem = TrimProblem::straight(DVec3::new(8.0, 0.0, 0.0), 0.1);
    let found = trim(&case.setup, &problem).unwrap_or_else(|e| panic!("{e}"));
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    for (a, b) in case
        .setup
        .animal
        .wings
        .iter()
        .zip(&found.setup.animal.wings)
    {
        assert_eq!(a.motion == b.motion, a.name.ends_with("tail"), "{}", a.name);
    }
    // The written case has these wings.
    let text = trimmed_case(&case, &found).unwrap();
    let written = LoadedCase::from_text("bird", &text, Path::new(""), &[]).unwrap();
    for (a, b) in written
        .setup
        .animal
        .wings
        .iter()
        .zip(&found.setup.animal.wings)
    {
        let [x, y] = [a, b].map(|w| w.motion.angles(0.03).map(|angle| angle[0]));
        let apart = x
            .iter()
            .zip(y)
            .map(|(x, y)| (x - y).abs())
            .fold(0.0, f64::max);
        assert!(apart < 1e-12, "{}: {apart:e}", a.name); // degrees and back
        let is_constant = matches!(a.motion.angles.phi, AngleLaw::Constant(_));
        assert_eq!(is_constant, a.name.ends_with("tail"));
    }
}

/// The tail's incidence as an unknown: its moment balances that of the wings, and the case that is written has it on
/// either side, wherever the angle stands.
#[test]
fn balances_a_bird_is_trimmed_by_its_elevator() {
    for set in [
        &[][..],
        &["wing.left_tail.motion={ phi.constant_deg = 10, psi.constant_deg = -3 }"],
    ] {
        let case = bird(set);
        let mut problem = TrimProblem::straight(DVec3::new(8.0, 0.0, 0.0), 0.1);
        problem.unknowns[2] = Unknown::TailIncidence;
        let found = trim(&case.setup, &problem).unwrap_or_else(|e| panic!("{e}"));
        assert!(found.solution.converged, "{:?}", found.solution.residual);
        assert!(found.solution.residual[2].abs() < 1e-9); // the mean pitching moment
        let psi = found.solution.value(Unknown::TailIncidence).unwrap();
        assert!(psi.abs() > 1e-3, "{psi}");
        let text = trimmed_case(&case, &found).unwrap();
        let written = LoadedCase::from_text("bird", &text, Path::new(""), &[]).unwrap();
        for tail in ["right_tail", "left_tail"] {
            let now = angles(&written, tail)[2];
            assert!((now - (-3f64).to_radians() - psi).abs() < 1e-12, "{now}");
        }
        let problem = TrimProblem {
            unknowns: vec![
                Unknown::BodyPitch,
                Unknown::StrokeAmplitude,
                Unknown::TailIncidence,
            ],
            ..TrimProblem::straight(DVec3::new(8.0, 0.0, 0.0), found.solution.body_pitch)
        };
        let again = trim(&written.setup, &problem).unwrap();
        let left = again.solution.value(Unknown::TailIncidence).unwrap();
        assert!(left.abs() < 1e-7, "{left}");
    }
}

/// A tail that trims and commands leave is steered in derivatives: by as much as the mean loads of two cases differ that
/// have it at other angles. "all" is of the wings that are steered together.
#[test]
fn agrees_derivatives_of_a_tail_with_the_difference_of_two_cases() {
    const STEP: f64 = 0.01;
    let (attitude, velocity) = (r2(0.1), DVec3::new(8.0, 0.0, 0.3));
    let level = Level::new(attitude, DVec3::new(0.0, 0.0, 9.81));
    let load = |by: f64| {
        let own = format!(
            "wing.left_tail.motion={{ phi.constant_deg = 10, psi.constant_deg = {} }}",
            by - 3.0
        );
        let beat = Beat::new(&bird(&[&own]).setup, 60).unwrap();
        beat.mean_load(&level, velocity, DVec3::ZERO).unwrap()
    };
    let [plus, minus] = [STEP, -STEP].map(load);
    let list = control_derivatives(&bird(&[]).setup, attitude, velocity, 60).unwrap();
    let of = |control: &str, wing: &str| {
        let row = list.iter().find(|d| d.control == control && d.wing == wing);
        row.unwrap().derivative
    };
    let found = of("feathering_offset", "left_tail");
    let per = 2.0 * STEP.to_radians();
    let force = (plus.force - minus.force) / per;
    let moment = (plus.moment - minus.moment) / per;
    let apart = [
        found.force.distance(force) / force.length(),
        found.moment.distance(moment) / moment.length(),
    ];
    // 1.4e-8: differences over unequal steps.
    assert!(
        force.z < -1.0 && apart.iter().all(|x| *x < 1e-7),
        "{force} {apart:?}"
    );
    // A stroke that does not vary has no amplitude.
    assert_eq!(of("stroke_amplitude", "left_tail").force, DVec3::ZERO);
    let wings = of("feathering_offset", "left").force + of("feathering_offset", "right").force;
    let all = of("feathering_offset", "all").force;
    assert!(wings.distance(all) < 1e-8 * all.length(), "{wings} {all}");
}

#[test]
fn refuses_the_elevator_of_a_flyer_without_a_tail_or_with_two() {
    let refused = |text: &str| {
        let case = LoadedCase::from_text("bird", text, Path::new(""), &[]);
        let case = case.unwrap_or_else(|e| panic!("{e}"));
        let mut problem = TrimProblem::straight(DVec3::new(8.0, 0.0, 0.0), 0.1);
        problem.unknowns[2] = Unknown::TailIncidence;
        trim(&case.setup, &problem).unwrap_err().to_string()
    };
    let flaps = "motion.psi.constant_deg = -3\nmotion.phi.constant_deg = -10";
    let without = BIRD.replace(flaps, "motion.phi.fourier.sine_deg = [5]");
    let said = refused(&without);
    assert!(said.contains("asks for a tail"), "{said}");
    let second = BIRD.find("[wing.right_tail]").unwrap();
    let end = BIRD.find("[wing.left]").unwrap();
    let nose = BIRD[second..end]
        .replace("right_tail", "right_nose")
        .replace("-0.35", "0.3");
    let said = refused(&format!("{BIRD}{nose}"));
    assert!(said.contains("`right_nose`, `right_tail`"), "{said}");
}

/// A tail is what stands still, however its shape and its angles are written; one that beats is none.
#[test]
fn exact_tails_are_wings_that_do_not_vary_however_they_are_written() {
    let adjust = "motion.adjust={ stroke_offset_deg = 7, feathering_offset_deg = 2 }";
    let shape = "wing.right_tail.deformation=";
    for (set, is_tail) in [
        (format!("{shape}{{ twist = [{{ linear_deg = [0, 2] }}] }}"), true),
        (
            format!("{shape}{{ twist = [{{ linear_deg = [0, 2], fourier = {{ mean = 1, sine = [0] }} }}] }}"),
            true,
        ),
        (
            format!("{shape}{{ twist = [{{ linear_deg = [0, 2], fourier.sine = [1] }}] }}"),
            false,
        ),
        (
            format!("{shape}{{ camber = [{{ linear = [0.02, 0.01] }}], bending = [{{ linear_m = [0, 1e-3], fourier.cosine = [0.1] }}] }}"),
            false,
        ),
        ("wing.right_tail.motion.psi={ fourier.mean_deg = -3 }".to_owned(), true),
        (
            "wing.right_tail.motion.psi={ smooth_square = { amplitude_deg = 0, shape = 2 } }".to_owned(),
            true,
        ),
        (
            "wing.right_tail.motion.psi={ oval = { amplitude_deg = 0, count = 2 } }".to_owned(),
            true,
        ),
        (
            "wing.right_tail.motion.psi={ table.rows_deg = [[0, -3], [0.3, -3], [0.6, -3], [1, -3]] }".to_owned(),
            true,
        ),
        (
            "wing.right_tail.motion.psi={ table.rows_deg = [[0, -3], [0.3, -3], [0.6, -4], [1, -3]] }".to_owned(),
            false,
        ),
    ] {
        let [plain, adjusted] = [bird(&[&set]), bird(&[&set, adjust])];
        let wings = plain.setup.animal.wings.iter().zip(&adjusted.setup.animal.wings);
        let kept: Vec<bool> = wings.map(|(a, b)| a.motion == b.motion).collect();
        // In the order of names: left, left_tail, right, right_tail.
        assert_eq!(kept, [false, is_tail, false, is_tail], "{set}");
        let steered: Vec<bool> = sides(&plain.setup).iter().map(Option::is_some).collect();
        assert_eq!(steered, [true, !is_tail, true, !is_tail], "{set}");
    }
}

/// A pair whose names tell none is one by its place: the same elevator, written on either side, also beside a fin on the
/// same hinge.
#[test]
fn invariant_a_tail_has_its_elevator_whatever_its_wings_are_called() {
    let (before, tail) = BIRD.split_once("[wing.right_tail]").unwrap();
    let (tail, after) = tail.split_once("[wing.left]").unwrap();
    let right = |name: &str| format!("[wing.{name}]\nside = \"right\"{tail}");
    let left = right("tail-b")
        .replace("\"right\"", "\"left\"")
        .replace("= -10", "= 10");
    let after = after.replace("[wing.left_tail]", "");
    let fin = right("fin")
        .replace("= -10", "= -90")
        .replace("0.15", "0.1");
    let glides = |text: &str| {
        let twist = "deformation.twist = [{ linear_deg = [0, 12], fourier.cosine = [-1] }]";
        let still = text.replace("phi.fourier.sine_deg = [25]", "phi.constant_deg = -5");
        still.replace(twist, "")
    };
    let named = |text: &str| LoadedCase::from_text("bird", text, Path::new(""), &[]).unwrap();
    let incidence = |text: &str, last: [&str; 2]| {
        let case = named(text);
        let mut problem = TrimProblem::straight(DVec3::new(8.0, 0.0, 0.0), 0.1);
        problem.unknowns[2] = Unknown::TailIncidence;
        let found = trim(&case.setup, &problem).unwrap_or_else(|e| panic!("{e}"));
        assert!(found.solution.converged, "{:?}", found.solution.residual);
        let psi = found.solution.value(Unknown::TailIncidence).unwrap();
        let written = named(&trimmed_case(&case, &found).unwrap());
        for wing in last {
            let now = angles(&written, wing)[2];
            assert!(
                (now - (-3f64).to_radians() - psi).abs() < 1e-12,
                "{wing}: {now}"
            ); // degrees and back
        }
        psi
    };
    let wanted = incidence(BIRD, ["left_tail", "right_tail"]);
    let (other, both) = (
        format!("{before}{}{left}[wing.left]{after}", right("tail-a")),
        ["tail-a", "tail-b"],
    );
    let found = incidence(&other, both);
    assert!((found - wanted).abs() < 1e-8, "{found} {wanted}"); // residuals of 1e-9 of either
    let tails = |text: &str| {
        let case = named(text);
        let wings = &case.setup.animal.wings;
        let tail = tail_wings(&case.setup).unwrap_or_else(|e| panic!("{e}"));
        tail.map(|w| wings[w].name.clone())
    };
    for text in [&other, &format!("{other}{fin}")] {
        assert_eq!(tails(text), ["tail-b", "tail-a"]);
        assert_eq!(tails(&glides(text)), ["tail-b", "tail-a"]);
    }
}
