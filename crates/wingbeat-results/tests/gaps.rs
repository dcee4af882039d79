//! Gaps narrower than the panels are named, in their prescribed motion and as they are flown.

use std::path::Path;

use wingbeat_case::LoadedCase;
use wingbeat_flight::{DoubtKind, Simulation};
use wingbeat_results::summary::Verdict;
use wingbeat_results::{Outcome, Summary};

/// A wing of 40 x 100 mm that lies 1 mm over a ground, or as it is `set`.
fn case(set: &[&str]) -> LoadedCase {
    let text = r#"
        format = 1
        gravity_m_s2 = [0, 0, 0]
        time = { step_s = 1e-3, steps = 3 }
        flight.mode = "tethered"
        body = { mass_kg = 1, inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0] }
        [air]
        density_kg_m3 = 1.2
        stream_m_s = [-1, 0, 0]
        shed = ["trailing"]
        body = false
        ground = { point_m = [0, 0, 1e-3], normal = [0, 0, -1] }
        [wing.right]
        mirror = false
        hinge_m = [0, 0, 0]
        mass_kg = 0.005
        motion.phi.constant_deg = 0
        planform.rectangle = { chord_m = 0.04, span_m = 0.1, axis_fraction = 0.25 }
        mesh = { chordwise = 4, spanwise = 5 }
    "#;
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    LoadedCase::from_text("gaps", text, Path::new(""), &set).unwrap()
}

/// What is said of gaps before the flight.
fn doubts(set: &[&str]) -> Vec<String> {
    let all = case(set).setup.doubts().into_iter();
    let gaps = all.filter(|d| d.kind == DoubtKind::NarrowGaps);
    gaps.map(|d| d.said).collect()
}

/// The panels are 10 mm long, its image is 2 mm away: with 20 panels they are as short as that.
#[test]
fn behaves_wings_low_over_a_ground_are_named_with_the_remedy() {
    let [said] = &doubts(&[])[..] else {
        panic!("{:?}", doubts(&[]));
    };
    for part in [
        "wing `right` faces its own mirror image in air.ground",
        "gaps of 2.00e-3 m",
        "panels are 1.00e-2 m long",
        "over 100 % of the area",
        "in 100 % of the beat",
        "up to 80 %",
        "give 20 panels along the chord",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    for silent in [
        "wing.right.mesh.chordwise=20",
        "air.ground.point_m=[0, 0, 4e-3]",
        "wing.right.motion.phi.constant_deg=-30",
        "flight.mode=free",
    ] {
        assert_eq!(doubts(&[silent]), [""; 0], "{silent}");
    }
}

/// Upright wings 1 mm from each other are named once, and so is a wing that comes down to the ground on its tether.
#[test]
fn behaves_wings_beside_each_other_and_wings_that_come_down_are_named() {
    let both = ["wing.right.mirror=true", "wing.right.hinge_m=[0, 5e-4, 0]"];
    let upright = [
        "wing.right.motion.phi.constant_deg=90",
        "air.ground.point_m=[0, 0, 1]",
    ];
    let said = doubts(&[both, upright].concat());
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains("faces wing `"), "{said:?}");
    let apart = ["wing.right.hinge_m=[0, 5e-3, 0]"];
    assert_eq!(doubts(&[&both[..], &upright, &apart].concat()), [""; 0]);
    let other_air = [
        "air.model=blade_element",
        "air.ground=",
        "air.shed=",
        "air.body=",
    ];
    assert_eq!(
        doubts(&[&both[..], &upright[..1], &other_air].concat()),
        [""; 0]
    );
    let sinks = [
        "air.ground.point_m=[0, 0, 0.0322]",
        "flight.velocity_m_s=[0, 0, 0.5]",
        "time.steps=60",
    ];
    let said = doubts(&sinks);
    assert!(said[0].contains("in 2 % of the beat"), "{said:?}");
    assert_eq!(doubts(&[&sinks[..2], &["time.steps=50"]].concat()), [""; 0]);
}

/// A free body over a ground is not known beforehand: its summary says what it flew.
#[test]
fn behaves_summaries_of_free_flights_name_gaps_that_were_flown() {
    for (height, is_named) in [("1e-3", true), ("0.1", false)] {
        let ground = format!("air.ground.point_m=[0, 0, {height}]");
        let case = case(&["flight.mode=free", &ground]);
        let mut flight = Simulation::new(case.setup.clone()).unwrap();
        let mut records = vec![flight.record().clone()];
        while !flight.finished() {
            records.push(flight.step().unwrap().clone());
        }
        let summary = Summary::of(&case.setup, &records, &Outcome::Finished);
        let said = (summary.warnings.iter()).find(|w| w.contains("Gaps narrower than the panels"));
        assert_eq!(said.is_some(), is_named, "{:?}", summary.warnings);
        if let Some(said) = said {
            assert!(said.contains("of the flight"), "{said}");
            assert!(summary.verdict >= Verdict::Amber);
        }
    }
}
