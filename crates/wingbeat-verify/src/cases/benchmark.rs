//! The published benchmark of unsteady vortex lattices.

use crate::lab::series::Table;
use crate::lab::{fly, rectangle, total_force};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::TAU;
use wingbeat_air::{AirSettings, Lattice, NodeMotion, Surface};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[Case {
    name: "uvlm-benchmark",
    about: "The two cases of the code-to-code benchmark of the vortex lattice: a square wing started \
            suddenly at 10 deg, and pitching about its leading edge.",
    part: Part::Programs,
    quick: true,
    run,
}];

const SOURCE: &str = "Verstraete, Ceballos, Hente, Roccia, Gebhardt 2023, J. Aerosp. Inf. Syst., \
                      doi 10.2514/1.I011184; tables recomputed independently";

struct Reference {
    loads: Table,
    gamma: Vec<[f64; 16]>,
    dp: Vec<[f64; 16]>,
}

fn reference(loads: &str, panels: &str) -> Reference {
    let rows = |word: &str| {
        panels
            .lines()
            .filter(|l| l.split(',').nth(1) == Some(word))
            .map(|l| {
                let x: Vec<f64> = l
                    .split(',')
                    .skip(2)
                    .map(|w| w.parse().expect("number"))
                    .collect();
                std::array::from_fn(|k| x[k])
            })
            .collect()
    };
    Reference {
        loads: Table::new(loads),
        gamma: rows("gamma"),
        dp: rows("dp"),
    }
}

/// Square wing of 4 x 4 unit panels, x span, y chord and stream, z up; columns run along -x, which
/// makes the normals point up.
fn motion([angle, rate]: [f64; 2]) -> NodeMotion {
    let flat = rectangle(4, 4, 4.0 * DVec3::Y, -4.0 * DVec3::X);
    let (s, c) = angle.sin_cos();
    NodeMotion {
        position: flat
            .iter()
            .map(|p| DVec3::new(p.x + 4.0, p.y * c, -p.y * s))
            .collect(),
        velocity: flat
            .iter()
            .map(|p| DVec3::new(0.0, -p.y * s, -p.y * c) * rate)
            .collect(),
    }
}

fn compare(
    name: &str,
    stream: DVec3,
    pitch: impl Fn(f64) -> [f64; 2],
    reference: &Reference,
) -> Result<Vec<Row>, VerifyError> {
    let lattice = Lattice::new(
        vec![Surface::grid("wing", 4, 4)],
        AirSettings::benchmark(1.0, stream),
    )?;
    let numbers = |c: &str| reference.loads.numbers(c);
    let [fx, fy, fz] = ["Fx", "Fy", "Fz"].map(numbers);
    let mut worst = [0.0_f64; 3];
    fly(
        &lattice,
        |t| motion(pitch(t)),
        1.0,
        fx.len() - 1,
        |n, _, loads, _| {
            let theirs = DVec3::new(fx[n], fy[n], fz[n]);
            worst[0] = worst[0].max((total_force(loads) - theirs).length());
            for p in 0..16 {
                let q = 4 * (p / 4) + 3 - p % 4; // their columns run along +x
                worst[1] = worst[1].max((loads.gamma[p] - reference.gamma[n][q]).abs());
                worst[2] = worst[2].max((loads.pressure_jump[p] - reference.dp[n][q]).abs());
            }
        },
    )?;
    let row = |(what, error): (&str, f64)| {
        Row::new(
            format!("{name}: largest difference of {what} over all steps"),
            "1",
            error,
        )
        .against(0.0, SOURCE)
        .within(
            1e-10,
            "13 digits of the tables; the free wake amplifies roundings some hundredfold",
        )
    };
    let what = ["the force", "circulations", "pressure jumps"];
    Ok(what.into_iter().zip(worst).map(row).collect())
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let (s, c) = 10_f64.to_radians().sin_cos();
    let one = reference(
        include_str!("../../data/bench1_alpha10_loads.csv"),
        include_str!("../../data/bench1_alpha10_panels.csv"),
    );
    let two = reference(
        include_str!("../../data/bench2_alpha0_loads.csv"),
        include_str!("../../data/bench2_alpha0_panels.csv"),
    );
    let pitch = |t: f64| {
        let (a, w) = (5_f64.to_radians(), TAU / 10.0);
        [a * (w * t).sin(), a * w * (w * t).cos()]
    };
    let mut rows = compare("sudden start", DVec3::new(0.0, c, s), |_| [0.0; 2], &one)?;
    rows.extend(compare("pitching", DVec3::Y, pitch, &two)?);
    Ok(rows)
}
