//! An elastic wing on a flapping hinge that has no inertia of its own.

use wingbeat::case::LoadedCase;
use wingbeat::flight::Simulation;

const WING: &str = "format = 1
gravity_m_s2 = [0, 0, 0]
[time]
step_s = 0.004
steps = 1000
[flight]
mode = \"tethered\"
[air]
model = \"none\"
[body]
mass_kg = 1.0
inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]
[wing.right]
mirror = false
hinge_m = [0, 0, 0]
planform.rectangle = { chord_m = 0.1, span_m = 1.0, axis_fraction = 0.5 }
mesh = { chordwise = 2, spanwise = 20 }
[wing.right.structure.beam]
axis_fraction = 0.5
mass_fraction = 0.5
elements = 20
flap_newton_m2 = [1.0, 1.0]
torsion_newton_m2 = [1.0, 1.0]
lag_newton_m2 = [1e4, 1e4]
mass_kg_per_m = [1.0, 1.0]
inertia_kg_m = [1e-3, 1e-3]
[joint.h]
child = \"right\"
kind = \"revolute\"
axis = [1, 0, 0]
";

/// Largest angle of the hinge \[rad\] and the largest energy that is missing \[J\] within a second.
fn flown(hinge: &str, step: f64) -> [f64; 2] {
    let set = [format!("time.step_s={step}")];
    let text = format!("{WING}{hinge}");
    let case = LoadedCase::from_text("hinge", &text, std::path::Path::new("."), &set).unwrap();
    let mut flight = Simulation::new(case.setup).unwrap();
    let mut largest = [0.0_f64; 2];
    for _ in 0..(1.0 / step) as usize {
        let record = flight.step().unwrap();
        largest[0] = largest[0].max(record.joints[0][0].abs());
        largest[1] = largest[1].max(record.energy_residual.abs());
    }
    largest
}

/// A spring that lets go has no more energy than it had, whatever the step: the root starts with an
/// acceleration that no step resolves.
#[test]
fn limit_a_wing_that_is_let_go_turns_no_farther_than_it_began() {
    let hinge = "start_deg = [1.0]
[[joint.h.element]]
stiffness_newton_m_per_rad = 0.3
";
    let start = 1.0_f64.to_radians();
    for step in [0.008, 0.004, 0.002] {
        let [angle, missing] = flown(hinge, step);
        // 1.6 to 2 % of the energy of the spring: the jerk at the start.
        let spring = 0.5 * 0.3 * start * start;
        println!("{step}: {angle} {missing}");
        assert!(angle < 1.0001 * start, "{step}: {angle}");
        assert!(missing < 0.03 * spring, "{step}: {missing}");
    }
}

/// A motor that starts smoothly: the missing energy falls with the square of the step.
#[test]
fn order_energy_of_a_wing_on_a_hinge_that_a_motor_turns() {
    let hinge = "[[joint.h.element]]
stiffness_newton_m_per_rad = 3.0
damping_newton_m_s_per_rad = 0.5
moment_newton_m = { frequency_hz = 2.0, sine = [0.02] }
";
    let [coarse, fine] = [0.008, 0.004].map(|step| flown(hinge, step));
    println!("{coarse:?} {fine:?}");
    assert!((coarse[0] / fine[0] - 1.0).abs() < 0.02);
    let order = (coarse[1] / fine[1]).log2();
    assert!((1.7..2.5).contains(&order), "{order}");
}
