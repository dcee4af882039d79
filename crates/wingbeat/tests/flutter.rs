//! Flutter of elastic wings held in a stream.

use std::f64::consts::TAU;

use wingbeat::analysis::AnalysisError;
use wingbeat::analysis::flutter::{
    Condition, FlutterSettings, Realisation, SteadyWing, Vibration, condition, crossings, growing,
    likely,
};
use wingbeat::case::LoadedCase;
use wingbeat::flight::FlightSetup;

#[path = "flutter/divergence.rs"]
mod divergence;
#[path = "flutter/folded.rs"]
mod folded;
#[path = "flutter/hale.rs"]
mod hale;
#[path = "flutter/several.rs"]
mod several;
mod support;
#[path = "flutter/theodorsen.rs"]
mod theodorsen;

use support::case_of;

const GOLAND: &str = include_str!("../../wingbeat-verify/data/goland.toml");

/// Goland's wing, coarse, with keys set.
fn goland(set: &[&str]) -> LoadedCase {
    let coarse = [
        "wing.right.mesh.chordwise=4",
        "wing.right.mesh.spanwise=8",
        "time.step_s=0.0028575",
        "air.max_wake_rows=40",
    ];
    case_of("goland", GOLAND, &[&coarse[..], set].concat())
}

fn settings() -> FlutterSettings {
    FlutterSettings {
        modes: 2,
        ..FlutterSettings::default()
    }
}

fn at(set: &[&str], speed: f64) -> Condition {
    alone(&goland(set).setup, speed, &settings())
}

/// That of the one wing, or of the first of two that are mirror images of each other.
fn alone(setup: &FlightSetup, speed: f64, settings: &FlutterSettings) -> Condition {
    let mut found = condition(setup, speed, settings).unwrap();
    assert_eq!(found.len(), 1);
    found.swap_remove(0)
}

#[test]
fn exact_wing_in_thin_air_vibrates_as_its_structure_does() {
    // A millionth of the density: what is left is the structure and the damping by strain rates, tau omega / 2 of each
    // mode. Generalized-alpha without dissipation lengthens periods by (omega h)^2 / 12: 0.6 % at 15.2 Hz.
    let tau = 2e-4;
    let found = at(
        &[
            "air.density_kg_m3=1e-6",
            &format!("wing.right.structure.damping_s={tau}"),
        ],
        160.0,
    );
    assert_eq!(found.modes.len(), 2, "{:?}", found.modes);
    let step = 0.0028575;
    for (mode, vacuum) in found.modes.iter().zip(&found.steady.vacuum) {
        let expected = vacuum * (1.0 - (vacuum * step).powi(2) / 12.0);
        let off = mode.frequency / expected - 1.0;
        assert!(off.abs() < 2e-3, "{off} of {vacuum}");
        let off = mode.damping() / (0.5 * tau * vacuum) - 1.0;
        assert!(off.abs() < 3e-2, "{off} of {vacuum}");
    }
}

#[test]
fn published_goland_flutters_within_two_percent_of_163_to_169_m_s() {
    // Lattices of others have 163 to 169 m/s. This one, its rings inside the side edges, converges to 170.5,
    // and has 166 on coarse meshes with rings on the edges, which make the span too large.
    let found = [155.0, 180.0].map(|speed| at(&[], speed));
    let crossings = crossings(&found);
    assert_eq!(crossings.len(), 1, "{crossings:?}");
    let c = crossings[0];
    assert!(
        c.begins && (163.0..=1.02 * 169.0).contains(&c.speed),
        "{c:?}"
    );
    // 10.9 to 11.2 Hz: 69 to 70 rad/s.
    assert!(
        (c.frequency / 70.0 - 1.0).abs() < 0.03,
        "{}",
        c.frequency / TAU
    );
    for condition in &found {
        assert!(condition.nonlinearity < 5e-6, "{}", condition.nonlinearity);
        assert!(
            condition.response.residual < 2e-3,
            "{}",
            condition.response.residual
        );
        assert!(condition.steady.drift < 1e-7);
    }
}

