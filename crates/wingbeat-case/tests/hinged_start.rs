//! The first instant of wings on passive hinges: what they do to each other's added mass.

use wingbeat_flight::Record;

use crate::common::{self, fly};

/// Wings that let go of their hinges from 30 deg in still air, nothing shed: the second third of a chord above the first.
const STACKED: &str = r#"
format = 1
time = { steps_per_beat = 1280, steps = 3 }
motion = { frequency_hz = 100, start = "impulsive" }
flight.mode = "tethered"
[body]
mass_kg = 8e-5
inertia_about_centre_kg_m2 = [1.5e-9, 1.5e-9, 5e-10, 0, 0, 0]
[air]
model = "vortex_lattice"
body = false
shed = []
[wing.right]
hinge_m = [0, 0.003, 0]
mass_kg = 5e-7
planform.rectangle = { span_m = 0.014, chord_m = 0.004 }
mesh = { chordwise = 3, spanwise = 5 }
motion.phi.constant_deg = 0
[wing.fore-right]
hinge_m = [0, 0.003, -0.0012]
mass_kg = 5e-7
planform.rectangle = { span_m = 0.014, chord_m = 0.004 }
mesh = { chordwise = 3, spanwise = 5 }
motion.phi.constant_deg = 0
[joint.one]
child = "right"
kind = "revolute"
axis = [0, 1, 0]
start_deg = [30]
element = [{ stiffness_newton_m_per_rad = 2.4e-6, damping_newton_m_s_per_rad = 2e-10 }]
[joint.two]
child = "fore-right"
kind = "revolute"
axis = [0, 1, 0]
start_deg = [30]
element = [{ stiffness_newton_m_per_rad = 2.4e-6, damping_newton_m_s_per_rad = 2e-10 }]
"#;

/// The records of the wings above, and the place of the right wing among the bodies.
fn stacked(set: &[&str]) -> (Vec<Record>, usize) {
    let case = common::load(STACKED, set);
    let setup = case.expect("a case").setup;
    let wings = &setup.animal.wings;
    let right = wings
        .iter()
        .position(|w| w.name == "right")
        .expect("a wing");
    (fly(setup), right + 1)
}

/// What wings do to each other's added mass is there from the first instant on: accelerations and forces go over into
/// those of the steps after it, which have it by differences. Without it they were 4 % and 53 % off.
#[test]
fn limit_the_first_instant_of_wings_on_hinges_is_that_of_small_steps() {
    for mirror in ["air.mirror=true", "air.mirror=false"] {
        let (records, right) = stacked(&[mirror]);
        assert!(records[0].corrector_passes > 1);
        let angular = |k: usize| records[k].accelerations[right].angular.y;
        let force = |k: usize| records[k].air[right].force.length();
        let apart = [angular(0) / angular(1) - 1.0, force(0) / force(1) - 1.0];
        println!("{mirror}: {apart:?}");
        // What a step changes: 1.2e-3 and 1.6e-3.
        assert!(apart[0].abs() < 3e-3 && apart[1].abs() < 4e-3, "{apart:?}");
    }
}

/// Half of the air has the image in its influence matrix, both halves have the other wing in their passes.
#[test]
fn agrees_the_first_instant_of_hinged_wings_with_half_of_the_air_and_with_both_halves() {
    let [half, whole] = ["air.mirror=true", "air.mirror=false"].map(|m| stacked(&[m]));
    let (of, right) = (
        |r: &[Record], k: usize| (r[0].accelerations[k], r[0].air[k]),
        half.1,
    );
    let (a, b) = (of(&half.0, right), of(&whole.0, right));
    let angular = a.0.angular.y / b.0.angular.y - 1.0;
    let force = (a.1.force - b.1.force).length() / b.1.force.length();
    println!("angular acceleration {angular:.1e}, force {force:.1e} apart");
    // Rounding; without passes one pair alone is 2e-4 and 2e-3 apart.
    assert!(angular.abs() < 1e-14 && force < 1e-14, "{angular} {force}");
}
