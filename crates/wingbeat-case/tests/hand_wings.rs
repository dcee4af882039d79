//! What is doubted of a wing that hangs on another one: its motion is that of both.

use crate::common;
use wingbeat_analysis::{Beat, Level, control_derivatives, doubtful_reynolds_numbers, estimate};
use wingbeat_flight::FlightSetup;
use wingbeat_math::{DVec3, r2};

/// A hand wing on an arm wing, each of 3.3 chords, that flap together.
const HAND: &str = r#"
format = 1
[time]
steps_per_beat = 40
beats = 2
[motion]
frequency_hz = 20
stroke_plane_pitch_deg = 30
[flight]
mode = "tethered"
velocity_m_s = [3, 0, 0]
[air]
model = "blade_element"
density_kg_m3 = 1.225
[body]
mass_kg = 0.01
inertia_about_centre_kg_m2 = [1e-5, 1e-5, 1e-5, 0, 0, 0]
[wing.right]
hinge_m = [0, 0.01, 0]
mass_kg = 0.0005
motion.phi.fourier = { cosine_deg = [40] }
motion.psi.fourier = { mean_deg = 10, sine_deg = [20] }
planform.rectangle = { chord_m = 0.03, span_m = 0.1, axis_fraction = 0.25 }
mesh = { chordwise = 3, spanwise = 10 }
[wing.hand-right]
mass_kg = 0.0005
planform.rectangle = { chord_m = 0.03, span_m = 0.1, axis_fraction = 0.25 }
mesh = { chordwise = 3, spanwise = 10 }
[joint.wrist-right]
parent = "right"
child = "hand-right"
kind = "weld"
at_m = [0, 0.1, 0]
"#;

const FREE: [&str; 2] = [
    "joint.wrist-right.kind=\"revolute\"",
    "joint.wrist-right.axis=[1,0,0]",
];

fn setup(keys: &[&str]) -> FlightSetup {
    common::load(HAND, keys).unwrap().setup
}

/// A welded hand is where an arm twice as long would be, and its velocity is that of its places a microsecond
/// before and after.
#[test]
fn exact_motion_of_a_hand_is_that_of_the_arm_extended() {
    let setup = setup(&[]);
    let hand = (setup
        .animal
        .wings
        .iter()
        .position(|w| w.name == "hand-right"))
    .unwrap();
    let arm = (setup.animal.wings.iter().position(|w| w.name == "right")).unwrap();
    let at = |w: usize, t: f64| setup.prescribed_in_body(w, t).unwrap();
    let x = DVec3::new(0.01, 0.08, 0.0);
    let place = |w: usize, x: DVec3, t: f64| at(w, t).p + at(w, t).r * x;
    let (t, dt) = (5e-3, 1e-6);
    let apart = place(hand, x, t).distance(place(arm, x + DVec3::new(0.0, 0.1, 0.0), t));
    let difference = (place(hand, x, t + dt) - place(hand, x, t - dt)) / (2.0 * dt);
    let moving = at(hand, t);
    let velocity = moving.v + moving.r * moving.w.cross(x);
    let error = velocity.distance(difference) / velocity.length();
    println!("{apart:e} {error:e}");
    // Measured: roundings, and the third derivative times a sixth of the squared interval.
    assert!(apart < 5e-17 && error < 5e-8, "{apart:e} {error:e}");
}

/// Slowly towed, the hand has the Reynolds number of its flapping: of the tip at twice the arm's length. On a
/// free joint it is not known.
#[test]
fn agrees_reynolds_number_of_a_hand_is_that_of_its_tip() {
    let slow = "flight.velocity_m_s=[0.03,0,0]";
    let towed = setup(&[slow]);
    let said = doubtful_reynolds_numbers(&towed);
    assert!(said.is_empty(), "{said:?}");
    for w in estimate(&towed).wings {
        // 2 Phi R f of the arm, 5.58 m/s, and twice that; feathering moves the corners of the tip besides.
        let flapping = if w.report.name.starts_with("hand") {
            11.17
        } else {
            5.58
        };
        println!("{} {}", w.report.name, w.tip_speed);
        assert!(
            (w.tip_speed / flapping - 1.0).abs() < 0.01,
            "{}",
            w.tip_speed
        );
    }
    let free = setup(&[slow, FREE[0], FREE[1]]);
    let said = doubtful_reynolds_numbers(&free);
    assert!(said.is_empty(), "{said:?}");
    let hands = estimate(&free)
        .wings
        .into_iter()
        .filter(|w| w.report.name.starts_with("hand"));
    assert!(hands.map(|w| w.reynolds).all(|re| re.is_none()));
}

