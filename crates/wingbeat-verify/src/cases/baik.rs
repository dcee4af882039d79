//! A plate that pitches and plunges in a channel, quasi two-dimensional.

use crate::lab::rig::{Edge, Fluid, Nose, Pose, Wing, forces};
use crate::lab::series::{Table, harmonic, interpolate, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};
use std::f64::consts::{PI, TAU};
use wingbeat_math::{DVec3, r2};

pub(super) const CASES: &[Case] = &[Case {
    name: "baik-2011",
    about: "A flat plate with round edges from wall to wall of a channel at a Reynolds number of 5000 pitches and \
            plunges, effective incidence 8 + 14 sin deg, at the reduced frequencies 0.5 (W1, W4) \
            and 1 (W2, W3) and the Strouhal numbers 0.16 (W1, W3) and 0.32 (W2, W4): histories of lift and drag coefficient. Computed: the middle strip, two \
            chords wide, of a wing of aspect ratio 32.",
    part: Part::Experiments,
    quick: false,
    run,
}];

/// Name, reduced frequency, amplitudes [deg] of the plunge's flow angle and of pitch, harmonics that
/// the filter of the measurement leaves.
type Motion = (&'static str, f64, [f64; 2], usize);

/// The first two were looked at first; the others were computed once the method stood.
const MOTIONS: [Motion; 4] = [
    ("W1", 0.5, [27.182, 13.16], 7),
    ("W3", 1.0, [27.182, 13.16], 3),
    ("W2", 1.0, [47.756, 33.73], 3),
    ("W4", 0.5, [47.756, 33.73], 7),
];
/// So many motions from the first on, and what they are called together.
const GROUPS: [(usize, &str); 2] = [(2, "mean of W1 and W3"), (4, "mean of all four")];

/// Span positions [chords] from the middle to the tip.
const STATIONS: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.5, 7.0, 11.0, 16.0];
/// Travel [chords] until the last period ends, four periods of W1 and W4 and eight of the others: the
/// measurement leaves out its first five, and what begins from rest lacks lift as long as the vortex of the
/// start is near (Wagner), 4 % at 25 chords.
const TRAVEL: f64 = 25.0;
const AXIS: f64 = 0.25;
const MEAN: f64 = 8.0;

impl Plunge {
    /// Height [chords] by quadrature of the rate `-tan(A sin 2 pi s)`, highest at s = 0.
    fn of(amplitude: f64, period: f64) -> Self {
        let rate = |s: f64| -(amplitude * (TAU * s).sin()).tan();
        let mut height = vec![0.0];
        for k in 0..FINE {
            let s = |part: f64| (k as f64 + part) / FINE as f64;
            let simpson = (rate(s(0.0)) + 4.0 * rate(s(0.5)) + rate(s(1.0))) / 6.0;
            height.push(height[k] + period * simpson / FINE as f64);
        }
        let phase = (0..=FINE).map(|k| k as f64 / FINE as f64).collect();
        Self {
            amplitude,
            phase,
            height,
        }
    }

    fn at(&self, s: f64) -> [f64; 2] {
        let height = interpolate(&self.phase, &self.height, s.rem_euclid(1.0));
        [height, -(self.amplitude * (TAU * s).sin()).tan()]
    }
}

const FINE: usize = 2000;

/// Plunge over a period: height [chords] and the law of its rate.
struct Plunge {
    amplitude: f64,
    phase: Vec<f64>,
    height: Vec<f64>,
}

/// Drag and lift coefficient of the middle over the last period, a sample a step, both ends.
fn coefficients(
    &(_, k, [flow, pitch], _): &Motion,
    edge: Edge,
    [rows, per_chord, periods]: [usize; 3],
) -> Result<[Vec<f64>; 2], VerifyError> {
    let period = PI / k;
    let steps = (period * per_chord as f64).round() as usize;
    let plunge = Plunge::of(flow.to_radians(), period);
    let pitch = pitch.to_radians();
    let pose = |t: f64| {
        let s = t / period;
        let [height, rise] = plunge.at(s);
        let (sin, cos) = (TAU * s).sin_cos();
        Pose {
            turn: r2(MEAN.to_radians() - pitch * sin),
            spin: -pitch * TAU / period * cos * DVec3::Y,
            shift: height * DVec3::Z,
            velocity: rise * DVec3::Z,
        }
    };
    let wing = Wing {
        measured: 1,
        nose: Nose::Blunt,
        ..Wing::rectangle(rows, &STATIONS, AXIS, true)
    };
    let dt = period / steps as f64;
    let force = forces(
        &Fluid::unit(5000.0),
        &wing,
        edge,
        pose,
        [0.0, dt],
        periods * steps,
    )?;
    let last = &force[(periods - 1) * steps..];
    let of = |part: fn(&DVec3) -> f64| last.iter().map(|f| 2.0 * part(f)).collect();
    Ok([of(|f| f.x), of(|f| f.z)])
}

