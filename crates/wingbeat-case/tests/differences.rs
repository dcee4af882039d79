//! In which keys two cases differ.

use crate::common::preset;
use wingbeat_case::differences;

#[test]
fn exact_keys_that_differ() {
    let case = |set: &[&str]| preset("rectangular-wing", set);
    let plain = case(&[]);
    assert_eq!(differences(&plain, &plain), []);
    let other = case(&["air.density_kg_m3=2.5", "air.max_wake_rows=7"]);
    let found = differences(&plain, &other);
    let keys: Vec<&str> = found.iter().map(|d| d.key.as_str()).collect();
    assert_eq!(keys, ["air.density_kg_m3", "air.max_wake_rows"]);
    assert_eq!(
        (found[0].second.as_deref(), &found[1].first),
        (Some("2.5"), &None)
    );
}

/// A published set and coefficients of one's own exclude each other; a case has the one or the other.
#[test]
fn exact_what_another_choice_excludes_is_not_there() {
    let case = |set: &[&str]| preset("fruit-fly-blade", set);
    let own = case(&[
        "air.blade.coefficients=",
        "air.blade.own={lift=1.8,drag_0=0.06,drag_90=2.0}",
    ]);
    for (set, name) in [
        // the default, which the coefficients of the other replace
        (vec!["air.blade.coefficients="], "\"dickson-2008\""),
        (
            vec!["air.blade.coefficients=dickinson-1999"],
            "\"dickinson-1999\"",
        ),
    ] {
        let published = case(&set);
        let found = differences(&published, &own);
        let found: Vec<_> = found
            .iter()
            .map(|d| (d.key.as_str(), d.first.as_deref(), d.second.as_deref()))
            .collect();
        let expected = [
            ("air.blade.coefficients", Some(name), None),
            ("air.blade.own.drag_0", None, Some("0.06")),
            ("air.blade.own.drag_90", None, Some("2.0")),
            ("air.blade.own.lift", None, Some("1.8")),
        ];
        assert_eq!(found, expected);
    }
}

/// What is compared is what the resolved cases say, line by line.
#[test]
fn agrees_with_the_resolved_cases() {
    let presets = ["fruit-fly-blade", "fruit-fly-vacuum", "rectangular-wing"];
    let [blade, vacuum, lattice] = presets.map(|name| preset(name, &[]));
    for (a, b) in [(&blade, &vacuum), (&vacuum, &lattice), (&lattice, &blade)] {
        let texts = [a, b].map(|case| case.resolved().parse::<toml::Table>().unwrap());
        for d in differences(a, b) {
            let at = |table: &toml::Table| {
                let mut value = toml::Value::Table(table.clone());
                for part in d.key.split('.') {
                    value = value.get(part)?.clone();
                }
                (!value.is_table()).then_some(value)
            };
            let there = texts.each_ref().map(at).map(|v| v.is_some());
            assert_eq!(there, [d.first.is_some(), d.second.is_some()], "{}", d.key);
        }
    }
}
