//! What an analysis refuses, and in which words.

use crate::common;

use wingbeat_analysis::{Beat, trim};
use wingbeat_math::DVec3;

#[test]
fn refuses_a_trim_without_weight_by_name() {
    let mut setup = common::fly();
    setup.gravity = DVec3::ZERO;
    let said = trim(&setup, &common::hover(20)).unwrap_err().to_string();
    assert!(said.contains("gravity_m_s2"), "{said}");
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
