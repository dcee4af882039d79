//! The slender wing of Patil, Hodges & Cesnik (2001) in strips: flutter at 32.2 m/s, divergence at 37.15 m/s.

use wingbeat::analysis::flutter::{Condition, FlutterSettings, crossings};

use crate::support::{case_of, strips};

fn hale() -> String {
    strips(
        "step_s = 0.004
steps = 200",
        "density_kg_m3 = 0.0889
stream_m_s = [-30, 0, 0]
blade.states = 6",
        "mirror = false
motion.psi.constant_deg = 0.02
planform.rectangle = { chord_m = 1.0, span_m = 16.0, axis_fraction = 0.5 }
mesh = { chordwise = 1, spanwise = 10 }
[wing.right.structure]
spectral_radius = 1.0
[wing.right.structure.beam]
axis_fraction = 0.5
mass_fraction = 0.5
elements = 8
flap_newton_m2 = [2e4, 2e4]
torsion_newton_m2 = [1e4, 1e4]
lag_newton_m2 = [4e6, 4e6]
mass_kg_per_m = [0.75, 0.75]
inertia_kg_m = [0.1, 0.1]",
    )
}

fn at(set: &[&str], speed: f64, settings: &FlutterSettings) -> Condition {
    super::alone(&case_of("hale", &hale(), set).setup, speed, settings)
}

/// Without incidence.
const LEVEL: &str = "wing.right.motion.psi.constant_deg=0";

#[test]
fn behaves_squares_of_a_response_that_grows_are_no_modes() {
    // Grows by 3000 within the response: its squares were a motion that grew twice as fast without vibrating, static
    // divergence, below the speed of divergence, and one of twice the frequency.
    let found = at(&[LEVEL], 37.0, &FlutterSettings::default());
    assert!(found.divergence.is_none(), "{:?}", found.divergence);
    assert!(found.disturbance < 1e-5 && found.nonlinearity < 3e-4);
    let [mode] = found.modes[..] else {
        panic!("{:?}", found.modes)
    };
    assert!((mode.growth - 1.884).abs() < 0.01, "{mode:?}");
}

#[test]
fn published_slender_wing_flutters_at_32_m_s_as_it_comes_to_rest() {
    // 32.2 m/s (Patil, Hodges & Cesnik 2001). What is left of the way to rest decays within 8 to 12 s, without
    // vibrating: 4000 long steps were too few.
    let found = [31.0, 33.0].map(|speed| at(&[], speed, &FlutterSettings::default()));
    assert!(found.iter().all(|c| c.steady.drift < 1e-7));
    let [c] = crossings(&found)[..] else {
        panic!("{found:?}")
    };
    assert!(c.begins && (c.speed / 32.2 - 1.0).abs() < 0.015, "{c:?}");
}
