//! What is doubted of wings that loads bend.

use std::path::Path;

use crate::common::preset;
use wingbeat_analysis::estimate;
use wingbeat_case::LoadedCase;

fn doubts(set: &[&str]) -> String {
    let coarse = [
        "wing.right.mesh.chordwise=4",
        "wing.right.mesh.spanwise=4",
        "time.steps=10",
    ];
    let set: Vec<&str> = [&coarse[..], set].concat();
    estimate(&preset("membrane-wing", &set).setup)
        .doubts
        .join("\n")
}

/// A film that is held all round vibrates about rest as its bending has it, and flies as its stretching has it: neither
/// that frequency nor damping over it says that a number is wrong. One that is free of its frame is too soft.
#[test]
fn behaves_films_on_frames_are_not_doubted_for_bending_little() {
    let thin = "wing.right.structure.shell.bending_factor=1e-9";
    let held = doubts(&[thin]);
    assert!(
        !held.contains("frequency") && !held.contains("damping ratio"),
        "{held}"
    );
    let shell = "wing.right.structure.shell";
    let free = [
        format!("{shell}.clamped_perimeter=false"),
        format!("{shell}.clamped_leading_edge=true"),
    ];
    let free = doubts(&[thin, &free[0], &free[1]]);
    assert!(
        free.contains("so soft a wing does not follow its root"),
        "{free}"
    );
}

/// Tensions that no sheet bears: latex of 440 N/m against stretching.
#[test]
fn behaves_tensions_beyond_the_stretching_of_a_sheet_are_doubted() {
    let with = |tension: &str| {
        doubts(&[&format!(
            "wing.right.structure.shell.prestress_newton_per_m={tension}"
        )])
    };
    let doubt = "prestress_newton_per_m in N/m";
    assert!(!with("[40, 40]").contains(doubt), "{}", with("[40, 40]"));
    assert!(with("[5000, 5000]").contains(doubt));
    assert!(with("[0, 5000]").contains(doubt));
}

/// Damping that lets a wing creep: the key that it is of is named.
#[test]
fn behaves_damping_that_creeps_is_named_by_its_key() {
    let stretched = "wing.right.structure.shell.prestress_newton_per_m=[20, 20]";
    let with = |strain_rate: &str, mass: &str| {
        let keys = [
            format!("wing.right.structure.damping_s={strain_rate}"),
            format!("wing.right.structure.mass_damping_per_s={mass}"),
        ];
        doubts(&[stretched, &keys[0], &keys[1]])
    };
    let [strain_rates, momentum] = ["structure.damping_s is", "structure.mass_damping_per_s is"];
    let slow = with("0", "1e4");
    assert!(
        slow.contains(momentum) && !slow.contains(strain_rates),
        "{slow}"
    );
    let fast = with("1", "0");
    assert!(
        fast.contains(strain_rates) && !fast.contains(momentum),
        "{fast}"
    );
}

/// Goland's wing with its stiffness in N mm2: no matter is so stiff, while its first frequency is that of torsion still.
#[test]
fn behaves_beams_stiffer_than_any_matter_are_doubted() {
    let text = include_str!("../../wingbeat-verify/data/goland-strips.toml");
    let with = |set: &[String]| {
        let case = LoadedCase::from_text("goland", text, Path::new("."), set).unwrap();
        estimate(&case.setup).doubts.join("\n")
    };
    let doubt = "no matter is so stiff for its weight";
    assert!(!with(&[]).contains(doubt), "{}", with(&[]));
    let wing = "wing.right.structure.beam";
    for key in [
        "flap_newton_m2=[9.77e12, 9.77e12]",
        "torsion_newton_m2=[9.87e11, 9.87e11]",
    ] {
        let said = with(&[format!("{wing}.{key}")]);
        assert!(said.contains(doubt), "{key}: {said}");
    }
}
