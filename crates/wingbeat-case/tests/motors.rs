//! Flyers whose wings motors drive through joints: their trim, and wings that hang at one point.

use crate::common;
use wingbeat_analysis::control::sides;
use wingbeat_analysis::{Trim, TrimProblem, TrimRequest, Unknown, tail_wings, trim};
use wingbeat_case::{LoadedCase, trimmed_case};
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

/// Two wings of 70 mm on motors with springs, feathering hinges that give way; the body is long enough that it does
/// not tumble within a beat.
const MOTOR: &str = include_str!("data/motor.toml");

fn hover(case: &LoadedCase, unknowns: Option<Vec<Unknown>>) -> Trim {
    let request = TrimRequest {
        unknowns,
        ..TrimRequest::default()
    };
    let problem = request.problem(&case.setup).unwrap();
    let found = trim(&case.setup, &problem).unwrap();
    assert!(found.solution.converged, "{:?}", found.solution);
    found
}

/// The voltage that hovers: by itself trim chooses it, the pitch of the body and its mass centre. What is written is back
/// where it was after a beat.
#[test]
fn exact_trimmed_voltage_flies_a_periodic_beat() {
    let case = common::load(MOTOR, &[]).unwrap();
    let found = hover(&case, None);
    use Unknown::{BodyPitch, DriveAmplitude, MassCentre};
    let values = [BodyPitch, DriveAmplitude, MassCentre].map(|u| found.solution.value(u).unwrap());
    println!("pitch, drive, mass centre {values:?}");
    assert!(values[1] != 0.0);
    // The strokes are alike fore and aft: the mass centre comes below the hinges.
    let shift = found.solution.mass_centre;
    assert!((shift - 2e-3).abs() < 1e-11, "{shift:e}"); // what a trim is found to
    let text = trimmed_case(&case, &found).unwrap();
    let written = common::load(&text, &[]).unwrap();
    let joint = &written.raw.joint["right"].element[0];
    let moment = joint.moment_newton_m.as_ref().unwrap().cosine[0];
    assert!((moment / (0.03 * (1.0 + values[1])) - 1.0).abs() < 1e-12);
    let [first, .., last] = &common::fly(written.setup)[..] else {
        panic!("a flight");
    };
    let moved = last.mass_centre.distance(first.mass_centre) / 70e-3;
    let apart = |from: usize, to: usize| {
        let pairs = last.coordinates[from..to]
            .iter()
            .zip(&first.coordinates[from..to]);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    println!("moved by {moved:.1e} R, turned by {:.1e} rad", apart(3, 6));
    assert!(moved < 1e-6 && apart(3, 6) < 1e-6);
    let joints = last.joints.iter().zip(&first.joints);
    assert!(joints.clone().all(|(a, b)| (a[0] - b[0]).abs() < 1e-6));
}

/// A pair of wings with constant angles beside wings on motors is a tail: stroke planes leave it as it is, and it has the
/// elevator. Where nothing drives the joints there is none.
#[test]
fn exact_a_tail_beside_wings_on_motors_is_held() {
    let tail = "wing.right_tail={ hinge_m = [-60e-3, 0, 0], mass_kg = 1e-5, motion.psi.constant_deg = 0, motion.phi.constant_deg = 0, \
                motion.stroke_plane_pitch_deg = 0, planform.rectangle = { chord_m = 20e-3, span_m = 30e-3, axis_fraction = 0.25 } }";
    let turned = [tail, "motion.adjust.stroke_plane_deg=5"];
    let planes = |set: &[&str]| {
        let setup = common::load(MOTOR, set).unwrap().setup;
        let wings = setup.animal.wings.iter();
        let planes: Vec<f64> = wings
            .map(|w| w.motion.stroke_plane_pitch.to_degrees())
            .collect();
        (planes, sides(&setup), tail_wings(&setup).ok())
    };
    // left, left_tail, right, right_tail
    let (found, steered, pair) = planes(&turned);
    for (found, expected) in found.iter().zip([95.0, 0.0, 95.0, 0.0]) {
        assert!((found - expected).abs() < 1e-12, "{found}");
    }
    assert_eq!(steered, [Some(-1.0), None, Some(1.0), None]);
    assert_eq!(pair, Some([1, 3]));
    let idle = "joint.right.element=[{ direction = 0, stiffness_newton_m_per_rad = 5e-3 }]";
    let (found, steered, _) = planes(&[&turned[..], &[idle]].concat());
    assert!((found[1] - 5.0).abs() < 1e-12 && steered.iter().all(Option::is_some));
}

/// The mass centre of a body that has a joint moves in the body, of one without the hinges move the other way: the same
/// flight.
#[test]
fn agrees_mass_centre_moves_in_the_body_as_hinges_do_the_other_way() {
    let unknowns = [
        Unknown::BodyPitch,
        Unknown::StrokeAmplitude,
        Unknown::MassCentre,
    ];
    let found = |set: &[&str]| {
        let case = common::preset("fruit-fly-blade", set);
        let found = hover(&case, Some(unknowns.to_vec()));
        let written = trimmed_case(&case, &found).unwrap();
        let written = common::load(&written, &[]).unwrap();
        let beat = common::fly(written.setup);
        let steps = found.beat.steps();
        let moved = beat[steps].mass_centre.distance(beat[0].mass_centre);
        assert!(moved < 1e-6 * found.beat.wing_length(), "{moved:e}");
        unknowns.map(|u| found.solution.value(u).unwrap())
    };
    let without = found(&[]);
    let grain = "segment.grain={ mass_kg = 1e-13, centre_m = [0, 0, 0], inertia_about_centre_kg_m2 = [1e-25, 1e-25, 1e-25, 0, 0, 0] }";
    let with = found(&[grain, "joint.grain={ child = \"grain\", at_m = [0, 0, 0] }"]);
    println!("{without:?} {with:?}");
    for (a, b) in without.iter().zip(&with) {
        // A ten millionth of the weight hangs elsewhere: 1.5e-6 of the mass centre, which hangs on small moments.
        assert!((a - b).abs() < 1e-5 * a.abs(), "{a} {b}");
    }
}

#[test]
fn refuses_a_drive_that_is_not_there() {
    let case = common::preset("fruit-fly-blade", &[]);
    let problem = TrimProblem {
        unknowns: vec![
            Unknown::BodyPitch,
            Unknown::DriveAmplitude,
            Unknown::StrokeOffset,
        ],
        ..TrimProblem::straight(DVec3::ZERO, 0.7)
    };
    let said = trim(&case.setup, &problem).map(|_| ()).unwrap_err();
    let said = said.to_string();
    assert!(
        said.contains("drive_amplitude") && said.contains("stroke_amplitude"),
        "{said}"
    );
}

/// Four wings, two of them at each point, all at the same angle where they start: in a lattice that is named, by the
/// wings, as a doubt and where the flight fails. Apart by an angle or by the hinges it begins.
#[test]
fn behaves_wings_that_start_in_each_other_are_named() {
    let (body, wing) = MOTOR.split_once("[wing.right]").unwrap();
    let of = |name: &str, sign: &str| {
        let wing = format!("[wing.right]{wing}").replace("0.03", &format!("{sign}0.03"));
        let names = [("wing.right", "wing."), ("joint.right", "joint.")];
        let named = names.iter().fold(wing, |text, (old, new)| {
            text.replace(old, &format!("{new}{name}"))
        });
        named.replace("\"right\"", &format!("\"{name}\"")) + "\n"
    };
    let text = [body, &of("upper-right", ""), &of("lower-right", "-")].concat();
    let lattice = [
        "air.model=vortex_lattice",
        "air.body=false",
        "air.shed=[\"trailing\", \"tip\", \"leading\"]", // roots of wings a fifth of a chord apart
        "air.leading_edge=suction",
        "time.beats=0.02",
        "wing.upper-right.mesh={chordwise=2,spanwise=4}",
        "wing.lower-right.mesh={chordwise=2,spanwise=4}",
    ];
    let load = |more: &[&str]| common::load(&text, &[&lattice, more].concat()).unwrap();
    let together = load(&[]);
    let said = together.setup.coincident_at_start();
    assert!(
        said.len() == 2 && said[1].contains("`lower-right` and `upper-right` start in each other"),
        "{said:?}"
    );
    assert!(said[1].contains("hinges are in one place"), "{said:?}");
    let error = Simulation::new(together.setup.clone())
        .map(|_| ())
        .unwrap_err();
    let refused = together.refused(&error).to_string();
    assert!(refused.contains("start in each other"), "{refused}");
    for key in [
        "joint.upper-right.start_deg=[20, 0]",
        "wing.upper-right.motion.phi.constant_deg=20",
        "wing.upper-right.hinge_m=[6e-3, 12e-3, -10e-3]",
    ] {
        let apart = load(&[key]);
        assert!(apart.setup.coincident_at_start().is_empty(), "{key}");
        Simulation::new(apart.setup).unwrap();
    }
    // Blade elements do not feel it.
    let blades = common::load(&text, &[]).unwrap();
    assert!(blades.setup.coincident_at_start().is_empty());
}
