//! Strips that carry the circulation of wings through a body.

use crate::common::{fly, rectangle, translating};
use crate::joined_edges::settings;
use wingbeat_air::{AirError, JoinedEdge, Lattice, LoadMethod, SheddingKinds, Surface};
use wingbeat_math::DVec3;

const ROWS: usize = 3;
const COLS: usize = 4;

/// Half the width of the gap between two wings of chord 1.
const GAP: f64 = 0.2;

/// Wings on either side of the gap and the strips through it: first to last left wing, right wing, left strip,
/// right strip. Columns run from the middle outward, normals up.
fn surfaces() -> Vec<Surface> {
    let both = |name: &str, cols: usize| {
        let right = Surface::grid(&format!("right {name}"), ROWS, cols);
        let mut left = Surface::grid(&format!("left {name}"), ROWS, cols);
        left.panels.iter_mut().for_each(|c| c.reverse());
        [left, right]
    };
    let strip = |s: Surface| Surface {
        carry_through: true,
        ..s
    };
    let strips = both("strip", 1).map(strip);
    both("wing", COLS).into_iter().chain(strips).collect()
}

/// The wings to their strips, and these to each other.
fn joined() -> Vec<JoinedEdge> {
    let edge = |surfaces: [usize; 2], column: [usize; 2], cols: [usize; 2]| JoinedEdge {
        surfaces,
        nodes: (0..=ROWS)
            .map(|i| [0, 1].map(|k| i * (cols[k] + 1) + column[k]))
            .collect(),
    };
    vec![
        edge([0, 2], [0, 1], [COLS, 1]),
        edge([1, 3], [0, 1], [COLS, 1]),
        edge([2, 3], [0, 0], [1, 1]),
    ]
}

fn nodes() -> Vec<DVec3> {
    let piece = |sign: f64, from: f64, to: f64, cols: usize| {
        let span = DVec3::new(0.0, sign * (to - from), 0.0);
        let nodes = rectangle(ROWS, cols, DVec3::X, span);
        nodes.into_iter().map(move |x| x + sign * from * DVec3::Y)
    };
    let wings = [-1.0, 1.0]
        .into_iter()
        .flat_map(|s| piece(s, GAP, 2.0, COLS));
    let strips = [-1.0, 1.0].into_iter().flat_map(|s| piece(s, 0.0, GAP, 1));
    wings.chain(strips).collect()
}

#[test]
fn refuses_strips_that_lead_nowhere() {
    let settings = || settings(SheddingKinds::TRAILING, LoadMethod::Joukowski);
    assert!(Lattice::joined(surfaces(), &joined(), settings()).is_ok());
    for without in 0..3 {
        let mut joined = joined();
        joined.remove(without);
        let refused = Lattice::joined(surfaces(), &joined, settings());
        assert!(
            matches!(refused, Err(AirError::CarryThrough { .. })),
            "{without}"
        );
    }
}

/// In a stream from the side, with wings of unlike incidence: rings within, and what they shed behind and
/// ahead, are the means of those beside both roots; the sheets are one, with their middle between the roots.
#[test]
fn exact_strips_have_the_mean_of_both_sides() {
    let settings = settings(
        SheddingKinds {
            leading: true,
            ..SheddingKinds::TRAILING
        },
        LoadMethod::Joukowski,
    );
    let lattice = Lattice::joined(surfaces(), &joined(), settings).unwrap();
    let stream = DVec3::new(0.0, 0.3, 0.0);
    let place = || {
        let tilted = |x: DVec3| x - 0.1 * (x.x * (1.0 + x.y.max(GAP) - GAP)) * DVec3::Z;
        nodes().into_iter().map(tilted).collect::<Vec<_>>()
    };
    let motion = |t: f64| {
        let moved = place().into_iter().map(|x| x - t * stream);
        translating(moved.collect(), -stream)
    };
    let run = fly(&lattice, motion, 0.2, 4, |_, _, loads, _| {
        for row in 0..ROWS {
            let beside = [0, 1].map(|s| loads.gamma[lattice.panels_of(s).start + row * COLS]);
            for strip in [2, 3] {
                let within = loads.gamma[lattice.panels_of(strip).start + row];
                let mean = 0.5 * (beside[0] + beside[1]);
                assert!((within - mean).abs() < 1e-12 && beside[0] != beside[1]);
            }
        }
    })
    .unwrap();
    let sheets = &run.state.sheets;
    // Of each surface what leaves the leading edge, then the trailing edge; trailing edges run inward.
    let of = |surface: usize| {
        let here = lattice.sheets().iter().enumerate();
        let here = here.filter(move |(_, root)| root.surface == surface);
        here.map(|(k, root)| (&sheets[k], root)).collect::<Vec<_>>()
    };
    let [left, right, left_strip, right_strip] = [0, 1, 2, 3].map(of);
    for edge in 0..2 {
        let column = |cols: usize| if edge == 0 { 0 } else { cols - 1 };
        let ring = |sheet: &wingbeat_air::WakeSheet, sign: f64, r: usize| {
            sign * sheet.gamma[r * sheet.columns + column(sheet.columns)]
        };
        let rows = sheets[0].rows();
        assert!(rows > 3);
        for r in 0..rows {
            let sides = [&left, &right].map(|s| ring(s[edge].0, s[edge].1.signs[0], r));
            for strip in [&left_strip, &right_strip] {
                let within = ring(strip[edge].0, strip[edge].1.signs[0], r);
                let mean = 0.5 * (sides[0] + sides[1]);
                assert!((within - mean).abs() < 1e-12, "{edge} {r}: {within} {mean}");
            }
            let inner = if edge == 0 { 0 } else { 1 };
            let middles = [&left_strip, &right_strip].map(|s| s[edge].0.node(r, inner));
            let roots = [&left, &right].map(|s| {
                let columns = s[edge].0.columns;
                s[edge].0.node(r, if edge == 0 { 0 } else { columns })
            });
            assert_eq!(middles[0], middles[1]);
            assert!(middles[0].distance(roots[0].midpoint(roots[1])) < 1e-14);
        }
    }
}
