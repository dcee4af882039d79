//! Left and right: which wings are a pair, and what one that is given apart takes from the other.

use std::path::Path;

use wingbeat_case::{LoadedCase, case_of};
use wingbeat_model::Side;

use crate::common::{self, found, refusal};
use crate::idle::ANIMAL;

/// Doubts about an animal of two pairs of wings on one hinge on either side; strokes of the right ones \[deg\].
fn doubts(names: [&str; 2], strokes: [f64; 2], more: &str) -> String {
    let (before, after) = ANIMAL.split_once("[wing.right]").unwrap();
    let (wing, air) = after.split_once("[air]").unwrap();
    let mut text = before.to_owned();
    for (name, stroke) in names.into_iter().zip(strokes) {
        let wing = wing.replace("wing.right", &format!("wing.{name}"));
        let wing = wing.replace("60.0", &stroke.to_string());
        text += &format!("[wing.{name}]{wing}");
    }
    text += &format!("[air]\nmodel = \"blade_element\"\n{air}{more}");
    let case = LoadedCase::from_text("pairs", &text, Path::new(""), &[]).unwrap();
    wingbeat_analysis::estimate(&case.setup).doubts.join("\n")
}

const AGAINST: &str = "stroke against each other";

/// Of an X-wing each wing strokes against that above it, and with its image on the other side.
#[test]
fn behaves_wings_of_one_hinge_are_pairs_by_their_names() {
    let said = doubts(["upper-right", "lower-right"], [25.0, -25.0], "");
    assert!(!said.contains(AGAINST), "{said}");
    let left = "[wing.upper-left]\nmotion.phi.fourier = { sine_deg = [25.0] }\n";
    let said = doubts(["upper-right", "lower-right"], [25.0, -25.0], left);
    let wanted = format!("wings `upper-left` and `upper-right` {AGAINST}");
    assert_eq!(said.matches(AGAINST).count(), 1, "{said}");
    assert!(said.contains(&wanted), "{said}");
}

/// The side of a wing is a word of its name: `upright-left` is a left wing, and has its image on the right.
#[test]
fn behaves_sides_of_wings_are_words_of_their_names() {
    let wings = |name: &str| {
        let text = ANIMAL.replace("wing.right", &format!("wing.{name}"));
        let case = LoadedCase::from_text("case", &text, Path::new(""), &[]);
        let named = |c: LoadedCase| c.setup.animal.wings.into_iter().map(|w| (w.name, w.side));
        case.map(|c| named(c).collect::<Vec<_>>())
            .map_err(|e| e.to_string())
    };
    for (name, image) in [
        ("upright-right", "upright-left"),
        ("bright_right2", "bright_left2"),
        ("rightWing", "leftWing"),
    ] {
        let found = wings(name).unwrap();
        let side = |name: &str| found.iter().find(|w| w.0 == name).map(|w| w.1);
        assert_eq!(side(name), Some(Side::Right), "{found:?}");
        assert_eq!(side(image), Some(Side::Left), "{found:?}");
    }
    for name in ["left-of-right", "upright", "rightwing"] {
        let said = wings(name).unwrap_err();
        assert!(
            said.contains(&format!("wing.{name}.side")) && said.contains("one word of its name"),
            "{said}"
        );
    }
}

#[test]
fn refuses_part_of_a_table_whose_counterpart_has_more() {
    for (set, says) in [
        (
            &["wing.left.planform.beta.length_m=2.2e-3"][..],
            "r2_hat: this key is missing",
        ),
        (
            &[
                "wing.left.planform.beta.length_m=2.2e-3",
                "wing.left.planform.beta.r2_hat=0.6",
            ],
            "the chord is missing",
        ),
    ] {
        let said = refusal("fruit-fly-blade", set);
        let whole = "[wing.left.planform] takes the place of the whole of [wing.right.planform]";
        assert!(said.contains(says) && said.contains(whole), "{said}");
        assert!(
            !said.contains("[wing.right]\n"),
            "not the line of the other: {said}"
        );
        assert!(said.contains("(set on top of"), "{said}");
    }
}

#[test]
fn refuses_a_hinge_far_off_with_what_may_carry_it() {
    let said = refusal(
        "fruit-fly-hover",
        &["wing.right.hinge_m=[-9e-3, 0.1e-3, 0]"],
    );
    assert!(said.contains("a slim [body.part.boom]"), "{said}");
}

/// A rigid wing beside an elastic one: said by one key, kept by what is written of the setup, refused where it is
/// nothing.
#[test]
fn behaves_one_wing_of_a_pair_may_be_rigid() {
    let rigid = ["wing.left.structure.rigid=true", "air.mirror=false"];
    let case = found("hawkmoth-elastic", &rigid).unwrap();
    let bends = |setup: &wingbeat_flight::FlightSetup| -> Vec<(String, bool)> {
        let wings = setup.animal.wings.iter();
        wings
            .map(|w| (w.name.clone(), w.structure.is_some()))
            .collect()
    };
    let wanted = [("left".to_owned(), false), ("right".to_owned(), true)];
    assert_eq!(bends(&case.setup), wanted);
    let [left, right] = &case.setup.animal.wings[..] else {
        panic!("two wings")
    };
    assert!((left.mass.mass / right.mass.mass - 1.0).abs() < 1e-14);
    assert_eq!(bends(&case_of(&case.setup, None).unwrap().setup), wanted);
    for (preset, key, says) in [
        ("hawkmoth-blade", rigid[0], "true has no effect"),
        (
            "hawkmoth-elastic",
            "wing.left.structure={ rigid = true, damping_s = 1e-4 }",
            "made of nothing that bends",
        ),
    ] {
        let said = found(preset, &[key]).unwrap_err();
        assert!(said.contains(says), "{said}");
    }
}

/// Of a pair one wing may have nodes, which are its mesh, and the other an outline that a mesh divides; the mesh of a wing
/// with nodes has no effect.
#[test]
fn exact_one_wing_of_a_pair_may_have_nodes_and_the_other_a_mesh() {
    let nodes =
        "planform.nodes_m = [[[0, 0, 0], [0, -2e-3, 0]], [[-1e-3, 0, 0], [-1e-3, -2e-3, 0]]]";
    let text = ANIMAL.replace("[air]", &format!("[wing.left]\n{nodes}\n[air]"));
    let panels = |text: &str| {
        let case = common::load(text, &[])?;
        let wings = case.setup.animal.wings.iter();
        Ok::<_, String>(
            wings
                .map(|w| (w.mesh.rows, w.mesh.cols))
                .collect::<Vec<_>>(),
        )
    };
    let alone = panels(ANIMAL).unwrap();
    assert_eq!(panels(&text).unwrap(), [(1, 1), alone[1]]);
    let own = text.replace(nodes, &format!("mesh.spanwise = 3\n{nodes}"));
    let said = panels(&own).unwrap_err();
    assert!(
        said.contains("wing.left.mesh") && said.contains("no effect"),
        "{said}"
    );
}
