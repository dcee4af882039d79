//! Two cambered wings that flap about their roots and pitch in a wind tunnel: lift and drag over the beat.
//!
//! The published angles are their extremes: sines stand for them. Pitch is taken about the quarter chord, and both
//! wings flap about one axis in the plane of symmetry; the coefficients are taken to be over the area of both wings.

use crate::lab::rig::{Edge, Fluid, Nose, Pose, Wing, forces};
use crate::lab::series::{Table, interpolate};
use crate::{Case, Comparison, Part, Row, VerifyError};
use std::f64::consts::TAU;
use wingbeat_math::{DVec3, r1, r2, root_mean_square};

pub(super) const CASES: &[Case] = &[Case {
    name: "razak-2014",
    about: "Two wings of the section NACA 6409 flap by 30 deg about their roots and pitch by 6 deg a quarter of a beat ahead of \
            it or behind it, in streams of 6 to 14.8 m/s: lift and drag coefficient over the beat.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const CHORD: f64 = 0.16;
/// Root and tip from the axis of flapping [chords].
const ENDS: [f64; 2] = [0.15 / CHORD, 0.55 / CHORD];
const FLAP_DEG: f64 = 30.0;
const PITCH_DEG: f64 = 6.0;
const AXIS: f64 = 0.25;
/// Radius of the nose over the chord: that of the four-digit sections, 1.1019 times the square of the thickness
/// [Abbott & von Doenhoff 1959].
const NOSE: f64 = 1.1019 * 0.09 * 0.09;
/// Beats flown before the one compared: 12 to 37 chords of travel.
const BEFORE: f64 = 0.5;

/// A figure of the experiment.
struct Motion {
    figure: &'static str,
    /// Speed of the stream [m/s], frequency [1/s].
    speed: f64,
    frequency: f64,
    /// Mean pitch [deg].
    mean: f64,
    /// 1 where pitch leads the flap by a quarter of a beat, -1 where it lags.
    lead: f64,
}

const fn motion(figure: &'static str, flow: [f64; 2], mean: f64, lead: f64) -> Motion {
    let [speed, frequency] = flow;
    Motion {
        figure,
        speed,
        frequency,
        mean,
        lead,
    }
}

const MOTIONS: [Motion; 6] = [
    motion("9", [6.0, 0.79], 2.0, 1.0),
    motion("10", [6.0, 1.23], -4.0, 1.0),
    motion("11", [14.8, 1.23], -2.0, 1.0),
    motion("13", [9.4, 1.23], 1.0, -1.0),
    motion("14", [6.0, 1.5], -6.0, -1.0),
    motion("15", [6.0, 1.5], 10.0, -1.0),
];

/// Height of the mean line of NACA 64xx at this part of the chord, over the chord [Abbott & von Doenhoff 1959,
/// sec. 6.4].
fn mean_line(s: f64) -> f64 {
    const HEIGHT: f64 = 0.06;
    const PEAK: f64 = 0.4;
    let part = if s < PEAK { PEAK } else { 1.0 - PEAK };
    let ends = if s < PEAK { 0.0 } else { 1.0 - 2.0 * PEAK };
    HEIGHT * (ends + 2.0 * PEAK * s - s * s) / (part * part)
}

fn wing([rows, cols]: [usize; 2]) -> Wing {
    let stations: Vec<f64> = (0..=cols)
        .map(|j| ENDS[0] + (ENDS[1] - ENDS[0]) * j as f64 / cols as f64)
        .collect();
    let mut wing = Wing::rectangle(rows, &stations, AXIS, false);
    for x in &mut wing.nodes {
        x.z = mean_line(x.x + AXIS);
    }
    Wing {
        paired: true,
        nose: Nose::Aerofoil(NOSE),
        ..wing
    }
}

impl Motion {
    /// Chords that the stream goes in a beat.
    fn period(&self) -> f64 {
        self.speed / (self.frequency * CHORD)
    }

    /// Flap by a sine, tip up positive; pitch by a cosine, nose up positive.
    fn pose(&self, t: f64) -> Pose {
        let w = TAU / self.period();
        let (s, c) = (w * t).sin_cos();
        let [flap, pitch] = [FLAP_DEG, self.lead * PITCH_DEG].map(f64::to_radians);
        let flapped = r1(flap * s);
        Pose {
            turn: flapped * r2(self.mean.to_radians() + pitch * c),
            spin: flap * w * c * DVec3::X - flapped * (pitch * w * s * DVec3::Y),
            shift: DVec3::ZERO,
            velocity: DVec3::ZERO,
        }
    }

    /// Lift and drag coefficient at these phases of a beat.
    fn coefficients(
        &self,
        edge: Edge,
        [rows, cols, per_chord]: [usize; 3],
        phases: &[f64],
    ) -> Result<[Vec<f64>; 2], VerifyError> {
        let fluid = Fluid {
            kept: Some(20.0),
            ..Fluid::unit(self.speed * CHORD / 1.5e-5)
        };
        let steps = (self.period() * per_chord as f64).round();
        let dt = self.period() / steps;
        let last = ((1.0 + BEFORE) * steps).round() as usize + 1;
        let start = -BEFORE * self.period();
        let pose = |t: f64| self.pose(t);
        let force = forces(&fluid, &wing([rows, cols]), edge, pose, [start, dt], last)?;
        let phase: Vec<f64> = (0..force.len())
            .map(|k| (start + k as f64 * dt) / self.period())
            .collect();
        let at = |part: fn(&DVec3) -> f64| {
            let all: Vec<f64> = force.iter().map(part).collect();
            let of = |x: &f64| 2.0 * interpolate(&phase, &all, *x) / (ENDS[1] - ENDS[0]);
            phases.iter().map(of).collect()
        };
        Ok([at(|f| f.z), at(|f| f.x)])
    }
}

const SOURCE: &str =
    "Razak & Dimitriadis 2014, J. Fluids Struct. 49:687, in Lambert et al. 2017, figs. 9 to 15";
const BAND: &str = "the best that another program, FLUXVortex, has for these six motions in the mean: 0.233 in lift (an \
                    attached lattice with discrete vortices of strips added), 0.053 in drag; its attached lattice alone 0.247 \
                    and 0.055";
const OWN: &str =
    "root of the mean square of the measurement about its mean: in the reference's place";
const CHANGE: &str =
    "uncertainty: change of fig. 14 by 9 x 12 panels and 6 steps a chord for 6 x 8 and 4";
const QUANTITIES: [(&str, f64); 2] = [("lift", 0.233), ("drag", 0.053)];

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let table = Table::new(include_str!("../../data/razak2014_lift_drag.csv"));
    let figures: Vec<String> = table.words("figure").map(str::to_owned).collect();
    let columns = ["phase", "cl", "cd"].map(|name| table.numbers(name));
    let mut rows = Vec::new();
    for edge in Edge::ALL {
        let name = edge.name();
        let mut compared: [Vec<Comparison>; 2] = [vec![], vec![]];
        let mut change = [0.0; 2];
        for motion in &MOTIONS {
            let own = (0..figures.len()).filter(|&k| figures[k] == motion.figure);
            let own: Vec<usize> = own.collect();
            let of = |c: usize| -> Vec<f64> { own.iter().map(|&k| columns[c][k]).collect() };
            let phases = of(0);
            let computed = motion.coefficients(edge, [6, 8, 4], &phases)?;
            if motion.figure == "14" {
                let finer = motion.coefficients(edge, [9, 12, 6], &phases)?;
                for q in 0..2 {
                    let pairs = computed[q].iter().zip(&finer[q]);
                    change[q] = root_mean_square(pairs.map(|(a, b)| a - b));
                }
            }
            for q in 0..2 {
                let pairs = of(q + 1).into_iter().zip(&computed[q]);
                let what = QUANTITIES[q].0;
                compared[q].push(Comparison {
                    quantity: format!("{what} coefficient, fig. {}", motion.figure).into(),
                    along: "wingbeats [1]".into(),
                    against: "measured".into(),
                    name: name.into(),
                    points: (phases.iter().zip(pairs))
                        .map(|(x, (m, c))| [*x, m, *c])
                        .collect(),
                });
            }
        }
        for (q, (what, band)) in QUANTITIES.into_iter().enumerate() {
            let errors = compared[q].iter().map(Comparison::rms_error);
            let mean = errors.sum::<f64>() / MOTIONS.len() as f64;
            let quantity =
                format!("{name}: rms error of the {what} coefficient, mean of six motions");
            let row = Row::new(quantity, "1", mean).against(0.0, SOURCE);
            let row = row.uncertain(change[q]);
            rows.push(match edge == Edge::Sheds {
                true => row.within(band, BAND),
                false => row.because(CHANGE),
            });
            for comparison in std::mem::take(&mut compared[q]) {
                rows.extend(of_a_figure(name, comparison));
            }
        }
    }
    Ok(rows)
}

/// Error over the beat beside the measurement's own variation, and the means.
fn of_a_figure(name: &str, comparison: Comparison) -> [Row; 2] {
    let what = comparison.quantity.clone();
    let n = comparison.points.len() as f64;
    let mean = |k: usize| comparison.points.iter().map(|p| p[k]).sum::<f64>() / n;
    let (measured, computed) = (mean(1), mean(2));
    let about = comparison.points.iter().map(|p| (p[1] - measured).powi(2));
    let own = (about.sum::<f64>() / n).sqrt();
    let error = comparison.rms_error();
    [
        Row::new(format!("{name}: rms error of the {what}"), "1", error)
            .against(own, SOURCE)
            .because(OWN)
            .drawn(comparison),
        Row::new(format!("{name}: mean {what}"), "1", computed).against(measured, SOURCE),
    ]
}
