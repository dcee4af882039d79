//! What the summary says of wings that turn over on passive hinges.

use wingbeat_results::summary::Verdict;

use crate::flights::{flown, preset, says};

/// The hinge of a robot bee without its stop, as soft as that the air turns the wing over at mid stroke, and as stiff as
/// that it turns it by less than 90 deg.
#[test]
fn behaves_wings_that_turn_over_on_their_hinges_are_named() {
    let fly = |stiffness: &str| {
        let element = format!(
            "joint.hinge-right.element=[{{ stiffness_newton_m_per_rad = {stiffness}, damping_newton_m_s_per_rad = 2e-10 }}]"
        );
        let set = [&element, "air.model=blade_element", "time.beats=3"];
        flown(&preset("robobee", &set))
    };
    let soft = fly("2.4e-6");
    assert!(says(&soft, "turned by"), "{:?}", soft.warnings);
    assert!(
        says(&soft, "from the rest of its hinge"),
        "{:?}",
        soft.warnings
    );
    assert!(soft.verdict >= Verdict::Amber);
    let stiff = fly("2e-5");
    assert!(!says(&stiff, "from the rest"), "{:?}", stiff.warnings);
}
