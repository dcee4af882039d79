//! A rigid rectangular wing that a crank flaps in a wind tunnel.

use crate::lab::rig::{Edge, Fluid, Pose, Wing, forces};
use crate::lab::series::{Table, harmonic, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};
use std::f64::consts::TAU;
use wingbeat_math::{DVec3, r1, r2};

pub(super) const CASES: &[Case] = &[Case {
    name: "yang-2025",
    about: "A rigid rectangular wing flaps by 70 deg, driven by a crank, in a stream of 5.5 m/s at six \
            angles of installation: mean lift and thrust.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const CHORD: f64 = 0.13;
const SPEED: f64 = 5.5;
/// Root and tip from the axis of flapping [chords].
const ENDS: [f64; 2] = [0.08 / CHORD, 0.33 / CHORD];
/// Chords that the stream goes in a beat.
const PERIOD: f64 = SPEED / (2.5 * CHORD);
/// Dynamic pressure times area [gf].
const FORCE: f64 = 0.5 * 1.23 * SPEED * SPEED * 0.0325 / 9.806_65e-3;
/// Harmonics of the flap angle that are kept.
const HARMONICS: usize = 8;

/// Mean and harmonics [rad] of the flap angle, tip up positive.
fn flap() -> Vec<[f64; 2]> {
    let table = Table::new(include_str!("../../data/yang2025_flap_angle.csv"));
    let angle: Vec<f64> = (table.numbers("flap_deg").iter())
        .map(|a| a.to_radians())
        .collect();
    let terms = (1..=HARMONICS).map(|k| harmonic(&angle, angle.len() - 1, k));
    [[mean(&angle), 0.0]].into_iter().chain(terms).collect()
}

/// Mean lift and thrust over the last beat [gf].
fn means(
    incidence: f64,
    edge: Edge,
    [rows, cols, steps, beats]: [usize; 4],
) -> Result<[f64; 2], VerifyError> {
    let stations: Vec<f64> = (0..=cols)
        .map(|j| ENDS[0] + (ENDS[1] - ENDS[0]) * j as f64 / cols as f64)
        .collect();
    let wing = Wing::rectangle(rows, &stations, 0.5, false); // 1 mm thick
    let terms = flap();
    let pose = |t: f64| {
        let (mut angle, mut rate) = (0.0, 0.0);
        for (k, [a, b]) in terms.iter().enumerate() {
            let w = TAU * k as f64 / PERIOD;
            let (s, c) = (w * t).sin_cos();
            angle += a * c + b * s;
            rate += w * (b * c - a * s);
        }
        Pose {
            turn: r1(angle) * r2(incidence.to_radians()),
            spin: rate * DVec3::X,
            shift: DVec3::ZERO,
            velocity: DVec3::ZERO,
        }
    };
    let fluid = Fluid::unit(SPEED * CHORD / 1.47e-5);
    let dt = PERIOD / steps as f64;
    let force = forces(&fluid, &wing, edge, pose, [0.0, dt], beats * steps)?;
    let scale = FORCE * 2.0 / (ENDS[1] - ENDS[0]);
    let of = |part: fn(&DVec3) -> f64| {
        let last: Vec<f64> = force[(beats - 1) * steps..].iter().map(part).collect();
        scale * mean(&last)
    };
    Ok([of(|f| f.z), of(|f| -f.x)])
}

const SOURCE: &str = "Yang, Lee, Lee & Han 2025, J. Fluids Struct. 133:104263, fig. 11, type A";
const BAND: &str = "lattices of others with leading-edge vortices reach 3.4 and 4.1 gf in lift, 1.9 and 1.5 gf \
                    in drag; an attached one 6.3 gf in lift";
const CHANGE: &str =
    "uncertainty: change at 25 deg by 8 x 10 panels and 100 steps a beat for 6 x 8 and 80";
/// The largest angle.
const LAST: usize = 5;

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let table = Table::new(include_str!("../../data/yang2025_mean_lift_thrust.csv"));
    let angles = table.numbers("alpha_deg");
    let measured = ["lift_test_gf", "thrust_test_gf"].map(|name| table.numbers(name));
    let mut rows = Vec::new();
    for edge in Edge::ALL {
        let name = edge.name();
        let mut computed = Vec::new();
        for &angle in &angles {
            computed.push(means(angle, edge, [6, 8, 80, 2])?);
        }
        let finer = means(angles[LAST], edge, [8, 10, 100, 2])?;
        for (i, what, band) in [(0, "lift", 4.5), (1, "thrust", 2.0)] {
            let pairs = computed.iter().zip(&measured[i]);
            let apart: f64 = pairs.clone().map(|(a, b)| (a[i] - b).abs()).sum();
            let quantity = format!("{name}: mean absolute error of mean {what}");
            let row = Row::new(quantity, "gf", apart / angles.len() as f64).against(0.0, SOURCE);
            let points = angles.iter().zip(pairs.clone());
            let row = row
                .uncertain(finer[i] - computed[LAST][i])
                .drawn(Comparison {
                    quantity: format!("mean {what} [gf]").into(),
                    along: "angle of the stream [deg]".into(),
                    against: "measured".into(),
                    name: name.into(),
                    points: points.map(|(a, (c, m))| [*a, *m, c[i]]).collect(),
                });
            rows.push(match edge == Edge::Sheds {
                true => row.within(band, BAND),
                false => row.because(CHANGE),
            });
            for (angle, (computed, measured)) in angles.iter().zip(pairs) {
                let quantity = format!("{name}: mean {what} at {angle} deg");
                rows.push(Row::new(quantity, "gf", computed[i]).against(*measured, SOURCE));
            }
        }
    }
    Ok(rows)
}
