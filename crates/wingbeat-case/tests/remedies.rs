//! What to try, of keys that are nearly right and of choices that stand beside each other.

use crate::common::refusal;

#[test]
fn behaves_what_is_to_be_tried_is_the_key_that_was_meant() {
    for (preset, set, try_this) in [
        (
            "fruit-fly-hover",
            "wing.right.planform.rectangle.chord_m=1e-3",
            "delete wing.right.planform.beta to keep `rectangle`",
        ),
        (
            "robobee",
            "joint.hinge-right.element=[{ stiffness_newton_m_rad = 1e-6 }]",
            "did you mean `stiffness_newton_m_per_rad`?",
        ),
        (
            "fruit-fly-hover",
            "wing.right.planform.beta.offset_m=1e-3",
            "did you mean `root_offset_m`?",
        ),
        (
            "fruit-fly-hover",
            "wing.right.mass_mg=1e-3",
            "`mass_kg`: the unit is part of the key, convert the value",
        ),
    ] {
        let said = refusal(preset, &[set]);
        assert!(said.contains(try_this), "{set}: {said}");
    }
}
