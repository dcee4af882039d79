//! The published benchmark of unsteady vortex lattices (source line in the data files).

use crate::common::{fly, rectangle, total_force, translating};
use wingbeat_air::{AirSettings, AirState, Lattice, NodeMotion, Surface};
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

struct Case {
    stream: DVec3,
    /// Pitch angle [rad] and rate [rad/s], nose up, about the leading edge.
    pitch: fn(f64) -> [f64; 2],
    loads: &'static str,
    panels: &'static str,
    wake: &'static str,
}

/// Square wing of 4 x 4 unit panels, x span, y chord and stream, z up. Columns run along -x, which
/// makes the normals point up.
fn motion(pitch: fn(f64) -> [f64; 2], t: f64) -> NodeMotion {
    let flat = rectangle(4, 4, 4.0 * DVec3::Y, -4.0 * DVec3::X);
    let [angle, rate] = pitch(t);
    let (s, c) = angle.sin_cos();
    let place = |p: &DVec3| DVec3::new(p.x + 4.0, p.y * c, -p.y * s);
    NodeMotion {
        position: flat.iter().map(place).collect(),
        velocity: flat
            .iter()
            .map(|p| DVec3::new(0.0, -p.y * s, -p.y * c) * rate)
            .collect(),
    }
}

fn lattice(stream: DVec3) -> Lattice {
    let settings = AirSettings::benchmark(1.0, stream);
    Lattice::new(vec![Surface::grid("wing", 4, 4)], settings).unwrap()
}

/// Largest difference of the panels' numbers from a table row; its columns run along +x.
fn panel_error(ours: &[f64], row: &[f64]) -> f64 {
    let mirrored = |p: usize| 4 * (p / 4) + 3 - p % 4;
    (0..16)
        .map(|p| (ours[p] - row[2 + mirrored(p)]).abs())
        .fold(0.0, f64::max)
}

fn wake_error(state: &AirState, text: &str) -> f64 {
    let sheet = &state.sheets[0];
    let mut worst = 0.0_f64;
    for row in table(text) {
        let (r, c) = (row[0] as usize, row[1] as usize);
        let theirs = DVec3::new(row[2], row[3], row[4]);
        // The trailing edge is shed from tip to root, which is along +x.
        let ours = match r {
            0 => state.position[20 + (4 - c)],
            _ => sheet.node(sheet.rows() - r, c),
        };
        worst = worst.max((ours - theirs).length());
    }
    worst
}

fn compare(case: &Case, steps: usize) {
    let lattice = lattice(case.stream);
    let (loads, panels) = (table(case.loads), table(case.panels));
    assert_eq!(loads.len(), steps);
    let [mut force, mut gamma, mut dp] = [0.0_f64; 3];
    let run = fly(
        &lattice,
        |t| motion(case.pitch, t),
        1.0,
        steps - 1,
        |n, _, ours, _| {
            let theirs = DVec3::new(loads[n][2], loads[n][3], loads[n][4]);
            force = force.max((total_force(ours) - theirs).length());
            gamma = gamma.max(panel_error(&ours.gamma, &panels[2 * n]));
            dp = dp.max(panel_error(&ours.pressure_jump, &panels[2 * n + 1]));
        },
    )
    .unwrap();
    let wake = wake_error(&run.state, case.wake);
    println!("force {force:.1e} gamma {gamma:.1e} dp {dp:.1e} wake {wake:.1e}");
    // The tables have 13 to 15 digits; 40 steps of a free wake amplify roundings some hundredfold.
    for (what, error) in [
        ("force", force),
        ("gamma", gamma),
        ("dp", dp),
        ("wake", wake),
    ] {
        assert!(error < 1e-10, "{what} differs by {error:.1e}");
    }
}

#[test]
fn published_impulsive_start_at_ten_degrees() {
    let (s, c) = 10_f64.to_radians().sin_cos();
    compare(
        &Case {
            stream: DVec3::new(0.0, c, s),
            pitch: |_| [0.0, 0.0],
            loads: include_str!("../../../wingbeat-verify/data/bench1_alpha10_loads.csv"),
            panels: include_str!("../../../wingbeat-verify/data/bench1_alpha10_panels.csv"),
            wake: include_str!("../../../wingbeat-verify/data/bench1_alpha10_wake_last.csv"),
        },
        11,
    );
}

#[test]
fn published_pitching_about_the_leading_edge() {
    compare(
        &Case {
            stream: DVec3::Y,
            pitch: |t| {
                let (a, w) = (5_f64.to_radians(), std::f64::consts::TAU / 10.0);
                [a * (w * t).sin(), a * w * (w * t).cos()]
            },
            loads: include_str!("../../../wingbeat-verify/data/bench2_alpha0_loads.csv"),
            panels: include_str!("../../../wingbeat-verify/data/bench2_alpha0_panels.csv"),
            wake: include_str!("../../../wingbeat-verify/data/bench2_alpha0_wake_last.csv"),
        },
        41,
    );
}

/// The benchmark seen by an observer at rest with the air: the wing moves, nothing streams.
#[test]
fn invariant_benchmark_in_a_wing_that_moves_through_air_at_rest() {
    let (s, c) = 10_f64.to_radians().sin_cos();
    let stream = DVec3::new(0.0, c, s);
    let panels = table(include_str!(
        "../../../wingbeat-verify/data/bench1_alpha10_panels.csv"
    ));
    let moving = |t: f64| {
        let at_rest = motion(|_| [0.0, 0.0], t).position;
        translating(at_rest.iter().map(|x| *x - t * stream).collect(), -stream)
    };
    fly(&lattice(DVec3::ZERO), moving, 1.0, 10, |n, _, ours, _| {
        // Same tolerance as above.
        assert!(panel_error(&ours.gamma, &panels[2 * n]) < 1e-10);
        assert!(panel_error(&ours.pressure_jump, &panels[2 * n + 1]) < 1e-10);
    })
    .unwrap();
}
