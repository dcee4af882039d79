//! Bodies and joints from case files: the presets fly alone and with the vortex lattice.

use crate::common::{self, preset};
use wingbeat_analysis::{TrimProblem, trim};
use wingbeat_case::{LoadedCase, presets};
use wingbeat_dynamics::ElementLaw;
use wingbeat_flight::{Record, Simulation};
use wingbeat_math::DVec3;

/// Records of a case with overrides.
fn fly(name: &str, set: &[&str]) -> Vec<Record> {
    common::fly(preset(name, set).setup)
}

/// Whether loads bend its wings.
fn is_elastic(name: &str) -> bool {
    let wings = preset(name, &[]).setup.animal.wings;
    wings.iter().any(|w| w.structure.is_some())
}

/// Largest energy residual over the largest kinetic energy.
fn balance(records: &[Record]) -> f64 {
    let most = |f: fn(&Record) -> f64| records.iter().map(f).fold(0.0, |a: f64, x| a.max(x.abs()));
    let kinetic: f64 = most(|r| r.kinetic_energy);
    if kinetic == 0.0 {
        assert_eq!(most(|r| r.energy_residual), 0.0); // nothing moves, nothing works
        return 0.0;
    }
    most(|r| r.energy_residual) / kinetic
}

const ARTICULATED: [(&str, usize, usize); 4] = [
    // Preset, bodies, free coordinates.
    ("fruit-fly-abdomen", 5, 0),
    ("fruit-fly-abdomen-spring", 5, 1),
    ("robobee", 3, 2),
    ("dragonfly", 5, 0),
];

#[test]
fn balances_energy_of_every_preset_alone() {
    for preset in presets::PRESETS {
        // The integrator that a case without air has of its own; elastic wings remember their shape from step
        // to step: their energy closes at second order, which has its own tests.
        if is_elastic(preset.name) {
            continue;
        }
        let alone = [
            "air.model=none",
            "dynamics.integrator=order_eight",
            "control.controller=none",
        ];
        let records = fly(preset.name, &alone);
        let residual = balance(&records);
        println!(
            "{}: {residual:.1e} of the largest kinetic energy",
            preset.name
        );
        assert!(residual < 1e-6, "{}: {residual}", preset.name);
    }
    for (name, bodies, free) in ARTICULATED {
        let records = fly(name, &["air.model=none", "time.beats=0.5"]);
        let last = records.last().unwrap();
        assert_eq!(last.coordinates.len(), 6 * bodies);
        assert_eq!(last.joints.len(), free);
    }
}

/// The abdomen hangs on a spring that nothing drives: the law of the spring against Newton's and Euler's
/// equations of all bodies behind the hinge.
#[test]
fn agrees_power_of_springs_with_that_of_the_reactions_at_their_hinge() {
    let records = fly(
        "fruit-fly-abdomen-spring",
        &["air.model=none", "time.beats=2"],
    );
    let most = |f: &dyn Fn(&Record) -> f64| records.iter().map(f).fold(0.0, f64::max);
    let at_hinge = |r: &Record| r.hinges[2..].iter().map(|h| h.power).sum::<f64>(); // the neck is welded
    let scale = most(&|r| at_hinge(r).abs());
    let apart = most(&|r| (at_hinge(r) - r.passive_power).abs()) / scale;
    println!("power of {scale:.2e} W, apart by {apart:.1e}");
    assert!(scale > 0.0 && apart < 4e-14, "{scale:.1e} W, {apart:.1e}");
    // Its work: by differences of what is stored against the trapezoidal rule over 40 steps a beat.
    let trapezoid =
        |w: &[Record]| 0.5 * (w[1].time - w[0].time) * (at_hinge(&w[0]) + at_hinge(&w[1]));
    let by_power: f64 = records.windows(2).map(trapezoid).sum();
    let apart = (records.last().unwrap().passive_work - by_power).abs();
    let turned_over = most(&|r| r.passive_work.abs());
    println!("work of {turned_over:.2e} J, apart by {apart:.1e}");
    assert!(
        apart < 4e-4 * turned_over,
        "{turned_over:.1e} J, {apart:.1e}"
    );
}

