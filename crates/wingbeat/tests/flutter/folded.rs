//! Modes that are faster than half of the rate at which the response is sampled.

use std::f64::consts::{PI, TAU};

use wingbeat::analysis::flutter::{Condition, FlutterSettings, Vibration};

use super::alone;
use super::theodorsen::{scaled, sum, theodorsen, times};
use crate::support::{case_of, strips};

/// A slender wing (Tang & Dowell 2001, AIAA J. 39:1430, without the body at its tip), mass and elastic axes at mid chord, in strips.
fn slender() -> String {
    strips(
        "step_s = 0.0003
steps = 400",
        "density_kg_m3 = 1.225
stream_m_s = [-30, 0, 0]
blade.states = 6",
        "motion.psi.constant_deg = 0.01
planform.rectangle = { chord_m = 0.0508, span_m = 0.4508, axis_fraction = 0.5 }
mesh = { chordwise = 1, spanwise = 6 }
[wing.right.structure]
spectral_radius = 1.0
[wing.right.structure.beam]
axis_fraction = 0.5
mass_fraction = 0.5
elements = 6
flap_newton_m2 = [0.4186, 0.4186]
lag_newton_m2 = [18.44, 18.44]
torsion_newton_m2 = [0.9539, 0.9539]
mass_kg_per_m = [0.2351, 0.2351]
inertia_kg_m = [0.2056e-4, 0.2056e-4]",
    )
}

/// Growth and angular frequency of its first torsion mode at this speed [m/s]: `(I + pi rho b^4 / 8) s^2 + pi rho V b^3
/// (1 - C) s / 2 + GJ (pi / 2 L)^2 - pi rho V^2 b^2 C = 0`, `C` Theodorsen's function at the frequency of `s` (p-k method).
fn torsion(speed: f64) -> [f64; 2] {
    const HALF: f64 = 0.0254;
    let density = PI * 1.225;
    let inertia = 0.2056e-4 + density * HALF.powi(4) / 8.0;
    let stiffness = 0.9539 * (0.5 * PI / 0.4508).powi(2);
    let mut s = [0.0, (stiffness / inertia).sqrt()];
    for _ in 0..50 {
        let lag = theodorsen(s[1] * HALF / speed);
        let half = 0.25 * density * speed * HALF.powi(3) / inertia;
        let p = scaled(half, sum(&[[1.0, 0.0], scaled(-1.0, lag)]));
        let air = scaled(-density * (speed * HALF).powi(2), lag);
        let q = scaled(1.0 / inertia, sum(&[[stiffness, 0.0], air]));
        // s = -p + i sqrt(q - p^2)
        let d = sum(&[q, scaled(-1.0, times(p, p))]);
        let size = d[0].hypot(d[1]).sqrt();
        let (sin, cos) = (0.5 * d[1].atan2(d[0])).sin_cos();
        s = [-p[0] - size * sin, -p[1] + size * cos];
    }
    s
}

#[test]
fn agrees_torsion_sampled_less_than_twice_a_period_with_p_k_and_with_finer_samples() {
    let case = case_of("slender", &slender(), &[]);
    let speed = 40.0;
    let of = |modes: usize| {
        let settings = FlutterSettings {
            modes,
            ..FlutterSettings::default()
        };
        let found = alone(&case.setup, speed, &settings);
        assert!(found.untold.is_empty(), "{:?}", found.untold);
        found
    };
    let exact = torsion(speed);
    assert!((exact[1] / TAU - 104.7).abs() < 0.1, "{exact:?}");
    let near = |found: &Condition| -> Vibration {
        let apart = |v: &&Vibration| (v.growth - exact[0]).hypot(v.frequency - exact[1]);
        let nearest = found
            .modes
            .iter()
            .min_by(|a, b| apart(a).total_cmp(&apart(b)));
        *nearest.expect("modes")
    };
    // By three modes 196 samples a second, of which it makes 104.7 appear as 91.4; by six more than 750.
    let [coarse, fine] = [3, 6].map(|modes| near(&of(modes)));
    println!("{coarse:?} {fine:?} {exact:?}");
    let off = |v: &Vibration| (v.growth - exact[0]).hypot(v.frequency - exact[1]) / exact[1];
    assert!(off(&coarse) < 0.01 && off(&fine) < 0.01);
    assert!(coarse.distance(&fine) < 1e-3 * fine.frequency);
}
