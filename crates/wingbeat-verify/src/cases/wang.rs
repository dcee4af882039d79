//! A plate that hovers in plane flow at the Reynolds number of a fruit fly.

use crate::lab::rig::{Edge, Fluid, Pose, Wing, forces};
use crate::lab::series::{Table, correlation};
use crate::{Case, Comparison, Part, Row, VerifyError};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use wingbeat_math::{DVec3, r2};

pub(super) const CASES: &[Case] = &[Case {
    name: "wang-birch-dickinson-2004",
    about: "A plate hovers in plane flow at a Reynolds number of 75, 2.8 chords to and fro, incidence 45 deg at mid stroke, \
            turning about its mid chord while it reverses: lift and drag coefficient, mean of the beats 2 to 4, against a robot and two \
            computations of plane flow. Computed: one panel along the span, plane wakes; and the middle of a wing of aspect ratio 32.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const REYNOLDS: f64 = 75.0;
/// Stroke from end to end [chords].
const STROKE: f64 = 2.8;
/// Beat [chords over the largest speed].
const PERIOD: f64 = PI * STROKE;
const BEATS: usize = 4;
/// Samples of the reference in a beat, means over as long.
const SAMPLES: usize = 40;

/// Panels along the chord and steps a beat: those of insects, and finer.
const MESH: [usize; 2] = [5, 40];
const FINE: [usize; 2] = [10, 80];
/// Span of the section of plane flow [chords].
const SPAN: f64 = 1e3;
/// Span positions [chords] from the middle to the tip of the wide wing, as in the case `baik-2011`.
const STATIONS: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.5, 7.0, 11.0, 16.0];

const SOURCES: [(&str, &str, &str); 3] = [
    (
        "robot",
        "robot",
        "Wang, Birch & Dickinson 2004, J. Exp. Biol. 207:449, a robot in oil",
    ),
    (
        "computed by Eldredge",
        "eldredge",
        "Eldredge 2007, J. Comput. Phys. 221:626, vortex particles",
    ),
    (
        "computed by Li et al.",
        "li",
        "Li, Dong & Liu 2015, J. Fluids Struct. 58:49, immersed boundary",
    ),
];
const BAND: &str = "a fifth; the means of the robot, which is not plane, and of both computations lie 14 to 15 % apart; uncertainty: standard \
                    error of the mean of the beats";
const COURSE: &str =
    "rms difference over a beat; uncertainty: change by 10 panels and 80 steps a beat for 5 and 40";

/// What flies.
#[derive(Clone, Copy, PartialEq)]
enum Flow {
    Plane,
    Wide,
}

/// Mean force coefficients \[drag, lift\] of each fortieth of a beat, beat by beat.
type Beats = Vec<[Vec<f64>; 2]>;

/// Place of the mid chord along the stroke [chords], its speed, incidence from the direction of the stroke
/// [rad] and its rate.
fn stroke(s: f64) -> [f64; 4] {
    let (sin, cos) = (TAU * s).sin_cos();
    [
        0.5 * STROKE * cos,
        -sin,
        FRAC_PI_2 + FRAC_PI_4 * sin,
        FRAC_PI_4 * TAU / PERIOD * cos,
    ]
}

fn hover(flow: Flow, edge: Edge, [rows, per_beat]: [usize; 2]) -> Result<Beats, VerifyError> {
    let wing = match flow {
        Flow::Plane => Wing::section(rows, SPAN, 0.5),
        Flow::Wide => Wing {
            measured: 1,
            ..Wing::rectangle(rows, &STATIONS, 0.5, true)
        },
    };
    let width = match flow {
        Flow::Plane => SPAN,
        Flow::Wide => STATIONS[1],
    };
    // The chord points against the stroke's direction x at no incidence: the leading edge is the upper one throughout.
    let pose = |t: f64| {
        let [x, speed, angle, rate] = stroke(t / PERIOD);
        Pose {
            turn: r2(PI - angle),
            spin: -rate * DVec3::Y,
            shift: x * DVec3::X,
            velocity: speed * DVec3::X,
        }
    };
    let fluid = Fluid {
        stream: DVec3::ZERO,
        ..Fluid::unit(REYNOLDS)
    };
    let dt = PERIOD / per_beat as f64;
    let force = forces(&fluid, &wing, edge, pose, [0.0, dt], BEATS * per_beat)?;
    let part = per_beat / SAMPLES;
    let mean = |first: usize, of: &dyn Fn(&DVec3) -> f64| {
        let ends = |k: usize| 0.5 * (of(&force[k]) + of(&force[k + 1]));
        let sum: f64 = (first..first + part).map(ends).sum();
        2.0 * sum / (part as f64 * width)
    };
    let beat = |b: usize| {
        [true, false].map(|is_drag| {
            let sample = |i: usize| {
                let back = -stroke((i as f64 + 0.5) / SAMPLES as f64)[1].signum();
                let of = |f: &DVec3| if is_drag { back * f.x } else { f.z };
                mean(b * per_beat + i * part, &of)
            };
            (0..SAMPLES).map(sample).collect()
        })
    };
    Ok((0..BEATS).map(beat).collect())
}

/// Mean over the beats from the second on, sample by sample.
fn folded(beats: &Beats, i: usize) -> Vec<f64> {
    let n = (BEATS - 1) as f64;
    let at = |k: usize| beats[1..].iter().map(|b| b[i][k]).sum::<f64>() / n;
    (0..SAMPLES).map(at).collect()
}

fn average(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

/// Standard error of the mean over beats from the second on.
fn error_of_mean(beats: &Beats, i: usize) -> f64 {
    let means: Vec<f64> = beats[1..].iter().map(|b| average(&b[i])).collect();
    let (n, of) = (means.len() as f64, average(&means));
    (means.iter().map(|m| (m - of).powi(2)).sum::<f64>() / (n * (n - 1.0))).sqrt()
}

/// Rows of one flight against one source: mean and course of lift and drag.
fn against(
    source: usize,
    name: &str,
    judged: bool,
    [flown, finer]: [&Beats; 2],
    table: &Table,
) -> Vec<Row> {
    let (who, column, paper) = SOURCES[source];
    let mut rows = Vec::new();
    for (i, what, prefix) in [(1, "lift", "CL"), (0, "drag", "CD")] {
        let theirs = table.numbers(&format!("{prefix}_{column}"));
        let [computed, fine] = [flown, finer].map(|b| folded(b, i));
        let row = Row::new(
            format!("{name}: mean {what} coefficient, {who}"),
            "1",
            average(&computed),
        )
        .against(average(&theirs), paper)
        .uncertain(error_of_mean(flown, i));
        rows.push(match judged {
            true => row.within_part(0.2, BAND),
            false => row,
        });
        let beside = |values: &[f64]| Comparison {
            quantity: format!("{what} coefficient, {who}").into(),
            along: "phase [1]".into(),
            against: "reference".into(),
            name: name.to_owned().into(),
            points: (0..SAMPLES)
                .map(|k| [(k as f64 + 0.5) / SAMPLES as f64, theirs[k], values[k]])
                .collect(),
        };
        let [course, change] = [&computed, &fine].map(|v| beside(v));
        let rms = course.rms_error();
        let quantity = format!("{name}: rms difference of {what} coefficient, {who}");
        let row = Row::new(quantity, "1", rms).against(0.0, paper);
        let row = row.uncertain(change.rms_error() - rms).because(COURSE);
        rows.push(row.drawn(course));
        if judged {
            let quantity = format!("{name}: correlation of {what}, {who}");
            rows.push(Row::new(quantity, "1", correlation(&computed, &theirs)).against(1.0, paper));
        }
    }
    rows
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let table = Table::new(include_str!("../../data/wang2004_hover.csv"));
    let mut rows = Vec::new();
    for edge in Edge::ALL {
        let [flown, finer] = [
            hover(Flow::Plane, edge, MESH)?,
            hover(Flow::Plane, edge, FINE)?,
        ];
        for source in 0..SOURCES.len() {
            let judged = edge == Edge::Sheds;
            rows.extend(against(
                source,
                edge.name(),
                judged,
                [&flown, &finer],
                &table,
            ));
        }
        for (i, what) in [(1, "lift"), (0, "drag")] {
            let means: Vec<f64> = finer.iter().map(|b| average(&b[i])).collect();
            let name = edge.name();
            rows.push(Row::new(
                format!("{name}, 10 panels, 80 steps: mean {what} coefficient"),
                "1",
                average(&means[1..]),
            ));
            let first = average(&flown[0][i]);
            rows.push(Row::new(
                format!("{name}: mean {what} coefficient of the first beat"),
                "1",
                first,
            ));
        }
    }
    let wide = hover(Flow::Wide, Edge::Sheds, MESH)?;
    for (i, what) in [(1, "lift"), (0, "drag")] {
        let quantity = format!(
            "{}, middle of a wing of aspect ratio 32: mean {what} coefficient",
            Edge::Sheds.name()
        );
        let row = Row::new(quantity, "1", average(&folded(&wide, i)));
        rows.push(row.uncertain(error_of_mean(&wide, i)));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_rates_of_the_stroke_with_differences() {
        let h = 1e-6;
        for s in [0.1, 0.4, 0.8] {
            let [a, b] = [s + h, s - h].map(stroke);
            let rate = |k: usize| (a[k] - b[k]) / (2.0 * h * PERIOD);
            // Central differences: h^2, and roundings of 1e-16 / h.
            assert!((rate(0) - stroke(s)[1]).abs() < 1e-9);
            assert!((rate(2) - stroke(s)[3]).abs() < 1e-9);
        }
    }
}
