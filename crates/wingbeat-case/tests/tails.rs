//! Wings that stand still beside wings that beat: tails.

use std::path::Path;

use wingbeat_analysis::control::{adjustments, sides};
use wingbeat_analysis::{TrimProblem, trim};
use wingbeat_case::{LoadedCase, trimmed_case};
use wingbeat_math::DVec3;
use wingbeat_model::AngleLaw;

/// A bird-sized flapper with a V-tail.
const BIRD: &str = r#"
format = 1
name = "bird"
time = { steps_per_beat = 60, beats = 4 }
motion = { frequency_hz = 5, start = "impulsive" }
flight = { velocity_m_s = [8, 0, 0], pitch_deg = 5 }
air.model = "blade_element"
air.blade.centre_of_pressure.fixed = 0.25
air.blade.own = { lift = 2.0, drag_0 = 0.03, drag_90 = 2.0 }
output.frames_every = 0
body = { mass_kg = 0.3, centre_m = [-0.01, 0, 0], inertia_about_centre_kg_m2 = [1e-3, 3e-3, 3.5e-3, 0, 0, 0] }
[wing.right]
hinge_m = [0.03, 0.02, 0]
mass_kg = 0.02
planform.outline = { leading_m = [[0, 0.03], [0.5, 0.03]], trailing_m = [[0, -0.15], [0.5, -0.06]] }
mesh = { chordwise = 2, spanwise = 8 }
motion.psi.constant_deg = 4
motion.phi.fourier.sine_deg = [25]
deformation.twist = [{ linear_deg = [0, 12], fourier.cosine = [-1] }]
[wing.right_tail]
hinge_m = [-0.35, 0, 0]
mass_kg = 0.005
planform.outline = { leading_m = [[0, 0], [0.15, 0]], trailing_m = [[0, -0.1], [0.15, -0.1]] }
mesh = { chordwise = 1, spanwise = 4 }
motion.psi.constant_deg = -3
motion.phi.constant_deg = -10
[wing.left]
[wing.left_tail]
"#;

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
