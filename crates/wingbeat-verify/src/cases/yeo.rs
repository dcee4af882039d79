//! A rigid flapping wing in a wind tunnel.

use crate::lab::fly;
use crate::lab::series::{Table, interpolate, rms};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::TAU;
use wingbeat_air::{AirError, AirSettings, CoreModel, Lattice, NodeMotion, Plane, Surface};
use wingbeat_math::{DVec3, r1};

pub(super) const CASES: &[Case] = &[Case {
    name: "yeo-2011",
    about: "A rigid rectangular wing with rounded tip flapping in a wind tunnel at zero incidence: lift \
            that nine pressure ports gave, integrated over their areas.",
    part: Part::Experiments,
    quick: true,
    run,
}];

const FREQUENCY: f64 = 3.3;
const SPEED: f64 = 2.9;
/// What bears lift: half span less the 5 mm of the rounded tip [m].
const SPAN: f64 = 0.208;
/// A pressure port: the rectangle it stands for, and where it is.
struct Port {
    row: &'static str,
    position: &'static str,
    area: f64,
    /// Behind the leading edge at the root, and outboard [m].
    place: [f64; 2],
}

/// The ports: row blue near the root, orange, green near the tip. Places and areas were read off the
/// figures of the paper for PteraSoftware's validation.
const PORTS: [Port; 9] = [
    port("blue", "leading", 0.072 * 0.024, [0.012, 0.036]),
    port("blue", "middle", 0.072 * 0.024, [0.036, 0.036]),
    port("blue", "trailing", 0.072 * 0.024, [0.060, 0.036]),
    port("orange", "leading", 0.07 * 0.02112, [0.01308, 0.107]),
    port("orange", "middle", 0.07 * 0.02112, [0.0342, 0.107]),
    port("orange", "trailing", 0.07 * 0.02112, [0.05532, 0.107]),
    port("green", "leading", 0.071 * 0.015, [0.01569, 0.1775]),
    port("green", "middle", 0.06565 * 0.015, [0.03069, 0.176]),
    port("green", "trailing", 0.04165 * 0.015, [0.04569, 0.162825]),
];

const fn port(row: &'static str, position: &'static str, area: f64, place: [f64; 2]) -> Port {
    Port {
        row,
        position,
        area,
        place,
    }
}

/// Flap angle [rad] and rate [rad/s], tips up positive.
fn flap(t: f64) -> [f64; 2] {
    let a = [4.1e-5, -0.0322, -8.9e-7, 0.00046];
    let b = [0.3793, -1.95e-6, -0.0035, -3.6e-6];
    let (mut angle, mut rate) = (0.0354, 0.0);
    for k in 0..4 {
        let w = TAU * FREQUENCY * (k + 1) as f64;
        let (s, c) = (w * t).sin_cos();
        angle += a[k] * c + b[k] * s;
        rate += w * (b[k] * c - a[k] * s);
    }
    [angle, rate]
}

/// Lift of both wings by the ports at hundredths of a beat [N].
fn measured() -> Vec<f64> {
    let table = Table::new(include_str!("../../data/yeo2011_pressures.csv"));
    let (t, p) = (table.numbers("t_over_T"), table.numbers("pressure"));
    let names: Vec<(String, String)> = (table.words("row").map(str::to_owned))
        .zip(table.words("position").map(str::to_owned))
        .collect();
    let mut lift = vec![0.0; 100];
    for port in PORTS {
        let own: Vec<usize> = (0..t.len())
            .filter(|&k| names[k].0 == port.row && names[k].1 == port.position)
            .collect();
        let (t, p): (Vec<f64>, Vec<f64>) = own.iter().map(|&k| (t[k], p[k])).unzip();
        for (k, lift) in lift.iter_mut().enumerate() {
            let phase = k as f64 / 100.0;
            let [angle, _] = flap(phase / FREQUENCY);
            // Inches of water.
            *lift += 2.0 * 248.84 * interpolate(&t, &p, phase) * port.area * angle.cos();
        }
    }
    lift
}

