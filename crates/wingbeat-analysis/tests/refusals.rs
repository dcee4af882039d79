//! What an analysis refuses, and in which words.

use std::sync::Arc;

use crate::common;

use wingbeat_analysis::{AnalysisError, Beat, TrimProblem, TrimSettings, trim};
use wingbeat_dynamics::Wrench;
use wingbeat_flight::{Air, AirMemory, AirModel, AirScratch, FlightError, Instant};
use wingbeat_math::DVec3;

#[test]
fn refuses_a_trim_without_weight_by_name() {
    let mut setup = common::fly();
    setup.gravity = DVec3::ZERO;
    let said = trim(&setup, &common::hover(20)).unwrap_err().to_string();
    assert!(said.contains("gravity_m_s2"), "{said}");
}

/// Forward, right and up are those of n1, n2 and -n3.
#[test]
fn refuses_a_trim_whose_gravity_is_not_down_along_n3() {
    for (gravity, off) in [(-9.81 * DVec3::Z, "180"), (9.81 * DVec3::X, "90")] {
        let mut setup = common::fly();
        setup.gravity = gravity;
        let said = trim(&setup, &common::hover(20)).unwrap_err().to_string();
        assert!(
            said.contains(&format!("{off} degrees off n3 (gravity_m_s2"))
                && said.contains("up -n3"),
            "{said}"
        );
    }
}

#[test]
fn refuses_a_beat_of_a_case_without_wings_in_words_that_fit() {
    let mut setup = common::fly();
    setup.animal.wings.clear();
    let said = Beat::new(&setup, 20).unwrap_err().to_string();
    assert!(
        said.contains("no beating wings") && !said.contains("frequency"),
        "{said}"
    );
}

/// Wings that differ, where only the plane of symmetry is asked, are named before the first Newton step.
#[test]
fn refuses_wings_that_differ_before_it_searches() {
    let mut problem = common::hover(40);
    problem.settings = TrimSettings {
        iterations: 0,
        ..problem.settings
    };
    let mut setup = common::fly();
    assert!(trim(&setup, &problem).is_ok());
    setup.animal.wings[0].hinge_b.y *= 1.1;
    let found = trim(&setup, &problem);
    assert!(matches!(found, Err(AnalysisError::Asymmetric { .. })));
}

/// Programs that take no notice of the ranges are refused by the analysis itself: nothing cancels, nothing is
/// left to Newton's steps.
#[test]
fn refuses_trims_out_of_range_before_they_search() {
    type Change = fn(&mut TrimProblem);
    let cases: [(Change, &str); 7] = [
        (|p| p.velocity.x = 340.0, "below that of sound"),
        (
            |p| p.velocity = DVec3::new(500.0, 0.0, -500.0),
            "below that of sound",
        ),
        (|p| p.velocity.z = f64::NAN, "below that of sound"),
        (|p| p.turn_rate = f64::INFINITY, "a turn by inf rad/s"),
        (|p| p.turn_rate = -1e4, "whole turns in a wingbeat"),
        (|p| p.settings.steps = 19, "in 19 steps per wingbeat"),
        (|p| p.settings.steps = 2_001, "in 2001 steps per wingbeat"),
    ];
    for (change, words) in cases {
        let mut problem = common::hover(40);
        change(&mut problem);
        let said = trim(&common::fly(), &problem).unwrap_err().to_string();
        assert!(said.contains(words), "{said}");
    }
}

/// Air that says that time or place changes its loads.
#[derive(Debug)]
struct Gusty;

impl Air for Gusty {
    fn loads(
        &self,
        _at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        _out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        Ok(())
    }

    fn is_steady_and_uniform(&self) -> bool {
        false
    }
}

#[test]
fn refuses_trims_in_own_air_that_changes_in_words_of_its_own() {
    let mut setup = common::fly();
    setup.air = AirModel::Own(Arc::new(Gusty));
    let said = trim(&setup, &common::hover(20)).unwrap_err().to_string();
    assert!(
        said.contains("is_steady_and_uniform") && !said.contains("gust"),
        "{said}"
    );
}

/// A beat that pitches past a right angle, in air far too fast, turns in the plane of symmetry all the same.
#[test]
fn behaves_a_symmetric_beat_that_turns_over_is_not_taken_for_one_that_differs() {
    for speed in [10.0, -100.0] {
        let mut problem = common::hover(40);
        problem.velocity.x = speed;
        match trim(&common::fly(), &problem) {
            Ok(found) => assert!(!found.solution.converged && found.solution.lateral < 1e-12),
            Err(e) => assert!(!matches!(e, AnalysisError::Asymmetric { .. }), "{e}"),
        }
    }
}
