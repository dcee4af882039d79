//! Loops that close on wings and on what wings carry.

use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;

/// A crank that turns and a link, for a wing on a hinge: a four-bar linkage.
const CRANK_AND_LINK: &str = r#"format = 1
name = "four-bar"
[time]
step_s = 0.0005
steps = 4
[motion]
frequency_hz = 5
[flight]
mode = "tethered"
pitch_deg = 25
[air]
model = "none"
[body]
mass_kg = 1.0
inertia_about_centre_kg_m2 = [0.1,0.2,0.25,0,0,0]
[wing.right]
mirror = false
hinge_m = [0.1, 0.15, -0.05]
mass_kg = 0.1
planform.rectangle = { span_m = 0.6, chord_m = 0.2 }
[wing.right.motion]
phi.constant_deg = 10
[joint.h]
child = "right"
kind = "revolute"
axis = [1,0,0]
[[joint.h.element]]
damping_newton_m_s_per_rad=0.01
[segment.crank]
mass_kg = 0.02
centre_m = [0.1, 0.03, 0.1]
inertia_about_centre_kg_m2 = [1e-5,1e-5,1e-5,0,0,0]
[segment.link]
mass_kg = 0.03
centre_m = [0.1, 0.12, 0.05]
inertia_about_centre_kg_m2 = [5e-5,4e-5,3e-5,0,0,0]
[joint.a_crank]
child = "crank"
at_m = [0.1, 0.05, 0.15]
kind = "weld"
turn = { axis=[1,0,0], sine_deg=[15], frequency_hz=5 }
[joint.b_link]
parent = "crank"
child = "link"
at_m = [0.1, 0.10, 0.14]
kind = "revolute"
axis = [1,0,0]
"#;

/// A segment on the wing 0.05 m from its hinge, where the link ends.
const TAB: &str = r#"[segment.tab]
mass_kg = 1e-4
centre_m = [0, 0, 0]
inertia_about_centre_kg_m2 = [1e-8, 1e-8, 1e-8, 0, 0, 0]
[joint.c_atab]
parent = "right"
child = "tab"
at_m = [0, 0.05, 0]
"#;

/// Largest angle of a joint at the start \[rad\], the linkage closed by a joint with these lines.
fn angle(tab: bool, lines: &str) -> Result<f64, String> {
    let tab = if tab { TAB } else { "" };
    let text = format!(
        "{CRANK_AND_LINK}{tab}[joint.c_close]\nkind = \"point_on_line\"\naxis = [1, 0, 0]\n{lines}\n"
    );
    let case = LoadedCase::from_text("four-bar", &text, Path::new(""), &[]);
    let flight =
        Simulation::new(case.map_err(|e| e.to_string())?.setup).map_err(|e| e.to_string())?;
    // Those of the wing and of the link; then come those of the joint that closes the loop.
    let angles = flight.record().joints[..2].iter().map(|j| j[0].abs());
    Ok(angles.fold(0.0, f64::max))
}

/// The end of the link, body axes; the link ends at the tab as it is drawn, so that all joints start at 0.
const TIP: &str = "at_m = [0.1, 0.19924038765061, -0.04131759111665]";

#[test]
fn exact_a_segment_that_a_wing_carries_closes_a_loop_by_its_joint() {
    let of = "parent = \"link\"\nchild = \"tab\"";
    for point in ["", "at_child_m = [0, 0, 0]"] {
        let angle = angle(true, &format!("{of}\n{TIP}\n{point}")).unwrap();
        assert!(angle.abs() < 1e-9, "{point}: {angle}");
    }
    // The other way round the point on the link is needed, in body axes.
    let reversed = |point: &str| {
        angle(
            true,
            &format!("parent = \"tab\"\nchild = \"link\"\nat_m = [0, 0, 0]\n{point}"),
        )
    };
    let error = reversed("").unwrap_err();
    assert!(
        error.contains("joint.c_close.at_child_m") && error.contains("missing"),
        "{error}"
    );
    let angle = reversed(&TIP.replace("at_m", "at_child_m")).unwrap();
    assert!(angle.abs() < 1e-9, "{angle}");
}

/// Without the tab: from a point of the wing, in wing axes, to the end of the link.
#[test]
fn exact_a_loop_closes_at_any_point_of_a_wing() {
    let of = "parent = \"right\"\nchild = \"link\"\nat_m = [0, 0.05, 0]";
    let angle = angle(
        false,
        &format!("{of}\n{}", TIP.replace("at_m", "at_child_m")),
    )
    .unwrap();
    assert!(angle.abs() < 1e-9, "{angle}");
}