/// Pressure jump that a port would read of a flat wing's lattice, whose panel jumps [Pa] (or parts of
/// them) are `jump`, row by row from the leading edge: between the two columns at its sides, and along
/// the chord over that of a plate at incidence, which is steep there.
fn at_port(place: [f64; 2], flat: &[DVec3], [rows, cols]: [usize; 2], jump: &[f64]) -> f64 {
    let edge = |i: usize, j: usize| flat[i * (cols + 1) + j];
    // Plate at incidence: sqrt((1 - x) / x) at x, and its integral from the leading edge.
    let plate = |x: f64| ((1.0 - x) / x).sqrt();
    let integral = |x: f64| (x * (1.0 - x)).sqrt() + x.sqrt().asin();
    let centres: Vec<f64> = (0..rows).map(|i| (i as f64 + 0.5) / rows as f64).collect();
    let column = |j: usize| {
        let middle = |i: usize| 0.5 * (edge(i, j).x + edge(i, j + 1).x);
        let x = (place[0] - middle(0)) / (middle(rows) - middle(0));
        let over = |i: usize| {
            let [a, b] = [i, i + 1].map(|i| integral(i as f64 / rows as f64));
            jump[i * cols + j] / ((b - a) * rows as f64)
        };
        let over: Vec<f64> = (0..rows).map(over).collect();
        interpolate(&centres, &over, x) * plate(x)
    };
    let y: Vec<f64> = (0..cols)
        .map(|j| 0.5 * (edge(0, j).y + edge(0, j + 1).y))
        .collect();
    let columns: Vec<f64> = (0..cols).map(column).collect();
    interpolate(&y, &columns, place[1])
}

/// Leading and trailing edge of the right wing at span positions [m], x aft.
fn planform(mesh: [usize; 2]) -> Vec<DVec3> {
    let table = Table::new(include_str!("../../data/yeo2011_wing_planform_mm.csv"));
    let (y, x) = (table.numbers("span_mm"), table.numbers("chordwise_mm"));
    let tip = (0..y.len())
        .max_by(|&a, &b| y[a].total_cmp(&y[b]))
        .unwrap_or(0);
    let aft = |k: usize| 0.072 - 1e-3 * x[k];
    let lead: (Vec<f64>, Vec<f64>) = (0..tip).map(|k| (1e-3 * y[k], aft(k))).unzip();
    let trail: (Vec<f64>, Vec<f64>) = (tip..y.len()).rev().map(|k| (1e-3 * y[k], aft(k))).unzip();
    let [rows, cols] = mesh;
    let at = |i: usize, j: usize| {
        let y = SPAN * j as f64 / cols as f64;
        let (a, b) = (
            interpolate(&lead.0, &lead.1, y),
            interpolate(&trail.0, &trail.1, y),
        );
        DVec3::new(a + (b - a) * i as f64 / rows as f64, y, 0.0)
    };
    (0..=rows)
        .flat_map(|i| (0..=cols).map(move |j| (i, j)))
        .map(|(i, j)| at(i, j))
        .collect()
}

