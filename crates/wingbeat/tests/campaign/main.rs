//! Campaigns: files that are refused, points that survive their processes, tables that do not tell how they were made.

mod again;
mod alternatives;
#[path = "../support/browser.rs"]
#[allow(dead_code, reason = "this page is not driven by keys")]
mod browser;
mod chains;
mod docs;
mod kept;
mod kills;
mod page;
mod refusals;
mod runs;
#[path = "../support/mod.rs"]
mod support;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use support::{QUICK, flown};

/// Files of a merge.
const TABLES: [&str; 4] = ["points.csv", "points.parquet", "points.nc", "failed.csv"];

/// A campaign of so many samples at three frequencies, about a hundredth of a second each.
fn blade(samples: usize) -> String {
    format!(
        r#"case = "fruit-fly-blade"
keep = ["lift_over_weight", "power_watt", "end.mass_centre_n3_m"]
samples = {samples}
seed = 3
[set]
"time.beats" = 1
"time.steps_per_beat" = 40
[budget]
attempts = 20
[parameter."motion.frequency_hz"]
range = {{ from = 190, to = 210, count = 3 }}
[parameter."body.mass_kg"]
normal = {{ mean = 0.93e-6, standard_deviation = 0.05e-6 }}
"#
    )
}

/// Writes a campaign and a quick case into a folder.
fn write(dir: &Path, text: &str) {
    fs::write(dir.join("case.toml"), QUICK).unwrap();
    fs::write(dir.join("c.toml"), text).unwrap();
}

/// The merged tables of the campaign in `out`.
fn merged(dir: &Path, out: &str) -> BTreeMap<&'static str, Vec<u8>> {
    flown(dir, &["campaign", "merge", "c.toml", "--out", out]);
    let read = |name: &&'static str| (*name, fs::read(dir.join(out).join(name)).unwrap());
    TABLES.iter().map(read).collect()
}

/// The cells of a column of points.csv.
fn column(dir: &Path, out: &str, name: &str) -> Vec<String> {
    let text = fs::read_to_string(dir.join(out).join("points.csv")).unwrap();
    let mut lines = text.lines();
    let at = lines.next().unwrap().split(',').position(|c| c == name);
    let at = at.unwrap_or_else(|| panic!("no column {name} in\n{text}"));
    lines
        .map(|l| l.split(',').nth(at).unwrap().to_owned())
        .collect()
}

/// The numbers of a column of points.csv.
fn numbers(dir: &Path, out: &str, name: &str) -> Vec<f64> {
    let cells = column(dir, out, name).into_iter();
    cells.map(|c| c.parse().unwrap_or(f64::NAN)).collect()
}