#[test]
fn agrees_response_of_a_pair_with_that_of_its_mirrored_half() {
    let coarse = [
        "wing.right.mesh={chordwise=3,spanwise=6}",
        "air.max_wake_rows=25",
    ];
    let [half, whole] = ["air.mirror=true", "air.mirror=false"]
        .map(|set| at(&[&coarse[..], &[set]].concat(), 160.0));
    // Sums in another order; identification amplifies rounding by the smallest singular value kept, 1e5.
    for (a, b) in half.modes.iter().zip(&whole.modes).take(2) {
        let apart = (a.growth - b.growth).hypot(a.frequency - b.frequency);
        println!("{apart:e}");
        assert!(apart < 1e-4 * a.frequency, "{a:?} {b:?}");
    }
    assert!((half.steady.tip - whole.steady.tip).length() < 1e-7 * half.steady.tip.length());
}

#[test]
fn refuses_what_has_no_steady_state_to_look_about() {
    let told = |set: &[&str], speed: f64| -> String {
        let found = condition(&goland(set).setup, speed, &settings());
        let error: AnalysisError = found.map(|_| ()).unwrap_err();
        error.to_string()
    };
    let gust = "air.gust=[{ amplitude_m_s = [0, 0, 5], duration_s = 0.1 }]";
    let street =
        "air.vortex_street={ circulation_m2_s = 1, spacing_m = 1, drift_m_s = [-1, 0, 0] }";
    let cases: [(&[&str], &str); 5] = [
        (&[gust], "the air changes with time"),
        (&[street], "the air changes with time"),
        (&["flight.mode=free"], "the flight is free"),
        (&["flight.velocity_m_s=[1,0,0]"], "the body moves"),
        (&["air.stream_m_s=[0,0,0]"], "there is no stream"),
    ];
    for (set, what) in cases {
        let told = told(set, 160.0);
        assert!(told.contains(what), "{told}");
    }
    assert!(told(&[], 0.0).contains("there is no stream"));
    let mut still = goland(&[]).setup;
    still.air = wingbeat::flight::AirModel::None;
    let error = condition(&still, 160.0, &settings())
        .map(|_| ())
        .unwrap_err();
    assert!(
        error.to_string().contains("the air has no wakes"),
        "{error}"
    );
    let mut rigid = goland(&[]).setup;
    rigid
        .animal
        .wings
        .iter_mut()
        .for_each(|w| w.structure = None);
    let told = condition(&rigid, 160.0, &settings())
        .map(|_| ())
        .unwrap_err();
    assert!(told.to_string().contains("no wing is elastic"), "{told}");
}

const STRIPS: &str = include_str!("../../wingbeat-verify/data/goland-strips.toml");

/// Goland's wing in strips.
fn strips(set: &[&str]) -> LoadedCase {
    case_of("strips", STRIPS, set)
}

#[test]
fn published_goland_in_strips_flutters_at_137_m_s_as_by_theodorsens_function() {
    let set = [
        "wing.right.mesh.spanwise=10",
        "wing.right.structure.beam.elements=8",
    ];
    let setup = strips(&set).setup;
    let found = [135.0, 139.0].map(|speed| alone(&setup, speed, &settings()));
    let all = crossings(&found);
    assert_eq!(all.len(), 1, "{all:?}");
    let c = all[0];
    // Goland & Luke (1948): 137.2 m/s, 70.7 rad/s. By frequencies, with Theodorsen's function and two modes: 136.8
    // m/s (136.9 with eight). What is left is that of eight states, 10 strips, the step, and a straight line
    // between the two speeds.
    let [speed, frequency] = theodorsen::goland();
    assert!(
        (speed - 136.78).abs() < 0.02 && (frequency - 69.97).abs() < 0.02,
        "{speed} {frequency}"
    );
    assert!(c.begins && (c.speed / 137.2 - 1.0).abs() < 0.005, "{c:?}");
    assert!((c.speed / speed - 1.0).abs() < 0.005, "{c:?} {speed}");
    assert!((c.frequency / frequency - 1.0).abs() < 0.005, "{c:?}");
}

