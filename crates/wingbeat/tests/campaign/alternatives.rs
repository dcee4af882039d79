//! Keys that are given instead of others: what is taken out of the case and what varies are one change.

use std::fs;

use wingbeat::Flight;

use crate::support::{Scratch, flown, wingbeat};
use crate::{merged, numbers};

/// A campaign over the area of a wing whose case gives its chord.
fn areas(list: &str) -> String {
    format!(
        r#"case = "fruit-fly-blade"
keep = ["power_watt"]
remove = ["wing.right.planform.beta.mean_chord_m"]
[set]
"time.beats" = 1
"time.steps_per_beat" = 40
[parameter."wing.right.planform.beta.area_m2"]
list = {list}
"#
    )
}

#[test]
fn exact_a_key_varies_instead_of_one_that_is_removed() {
    let scratch = Scratch::new("campaign-alternatives");
    let dir = &scratch.0;
    fs::write(dir.join("c.toml"), areas("[1.6e-6, 1.7e-6]")).unwrap();
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    let keys = [
        "wing.right.planform.beta.mean_chord_m=",
        "wing.right.planform.beta.area_m2=1.7e-6",
        "time.beats=1",
        "time.steps_per_beat=40",
    ];
    let flight = Flight::preset_with("fruit-fly-blade", &keys).unwrap();
    let alone = flight.fly().unwrap().beats()[0].power_watt;
    assert_eq!(numbers(dir, "r", "power_watt")[1], alone); // to the bit
}

#[test]
fn refuses_values_and_removals_at_their_lines() {
    let scratch = Scratch::new("campaign-alternatives-wrong");
    let dir = &scratch.0;
    let said = |text: &str| {
        fs::write(dir.join("c.toml"), text).unwrap();
        let out = wingbeat(dir, &["campaign", "check", "c.toml"]);
        assert_eq!(out.status.code(), Some(2));
        String::from_utf8_lossy(&out.stderr).into_owned()
    };
    let of_value = said(&areas("[-1.6e-6, 1.7e-6]"));
    assert!(of_value.contains("c.toml:8:"), "{of_value}");
    // What the removal leaves out is not what varies.
    let other = areas("[0.5, 0.6]").replace("area_m2", "axis_fraction");
    let of_removal = said(&other);
    for says in ["c.toml:3:", "the chord is missing"] {
        assert!(of_removal.contains(says), "{of_removal}");
    }
}
