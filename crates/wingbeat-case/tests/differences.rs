//! In which keys two cases differ.

use wingbeat_case::{LoadedCase, differences};

#[test]
fn exact_keys_that_differ() {
    let case = |set: &[&str]| {
        let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
        LoadedCase::find("rectangular-wing", &set).unwrap()
    };
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