#[test]
fn refuses_flutter_in_strips_without_wakes() {
    let text = STRIPS.replace("unsteady = \"peters\"\n", "");
    let steady = case_of("strips", &text, &[]);
    let told = condition(&steady.setup, 130.0, &settings())
        .map(|_| ())
        .unwrap_err()
        .to_string();
    assert!(
        told.contains("no wakes") && told.contains("air.blade.unsteady"),
        "{told}"
    );
}

/// A condition that has modes of frequency, growth and its uncertainty.
fn with_modes(speed: f64, modes: &[[f64; 3]]) -> Condition {
    let mode = |[frequency, growth, _]: &[f64; 3]| Vibration {
        growth: *growth,
        frequency: *frequency,
        share: 0.5,
    };
    let modes_found: Vec<_> = modes.iter().map(mode).collect();
    Condition {
        speed,
        steady: SteadyWing {
            wing: 0,
            tip: Default::default(),
            turn: Default::default(),
            by_weight: Some(Default::default()),
            drift: 0.0,
            vacuum: vec![],
        },
        modes: modes_found.clone(),
        uncertainty: modes.iter().map(|m| m[2]).collect(),
        untold: vec![],
        divergence: None,
        response: Realisation {
            vibrations: modes_found,
            untold: vec![],
            order: 2 * modes.len(),
            residual: 0.0,
        },
        nonlinearity: 0.0,
        disturbance: 1e-5,
        length: 1.0,
        slow_joint: None,
    }
}

#[test]
fn behaves_growth_counts_beyond_its_uncertainty_alone() {
    // A mode that flutters, neutral at the speed between, and one whose growth is noise.
    let all = [
        with_modes(10.0, &[[70.0, -2.0, 0.1], [400.0, 0.2, 1.0]]),
        with_modes(11.0, &[[70.0, 0.05, 0.1], [400.0, -0.3, 1.0]]),
        with_modes(12.0, &[[70.0, 2.0, 0.1], [400.0, 0.1, 1.0]]),
    ];
    let found = crossings(&all);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].begins && (found[0].speed - 11.0).abs() < 1e-12);
    assert_eq!(found[0].between, [10.0, 12.0]);
    assert!(growing(&all).is_empty());
    // Frequencies that lie apart are of two modes.
    let apart = [
        with_modes(10.0, &[[70.0, -2.0, 0.1]]),
        with_modes(11.0, &[[140.0, 2.0, 0.1]]),
    ];
    assert!(crossings(&apart).is_empty());
    // Flutter at all speeds.
    let found = growing(&[
        with_modes(10.0, &[[70.0, 1.0, 0.1], [90.0, -1.0, 0.1]]),
        with_modes(11.0, &[[68.0, 2.0, 0.1], [91.0, -1.0, 0.1]]),
    ]);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].map(|v| v.frequency), [70.0, 68.0]);
}

#[test]
fn behaves_a_mode_that_is_neutral_at_first_and_grows_later_begins_about_there() {
    let all = [
        with_modes(31.5, &[[23.4, -0.1, 0.15]]),
        with_modes(33.5, &[[22.5, 0.4, 0.1]]),
        with_modes(35.5, &[[21.6, 1.0, 0.1]]),
    ];
    assert!(crossings(&all).is_empty() && growing(&all).is_empty());
    let [c] = likely(&all)[..] else {
        panic!("an onset")
    };
    assert!(c.begins && (c.speed - 31.9).abs() < 1e-12, "{c:?}");
    assert_eq!(c.between, [31.5, 33.5]);
    // Above zero already as found: at the latest there.
    let mut above = all.clone();
    above[0] = with_modes(31.5, &[[23.4, 0.1, 0.15]]);
    assert_eq!(likely(&above)[0].speed, 31.5);
    // Neutral throughout, or dying out: no onset.
    assert!(likely(&all[..1]).is_empty());
    let dies = [all[0].clone(), with_modes(33.5, &[[22.5, -0.4, 0.1]])];
    assert!(likely(&dies).is_empty());
}

#[test]
fn exact_undamped_wing_in_thin_air_is_neutral() {
    // Nothing damps it and nothing feeds it: growth is zero but for what is not known of it.
    let found = [150.0, 160.0].map(|speed| at(&["air.density_kg_m3=1e-6"], speed));
    for condition in &found {
        for k in 0..condition.modes.len() {
            assert_eq!(condition.grows(k), None, "{:?}", condition.modes[k]);
        }
    }
    assert!(crossings(&found).is_empty());
}

