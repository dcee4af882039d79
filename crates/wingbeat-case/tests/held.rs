//! Bodies that are held, for a while or all along, with joints that move freely.

use std::path::Path;

use crate::common::{self, fly};
use wingbeat_case::LoadedCase;
use wingbeat_flight::{Record, Simulation};

/// A body with a tail on a spring, which swings under its weight.
const TAIL: &str = "format = 1
name = \"tail\"
[time]
steps_per_beat = 60
beats = 1.2
[motion]
frequency_hz = 10.0
[flight]
held_beats = 1.0
[air]
model = \"none\"
[body]
mass_kg = 2.0
inertia_about_centre_kg_m2 = [0.01, 0.015, 0.02, 0, 0, 0]
[segment.tail]
mass_kg = 0.3
centre_m = [-0.3, 0, 0.02]
inertia_about_centre_kg_m2 = [1e-3, 2e-3, 2e-3, 0, 0, 0]
[joint.hinge]
child = \"tail\"
at_m = [-0.1, 0, 0]
kind = \"revolute\"
axis = [0, 1, 0]
[[joint.hinge.element]]
stiffness_newton_m_per_rad = 1.0
";

fn load(set: &[&str]) -> Result<LoadedCase, String> {
    common::load(TAIL, set)
}

fn flown(set: &[&str]) -> Vec<Record> {
    fly(load(set).unwrap_or_else(|e| panic!("{e}")).setup)
}

/// The angular velocity of the start is that of the release: until then a held body does not turn, and its
/// joints move as without it.
#[test]
fn exact_held_body_stands_still_until_its_release() {
    let still = flown(&[]);
    for form in ["momentum", "quaternion"] {
        let form = format!("dynamics.formulation={form}");
        let turning = flown(&[&form, "flight.angular_velocity_deg_s=[0,200,0]"]);
        for (a, b) in still.iter().zip(&turning).take(60) {
            assert!(b.root_angular_velocity.length() < 1e-12);
            assert!((a.joints[0][0] - b.joints[0][0]).abs() < 1e-12);
        }
        let released = turning[60].root_angular_velocity.y.to_degrees();
        assert!((released - 200.0).abs() < 1e-9, "{released}");
    }
    assert!(still[59].joints[0][0] > 0.1, "{:?}", still[59].joints);
}

#[test]
fn refuses_forms_that_no_held_body_with_free_joints_is_integrated_in() {
    for form in ["momentum", "euler"] {
        let form = format!("dynamics.formulation={form}");
        let text = load(&["flight={mode=\"tethered\"}", &form])
            .map(|_| ())
            .unwrap_err();
        assert!(
            text.contains("dynamics.formulation") && text.contains("quaternion"),
            "{text}"
        );
    }
    load(&["flight={mode=\"tethered\"}"]).unwrap();
}

/// A mass on a damper that takes it back a hundred times as fast as the steps are, and the same freely: plain
/// passes would lead away.
#[test]
fn exact_return_against_a_stiff_damper() {
    const SLIDE: &str = "format = 1
name = \"slide\"
gravity_m_s2 = [0, 0, 0]
time = { step_s = 1e-3, steps = 60 }
air.model = \"none\"
dynamics.integrator = \"bdf\"
body = { mass_kg = 1.0, inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0] }
segment.bob = { mass_kg = 0.1, centre_m = [0, 0, 0], inertia_about_centre_kg_m2 = [1e-5, 1e-5, 1e-5, 0, 0, 0] }
";
    for (mode, mass) in [("free", 0.1 / 1.1), ("tethered", 0.1)] {
        for (damper, bound) in [(100.0, 4e-3), (1000.0, 1e-2)] {
            let stiffness = 20.0 * damper;
            let joint = format!(
                "joint.slide={{ child = \"bob\", kind = \"prismatic\", axis = [1, 0, 0], at_m = [0, 0, 0], start_m = 0.01, element = [{{ stiffness_newton_per_m = {stiffness}, damping_newton_s_per_m = {damper} }}] }}"
            );
            let set = [joint, format!("flight={{mode=\"{mode}\"}}")];
            let case = LoadedCase::from_text("slide", SLIDE, Path::new(""), &set).unwrap();
            let mut flight = Simulation::new(case.setup).unwrap();
            // Overdamped: two exponentials.
            let (half, square): (f64, f64) = (0.5 * damper / mass, stiffness / mass);
            let root = (half * half - square).sqrt();
            let [slow, fast] = [-square / (half + root), -half - root];
            let mut worst = 0.0_f64;
            while !flight.finished() {
                let r = flight.step().unwrap();
                let [a, b] = [slow, fast].map(|rate| (rate * r.time).exp());
                let exact = 0.01 * (slow * b - fast * a) / (slow - fast);
                worst = worst.max((r.joints[0][0] - exact).abs() / 0.01);
                assert!(r.corrector_passes <= 6, "{}", r.corrector_passes);
            }
            // The starting steps do not resolve how the damper brakes.
            assert!(worst < bound, "{mode} {damper}: {worst:e}");
        }
    }
}

#[test]
fn behaves_an_animal_that_is_held_all_the_time_is_named() {
    let said = |beats: &str| {
        let set = [
            format!("time.beats={beats}"),
            "flight.held_beats=2".to_owned(),
        ];
        let setup = LoadedCase::find("fruit-fly-blade", &set).unwrap().setup;
        let doubts = wingbeat_analysis::estimate(&setup).doubts;
        doubts
            .iter()
            .filter(|d| d.contains("flight.held_beats"))
            .count()
    };
    assert_eq!([said("2"), said("3")], [1, 0]);
}
