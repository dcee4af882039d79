//! Static divergence, and steady deflections that grow as they do about it.

use std::f64::consts::PI;

use wingbeat::analysis::flutter::{Condition, FlutterSettings, steep};
use wingbeat::math::DVec3;

use super::{alone, with_modes};
use crate::support::{self, case_of};

/// `d = a q / (1 - q / q_D)` of a linear wing: the exponent is above 3 from two thirds of `q_D` on, and
/// Southwell's line through any two speeds meets 0 at `q_D`, to rounding.
#[test]
fn exact_deflections_of_a_linear_wing_tell_its_divergence() {
    const DIVERGENCE: f64 = 7.5;
    let at = |speed: f64| {
        let (q, q_d) = (speed * speed, DIVERGENCE * DIVERGENCE);
        let turn = 1e-4 * q / (1.0 - q / q_d);
        let mut c = with_modes(speed, &[]);
        c.steady.tip = DVec3::Z * 0.7 * turn;
        c.steady.turn = DVec3::X * turn;
        c
    };
    // sqrt(2 / 3) of 7.5 m/s is 6.12 m/s.
    assert!(steep(&[at(5.8), at(6.0)]).is_empty());
    let found = steep(&[at(6.0), at(6.2), at(6.5), at(7.0)]);
    assert_eq!(found.len(), 2);
    for s in &found {
        let off = s.divergence.unwrap() / DIVERGENCE - 1.0;
        assert!(off.abs() < 1e-13, "{off}");
    }
    // Loads that do not grow with the air, and deflections too small to tell.
    let still = [with_modes(6.0, &[]), with_modes(7.0, &[])];
    assert!(steep(&still).is_empty());
}

/// Under weight, too, `d = (d_w + a q) / (1 - q / q_D)`, `d_w` by weight alone: what the air adds to that tells the same
/// speed, whether the two go together or cancel each other; the whole deflection tells a false one.
#[test]
fn exact_deflections_of_a_linear_wing_under_weight_tell_its_divergence() {
    const DIVERGENCE: f64 = 7.5;
    let q_d = DIVERGENCE * DIVERGENCE;
    for weight in [-2e-3, -0.5e-3, 1e-3, 5e-3] {
        let at = |speed: f64| {
            let q = speed * speed;
            let by = |turn: f64| [DVec3::Z * 0.7 * turn, DVec3::X * turn];
            let mut c = with_modes(speed, &[]);
            [c.steady.tip, c.steady.turn] = by((weight + 1e-4 * q) / (1.0 - q / q_d));
            c.steady.by_weight = Some(by(weight));
            c
        };
        let pair = [at(6.5), at(7.0)];
        let found = steep(&pair);
        assert_eq!(found.len(), 1, "{weight}");
        let off = found[0].divergence.unwrap() / DIVERGENCE - 1.0;
        assert!(off.abs() < 1e-13, "{weight}: {off}");
        // Bent far by weight the wing is not linear.
        let far = pair.map(|mut c| {
            c.steady.by_weight = Some([DVec3::Z, DVec3::X * 0.3]);
            c.steady.tip += DVec3::Z;
            c.steady.turn += DVec3::X * 0.3;
            c
        });
        assert!(steep(&far).iter().all(|s| s.divergence.is_none()));
        assert_eq!(steep(&far).len(), 1, "{weight}");
    }
}

/// A wing of strips held at its root, stiff in bending, diverges in twist at `pi / (2 L) sqrt(2 GJ / (rho c e
/// a))`, e from the quarter chord to the elastic axis, a the lift slope of the strips; beyond, a motion that
/// does not vibrate grows.
#[test]
fn exact_static_divergence_of_strips() {
    let case = case_of("divergence", &torsion(), &[]);
    let at = |speed: f64| alone(&case.setup, speed, &FlutterSettings::default());
    let growth = |c: &Condition| c.divergence.map(|(motion, _)| motion.growth);
    let exact = divergence();
    let [below, above, far] = [14.0, 15.0, 15.4].map(at);
    assert!(growth(&below).is_none() && !below.diverges());
    assert!(far.diverges());
    let [near, more] = [&above, &far].map(|c| growth(c).unwrap());
    let found = above.speed - near * (far.speed - above.speed) / (more - near);
    println!("{found} {exact}");
    // Measured 0.15 %: growth is not quite linear in speed.
    assert!((found / exact - 1.0).abs() < 5e-3, "{found} {exact}");
}

/// Southwell's line by flights of the same wing with some incidence, without weight and with it on either side: it meets
/// zero at the speed of the closed form.
#[test]
fn exact_divergence_of_strips_under_weight_by_the_steady_deflections() {
    let exact = divergence();
    for gravity in [9.81, -9.81] {
        let set = [
            format!("gravity_m_s2=[0,0,{gravity}]"),
            "wing.right.motion.psi.constant_deg=0.15".to_owned(),
            "wing.right.mesh.spanwise=16".to_owned(),
            "wing.right.structure.beam.elements=16".to_owned(),
            "wing.right.structure.beam.mass_kg_per_m=[0.05,0.05]".to_owned(),
            "wing.right.structure.beam.inertia_kg_m=[0.00005,0.00005]".to_owned(),
        ];
        let set: Vec<&str> = set.iter().map(|s| &s[..]).collect();
        let case = case_of("divergence", &torsion(), &set);
        let pair = [12.8, 13.6].map(|v| alone(&case.setup, v, &FlutterSettings::default()));
        let turn = |c: &Condition| c.steady.turn.length();
        let line = pair.each_ref().map(|c| c.speed * c.speed / turn(c));
        let [q, more] = pair.each_ref().map(|c| c.speed * c.speed);
        let whole = (q + (more - q) * line[0] / (line[0] - line[1])).sqrt();
        let found = steep(&pair);
        println!("{gravity}: {found:?}, whole {whole:.3}, exact {exact:.3}");
        let speed = found[0].divergence.expect("small deflections");
        assert!(
            (speed / exact - 1.0).abs() < 5e-3,
            "{gravity}: {speed} {exact}"
        );
    }
}

/// Its speed of divergence [m/s].
fn divergence() -> f64 {
    0.5 * PI * (2.0 * 0.5 / (1.2 * 0.1 * 0.015 * 2.0 * PI)).sqrt()
}

/// The wing, without incidence and weight.
fn torsion() -> String {
    support::strips(
        "step_s = 0.001
steps = 6000",
        "density_kg_m3 = 1.2
stream_m_s = [-20, 0, 0]",
        "mirror = false
planform.rectangle = { chord_m = 0.1, span_m = 1.0, axis_fraction = 0.4 }
mesh = { chordwise = 1, spanwise = 20 }
[wing.right.structure]
damping_s = 0
mass_damping_per_s = 0
spectral_radius = 0.8
[wing.right.structure.beam]
axis_fraction = 0.4
mass_fraction = 0.3
elements = 20
flap_newton_m2 = [2000, 2000]
lag_newton_m2 = [200000, 200000]
axial_newton = [1e7, 1e7]
torsion_newton_m2 = [0.5, 0.5]
mass_kg_per_m = [0.5, 0.5]
inertia_kg_m = [0.0005, 0.0005]",
    )
}