/// Six modes, most of them hardly damped or hardly disturbed.
const SIX: FlutterSettings = FlutterSettings {
    modes: 6,
    disturbance: 1e-5,
    periods: 1.5,
    settling: 4000,
    antisymmetric: false,
};

#[test]
fn published_goland_in_strips_does_not_flutter_below_137_m_s_in_any_of_six_modes() {
    let setup = strips(&[]).setup;
    let found = [70.0, 80.0, 90.0].map(|speed| alone(&setup, speed, &SIX));
    assert!(crossings(&found).is_empty(), "{:?}", crossings(&found));
    assert!(growing(&found).is_empty());
}

/// Goland's wings in strips on hinges of this stiffness [N m/rad] along their spans.
fn on_hinges(stiffness: &str, set: &[&str]) -> LoadedCase {
    let text = STRIPS.replace("motion.psi", "# motion.psi");
    let text = text
        + r#"
[joint.hinge-right]
child = "right"
kind = "revolute"
axis = [0, 1, 0]
[[joint.hinge-right.element]]
stiffness_newton_m_per_rad = "#
        + stiffness;
    case_of("hinged", &text, set)
}

/// What moves on a hinge with a period `2 pi sqrt(J / k)` longer than the response is not found, and named.
#[test]
fn exact_periods_on_hinges_that_are_longer_than_the_response_are_named() {
    let coarse = [
        "wing.right.mesh.spanwise=8",
        "wing.right.structure.beam.elements=6",
    ];
    let at = |stiffness: &str| {
        let setup = on_hinges(stiffness, &coarse).setup;
        let inertia = setup.animal.wings[0].mass.inertia.y_axis.y;
        (alone(&setup, 80.0, &settings()), inertia)
    };
    let (stiff, _) = at("3e5");
    assert_eq!(stiff.slow_joint, None);
    let (soft, inertia) = at("1e2");
    let (joint, period) = soft.slow_joint.expect("a slow joint");
    assert!(joint.starts_with("hinge-"), "{joint}");
    let exact = TAU * (inertia / 1e2).sqrt();
    assert!((period / exact - 1.0).abs() < 1e-12 && period > soft.length);
}

#[test]
fn agrees_flutter_on_a_soft_hinge_of_six_modes_with_that_of_two() {
    let coarse = [
        "wing.right.mesh.spanwise=8",
        "wing.right.structure.beam.elements=6",
    ];
    let hinged = on_hinges("3e5", &coarse);
    let onsets = |settings: &FlutterSettings| {
        let found = [70.0, 80.0, 90.0].map(|v| alone(&hinged.setup, v, settings));
        crossings(&found)
    };
    let [six, two] = [onsets(&SIX), onsets(&settings())];
    println!("{six:?} {two:?}");
    assert_eq!((six.len(), two.len()), (1, 1), "{six:?} {two:?}");
    // A straight line of growth over 10 m/s; the modes are the same.
    assert!(
        (six[0].speed / two[0].speed - 1.0).abs() < 0.01,
        "{six:?} {two:?}"
    );
    assert!(
        (six[0].frequency / TAU / 9.107 - 1.0).abs() < 0.01,
        "{six:?}"
    );
}

#[test]
fn refuses_speeds_and_lengths_at_which_nothing_is_found() {
    let coarse = [
        "wing.right.mesh.spanwise=8",
        "wing.right.structure.beam.elements=6",
    ];
    let setup = strips(&coarse).setup;
    let diverges = condition(&setup, 339.0, &settings())
        .map(|_| ())
        .unwrap_err();
    assert!(
        matches!(diverges, AnalysisError::NotSteady { .. }),
        "{diverges}"
    );
    let short = FlutterSettings {
        periods: 0.01,
        ..settings()
    };
    let told = condition(&setup, 130.0, &short)
        .map(|_| ())
        .unwrap_err()
        .to_string();
    assert!(told.contains("--periods 0.01"), "{told}");
}
