//! What the summary says of passive joints whose energy the steps do not keep.

use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
use wingbeat_results::summary::Verdict;
use wingbeat_results::{Outcome, Summary};

/// A wing on a spring alone keeps `T + k q^2 / 2`. By backward differences of order four it gains, which the
/// balance of energy, whose work of free joints is the energy of their motion, does not show.
#[test]
fn exact_energy_that_a_passive_hinge_gains() {
    let stiffness = 1e-4;
    let text = r#"
        format = 1
        name = "spring"
        gravity_m_s2 = [0, 0, 0]
        flight.mode = "tethered"
        air.model = "none"
        dynamics.integrator = "bdf"
        body = { mass_kg = 1.0, inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0] }
        wing.right = { mirror = false, mass_kg = 1e-4, hinge_m = [0, 0, 0], planform.rectangle = { chord_m = 0.01, span_m = 0.04, axis_fraction = 0.0 } }
        joint.hinge = { child = "right", kind = "revolute", axis = [0, 1, 0], start_deg = [5.0], element = [{ stiffness_newton_m_per_rad = 1e-4 }] }
    "#;
    // The angular frequency is sqrt(3 k / m) / c = 173 / s.
    let steps = [
        (1.73e-3, Verdict::Red),
        (1.2e-3, Verdict::Amber),
        (4e-4, Verdict::Green),
    ];
    for (step, verdict) in steps {
        let time = format!("time={{step_s={step:e}, steps=600}}");
        let case =
            LoadedCase::from_text("spring", text, std::path::Path::new(""), &[time]).unwrap();
        let mut flight = Simulation::new(case.setup.clone()).unwrap();
        let mut records = vec![flight.record().clone()];
        while !flight.finished() {
            records.push(flight.step().unwrap().clone());
        }
        let energies = records
            .iter()
            .map(|r| r.kinetic_energy + 0.5 * stiffness * r.joints[0][0].powi(2));
        let energies: Vec<f64> = energies.collect();
        let gained = energies.iter().map(|e| (e - energies[0]).abs());
        let gained = gained.fold(0.0, f64::max);
        let most = records
            .iter()
            .map(|r| r.kinetic_energy.max(r.hinge_work.abs()));
        let expected = gained / most.fold(0.0, f64::max);
        let summary = Summary::of(&case.setup, &records, &Outcome::Finished);
        let found = summary.joint_residual_relative;
        println!("{step}: {found:e} of {expected:e}, {:?}", summary.verdict);
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "{found:e} of {expected:e}"
        );
        assert_eq!(summary.verdict, verdict, "{:?}", summary.warnings);
        assert!(summary.energy_residual_relative < 1e-12);
    }
}

/// The same of a spring between points, whose work is that of a load: a body that slides on it.
#[test]
fn behaves_energy_that_a_spring_between_points_gains_is_told() {
    let text = r#"
        format = 1
        name = "slide"
        gravity_m_s2 = [0, 0, 0]
        time = { step_s = 1e-3, steps = 600 }
        flight.mode = "tethered"
        air.model = "none"
        dynamics.integrator = "bdf"
        body = { mass_kg = 1.0, inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0] }
        segment.bob = { mass_kg = 0.1, centre_m = [0, 0, 0], inertia_about_centre_kg_m2 = [1e-5, 1e-5, 1e-5, 0, 0, 0] }
        joint.slide = { child = "bob", kind = "prismatic", axis = [1, 0, 0], at_m = [0, 0, 0], start_m = 0.01 }
        spring.s = { between = ["body", "bob"], at_m = [[-0.1, 0, 0], [0, 0, 0]], rest_m = 0.1, stiffness_newton_per_m = 9000.0 }
    "#;
    let case = LoadedCase::from_text("slide", text, std::path::Path::new(""), &[]).unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        records.push(flight.step().unwrap().clone());
    }
    // By backward differences of order four, 0.3 rad a step.
    let places = records.iter().map(|r| r.joints[0][0].abs());
    let largest = places.fold(0.0, f64::max);
    assert!(largest > 0.011, "{largest}");
    let summary = Summary::of(&case.setup, &records, &Outcome::Finished);
    assert_eq!(summary.verdict, Verdict::Red, "{:?}", summary.warnings);
    assert!(summary.joint_residual_relative > 0.1);
}
