//! The short set of the dossier: what `wingbeat verify --quick` runs, here as a gate.

/// No analytic case and no benchmark may miss; experiments are only reported.
#[test]
fn agrees_short_set_of_the_dossier_has_no_misses() {
    let cases = wingbeat_verify::select(true, "");
    assert!(cases.len() > 10);
    let dossier = wingbeat_verify::run(&cases, true, |e| {
        println!("{} {:?}", e.case, e.counts());
    });
    let page = dossier.page("test");
    let [passed, missed, _] = dossier.counts();
    assert!(missed == 0 && passed > 50, "{page}");
    assert_eq!(
        dossier.csv().lines().count(),
        1 + dossier.counts().iter().sum::<usize>()
    );
    assert!(serde_json::from_str::<serde_json::Value>(&dossier.json()).is_ok());
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