/// A tail on a slider: a spring of the joint, and a spring between points on the line of the slider.
#[test]
fn agrees_spring_between_points_with_the_spring_of_a_slider() {
    let fly = |spring: &[&str]| {
        let slider = [
            "air.model=none",
            "segment.abdomen.parts=[\"abdomen\"]",
            "joint.tail={ child = \"abdomen\", at_m = [-0.4e-3, 0, 0], kind = \"prismatic\", axis = [1, 0, 0], start_m = 5e-5 }",
            "time.beats=3",
        ];
        fly("fruit-fly-vacuum", &[&slider[..], spring].concat())
    };
    let joint = fly(&[
        "joint.tail.element=[{ stiffness_newton_per_m = 2.0, damping_newton_s_per_m = 1e-4 }]",
    ]);
    // 1 mm long where the slider is at zero: its tension is stiffness times displacement.
    let points = fly(&[
        "spring.tendon={ between = [\"body\", \"abdomen\"], at_m = [[0.6e-3, 0, 0], [0, 0, 0]], rest_m = 1e-3, stiffness_newton_per_m = 2.0, damping_newton_s_per_m = 1e-4 }",
    ]);
    let (mut apart, mut reach) = (0.0_f64, 0.0_f64);
    for (a, b) in joint.iter().zip(&points) {
        apart = apart.max((a.joints[0][0] - b.joints[0][0]).abs());
        reach = reach.max(a.joints[0][0].abs());
    }
    println!("apart by {apart:.1e} m of {reach:.1e} m");
    assert!(reach > 4e-5, "it moves");
    assert!(apart < 1e-9 * reach, "{apart:.1e}"); // tolerance of the integrator
    let [a, b] = [&joint, &points].map(|r| balance(r));
    assert!(a < 1e-8 && b < 1e-8, "{a:.1e} {b:.1e}");
}
/// Four prescribed wings that shake the body: the energy that is left over falls with the fourth power
/// of the step (measured 3e-5 at 40 steps a beat).
#[test]
fn order_four_of_backward_differences_on_the_dragonfly() {
    let residual = |steps: usize| {
        let steps = format!("time.steps_per_beat={steps}");
        balance(&fly("dragonfly", &["air.model=none", &steps]))
    };
    let [coarse, middle, fine] = [40, 80, 160].map(residual);
    println!("{coarse:.1e} {middle:.1e} {fine:.1e}");
    let orders = [coarse / middle, middle / fine].map(f64::log2);
    assert!(orders.iter().all(|p| (p - 4.0).abs() < 0.5), "{orders:?}");
}

#[test]
fn balances_coupled_flight_of_articulated_animals() {
    // Coarse wings, a quarter of a beat: everything takes part in the coupled steps.
    for (name, coarse) in [
        ("fruit-fly-abdomen", "wing.right.mesh.spanwise=4"),
        ("fruit-fly-abdomen-spring", "wing.right.mesh.spanwise=4"),
        ("robobee", "wing.right.mesh.spanwise=4"),
        ("dragonfly", "wing.fore-right.mesh.spanwise=4"),
    ] {
        let records = fly(name, &[coarse, "time.beats=0.25", "flight.held_beats=0"]);
        let (residual, last) = (balance(&records), records.last().unwrap());
        println!(
            "{name} with the lattice: {residual:.1e}, joints {:?}",
            last.joints
        );
        // The air is first order in the step, its loads jump where wakes are regularised.
        assert!(residual < 5e-3, "{name}: {residual}");
        assert!(last.air_work != 0.0 && last.wake_rings > 0);
    }
}

#[test]
fn agrees_free_and_tethered_passive_hinges_with_a_heavy_body() {
    // A tethered root is one of infinite mass: a free body a million times as heavy as the robot
    // leaves the hinges the same motion.
    let still = [
        "air.model=none",
        "gravity_m_s2=[0, 0, 0]",
        "time.beats=1",
        "time.steps_per_beat=40",
    ];
    let tethered = fly("robobee", &[&still[..], &["flight.mode=tethered"]].concat());
    let heavy = [
        "body.mass_kg=80",
        "body.inertia_about_centre_kg_m2=[1.5e-3, 1.5e-3, 0.5e-3, 0, 0, 0]",
    ];
    let free = fly("robobee", &[&still[..], &heavy].concat());
    let hinge = |r: &[Record]| r.last().unwrap().joints[0][0];
    let (a, b) = (hinge(&tethered), hinge(&free));
    println!("hinge angle after a beat: tethered {a:.9} rad, on a heavy body {b:.9} rad");
    assert!(a.abs() > 1e-3 && (a - b).abs() < 1e-5);
}