/// The history, a sample a step of one period and both ends, as its mean and first harmonics give it at
/// these phases.
fn filtered(history: &[f64], harmonics: usize, phases: &[f64]) -> Vec<f64> {
    let steps = history.len() - 1;
    let terms: Vec<[f64; 2]> = (1..=harmonics)
        .map(|k| harmonic(history, steps, k))
        .collect();
    let at = |s: &f64| {
        let term = |(k, [a, b]): (usize, &[f64; 2])| {
            let (sin, cos) = (TAU * (k + 1) as f64 * s).sin_cos();
            a * cos + b * sin
        };
        mean(history) + terms.iter().enumerate().map(term).sum::<f64>()
    };
    phases.iter().map(at).collect()
}

/// Drag and lift coefficient beside the measured ones.
fn beside(motion: &Motion, edge: Edge, mesh: [usize; 3]) -> Result<[Comparison; 2], VerifyError> {
    let table = Table::new(include_str!("../../data/baik2011_lift_drag.csv"));
    let own: Vec<usize> = (table.words("case").enumerate())
        .filter(|(_, name)| *name == motion.0)
        .map(|(k, _)| k)
        .collect();
    let [phase, drag, lift] = ["phase", "CD", "CL"].map(|name| {
        let column = table.numbers(name);
        own.iter().map(|&k| column[k]).collect::<Vec<f64>>()
    });
    let computed = coefficients(motion, edge, mesh)?;
    Ok([0, 1].map(|i| {
        let computed = filtered(&computed[i], motion.3, &phase);
        let points = phase.iter().zip([&drag, &lift][i]).zip(computed);
        Comparison {
            quantity: format!("{} coefficient, {}", ["drag", "lift"][i], motion.0).into(),
            along: "phase [1]".into(),
            against: "measured".into(),
            name: edge.name().into(),
            points: points.map(|((s, y), c)| [*s, *y, c]).collect(),
        }
    }))
}

const SOURCE: &str = "Baik 2011, thesis, Univ. Michigan, figs 5.24 to 5.27";
const BAND: &str = "a lattice with separation of others reaches 0.42 in lift and 0.29 in drag over four such \
                    motions, Theodorsen's theory 0.82 in lift";
const CHANGE: &str = "uncertainty: change for the second period of W1 by 12 panels along the chord and 20 steps a chord for 6 and 10";

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    for edge in Edge::ALL {
        let name = edge.name();
        let mut compared = Vec::new();
        for motion in &MOTIONS {
            let periods = (TRAVEL * motion.1 / PI).round() as usize;
            compared.push(beside(motion, edge, [6, 10, periods])?);
        }
        let errors = |c: &[Comparison; 2]| [0, 1].map(|i| c[i].rms_error());
        let all: Vec<[f64; 2]> = compared.iter().map(errors).collect();
        let mut short = Vec::new();
        for mesh in [[6, 10, 2], [12, 20, 2]] {
            short.push(errors(&beside(&MOTIONS[0], edge, mesh)?));
        }
        for (i, what, band) in [(1, "lift", 0.45), (0, "drag", 0.30)] {
            for (n, which) in GROUPS {
                let value = all[..n].iter().map(|e| e[i]).sum::<f64>() / n as f64;
                let quantity = format!("{name}: rms error of {what} coefficient, {which}");
                let row = Row::new(quantity, "1", value).against(0.0, SOURCE);
                let row = row.uncertain(short[1][i] - short[0][i]);
                rows.push(match edge == Edge::Sheds {
                    true => row.within(band, BAND),
                    false => row.because(CHANGE),
                });
            }
            for (k, (motion, error)) in MOTIONS.iter().zip(&all).enumerate() {
                let quantity = format!("{name}, {}: rms error of {what} coefficient", motion.0);
                let row = Row::new(quantity, "1", error[i]).against(0.0, SOURCE);
                rows.push(row.drawn(compared[k][i].clone()));
            }
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_plunge_amplitudes_follow_from_the_law() {
        for ((name, k, [flow, _], _), h0) in MOTIONS.iter().zip([0.5, 0.25, 0.5, 1.0]) {
            let plunge = Plunge::of(flow.to_radians(), PI / k);
            let [top, bottom] = [0.0, 0.5].map(|s| plunge.at(s)[0]);
            // The source rounds its angles to five digits.
            assert!((top - bottom - 2.0 * h0).abs() < 1e-3, "{name}");
            assert!(plunge.height[FINE].abs() < 1e-9, "{name} closes");
        }
    }
}
