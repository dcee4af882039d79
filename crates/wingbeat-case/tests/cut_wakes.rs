//! Wakes that are cut: what is said of them wing by wing.

use std::path::Path;

use wingbeat_analysis::{kept_wake, way_in_a_step};
use wingbeat_case::LoadedCase;

/// A glider that a tether moves at 6 m/s: joined wings of 0.25 x 0.08 m.
const WINGS: &str = r#"
format = 1
[time]
step_s = 0.006
steps = 300
[flight]
mode = "tethered"
velocity_m_s = [6, 0, 0]
[air]
body = false
shed = ["trailing"]
[body]
mass_kg = 0.03
inertia_about_centre_kg_m2 = [2e-4, 3e-4, 4.5e-4, 0, 0, 0]
[wing.right]
hinge_m = [0.012, 0, 0]
joined = true
mass_kg = 0
motion.psi.constant_deg = 3
motion.phi.constant_deg = 0
planform.rectangle = { span_m = 0.25, chord_m = 0.08 }
mesh = { chordwise = 3, spanwise = 8 }
"#;

/// A smaller tail behind them.
const TAIL: &str = r#"
[wing.right_tail]
hinge_m = [-0.25, 0, 0]
joined = true
mass_kg = 0
motion.psi.constant_deg = 0
motion.phi.constant_deg = 0
planform.rectangle = { span_m = 0.09, chord_m = 0.05 }
mesh = { chordwise = 2, spanwise = 4 }
"#;

fn glider(parts: &[&str], set: &str) -> LoadedCase {
    let set = [set.to_owned()];
    LoadedCase::from_text("glider", &parts.concat(), Path::new("."), &set).unwrap()
}

/// A tail that goes as fast leaves its own short chords behind sooner; its area is no measure of the wake of the wings.
/// It stands above their wake.
#[test]
fn invariant_a_tail_does_not_hide_that_the_wake_of_the_wings_is_short() {
    for way in ["0.14", "0.2"] {
        let set = format!("air.max_wake_distance_m={way}");
        let high = TAIL.replace("-0.25, 0, 0", "-0.25, 0, -0.3");
        let [alone, with_tail] = [&[WINGS][..], &[WINGS, &high]].map(|parts| {
            let kept = kept_wake(&glider(parts, &set).setup).unwrap();
            kept.is_short.unwrap()
        });
        assert_eq!(alone, with_tail, "{way} m");
    }
    let long = glider(&[WINGS, TAIL], "air.max_wake_distance_m=0.8");
    assert_eq!(kept_wake(&long.setup).unwrap().is_short, None);
    let step = way_in_a_step(&glider(&[WINGS, TAIL], "time.steps=10").setup);
    assert!((step - 6.0 * 0.006 / 0.05).abs() < 1e-12, "{step}"); // of the tail; roundings
}

/// A tail in the wake of the wings asks for a wake that goes on beyond it by the length of a wing, 0.25 m; the
/// trailing edges are 0.24 m apart. The wings behind a wing ahead, 0.31 m apart, ask for as much of its own
/// 0.09 m.
#[test]
fn behaves_wakes_that_end_before_a_wing_behind_are_named() {
    let short = |parts: &[&str], way: f64| {
        let set = format!("air.max_wake_distance_m={way}");
        kept_wake(&glider(parts, &set).setup).unwrap().is_short
    };
    let ahead = TAIL.replace("-0.25, 0, 0", "0.3, 0, 0");
    for (other, named, long) in [(TAIL, 0.47, 0.52), (&ahead[..], 0.37, 0.43)] {
        let said = short(&[WINGS, other], named).unwrap();
        assert!(said.contains("a tail behind a wing"), "{said}");
        assert_eq!(short(&[WINGS, other], long), None);
    }
    assert_eq!(short(&[WINGS], 0.37), None);
}

/// The mean chord of what is said is that of the keys: all areas over all lengths.
#[test]
fn exact_a_wake_cut_in_mean_chords_reads_back_in_mean_chords() {
    for parts in [&[WINGS][..], &[WINGS, TAIL]] {
        let case = glider(parts, "air.max_wake_distance_chords=12");
        let kept = kept_wake(&case.setup).unwrap();
        assert!((kept.chords - 12.0).abs() < 1e-12, "{}", kept.chords); // roundings
        assert!(kept.said.contains("12.0 mean chords"), "{}", kept.said);
    }
    let chord = glider(&[WINGS, TAIL], "time.steps=10")
        .setup
        .animal
        .mean_chord();
    let exact = (0.25 * 0.08 + 0.09 * 0.05) / (0.25 + 0.09);
    assert!((chord.unwrap() - exact).abs() < 1e-12);
}
