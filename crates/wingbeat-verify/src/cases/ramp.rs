//! A plate that pitches up to 45 deg within one chord of travel.

use crate::lab::ramp::Ramp;
use crate::lab::rig::{Edge, Fluid, Nose, Pose, Wing, forces};
use crate::lab::series::{Table, interpolate};
use crate::{Case, Comparison, Part, Row, VerifyError};
use std::f64::consts::FRAC_PI_4;
use wingbeat_math::{DVec3, r2};

pub(super) const CASES: &[Case] = &[Case {
    name: "stevens-babinsky-2017",
    about: "A flat plate of aspect ratio 4 with a round leading edge at a Reynolds number of 1e4 pitches from 0 to 45 deg within \
            a chord of travel, about its leading edge or its mid chord, and stays there: lift \
            coefficient against travel.",
    part: Part::Experiments,
    quick: false,
    run,
}];

/// In chords.
const RAMP: Ramp = Ramp {
    height: FRAC_PI_4,
    length: 1.0,
    smoothing: 11.0,
};
/// Travel before the ramp [chords]: the smoothed corner is below 1e-3 of its peak there.
const BEFORE: f64 = 0.4;
const HALF_SPAN: f64 = 2.0;

const SOURCE: &str = "Stevens & Babinsky 2017, Exp. Fluids 58:7, fig. 21";
const BAND: &str = "about a sixth of the mean lift coefficient during the ramp; no uncertainty of the measurement is \
                    given, the rig's vibration shows as 0.2";
const CHANGE: &str = "from 0.05 chords of travel on; the plate stalls from about 20 deg on; uncertainty: \
                      change by 9 x 18 panels and 30 steps a chord for 6 x 12 and 20";
/// Travel from which the rig is quiet [chords].
const QUIET: f64 = 0.25;
const RINGS: &str = "before, the rig rings: measured are 8.3, 6.6 and 5.6 after 0.05, 0.10 and 0.15 chords, where attached flow with its \
                     added mass makes 5.1, 4.1 and 3.5";

/// Travel [chords] and lift coefficient, smoothed as the measurement: mean over 100 ms, 0.07 chords.
fn lift(
    axis: f64,
    edge: Edge,
    [rows, cols, per_chord]: [usize; 3],
) -> Result<[Vec<f64>; 2], VerifyError> {
    let stations: Vec<f64> = (0..=cols)
        .map(|j| HALF_SPAN * j as f64 / cols as f64)
        .collect();
    let wing = Wing {
        nose: Nose::Blunt,
        ..Wing::rectangle(rows, &stations, axis, true)
    };
    let pose = |s: f64| {
        let [angle, rate] = RAMP.at(s);
        Pose {
            turn: r2(angle),
            spin: rate * DVec3::Y,
            shift: DVec3::ZERO,
            velocity: DVec3::ZERO,
        }
    };
    let (dt, last) = (1.0 / per_chord as f64, (5.44 * per_chord as f64) as usize);
    let force = forces(&Fluid::unit(1e4), &wing, edge, pose, [-BEFORE, dt], last)?;
    let s: Vec<f64> = (0..=last).map(|k| k as f64 * dt - BEFORE).collect();
    let raw: Vec<f64> = force.iter().map(|f| 2.0 * f.z / HALF_SPAN).collect();
    let window = (-3..=3).map(|k| f64::from(k) * 0.01);
    let smooth = |s0: &f64| {
        let near = window.clone().map(|w| interpolate(&s, &raw, s0 + w));
        near.sum::<f64>() / 7.0
    };
    let smoothed = s.iter().map(smooth).collect();
    Ok([s, smoothed])
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let table = Table::new(include_str!("../../data/stevens_babinsky2017_lift.csv"));
    let travel = table.numbers("s_over_c");
    let first = travel.iter().take_while(|s| **s < 0.05).count();
    let mut rows = Vec::new();
    for edge in Edge::ALL {
        let name = edge.name();
        for (about, axis, column) in [
            ("leading edge", 0.0, "CL_leading_edge_axis"),
            ("mid chord", 0.5, "CL_mid_chord_axis"),
        ] {
            let measured = &table.numbers(column)[first..];
            let beside = |mesh| -> Result<Comparison, VerifyError> {
                let [s, lift] = lift(axis, edge, mesh)?;
                let points = travel[first..].iter().zip(measured);
                let points = points.map(|(x, y)| [*x, *y, interpolate(&s, &lift, *x)]);
                Ok(Comparison {
                    quantity: format!("lift coefficient, about the {about}").into(),
                    along: "travel [chords]".into(),
                    against: "measured".into(),
                    name: name.into(),
                    points: points.collect(),
                })
            };
            let [coarse, fine] = [beside([6, 6, 20])?, beside([9, 9, 30])?];
            let [value, finer] = [&coarse, &fine].map(Comparison::rms_error);
            let quantity = format!("{name}, about the {about}: rms error of lift coefficient");
            let row = Row::new(quantity, "1", value).against(0.0, SOURCE);
            let row = row.uncertain(finer - value);
            let late = Comparison {
                points: coarse
                    .points
                    .iter()
                    .copied()
                    .filter(|p| p[0] >= QUIET)
                    .collect(),
                ..coarse.clone()
            };
            let late = late.rms_error();
            let row = row.drawn(coarse);
            rows.push(match edge == Edge::Sheds {
                true => row.within(0.6, BAND),
                false => row.because(CHANGE),
            });
            if axis == 0.0 {
                let quantity = format!("{name}, about the {about}, from 0.25 chords on: rms error");
                rows.push(
                    Row::new(quantity, "1", late)
                        .against(0.0, SOURCE)
                        .because(RINGS),
                );
            }
        }
    }
    Ok(rows)
}