/// An arm at 2 deg with a hand at 35 deg to it in a stream is beyond stall, as a wing at 37 deg is; with the
/// hand at 2 deg to it, or where the joint leaves it free, nothing is said.
#[test]
fn behaves_a_hand_beyond_stall_is_named() {
    let said = |turn: f64, more: &[&str]| {
        let hand = format!("wing.hand-right.motion.psi.constant_deg={turn}");
        let held = [
            "air.model=\"vortex_lattice\"",
            "air.body=false",
            "air.shed=[\"trailing\"]",
            "motion.stroke_plane_pitch_deg=0",
            "wing.right.motion.phi=",
            "wing.right.motion.psi=",
            "wing.right.motion.psi.constant_deg=2",
            "joint.wrist-right.at_m=[0,0.105,0]",
            &hand,
        ];
        setup(&[&held, more].concat()).attached_beyond_stall()
    };
    let beyond = said(35.0, &[]).unwrap();
    assert!(beyond.contains("(`hand-left`, `hand-right`)"), "{beyond}");
    assert_eq!(said(2.0, &[]), None);
    assert_eq!(said(35.0, &FREE), None);
}

/// A hand in its arm, by place or folded back, is named; beside it, or on a free joint, it is not.
#[test]
fn behaves_a_hand_that_lies_in_its_arm_is_named() {
    let named = |keys: &[&str]| setup(keys).coincident_wings();
    let within = "joint.wrist-right.at_m=[0,0.001,0]";
    let said = named(&[within]);
    assert!(
        said.len() == 2
            && said
                .iter()
                .all(|s| s.contains("in 100 % of the beat") && s.contains("at_m")),
        "{said:?}"
    );
    assert_eq!(
        named(&["wing.hand-right.motion.phi.constant_deg=180"]).len(),
        2
    );
    assert!(named(&[]).is_empty());
    assert!(named(&["joint.wrist-right.at_m=[0.03,0.001,0]"]).is_empty()); // edge on edge
    assert!(named(&[within, FREE[0], FREE[1]]).is_empty());
}

/// What feathering of both hands does to the mean loads, by derivatives and by two cases.
#[test]
fn agrees_derivatives_of_hands_with_the_difference_of_two_cases() {
    const STEP: f64 = 0.01;
    let (attitude, velocity) = (r2(0.2), DVec3::new(3.0, 0.0, 0.0));
    let level = Level::new(attitude, DVec3::new(0.0, 0.0, 9.81));
    let load = |by: f64| {
        let own = format!("wing.hand-right.motion.psi.constant_deg={by}");
        let beat = Beat::new(&setup(&["flight.mode=\"free\"", &own]), 40).unwrap();
        beat.mean_load(&level, velocity, DVec3::ZERO).unwrap().force
    };
    let force = (load(STEP) - load(-STEP)) / (2.0 * STEP.to_radians());
    let free = setup(&["flight.mode=\"free\""]);
    let list = control_derivatives(&free, attitude, velocity, 40).unwrap();
    let hands = list
        .iter()
        .filter(|d| d.control == "feathering_offset" && d.wing.starts_with("hand-"));
    let found: DVec3 = hands.map(|d| d.derivative.force).sum();
    let apart = found.distance(force) / force.length();
    // 1.4e-8: differences over unequal steps.
    assert!(force.length() > 1e-3 && apart < 1e-7, "{force} {apart:e}");
}
