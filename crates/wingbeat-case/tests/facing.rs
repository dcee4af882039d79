//! What is doubted of a flight, whichever way it faces and however its parts are joined.

use crate::common::preset;
use wingbeat_analysis::estimate;

fn doubts(name: &str, set: &[&str]) -> String {
    estimate(&preset(name, set).setup).doubts.join("\n")
}

/// A flyer that is pitched beyond the vertical faces the way it faced before, and forward is level under any gravity.
#[test]
fn behaves_air_from_behind_is_that_of_the_side_a_flyer_faces() {
    let said = |pitch: f64, velocity: &str, gravity: &str| {
        let set = [
            format!("flight.pitch_deg={pitch}"),
            format!("flight.velocity_m_s={velocity}"),
            format!("gravity_m_s2={gravity}"),
        ];
        let set: Vec<&str> = set.iter().map(String::as_str).collect();
        doubts("fruit-fly-blade", &set).contains("from behind")
    };
    let down = "[0,0,9.81]";
    for pitch in [0.0, 47.5, 80.0, 100.0, 120.0] {
        assert!(!said(pitch, "[3,0,0]", down), "{pitch}");
        assert!(said(pitch, "[-3,0,0]", down), "{pitch}");
    }
    // On end it faces nowhere.
    for pitch in [88.0, 90.0, 92.0] {
        assert!(
            !said(pitch, "[3,0,0]", down) && !said(pitch, "[-3,0,0]", down),
            "{pitch}"
        );
    }
    // The whole flight turned nose up by a right angle: down is along n1, forward along -n3.
    let down = "[9.81,0,0]";
    assert!(!said(137.5, "[3,0,0]", down) && !said(137.5, "[0,0,-3]", down));
    assert!(said(137.5, "[0,0,3]", down));
}

/// Surfaces of segments are panels as those of the body are.
#[test]
fn behaves_a_vortex_core_that_is_wide_beside_panels_of_segments_is_named() {
    let core = ["air.bound_core.algebraic.radius_m=1.2e-4"];
    let said = doubts("fruit-fly-abdomen", &core);
    for part in ["head", "thorax", "abdomen"] {
        let surface = format!("surfaces on the part `{part}`");
        assert!(said.contains(&surface), "{part}: {said}");
    }
}

/// A wing that is alone on its side has no other to pass through.
#[test]
fn behaves_a_long_stroke_of_one_wing_is_named_by_itself() {
    let said = |mirror: bool| {
        let set = [
            format!("wing.right.mirror={mirror}"),
            "motion.data=".to_owned(),
            "wing.right.motion.phi={fourier={sine_deg=[100]}}".to_owned(),
            "wing.right.motion.psi={fourier={cosine_deg=[-45]}}".to_owned(),
        ];
        let set: Vec<&str> = set.iter().map(String::as_str).collect();
        doubts("fruit-fly-tethered", &set)
    };
    let [one, two] = [false, true].map(said);
    assert!(
        one.contains("stroke amplitude 200 deg is above 190"),
        "{one}"
    );
    assert!(!one.contains("pass through"), "{one}");
    assert!(
        two.contains("left and right wing pass through each other"),
        "{two}"
    );
}
