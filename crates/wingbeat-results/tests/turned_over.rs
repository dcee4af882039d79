//! What the summary says of wings that turn over on passive hinges.

use wingbeat_results::Summary;
use wingbeat_results::summary::Verdict;

use crate::flights::{flown, preset, says};

const SOFT: &str = "{ stiffness_newton_m_per_rad = 2.4e-6, damping_newton_m_s_per_rad = 2e-9 }";

/// The robot bee in blade elements with other hinges.
fn fly(set: &[&str]) -> Summary {
    let blades = ["air.model=blade_element"];
    flown(&preset("robobee", &[&blades, set].concat()))
}

fn names_turned(s: &Summary) -> bool {
    let turned = says(s, "Wings that turn over");
    assert!(!turned || s.verdict >= Verdict::Amber);
    turned
}

/// A hinge with a spring \[N m/rad\] and without a stop.
fn hinge(stiffness: &str) -> String {
    format!(
        "joint.hinge-right.element=[{{ stiffness_newton_m_per_rad = {stiffness}, damping_newton_m_s_per_rad = 2e-10 }}]"
    )
}

/// The hinge without its stop, as soft as that the air turns the wing over at mid stroke, and as stiff as that it turns
/// it by less than 90 deg.
#[test]
fn behaves_wings_that_turn_over_on_their_hinges_are_named() {
    let soft = fly(&[&hinge("2.4e-6")]);
    assert!(names_turned(&soft), "{:?}", soft.warnings);
    assert!(says(&soft, "give the hinge a stop"), "{:?}", soft.warnings);
    let stiff = fly(&[&hinge("2e-5")]);
    assert!(!names_turned(&stiff), "{:?}", stiff.warnings);
}

/// The chord counts, not the coordinate of the hinge: a wing that is mounted at 45 deg turns over by 62 deg more, and is
/// upright where its hinge has turned by -45.
#[test]
fn behaves_wings_turn_over_by_their_chords_wherever_the_rest_of_their_hinges_is() {
    let mounted = |lower: f64, upper: f64| {
        let stop = format!(
            "joint.hinge-right.element=[{SOFT},{{ stop = {{ lower_deg = {lower}, upper_deg = {upper}, stiffness_newton_m_per_rad = 5e-4, damping_s_per_rad = 1e-3 }} }}]"
        );
        fly(&[
            &stop,
            "wing.right.motion.psi.constant_deg=45",
            "time.steps_per_beat=320",
        ])
    };
    let over = mounted(-80.0, 80.0);
    assert!(names_turned(&over), "{:?}", over.warnings);
    assert!(says(&over, "stiffer stops"), "{:?}", over.warnings);
    let upright = mounted(-120.0, 30.0);
    assert!(!names_turned(&upright), "{:?}", upright.warnings);
}

/// A wing that is welded to a spar which hangs on the hinge.
#[test]
fn behaves_wings_that_turn_over_with_what_carries_them_are_named() {
    let carried = fly(&[
        "segment.spar={mass_kg=1e-8,centre_m=[0,0,0],inertia_about_centre_kg_m2=[1e-16,1e-16,1e-16,0,0,0]}",
        "joint.hinge-right=",
        "joint.a={child=\"spar\",at_m=[0,2e-3,-5e-3],kind=\"revolute\",axis=[0,1,0],element=[{stiffness_newton_m_per_rad=2.4e-6,damping_newton_m_s_per_rad=2e-10}]}",
        "time.beats=2",
        "joint.b={child=\"right\",parent=\"spar\"}",
    ]);
    assert!(names_turned(&carried), "{:?}", carried.warnings);
    assert!(says(&carried, "joint `a`"), "{:?}", carried.warnings);
}

/// A stop that is reached is named, with how far it gives way, and what to do where that is more than 5 deg; one that is not
/// reached is not named.
#[test]
fn behaves_stops_that_are_reached_are_named() {
    let stopped = |end: f64, stiffness: &str| {
        let stop = format!(
            "joint.hinge-right.element=[{{ stiffness_newton_m_per_rad = 2.4e-6, damping_newton_m_s_per_rad = 2e-10 }}, {{ stop = {{ lower_deg = -{end}, upper_deg = {end}, stiffness_newton_m_per_rad = {stiffness}, damping_s_per_rad = 1e-3 }} }}]"
        );
        fly(&[&stop, "time.steps_per_beat=320", "time.beats=2"])
    };
    let [hard, soft, away] = [
        stopped(50.0, "2e-3"),
        stopped(50.0, "2e-6"),
        stopped(179.0, "5e-4"),
    ];
    let of = |s: &Summary| {
        s.warnings
            .iter()
            .find(|w| w.starts_with("Stops: "))
            .cloned()
    };
    println!("{:?}\n{:?}", of(&hard), of(&soft));
    let said = of(&hard).unwrap();
    assert!(said.contains(
        "joints `hinge-left` and `hinge-right` went beyond the stop from -50.0 to 50.0 deg"
    ));
    assert!(!said.contains("stiffer"));
    let said = of(&soft).unwrap();
    assert!(said.contains("a stiffer one"), "{said}");
    assert_eq!(of(&away), None);
}
