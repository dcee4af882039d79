//! Panels of cosine spacing and cores beside short panels, in cases.

use crate::common::found;
use wingbeat_case::{LoadedCase, presets::PRESETS};
use wingbeat_flight::FlightSetup;

fn bird(set: &[&str]) -> Result<FlightSetup, String> {
    Ok(found("bird-cruise", set)?.setup)
}

/// Control points in the middles of unequal rings make an error that more panels do not remove: refused by name.
#[test]
fn refuses_cosine_spacing_on_rings_of_the_benchmark() {
    for way in ["chordwise", "spanwise"] {
        let cosine = format!("wing.right.mesh.{way}_spacing=cosine");
        for inset in [
            "air.scheme=benchmark",
            "air.ring_inset=0",
            "air.ring_inset=0.1",
        ] {
            let refused = bird(&["wing.right.mesh.chordwise=6", &cosine, inset]).unwrap_err();
            for part in [
                &format!("{way}_spacing"),
                "\"cosine\"",
                "air.ring_inset",
                "\"accurate\"",
            ] {
                assert!(refused.contains(part), "{inset}: {refused}");
            }
        }
        bird(&["wing.right.mesh.chordwise=6", &cosine]).unwrap();
    }
    // Two panels of cosine spacing are alike.
    let two = [
        "wing.right.mesh.chordwise=2",
        "wing.right.mesh.chordwise_spacing=cosine",
    ];
    bird(&[&two[..], &["air.scheme=benchmark"]].concat()).unwrap();
}

/// Lift of panels as long as five of their cores is 1 % high.
#[test]
fn behaves_cores_wide_beside_panels_are_named() {
    // Of a fiftieth of the chord.
    let wide = |panels: usize, spacing: &str| {
        let panels = format!("wing.right.mesh.chordwise={panels}");
        let spacing = format!("wing.right.mesh.chordwise_spacing={spacing}");
        bird(&[&panels, &spacing]).unwrap().wide_bound_core()
    };
    assert_eq!(wide(8, "uniform"), None);
    assert_eq!(wide(4, "cosine"), None);
    for text in [wide(16, "uniform"), wide(8, "cosine")] {
        let text = text.expect("named");
        for part in ["air.bound_core", "`right`", "mesh.chordwise"] {
            assert!(text.contains(part), "{text}");
        }
    }
}

/// No preset has cores wide beside its panels.
#[test]
fn behaves_presets_have_narrow_bound_cores() {
    for preset in PRESETS {
        let case = LoadedCase::find(preset.name, &[]).unwrap();
        assert_eq!(case.setup.wide_bound_core(), None, "{}", preset.name);
    }
}
