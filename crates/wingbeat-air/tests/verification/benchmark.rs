//! The published benchmark of unsteady vortex lattices (source line in the data files) in air at rest; in its stream
//! it is compared by case `uvlm-benchmark` of the verification report, and with its wake through the program.

use crate::common::{fly, rectangle, translating};
use wingbeat_air::{AirSettings, Lattice, Surface};
use wingbeat_math::DVec3;

/// Rows of a table, the comment and the header left out; words are kept as NaN.
fn table(text: &str) -> Vec<Vec<f64>> {
    let numbers = |line: &str| {
        line.split(',')
            .map(|w| w.parse().unwrap_or(f64::NAN))
            .collect()
    };
    text.lines().skip(2).map(numbers).collect()
}

/// Square wing of 4 x 4 unit panels, x span, y chord and stream, z up. Columns run along -x, which
/// makes the normals point up.
fn nodes() -> Vec<DVec3> {
    let flat = rectangle(4, 4, 4.0 * DVec3::Y, -4.0 * DVec3::X);
    flat.iter().map(|p| *p + 4.0 * DVec3::X).collect()
}

/// Largest difference of the panels' numbers from a table row; its columns run along +x.
fn panel_error(ours: &[f64], row: &[f64]) -> f64 {
    let mirrored = |p: usize| 4 * (p / 4) + 3 - p % 4;
    (0..16)
        .map(|p| (ours[p] - row[2 + mirrored(p)]).abs())
        .fold(0.0, f64::max)
}

/// The benchmark seen by an observer at rest with the air: the wing moves, nothing streams.
#[test]
fn invariant_benchmark_in_a_wing_that_moves_through_air_at_rest() {
    let (s, c) = 10_f64.to_radians().sin_cos();
    let stream = DVec3::new(0.0, c, s);
    let panels = table(include_str!(
        "../../../wingbeat-verify/data/bench1_alpha10_panels.csv"
    ));
    let moving = |t: f64| translating(nodes().iter().map(|x| *x - t * stream).collect(), -stream);
    let settings = AirSettings::benchmark(1.0, DVec3::ZERO);
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 4)], settings).unwrap();
    fly(&lattice, moving, 1.0, 10, |n, _, ours, _| {
        // The tables have 13 to 15 digits; a free wake amplifies roundings some hundredfold.
        assert!(panel_error(&ours.gamma, &panels[2 * n]) < 1e-10);
        assert!(panel_error(&ours.pressure_jump, &panels[2 * n + 1]) < 1e-10);
    })
    .unwrap();
}
