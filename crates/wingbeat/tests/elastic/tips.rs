//! How far wings are bent, in summaries.

use crate::support::{Scratch, flown, wingbeat};
use crate::{CASE, LATTICE, beam};

/// What the summary, its text and `compare` say of tips is the largest of the columns.
#[test]
fn exact_the_summary_has_the_largest_of_the_tips() {
    let scratch = Scratch::new("elastic-tips");
    let set: Vec<String> = [LATTICE.map(str::to_owned).to_vec(), beam(2e-4).to_vec()].concat();
    std::fs::write(scratch.0.join("c.toml"), CASE).unwrap();
    let sets: Vec<String> = set.iter().map(|s| format!("--set={s}")).collect();
    let run = ["run", "c.toml", "--out", "r", "--quiet"];
    let args: Vec<&str> = run
        .into_iter()
        .chain(sets.iter().map(String::as_str))
        .collect();
    flown(&scratch.0, &args);
    let history = wingbeat::results::History::read(&scratch.0.join("r/history.csv")).unwrap();
    let column = |name: &str| history.column(&name.replace('*', "wing_right")).to_vec();
    let size = |k: usize| {
        let of = |c| column(&format!("tip_*_displacement_w{c}_m"))[k];
        [1, 2, 3].map(of).iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    let largest = |x: Vec<f64>| x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let wanted = [
        largest((0..history.rows()).map(size).collect()),
        largest(column("tip_*_twist_rad")).to_degrees(),
        largest(column("strain_energy_*_joule")),
    ];
    let text = std::fs::read_to_string(scratch.0.join("r/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    let wing = &summary["elastic_wings"][1];
    assert_eq!(wing["wing"], "right");
    let names = ["tip_displacement_m", "tip_twist_deg", "strain_energy_joule"];
    for (name, wanted) in names.into_iter().zip(wanted) {
        let found = wing[name].as_f64().unwrap();
        // Columns and summary have all digits, the square root its rounding.
        assert!(
            wanted > 0.0 && (found - wanted).abs() < 1e-14 * wanted,
            "{name}: {found} {wanted}"
        );
    }
    let words = std::fs::read_to_string(scratch.0.join("r/summary.txt")).unwrap();
    assert!(
        words.contains("Loads displaced the tip of the wing `"),
        "{words}"
    );
    let compared = wingbeat(&scratch.0, &["compare", "r", "r"]);
    let compared = String::from_utf8(compared.stdout).unwrap();
    assert!(
        compared.contains("tip displaced by up to [m]"),
        "{compared}"
    );
}
