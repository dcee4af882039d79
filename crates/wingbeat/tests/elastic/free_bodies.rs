//! Free bodies with elastic wings in empty space: what they keep.

use wingbeat::flight::Record;

use super::{beam, fly, strings};

/// A body that turns about all axes in empty space, its wings bending: nothing drives it.
fn tumbling(steps: usize, structure: &[String]) -> Vec<Record> {
    let set = strings(&[
        "air.model=\"none\"",
        "gravity_m_s2=[0,0,0]",
        "flight.angular_velocity_deg_s=[2700,1500,-2100]",
        "motion.frequency_hz=20",
        "time.steps_per_beat=100",
        &format!("time.beats={}", steps / 100),
        "wing.right.motion.phi.fourier.cosine_deg=[0]",
        "wing.right.mesh.chordwise=1",
        "wing.right.mesh.spanwise=1",
        "wing.right.structure.spectral_radius=1",
    ]);
    fly(&[&set[..], structure].concat())
}

fn two_beams() -> Vec<String> {
    [
        &beam(2e-4)[..],
        &strings(&["wing.right.structure.beam.elements=2"]),
    ]
    .concat()
}

/// A sheet between two spars.
fn spars_and_sheet() -> Vec<String> {
    let vein = |x: usize| format!("{{from=[0,{x}],to=[1,{x}],radius_m=[3e-4,3e-4],young_pa=1e10}}");
    strings(&[
        "wing.right.structure.shell.young_pa=3e9",
        "wing.right.structure.shell.thickness_m=[1e-4,1e-4]",
        &format!("wing.right.structure.vein=[{},{}]", vein(0), vein(1)),
    ])
}

/// Momentum, angular momentum and energy of a free body with wings of `structure`, all its own, over so many steps.
fn keeps_all(steps: usize, structure: &[String]) {
    let records = tumbling(steps, structure);
    assert_eq!(records.len(), steps + 1);
    let largest = |of: fn(&Record) -> f64| records.iter().map(of).fold(0.0, f64::max);
    let tip = largest(|r| r.elastic[0].tip.length());
    let linear = largest(|r| r.momentum_residual.length()) / largest(|r| r.momentum.length());
    let angular = largest(|r| r.angular_momentum_residual.length())
        / largest(|r| r.angular_momentum.length());
    let kinetic = records[0].kinetic_energy;
    let energy = |part: &[Record]| {
        let residuals = part.iter().map(|r| r.energy_residual.abs() / kinetic);
        residuals.fold(0.0, f64::max)
    };
    let [early, late] = [&records[..steps / 2], &records[steps / 2..]].map(energy);
    println!("tip {tip:.2e} m, {linear:.1e}, {angular:.1e}, energy {early:.3e} {late:.3e}");
    assert!(tip > 5e-5, "soft: {tip}");
    // Thousands of steps of some roundings each.
    assert!(linear < 3e-14 && angular < 5e-13, "{linear:e} {angular:e}");
    // Second order in the step (here a twentieth of the first period), and bounded: no more in the second half.
    assert!(late < 1.2 * early && early < 5e-4, "{early:e} {late:e}");
}

#[test]
fn conserves_momentum_and_energy_of_a_free_body_with_beams_over_thousands_of_steps() {
    keeps_all(4_000, &two_beams());
}

#[test]
fn conserves_momentum_and_energy_of_a_free_body_with_sheets_and_spars() {
    keeps_all(2_000, &spars_and_sheet());
}

/// Panels nine times as long as wide, whose mass follows the line along their long sides.
#[test]
fn conserves_momentum_and_energy_of_a_free_body_with_sheets_of_long_panels() {
    let long = strings(&["wing.right.mesh.chordwise=3"]);
    keeps_all(1_000, &[&spars_and_sheet()[..], &long].concat());
}

#[test]
#[ignore = "half a minute; the same as above, longer"]
fn conserves_momentum_and_energy_of_a_free_body_with_sheets_over_ten_thousand_steps() {
    keeps_all(10_000, &spars_and_sheet());
}
