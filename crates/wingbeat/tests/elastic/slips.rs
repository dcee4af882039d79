//! Structures that are not what was meant: doubted before a flight, not trusted after it.

use wingbeat::analysis::{About, estimate, power, wing_modes};

use wingbeat::flight::Simulation;
use wingbeat::results::{Outcome, Summary};

use super::{case, fly, strings};

const BEAM: &str = "wing.right.structure.beam";
const SHELL: &str = "wing.right.structure.shell";

/// Doubts about the wings of a case with these keys set.
fn doubts(set: &[String]) -> Vec<String> {
    let mut all = estimate(&case(set).setup).doubts;
    all.retain(|d| d.starts_with("wing "));
    all
}

/// A beam of an EI and a GJ, and more.
fn beam(flap: f64, torsion: f64, more: &[&str]) -> Vec<String> {
    let mut set = strings(more);
    for (name, x) in [("flap", flap), ("torsion", torsion)] {
        set.push(format!("{BEAM}.{name}_newton_m2=[{x:e}, {x:e}]"));
    }
    set
}

/// A sheet of a modulus and a thickness, and more.
fn sheet(young: f64, thickness: f64, more: &[&str]) -> Vec<String> {
    let mut set = strings(more);
    set.push(format!("{SHELL}.young_pa={young:e}"));
    set.push(format!("{SHELL}.thickness_m=[{thickness}, {thickness}]"));
    set
}

#[test]
fn exact_first_frequency_of_an_even_beam() {
    // 1.8751^2 sqrt(EI / (m L^3)), of 24 elements 0.02 / 24^2 more; mass on the axis, twist stiff.
    let even = ["axis_fraction=0.5", "mass_fraction=0.5", "elements=24"];
    let even = even.map(|k| format!("{BEAM}.{k}"));
    let found = estimate(&case(&beam(1e-4, 1e-1, &even.each_ref().map(String::as_str))).setup);
    let expected = 1.875_104_07_f64.powi(2) * (1e-4 / (1e-4 * 0.06_f64.powi(3))).sqrt();
    let first = found.wings[0].first_frequency.unwrap() * 2.0 * std::f64::consts::PI;
    // It shears as a plate: 0.6 % of (chord / length)^2.
    assert!((first / expected - 1.0).abs() < 1e-3, "{first} {expected}");
    let ratio = found.wings[0].frequency_ratio.unwrap();
    assert!((ratio * 20.0 / found.wings[0].first_frequency.unwrap() - 1.0).abs() < 1e-12);
}

#[test]
fn agrees_first_frequencies_with_those_of_modes() {
    let vein = "wing.right.structure.vein=[{ radius_m = [5e-4, 1e-4], young_pa = 1e9 }]";
    let film = format!("{SHELL}.bending_factor=1e-3");
    for set in [
        beam(1e-4, 1e-5, &[]),
        sheet(3e9, 4e-4, &[]),
        sheet(3e9, 4e-4, &[vein, &film]),
    ] {
        let setup = case(&set).setup;
        let quick = estimate(&setup).wings[0].first_frequency.unwrap();
        let mode = &wing_modes(&setup, About::Rest, 1).unwrap()[0].vacuum[0];
        let error = quick * 2.0 * std::f64::consts::PI / mode.frequency - 1.0;
        // Sheets: the shape is sought without the inertia of the nodes' turns.
        assert!(error.abs() < 3e-3, "{set:?}: {error:e}");
    }
}

