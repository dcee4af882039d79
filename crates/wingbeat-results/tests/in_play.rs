//! Residuals of energy and momentum do not depend on the inertial frame, nor on masses that do not take part.

use wingbeat_case::LoadedCase;
use wingbeat_results::Summary;
use wingbeat_results::summary::Verdict;

use crate::flights::{flown, preset};

/// A wing that bends, held in air that passes at 6 m/s.
const WING: &str = r#"
format = 1
name = "wing"
gravity_m_s2 = [0, 0, 0]
time = { steps_per_beat = 40, beats = 1 }
motion = { frequency_hz = 3.0, start = "impulsive" }
flight.mode = "tethered"
air = { model = "blade_element", density_kg_m3 = 1.225 }
dynamics.integrator = "bdf"
output = { frames_every = 0, figures = false, page = false }
body = { mass_kg = 0.5, inertia_about_centre_kg_m2 = [0.004, 0.006, 0.008, 0, 0, 0] }
[wing.right]
hinge_m = [0.02, 0.05, 0.01]
motion.phi.constant_deg = 5
motion.psi.fourier = { mean_deg = 3, cosine_deg = [5] }
planform.rectangle = { chord_m = 0.1, span_m = 0.5, axis_fraction = 0.3 }
mesh = { chordwise = 4, spanwise = 8 }
[wing.right.structure.beam]
axis_fraction = 0.3
mass_fraction = 0.42
flap_newton_m2 = [1.5, 0.3]
lag_newton_m2 = [60, 20]
torsion_newton_m2 = [0.6, 0.2]
mass_kg_per_m = [0.2, 0.08]
"#;

fn summary(set: &[&str]) -> Summary {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    flown(&LoadedCase::from_text("wing", WING, std::path::Path::new("."), &set).unwrap())
}

fn residuals(s: &Summary) -> [f64; 2] {
    [s.energy_residual_relative, s.momentum_residual_relative]
}

/// In a stream, towed through still air, and towed with a body two thousand times as heavy, a wing bends the same way:
/// its balances close as well, and its verdict is one.
#[test]
fn invariant_residuals_in_a_stream_are_those_of_a_tow_whatever_the_body_weighs() {
    let stream = "air.stream_m_s=[-6,0,0]";
    let tow = "flight.velocity_m_s=[6,0,0]";
    let held = summary(&[stream]);
    for set in [
        &[tow][..],
        &[tow, "body.mass_kg=1000"],
        &[stream, "body.mass_kg=1000"],
    ] {
        let other = summary(set);
        assert_eq!(other.verdict, held.verdict, "{:?}", other.warnings);
        for (a, b) in residuals(&held).into_iter().zip(residuals(&other)) {
            println!("{set:?}: {a:e} {b:e}");
            assert!((a / b - 1.0).abs() < 1e-3, "{set:?}: {a:e} {b:e}");
        }
    }
}

/// What flies freely, seen from air that goes along.
#[test]
fn invariant_residuals_of_a_free_flight_do_not_depend_on_the_frame() {
    let free = ["flight.mode=\"free\"", "wing.right.mirror=true"];
    let fly = |set: &str| summary(&[&free[..], &[set]].concat());
    let [one, other] = ["air.stream_m_s=[-6,0,0]", "flight.velocity_m_s=[6,0,0]"].map(fly);
    let (a, b) = (residuals(&one)[0], residuals(&other)[0]);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-3, "{a:e} {b:e}");
}

/// Correctors follow the motion to a tolerance: works are those of the accepted states, and so is the impulse by which
/// they are seen from another frame. The remainder is the rounding of momenta in a stream ten thousand times as fast.
#[test]
fn invariant_energy_residual_of_a_fly_does_not_depend_on_the_speed_of_a_stream_that_it_goes_with() {
    let fly = |set: &[&str]| {
        let more = ["time.steps_per_beat=40", "time.beats=2"];
        flown(&preset("fruit-fly-blade", &[&more, set].concat()))
    };
    let still = fly(&[]);
    let carried = fly(&[
        "flight.velocity_m_s=[3000,0,0]",
        "air.stream_m_s=[3000,0,0]",
    ]);
    let (a, b) = (residuals(&still)[0], residuals(&carried)[0]);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-3, "{a:e} {b:e}");
    assert_eq!(carried.verdict, still.verdict, "{:?}", carried.warnings);
}

/// What is missing in force and moment of a support does no work, however the support moves: at 40 steps a beat less
/// than a tenth of the tolerance is left of what that power was (1e-4 of a tow that rises from rest, 7e-5 of a turn).
#[test]
fn behaves_energy_of_a_tether_that_speeds_up_or_turns_closes_as_of_one_that_rests() {
    for motion in [
        &["flight.velocity_m_s=[1,0,0]", "flight.tether.start_s=0.02"][..],
        &["flight.tether.pitch.rate_deg_s=1e4"],
    ] {
        let tether = [
            "flight.mode=tethered",
            "time.steps_per_beat=40",
            "time.beats=4",
        ];
        let s = flown(&preset("fruit-fly-blade", &[&tether, motion].concat()));
        let energy = residuals(&s)[0];
        println!("{motion:?}: {energy:e}");
        assert!(energy < 5e-6, "{motion:?}: {energy:e}");
        assert_eq!(s.verdict, Verdict::Green, "{:?}", s.warnings);
    }
}

/// Eight steps do not follow the wings of a fly that is held, whatever its body weighs, and gravity does not hide how
/// sixteen turn it in vacuum.
#[test]
fn invariant_verdicts_do_not_depend_on_the_mass_of_a_held_body_nor_on_a_fall() {
    let held = |mass: &str| {
        let set = [
            "time.steps_per_beat=8",
            "time.beats=3",
            "flight.held_beats=2.5",
            "dynamics.integrator=hamming",
            mass,
        ];
        flown(&preset("fruit-fly-blade", &set))
    };
    let [light, heavy] = ["body.mass_kg=9.315e-7", "body.mass_kg=1e-3"].map(held);
    let (a, b) = (residuals(&light)[1], residuals(&heavy)[1]);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-6, "{a:e} {b:e}");
    assert_eq!([light.verdict, heavy.verdict], [Verdict::Red; 2]);
    let falls = |gravity: &str| {
        let set = [
            "dynamics.integrator=hamming",
            "time.steps_per_beat=16",
            "time.beats=50",
            gravity,
        ];
        residuals(&flown(&preset("fruit-fly-vacuum", &set)))[0]
    };
    let [a, b] = ["gravity_m_s2=[0,0,0]", "gravity_m_s2=[0,0,9.81]"].map(falls);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-4, "{a:e} {b:e}");
}
