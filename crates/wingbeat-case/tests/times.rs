//! Tables of angles over time: units that are misread, laws that do not close.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use wingbeat_case::{FittedTable, LoadedCase};

use crate::common::refusal;

/// Samples of a stroke in time: five wingbeats at the frequency `at` \[wingbeats per ms\] of each time \[ms\].
fn filmed(at: impl Fn(f64) -> f64) -> String {
    let stroke = |x: f64| 60.0 * (TAU * x).cos() + 5.0 * (3.0 * TAU * x).sin();
    let row = |k: i32| {
        let t = 0.13 * f64::from(k);
        format!("{t},{}\n", stroke(at(t) * t))
    };
    (0..=192).map(row).collect()
}

/// A fly with this table of the right stroke, whose header is `header`.
fn law(name: &str, header: &str, rows: &str, more: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("times");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join(name);
    fs::write(&file, format!("{header}\n{rows}")).unwrap();
    format!("wing.right.motion.phi={{ table = {{ file = {file:?}, {more} }} }}")
}

fn fitted(set: &[String]) -> FittedTable {
    let case = LoadedCase::find("fruit-fly-tethered", set).unwrap();
    let [fit] = &case.fitted_tables()[..] else {
        panic!("one table is fitted")
    };
    fit.clone()
}

fn doubt(law: String) -> Option<String> {
    fitted(&[law]).doubt()
}

/// Wingbeats at 200 Hz that are read at 190 Hz: the frequency with which they repeat is found. Where the
/// frequency changes, no other fits.
#[test]
fn exact_the_frequency_of_a_table_is_found_where_it_is_misread() {
    let steady = filmed(|_| 0.2);
    let read = |beats: f64| {
        let more = format!("beats_per_unit = {beats}, harmonics = 4");
        doubt(law("steady.csv", "time_ms,phi_deg", &steady, &more))
    };
    assert_eq!(read(0.2), None);
    for beats in [0.19, 0.22] {
        let said = read(beats).expect("a doubt");
        assert!(
            said.contains("is likely to be wrong: with 0.2000 "),
            "{said}"
        );
    }
    let drifting = filmed(|t| 0.19 + 0.0008 * t);
    let more = "beats_per_unit = 0.21, harmonics = 4";
    let said = doubt(law("drift.csv", "time_ms,phi_deg", &drifting, more)).expect("a doubt");
    assert!(
        said.contains("the frequency changes within the table"),
        "{said}"
    );
    assert!(!said.contains("is likely to be wrong"), "{said}");
}

/// One or two samples of 193 that are 60 deg off are named with number, angle and deviation, and not the times, which
/// are right. Numbers are said without their roundings.
#[test]
fn exact_a_sample_that_is_off_is_named_before_the_times() {
    let steady = filmed(|_| 0.2);
    let spiked = |at: &[usize]| -> String {
        let row = |(k, line): (usize, &str)| match (line.split_once(','), at.contains(&k)) {
            (Some((t, q)), true) => format!("{t},{}\n", q.parse::<f64>().unwrap() + 60.0),
            _ => format!("{line}\n"),
        };
        steady.lines().enumerate().map(row).collect()
    };
    let read = |at: &[usize], beats: f64| {
        let more = format!("beats_per_unit = {beats}, harmonics = 4");
        let table = law("spiked.csv", "time_ms,phi_deg", &spiked(at), &more);
        let fit = fitted(&[table]);
        (fit.doubt().expect("a doubt"), fit.outliers)
    };
    let (said, outliers) = read(&[100], 0.2);
    let [one] = &outliers[..] else {
        panic!("{outliers:?}")
    };
    // All samples but this one are those of a series of three harmonics.
    assert!((one.off_deg - 60.0).abs() < 1e-9, "{one:?}");
    assert!((one.phase - 2.6).abs() < 1e-12 && one.sample == 101);
    assert!(
        said.contains("sample 101 of 193, 6.7037 deg at phase 2.6, is 60.0 deg off"),
        "{said}"
    );
    assert!(!said.contains("beats_per_unit"), "{said}");
    let (said, outliers) = read(&[20, 100], 0.2);
    assert!(
        outliers.len() == 2 && said.contains("one more is off"),
        "{said}"
    );
    let (said, _) = read(&[], 0.19);
    assert!(said.contains("with 0.2000 "), "{said}");
}