/// Lift of both wings over the third beat at hundredths of it [N]: all of it, and what the ports would
/// make of it. Steps of about one panel.
fn lift(mesh: [usize; 2]) -> Result<[Vec<f64>; 2], AirError> {
    let per_beat = (SPEED / FREQUENCY / (0.072 / mesh[0] as f64)).round() as usize;
    let core = CoreModel::Scully { radius: 0.002 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        inset: 0.0, // the roots meet at the plane of symmetry
        images: vec![Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
        }],
        ..AirSettings::accurate(1.225, SPEED * DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", mesh[0], mesh[1])], settings)?;
    let flat = planform(mesh);
    let motion = |t: f64| {
        let [angle, rate] = flap(t);
        let position: Vec<DVec3> = flat.iter().map(|x| r1(angle) * *x).collect();
        let velocity = position.iter().map(|x| rate * DVec3::X.cross(*x)).collect();
        NodeMotion { position, velocity }
    };
    let dt = 1.0 / (FREQUENCY * per_beat as f64);
    let (mut steps, mut lift) = (Vec::new(), [vec![], vec![]]);
    fly(&lattice, motion, dt, 3 * per_beat, |_, _, loads, _| {
        steps.push(loads.time * FREQUENCY);
        lift[0].push(2.0 * loads.surfaces[0].force.z);
        let normal = loads.panels.normal.iter();
        let up: Vec<f64> = (loads.pressure_jump.iter().zip(normal))
            .map(|(jump, n)| jump * n.z)
            .collect();
        let read = |p: &Port| p.area * at_port(p.place, &flat, mesh, &up);
        lift[1].push(2.0 * PORTS.iter().map(read).sum::<f64>());
    })?;
    let third = |lift: Vec<f64>| {
        (0..100)
            .map(|k| interpolate(&steps, &lift, 2.0 + f64::from(k) / 100.0))
            .collect()
    };
    Ok(lift.map(third))
}

fn run(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mesh = if quick {
        [[2, 7], [3, 11]]
    } else {
        [[5, 18], [8, 28]]
    };
    let [coarse, fine] = [lift(mesh[0])?, lift(mesh[1])?];
    let measured = measured();
    let apart = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.len() as f64
    };
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let source = "Yeo, Atkins, Shyy 2011, digitised in camUrban/PteraSoftware, validation";
    let mut rows = Vec::new();
    for (kind, name, note) in [
        (
            0,
            "whole wings",
            "nine ports stand for the whole pressure of the wing measured",
        ),
        (
            1,
            "at the ports",
            "our pressures at the nine ports with the same areas: like for like",
        ),
    ] {
        let (coarse, fine) = (&coarse[kind], &fine[kind]);
        let change = apart(coarse, fine);
        let error = Row::new(
            format!("{name}: mean absolute error of lift over the third beat"),
            "N",
            apart(fine, &measured),
        )
        .against(0.0, source)
        .uncertain(change);
        rows.push(if quick {
            error.because("two coarse meshes; the whole set judges a finer one")
        } else {
            error.within(
                0.027,
                "what the other program, PteraSoftware, publishes for this case (all of its lift): \
                 0.027 N, 0.0291 N in its repository, on a measured rms of 0.0717 N; nothing here is \
                 fitted",
            )
        });
        for (what, of) in [("rms lift", rms as fn(&[f64]) -> f64), ("mean lift", mean)] {
            rows.push(
                Row::new(format!("{name}: {what}"), "N", of(fine))
                    .against(of(&measured), source)
                    .uncertain(change)
                    .because(note),
            );
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Panels with the mean pressures of a plate at incidence: ports read the plate's own.
    #[test]
    fn exact_ports_read_a_plate_at_incidence() {
        let mesh = [6, 52]; // nodes every 4 mm of span, so at the 36 mm of the first ports
        let flat = planform(mesh);
        // Mean over a panel by its antiderivative, a second way to write it: x = sin^2(a).
        let mean = |i: usize| {
            let [a, b] = [i, i + 1].map(|i| (i as f64 / 6.0).sqrt().asin());
            6.0 * ((b + 0.5 * (2.0 * b).sin()) - (a + 0.5 * (2.0 * a).sin()))
        };
        let jump: Vec<f64> = (0..6 * 52).map(|k| mean(k / 52)).collect();
        let [lead, trail] = [flat[9].x, flat[6 * 53 + 9].x];
        for port in &PORTS[..3] {
            let x = (port.place[0] - lead) / (trail - lead);
            let read = at_port(port.place, &flat, mesh, &jump);
            let exact = ((1.0 - x) / x).sqrt();
            // The outline bends by some hundredths of a millimetre between columns 4 mm apart.
            assert!((read / exact - 1.0).abs() < 1e-3, "{read} {exact}");
        }
    }
}
