//! How far from body and segments a hinge may lie.

use std::path::Path;

use wingbeat_case::LoadedCase;

/// A trunk with these keys and a boom behind it that a joint lets turn, on which a tail wing hinges at `at` \[m\].
fn tail(trunk: &str, at: f64) -> Result<LoadedCase, String> {
    let text = format!(
        "format = 1\n[time]\nsteps_per_beat = 40\nbeats = 1\n[flight]\nmode = \"tethered\"\n[motion]\nfrequency_hz = 10\n\
         [air]\nmodel = \"blade_element\"\n[body.part.trunk]\n{trunk}\nmass_kg = 0.02\n[body.part.boom]\nlength_m = 0.2\n\
         diameter_m = 0.004\ncentre_m = [-0.15, 0, 0]\nmass_kg = 0.001\n[segment.tailboom]\nparts = [\"boom\"]\n\
         [joint.boomroot]\nchild = \"tailboom\"\nat_m = [-0.05, 0, 0]\nturn = {{ axis = [0, 1, 0], sine_deg = [10] }}\n\
         [wing.right_tail]\nhinge_m = [{at}, 0.002, 0]\nmass_kg = 1e-4\nmotion.phi.fourier = {{ sine_deg = [5] }}\n\
         planform.rectangle = {{ span_m = 0.05, chord_m = 0.03 }}\n[joint.tail]\nparent = \"tailboom\"\nchild = \"right_tail\"\n"
    );
    LoadedCase::from_text("tail", &text, Path::new(""), &[]).map_err(|e| e.to_string())
}

/// On the end of the boom, 0.19 m behind the trunk of 0.1 m, it may lie: the boom carries it. In millimetres for
/// metres it may not.
#[test]
fn behaves_hinges_on_segments_are_near_what_carries_them() {
    let trunk = "length_m = 0.1\ndiameter_m = 0.02";
    assert_eq!(tail(trunk, -0.24).map(|_| ()), Ok(()));
    let far = tail(trunk, -24.0).map(|_| ()).unwrap_err();
    assert!(
        far.contains("hinge_m") && far.contains("half their extent"),
        "{far}"
    );
}

/// The extent is the largest, not that along b1: beside a trunk that stands.
#[test]
fn behaves_hinges_beside_bodies_that_stand_may_lie_as_far_as_beside_those_that_lie() {
    let text = |direction: &str, hinge: f64| {
        format!(
            "format = 1\n[time]\nsteps_per_beat = 40\nbeats = 1\n[flight]\nmode = \"tethered\"\n[motion]\nfrequency_hz = 10\n\
             [air]\nmodel = \"blade_element\"\n[body.part.trunk]\nlength_m = 0.1\ndiameter_m = 0.02\n\
             direction = {direction}\nmass_kg = 0.02\n[wing.right]\nhinge_m = [0.0, {hinge}, 0.0]\nmass_kg = 1e-4\n\
             motion.phi.fourier = {{ sine_deg = [30] }}\nplanform.rectangle = {{ span_m = 0.1, chord_m = 0.03 }}\n"
        )
    };
    for direction in ["[1, 0, 0]", "[0, 0, 1]"] {
        let found = |hinge| {
            let text = text(direction, hinge);
            LoadedCase::from_text("stand", &text, Path::new(""), &[]).is_ok()
        };
        assert!(found(0.022) && found(0.055) && !found(0.07), "{direction}");
    }
}