/// Strokes filmed at 200 Hz that are flown at another frequency: this is said where that is near, as where it was
/// forgotten, in whatever unit the times are; not of strokes that are flown far slower.
#[test]
fn behaves_a_table_that_is_flown_at_another_frequency_says_so() {
    let steady = filmed(|_| 0.2);
    let flown = |frequency: f64, more: &str| {
        let table = law("flown.csv", "time_ms,phi_deg", &steady, more);
        fitted(&[table, format!("motion.frequency_hz={frequency}")]).other_frequency()
    };
    let timed = "beats_per_unit = 0.2, harmonics = 4";
    for frequency in [199.5, 200.0, 20.0] {
        assert_eq!(flown(frequency, timed), None);
    }
    let said = flown(212.3, timed).expect("that");
    assert!(
        said.contains("is not motion.frequency_hz = 212.3"),
        "{said}"
    );
}

/// The wingbeats of a table that does not fit, and what a unit of its column asks for.
#[test]
fn refuses_times_in_ms_that_are_taken_for_seconds() {
    let more = "beats_per_unit = 200, harmonics = 4";
    let said = refusal(
        "fruit-fly-tethered",
        &[&law("ms.csv", "time_ms,phi_deg", &filmed(|_| 0.2), more)],
    );
    for says in [
        "With beats_per_unit = 200 the table goes on for 4992.0 wingbeats",
        "in ms the frequency in kHz, 0.2 for 200 Hz",
    ] {
        assert!(said.contains(says), "{said}");
    }
}

#[test]
fn refuses_angles_in_units_that_are_not_read() {
    for unit in ["mrad", "gon", "turns"] {
        let header = format!("phase,phi_{unit}");
        let more = "beats_per_unit = 0.2, harmonics = 4";
        let law = law("unit.csv", &header, &filmed(|_| 0.2), more);
        let said = refusal("fruit-fly-tethered", &[&law]);
        assert!(
            said.contains(&format!("says `{unit}`, and angles are read in")),
            "{said}"
        );
    }
}

/// A saw is one jump at the end of the beat, not noise; a sample that is wrong is no jump.
#[test]
fn behaves_a_law_that_does_not_close_jumps() {
    let doubts = |angle: &dyn Fn(i32) -> f64| {
        let row = |k: i32| format!("[{}, {}]", f64::from(k) / 64.0, angle(k % 64));
        let rows: Vec<String> = (0..=64).map(row).collect();
        let law = format!(
            "wing.right.motion.phi={{table={{rows_deg=[{}]}}}}",
            rows.join(",")
        );
        let case = LoadedCase::find("fruit-fly-tethered", &[law]).unwrap();
        case.setup.scattered_angles().join("\n")
    };
    let saw = doubts(&|k| f64::from(k));
    let says = "motion.phi jumps by 63.0 deg at the end of the beat, where other samples are 1.00 deg apart at most";
    assert!(saw.contains(says), "{saw}");
    let wrong = doubts(&|k| {
        let stroke = 60.0 * (TAU * f64::from(k) / 64.0).sin();
        stroke + if k == 20 { 90.0 } else { 0.0 }
    });
    assert!(
        wrong.contains("the samples of motion.phi scatter"),
        "{wrong}"
    );
}

/// A hole in a table is named; what is merely uneven, or coarse all over, is not.
#[test]
fn behaves_a_gap_between_samples_is_named() {
    let gaps = |keeps: &dyn Fn(i32) -> bool, count: i32| {
        let angle = |k: i32| 60.0 * (TAU * f64::from(k % count) / f64::from(count)).sin();
        let row = |k: i32| format!("[{}, {}]", f64::from(k) / f64::from(count), angle(k));
        let ends = [0, count];
        let rows = (0..=count).filter(|k| keeps(*k) || ends.contains(k));
        let rows: Vec<String> = rows.map(row).collect();
        let law = format!(
            "wing.right.motion.phi={{table={{rows_deg=[{}]}}}}",
            rows.join(",")
        );
        let case = LoadedCase::find("fruit-fly-tethered", &[law]).unwrap();
        case.setup.gaps_in_angles().join("\n")
    };
    let hole = gaps(&|k| !(51..=99).contains(&k), 200);
    let says = "wings `left`, `right`: motion.phi has no samples from phase 0.250 to 0.500, where others are 0.0050 wingbeats apart";
    assert!(hole.contains(says), "{hole}");
    let last = gaps(&|k| (0..180).contains(&k), 200);
    assert!(last.contains("from phase 0.895 to 1.000"), "{last}");
    for (count, keeps) in [(200, 7), (12, 100), (16, 3)] {
        let found = gaps(&|k| k % keeps != 1, count);
        assert!(found.is_empty(), "{count} {keeps}: {found}");
    }
}
