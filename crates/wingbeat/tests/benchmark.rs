//! The published vortex-lattice benchmark, flown from its case files by the program: circulations,
//! pressure jumps, forces and wake nodes.
//!
//! Their axes (x span, y chord and stream, z up) are ours by (n1, n2, n3) = (-y, -x, -z); frames
//! carry (n1, -n2, -n3), that is (-y, x, z). Their circulations and pressure jumps are signed for
//! the upward normal, ours for the wing's +axis 3, which points down here.

use std::fs;
use std::path::Path;

use crate::support::{Scratch, array, wingbeat};
use wingbeat::results::History;

/// The reference has 13 significant digits of numbers of order one; 40 steps of a free wake amplify roundings some
/// hundredfold.
const TOLERANCE: f64 = 1e-10;

fn table(name: &str) -> Vec<Vec<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../wingbeat-verify/data")
        .join(name);
    let text = fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|l| !l.starts_with('#')).skip(1);
    rows.map(|l| l.split(',').map(str::to_owned).collect())
        .collect()
}

fn numbers(fields: &[String]) -> Vec<f64> {
    fields.iter().map(|f| f.parse().unwrap()).collect()
}

fn floats(text: &str, name: &str) -> Vec<f64> {
    array(text, name)
        .into_iter()
        .map(f64::from_le_bytes)
        .collect()
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m, (x, y)| m.max((x - y).abs()))
}

/// Length of the difference of two vectors.
fn distance(a: [f64; 3], b: &[f64]) -> f64 {
    assert_eq!(b.len(), 3);
    let squares = a.iter().zip(b).map(|(x, y)| (x - y).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Largest differences: circulation, pressure jump, force, wake nodes.
fn compare(preset: &str, reference: &str) -> [f64; 4] {
    let scratch = Scratch::new(preset);
    let out = wingbeat(&scratch.0, &["run", preset, "--out", "run", "--quiet"]);
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    let frame = |stem: &str, step: usize| {
        fs::read_to_string(scratch.0.join(format!("run/frames/{stem}_{step:06}.vtp"))).unwrap()
    };
    let mut worst = [0.0_f64; 4];
    for row in table(&format!("{reference}_panels.csv")) {
        let text = frame("surfaces", row[0].parse().unwrap());
        // Circulations of frames are right-handed about the corners, pressure jumps along the normal.
        let (k, name, sign) = match row[1].as_str() {
            "gamma" => (0, "circulation_m2_per_s", 1.0),
            _ => (1, "pressure_jump_pascal", -1.0),
        };
        let ours: Vec<f64> = floats(&text, name).iter().map(|g| sign * g).collect();
        worst[k] = worst[k].max(largest_difference(&ours, &numbers(&row[2..])));
    }
    let history = History::read(&scratch.0.join("run/history.csv")).unwrap();
    let loads = table(&format!("{reference}_loads.csv"));
    assert_eq!(loads.len(), history.rows());
    for (k, row) in loads.iter().enumerate() {
        let n = |i: usize| history.column(&format!("air_wing_left_force_n{i}_newton"))[k];
        let ours = [-n(2), -n(1), -n(3)];
        worst[2] = worst[2].max(distance(ours, &numbers(&row[2..5])));
    }
    let wake = table(&format!("{reference}_wake_last.csv"));
    let text = frame("wakes", loads.len() - 1);
    worst[3] = wake_difference(&wake, &floats(&text, "points"));
    worst
}

/// Wake nodes row by row; ours run along the trailing edge from tip to root, theirs with x.
fn wake_difference(reference: &[Vec<String>], points: &[f64]) -> f64 {
    let columns = 1 + reference
        .iter()
        .map(|r| r[1].parse::<usize>().unwrap())
        .max()
        .unwrap();
    let ours = |row: usize, node: usize| {
        let at = 3 * (row * columns + columns - 1 - node);
        [points[at + 1], -points[at], points[at + 2]]
    };
    assert_eq!(points.len(), 3 * reference.len());
    let difference = |r: &Vec<String>| {
        let node = ours(r[0].parse().unwrap(), r[1].parse().unwrap());
        distance(node, &numbers(&r[2..5]))
    };
    reference.iter().map(difference).fold(0.0, f64::max)
}

#[test]
fn published_benchmark_1_impulsive_start_at_ten_degrees() {
    let worst = compare("benchmark-1", "bench1_alpha10");
    assert!(worst.iter().all(|d| *d < TOLERANCE), "{worst:?}");
}

#[test]
fn published_benchmark_2_pitching_about_the_leading_edge() {
    let worst = compare("benchmark-2", "bench2_alpha0");
    assert!(worst.iter().all(|d| *d < TOLERANCE), "{worst:?}");
}