#[test]
fn behaves_structures_in_other_units_are_doubted() {
    assert!(doubts(&beam(1e-4, 1e-4, &[])).is_empty());
    assert!(doubts(&sheet(3e9, 4e-4, &[])).is_empty());
    let far = format!("{BEAM}.mass=[{{ at = 1, mass_kg = 1e-5, offset_m = [1, 0, 0] }}]");
    let damped = "wing.right.structure.damping_s=0.1";
    let vein = "wing.right.structure.vein=[{ radius_m = [1e-2, 1e-2], young_pa = 1e9 }]";
    let region = "wing.right.structure.region=[{ thickness_m = 0.01 }]";
    for (set, says) in [
        (beam(1e-8, 1e-4, &[]), "is below 1"),
        (beam(1e2, 1e-2, &[]), "flap_newton_m2 alone"),
        (beam(1e6, 1e6, &[]), "is above 1000"),
        (beam(1e30, 1e-4, &[]), "flap_newton_m2 alone"),
        (beam(1e-4, 1e-4, &[damped]), "damping ratio"),
        (beam(1e-4, 1e-4, &[&far]), "beam.mass[0]"),
        (sheet(3.0, 1e-4, &[]), "is below 1"),
        (sheet(3e18, 1e-4, &[]), "is above 1000"),
        (sheet(3e9, 0.1, &[]), "shell.thickness"),
        (sheet(3e9, 1e-4, &[vein]), "vein[0].radius_m"),
        (sheet(3e9, 1e-4, &[region]), "region[0].thickness_m"),
    ] {
        let said = doubts(&set).join("; ");
        assert!(said.contains(says), "{set:?}: {said}");
    }
}

#[test]
fn balances_power_of_damping_with_that_of_the_muscles_in_vacuum() {
    let set = [
        "flight.mode=tethered",
        "air.model=none",
        "time.beats=6",
        "wing.right.structure.damping_s=1e-3",
    ];
    let powers = |set: &[String]| power(&case(set).setup).unwrap();
    let found = powers(&beam(1e-3, 1e-3, &set));
    // Nothing else takes power; second order in the step, 80 a beat.
    assert!(
        (found.damping / found.perfect_storage - 1.0).abs() < 1e-2,
        "{found:?}"
    );
    assert!(found.damping > 0.0);
    let rigid = powers(&strings(&set[..3]));
    assert!(rigid.damping.abs() <= 0.0, "{rigid:?}");
}

#[test]
fn behaves_errors_of_elastic_wings_advise_what_is_possible() {
    let error = |set: &[String]| {
        let mut flight = match Simulation::new(case(set).setup) {
            Ok(flight) => flight,
            Err(e) => return e.to_string(),
        };
        let failed = std::iter::repeat_with(|| flight.step().map(drop));
        let failed = failed.take(20).find_map(Result::err);
        failed.expect("a step fails").to_string()
    };
    // EI of 1e30: rounding of places times the stiffness is more than all loads.
    let stiff = error(&beam(1e30, 1e-4, &[]));
    assert!(stiff.contains("rounding of its shape"), "{stiff}");
    let strict = [
        "corrector.tolerance=1e-30",
        "corrector.max_passes=2",
        "dynamics.integrator=hamming",
        "air.model=none",
    ];
    for set in [beam(1e-4, 1e-4, &strict), strings(&strict)] {
        let said = error(&set);
        let is_elastic = set.len() > strict.len();
        // `order_eight` refuses elastic wings.
        assert_eq!(said.contains("order_eight"), !is_elastic, "{said}");
    }
}

#[test]
fn behaves_torn_and_folded_wings_are_not_trusted() {
    let coarse = strings(&["wing.right.mesh={chordwise=2,spanwise=4}"]);
    let verdict = |set: &[String]| {
        let set = [set, &coarse].concat();
        let found = Summary::of(&case(&set).setup, &fly(&set), &Outcome::Finished);
        (found.verdict.word(), found.warnings.join(" "))
    };
    let (sound, _) = verdict(&beam(1e-4, 1e-4, &[]));
    assert_eq!(sound, "green");
    let stretches = format!("{BEAM}.axial_newton=[1e-3, 1e-3]");
    let (torn, said) = verdict(&beam(1e-4, 1e-4, &[&stretches, "time.beats=0.8"]));
    assert_eq!(torn, "red", "{said}");
    assert!(said.contains("was torn"), "{said}");
    let (double, said) = verdict(&beam(1e-8, 1e-4, &["time.beats=1"]));
    assert_eq!(double, "amber", "{said}");
    assert!(said.contains("was bent double"), "{said}");
}