#[test]
fn agrees_formulations_from_the_case_file() {
    let common = ["air.model=none", "time.beats=1", "dynamics.tolerance=1e-12"];
    let fly = |more: &[&str]| {
        let records = fly("fruit-fly-abdomen-spring", &[&common[..], more].concat());
        records.last().unwrap().clone()
    };
    let momentum = fly(&[]);
    let quaternion = fly(&["dynamics.formulation=quaternion"]);
    let projected = fly(&[
        "dynamics.formulation=quaternion",
        "dynamics.stabilisation=projection",
    ]);
    for other in [&quaternion, &projected] {
        let angle = (momentum.joints[0][0] - other.joints[0][0]).abs();
        let way = (momentum.mass_centre - other.mass_centre).length();
        println!("abdomen {angle:.1e} rad, mass centre {way:.1e} m");
        assert!(angle < 1e-9 && way < 1e-12);
    }
}

#[test]
fn exact_a_fly_of_a_kilogram_is_warned_about() {
    let set = vec!["body.mass_kg=1".to_owned()];
    let case = LoadedCase::find("fruit-fly-vacuum", &set).unwrap();
    let warnings = wingbeat_flight::doubtful_masses(&case.setup);
    assert!(
        warnings.len() == 1 && warnings[0].contains("check the units"),
        "{warnings:?}"
    );
    let none = LoadedCase::find("fruit-fly-vacuum", &[]).unwrap();
    assert_eq!(wingbeat_flight::doubtful_masses(&none.setup), [""; 0]);
    // Held without weight: no mass changes the flight.
    for benchmark in ["benchmark-1", "benchmark-2"] {
        let held = LoadedCase::find(benchmark, &[]).unwrap();
        assert_eq!(wingbeat_flight::doubtful_masses(&held.setup), [""; 0]);
    }
}

#[test]
fn agrees_trim_of_passive_hinges_with_the_flight_it_leads_to() {
    // The wings of the robot feather by themselves: hinge angles and rates are unknowns of the trim.
    // Flown from there, body and hinges are back after a beat where they were.
    let set = ["air.model=\"blade_element\"".to_owned()];
    let case = LoadedCase::find("robobee", &set).unwrap_or_else(|e| panic!("{e}"));
    let problem = TrimProblem::straight(DVec3::ZERO, 0.0);
    let found = trim(&case.setup, &problem).expect("the robot");
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    assert_eq!(
        found.solution.residual.len(),
        6 + 4,
        "two hinges, coordinate and speed"
    );
    let mut flight = Simulation::new(found.free()).expect("a trimmed flight");
    let first = flight.record().clone();
    while !flight.finished() {
        flight.step().expect("a step");
    }
    let last = flight.record();
    let drift = (last.mass_centre - first.mass_centre).length();
    assert!(drift < 1e-6 * found.beat.wing_length(), "{drift:e} m");
    let degrees = |a: f64, b: f64| (a - b).to_degrees().abs();
    for k in 3..6 {
        let turned = degrees(first.coordinates[k], last.coordinates[k]);
        assert!(turned < 1e-3, "angle {k} of the body: {turned:e} deg");
    }
    for (a, b) in first.joints.iter().zip(&last.joints) {
        assert!(degrees(a[0], b[0]) < 1e-3, "hinge: {a:?} {b:?}");
    }
    // Another hinge, another trim: the joints are those of the animal.
    let mut stiff = case.setup.clone();
    for joint in &mut stiff.joints {
        for element in &mut joint.model.elements {
            if let ElementLaw::Spring { stiffness, .. } = &mut element.law {
                *stiffness *= 2.0;
            }
        }
    }
    let other = trim(&stiff, &problem).expect("the robot");
    let apart = (other.solution.adjustment.stroke_amplitude
        - found.solution.adjustment.stroke_amplitude)
        .abs();
    assert!(!other.solution.converged || apart > 1e-3, "{apart}");
}
