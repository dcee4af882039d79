//! A flapping case run by two other programs: what 40 steps a beat are good for.

use crate::lab::series::{Table, mean, rms};
use crate::lab::{forces, rectangle};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::TAU;
use wingbeat_air::{AirError, AirSettings, CoreModel, Lattice, NodeMotion, Plane, Surface};
use wingbeat_math::{DVec3, r1};

pub(super) const CASES: &[Case] = &[Case {
    name: "peer-case",
    about: "Two rectangular wings flapping by 25 deg at k = 0.31 in forward flight, 8 x 20 panels \
            each, 40 steps a beat: lift against our own converged history and two other programs'.",
    part: Part::Programs,
    quick: false,
    run,
}];

const PERIOD: f64 = 0.25;

/// The right wing flapping about the line through its root leading edge, x aft, y right, z up.
fn motion(rows: usize, cols: usize, t: f64) -> NodeMotion {
    let (w, amplitude) = (TAU / PERIOD, 25_f64.to_radians());
    let (angle, rate) = (amplitude * (w * t).cos(), -amplitude * w * (w * t).sin());
    let mut motion = NodeMotion::default();
    for x in rectangle(rows, cols, 0.1 * DVec3::X, 0.4 * DVec3::Y) {
        let arm = r1(angle) * x;
        motion.position.push(arm + 0.01 * DVec3::Y);
        motion.velocity.push(rate * DVec3::X.cross(arm));
    }
    motion
}

/// Core of the other programs, on the wings as in the wake [m].
const CORE: f64 = 0.003;

/// Core of the wing's filaments for a mesh with `rows` panels along the chord [m]: a hundredth of a
/// panel. One of fixed size is no small part of a panel any more when the mesh is refined: rings
/// weaken each other less, and lift grows instead of converging.
fn small_core(rows: usize) -> f64 {
    0.01 * 0.1 / rows as f64
}

/// Lift of both wings [N] over `beats`, with the core `bound` [m] on the wing; the left one is the
/// image of the right one.
fn lift(
    mesh: [usize; 2],
    per_beat: usize,
    beats: usize,
    accurate: bool,
    bound: f64,
) -> Result<Vec<f64>, AirError> {
    let (s, c) = 5_f64.to_radians().sin_cos();
    let stream = 4.0 * DVec3::new(c, 0.0, s);
    let scheme = match accurate {
        true => AirSettings::accurate(1.225, stream),
        false => AirSettings::benchmark(1.225, stream),
    };
    let settings = AirSettings {
        bound_core: CoreModel::Scully { radius: bound },
        wake_core: CoreModel::Scully { radius: CORE },
        images: vec![Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
        }],
        ..scheme
    };
    let [rows, cols] = mesh;
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, cols)], settings)?;
    let dt = PERIOD / per_beat as f64;
    let force = forces(&lattice, |t| motion(rows, cols, t), dt, beats * per_beat)?;
    Ok(force.iter().map(|f| 2.0 * (f.z * c - f.x * s)).collect())
}

/// Root mean square of the difference of two histories over the second beat, relative to the second's.
fn difference(a: &[f64], per_a: usize, b: &[f64], per_b: usize) -> f64 {
    let n = 40;
    let at = |x: &[f64], per: usize| -> Vec<f64> { (n..2 * n).map(|k| x[k * per / n]).collect() };
    let (a, b) = (at(a, per_a), at(b, per_b));
    let apart: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
    rms(&apart) / rms(&b)
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let computed = lift([8, 20], 40, 2, true, small_core(8))?;
    let benchmark = lift([8, 20], 40, 2, false, small_core(8))?;
    let their_core = lift([8, 20], 40, 2, true, CORE)?;
    let middle = lift([12, 30], 80, 2, true, small_core(12))?;
    let fine = lift([16, 40], 160, 2, true, small_core(16))?;
    let bound = difference(&middle, 80, &fine, 160);
    let whole = |x: &[f64], per: usize| mean(&x[per..=2 * per]);
    let mut rows = vec![
        Row::new(
            "accurate scheme, 40 steps: rms difference of lift from converged over the second beat",
            "1",
            difference(&computed, 40, &fine, 160),
        )
        .against(0.0, "our own run with 16 x 40 panels and 160 steps")
        .uncertain(bound)
        .within(
            0.02,
            "what is asked of the accurate scheme; the other programs are 4 % and 12 % off theirs",
        ),
        Row::new(
            "benchmark scheme, 40 steps: the same",
            "1",
            difference(&benchmark, 40, &fine, 160),
        )
        .against(0.0, "our own run with 16 x 40 panels and 160 steps")
        .uncertain(bound)
        .because("first order"),
        Row::new(
            "mean lift of the second beat, accurate scheme",
            "N",
            whole(&computed, 40),
        )
        .against(
            whole(&fine, 160),
            "our own run with 16 x 40 panels and 160 steps",
        )
        .within_part(0.01, "half of what the history may be off"),
        Row::new(
            "the same with the other programs' core on the wing, a quarter of a panel",
            "N",
            whole(&their_core, 40),
        )
        .because("weakens what rings do to each other, the more the finer the mesh"),
    ];
    rows.extend(other_programs(&fine));
    Ok(rows)
}

/// Histories of other programs against our converged one, `fine`.
fn other_programs(fine: &[f64]) -> Vec<Row> {
    let mut rows = vec![];
    for (name, text) in [
        (
            "PteraSoftware 5.1.0",
            include_str!("../../data/flap_rect_pterasoftware.csv"),
        ),
        (
            "Imperial College UVLM",
            include_str!("../../data/flap_rect_imperial_uvlm.csv"),
        ),
    ] {
        let theirs = Table::new(text).numbers("lift_N");
        rows.push(
            Row::new(
                format!("{name}, 40 steps: rms difference of lift from our converged history"),
                "1",
                difference(&theirs, 40, fine, 160),
            )
            .because("theirs holds leading-edge suction, which acts along x and so hardly in lift"),
        );
    }
    rows
}
