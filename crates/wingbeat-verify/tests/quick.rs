//! The short set of the report: what `wingbeat verify --quick` runs, here as a gate.

/// Three quarters of the time of the short set, and tested beside the lattice (`crates/wingbeat-air/tests/verification`):
/// lift slopes of rectangles in `wings`, Theodorsen's lift and moment in `impulse` and `centre_of_pressure`, rings of
/// particles in `particles`. Wings of other outlines, by the same means, stay.
const TESTED_ELSEWHERE: [&str; 3] = ["steady-rectangular", "theodorsen", "vortex-particles"];

/// No analytic case and no benchmark may fail; experiments are only reported.
#[test]
fn agrees_short_set_of_the_report_has_no_failure() {
    let mut cases = wingbeat_verify::select(true, "");
    let all = cases.len();
    cases.retain(|c| !TESTED_ELSEWHERE.contains(&c.name));
    assert!(cases.len() > 10 && cases.len() == all - TESTED_ELSEWHERE.len());
    let report = wingbeat_verify::run(&cases, true, |e| {
        println!("{} {:?}", e.case, e.counts());
    });
    let page = report.page("test");
    let [passed, failed, _] = report.counts();
    assert!(failed == 0 && passed > 50, "{page}");
    assert_eq!(
        report.csv().lines().count(),
        1 + report.counts().iter().sum::<usize>()
    );
    assert!(serde_json::from_str::<serde_json::Value>(&report.json()).is_ok());
}

#[test]
fn exact_names_of_cases_are_unique() {
    let mut names: Vec<_> = wingbeat_verify::select(false, "")
        .iter()
        .map(|c| c.name)
        .collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}
