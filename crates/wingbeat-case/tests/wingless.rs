//! Cases without wings: keys that act on wings alone are refused by name.

use std::path::Path;

use crate::common;
use wingbeat_case::LoadedCase;

use crate::idle::{ANIMAL, BLADE};

#[test]
fn refuses_motions_of_wings_that_are_not_there() {
    let wings = ANIMAL.find("[wing.right]").unwrap();
    let none = format!("{}[air]\nmodel = \"none\"\n", &ANIMAL[..wings]);
    let load = |set: &[String]| LoadedCase::from_text("idle", &none, Path::new(""), set);
    load(&[]).unwrap();
    for set in [
        "motion.data=\"fwuav-hawkmoth\"",
        "motion.stroke_plane_pitch_deg=20",
        "motion.phase=0.25",
        "motion.adjust={ stroke_amplitude = 0.1 }",
        "motion.difference={ stroke_offset_deg = 1 }",
        "motion.start=impulsive",
        "motion.start_beats=2",
        "dynamics.wings=massless",
    ] {
        let Err(refused) = load(&[set.to_owned()]) else {
            panic!("{set} is accepted");
        };
        let (key, refused) = (set.split_once('=').unwrap().0, refused.to_string());
        assert!(
            refused.contains(key) && refused.contains("no effect without wings"),
            "{refused}"
        );
    }
}

/// A body in a stream, without wings.
fn body(set: &[&str]) -> Result<LoadedCase, String> {
    let wings = ANIMAL.find("[motion]").unwrap();
    let parts = ANIMAL.find("[body]").unwrap()..ANIMAL.find("[wing.right]").unwrap();
    let time =
        ANIMAL[..wings].replace("steps_per_beat = 20\nbeats = 1", "step_s = 1e-3\nsteps = 5");
    let text = format!("{time}[air]\nstream_m_s = [-1, 0, 0]\n{}", &ANIMAL[parts]);
    common::load(&text, set)
}

#[test]
fn refuses_keys_of_wakes_and_sections_where_there_are_no_wings() {
    let resolved = body(&[]).unwrap().resolved();
    LoadedCase::from_text("again", &resolved, Path::new(""), &[]).unwrap();
    for set in [
        "air.shed=[\"trailing\"]",
        "air.wake_overlap=0.5",
        "air.convection=euler",
        "air.ring_inset=0.1",
        "air.loads=polhamus",
        "air.leading_edge=always",
        "air.leading_edge_threshold=0.3",
        "air.max_wake_rows=5",
        "air.max_wake_age_s=1",
        "air.clearance_m=1e-4",
        "air.clearance_chords=0.2",
        "air.wake_core.algebraic.radius_m=1e-4",
        "air.particles={ after_rows = 3, radius_m = 1e-4 }",
        "air.section_drag={ cd0 = 0.1 }",
    ] {
        let refused = body(&[set]).map(|_| set).unwrap_err();
        let key = set.split('=').next().unwrap();
        let key = key
            .strip_suffix(".algebraic.radius_m")
            .unwrap_or(key)
            .trim();
        let is_named = refused.contains(key) && refused.contains("no effect without wings");
        assert!(is_named, "{set}: {refused}");
    }
}

/// Blade elements of nothing would be a vacuum.
#[test]
fn refuses_blade_elements_without_wings_and_drag() {
    let drag = "air.blade.body_drag={ area_m2 = 1e-6, along = 0.5, across = 1 }";
    let none = "air.blade.body_drag={ area_m2 = 0, along = 0.5, across = 1 }";
    for set in [&[BLADE][..], &[BLADE, none]] {
        let refused = body(set).map(|_| set).unwrap_err();
        let is_named = refused.contains("air.model") && refused.contains("no wings");
        assert!(is_named, "{refused}");
    }
    let resolved = body(&[BLADE, drag]).unwrap().resolved();
    LoadedCase::from_text("again", &resolved, Path::new(""), &[]).unwrap();
    for key in ["rotation=none", "unsteady=jones", "induced_m_s=[0, 0, 1]"] {
        let set = format!("air.blade.{key}");
        let refused = body(&[BLADE, drag, &set]).map(|_| set).unwrap_err();
        assert!(refused.contains("no effect without wings"), "{refused}");
    }
}
