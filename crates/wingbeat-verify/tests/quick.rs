//! The short set of the report: what `wingbeat verify --quick` runs, here as a gate.

/// No analytic case and no benchmark may fail; experiments are only reported.
#[test]
fn agrees_short_set_of_the_report_has_no_failure() {
    let cases = wingbeat_verify::select(true, "");
    assert!(cases.len() > 10);
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
