//! A plate that pitches up to 45 deg fast, within one chord of travel, or slowly, within six.

use crate::lab::ramp::Ramp;
use crate::lab::rig::{Edge, Fluid, Nose, Pose, Wing, forces};
use crate::lab::series::{Table, interpolate};
use crate::{Case, Comparison, Part, Row, VerifyError};
use std::f64::consts::{FRAC_PI_4, LN_2, TAU};
use wingbeat_math::{DVec3, r2};

pub(super) const CASES: &[Case] = &[Case {
    name: "mancini-2017",
    about: "A flat plate of aspect ratio 4 and 5 % thickness with round edges at a Reynolds number of 2e4 pitches about its leading edge \
            from 0 to 45 deg within one chord of travel (fast) or six (slow): lift coefficient against travel.",
    part: Part::Experiments,
    quick: false,
    run,
}];

/// A flight: name, its ramp (in chords), travel before it [chords], by when the smoothed corner
/// is below 1e-4 of its peak, column of the measurement, and band.
struct Flight {
    name: &'static str,
    ramp: Ramp,
    before: f64,
    column: &'static str,
    band: f64,
    /// Travel to which it is followed [chords], the slow one beyond its end.
    last: f64,
}

const fn ramp(length: f64, smoothing: f64) -> Ramp {
    Ramp {
        height: FRAC_PI_4,
        length,
        smoothing,
    }
}

const FLIGHTS: [Flight; 2] = [
    Flight {
        name: "fast",
        ramp: ramp(1.0, 15.0),
        before: 0.4,
        column: "CL_fast",
        band: 1.22,
        last: COMPARED,
    },
    Flight {
        name: "slow",
        ramp: ramp(6.0, 4.0),
        before: 1.2,
        column: "CL_slow",
        band: 0.29,
        last: 8.0,
    },
];

const HALF_SPAN: f64 = 2.0;
/// Travel [chords] over which others compare.
const COMPARED: f64 = 5.0;
/// By so much [chords] the measured lift of the fast ramp is late: both pulses of added mass, at the corners,
/// have their peaks there, a chord apart, the first at 0.25.
const LATE: f64 = 0.25;
/// Cut-off of the measurement's filter [1/chord]: 12 Hz at 0.26 m/s and a chord of 76.2 mm.
const CUT_OFF: f64 = 12.0 * 0.0762 / 0.26;

const SOURCE: &str = "Mancini 2017, thesis, Univ. Maryland, fig. 4.13b";
const BAND: &str = "what the lattice of others with shed leading-edge vorticity reaches over the first five chords (without it 1.40 fast, \
                    0.38 slow); uncertainty: change by 9 x 9 panels and 30 steps a chord for 6 x 6 and 20";
const SHIFTED: &str = "both pulses of added mass in the measured lift come a quarter of a chord after the corners of the ramp: the motion or its \
                       record is late";

/// Travel up to `until` [chords] and lift coefficient.
fn lift(
    flight: &Flight,
    edge: Edge,
    [panels, per_chord]: [usize; 2],
    until: f64,
) -> Result<[Vec<f64>; 2], VerifyError> {
    let stations: Vec<f64> = (0..=panels)
        .map(|j| HALF_SPAN * j as f64 / panels as f64)
        .collect();
    let wing = Wing {
        nose: Nose::Blunt,
        ..Wing::rectangle(panels, &stations, 0.0, true)
    };
    let pose = |s: f64| {
        let [angle, rate] = flight.ramp.at(s);
        Pose {
            turn: r2(angle),
            spin: rate * DVec3::Y,
            shift: DVec3::ZERO,
            velocity: DVec3::ZERO,
        }
    };
    let dt = 1.0 / per_chord as f64;
    let last = ((flight.before + until) * per_chord as f64).ceil() as usize;
    let force = forces(
        &Fluid::unit(2e4),
        &wing,
        edge,
        pose,
        [-flight.before, dt],
        last,
    )?;
    let s: Vec<f64> = (0..=last).map(|k| k as f64 * dt - flight.before).collect();
    let raw: Vec<f64> = force.iter().map(|f| 2.0 * f.z / HALF_SPAN).collect();
    let filtered = s.iter().map(|s0| filtered(&s, &raw, *s0)).collect();
    Ok([s, filtered])
}

/// What a filter without lag that halves what has the frequency of the cut-off leaves: a mean with the weights
/// of a bell curve.
fn filtered(s: &[f64], raw: &[f64], s0: f64) -> f64 {
    let width = (2.0 * LN_2).sqrt() / (TAU * CUT_OFF);
    let steps = -15..=15_i32;
    let weight = |k: i32| (-0.5 * (0.2 * f64::from(k)).powi(2)).exp();
    let at = |k: i32| interpolate(s, raw, s0 + 0.2 * f64::from(k) * width);
    let all: f64 = steps.clone().map(weight).sum();
    steps.map(|k| weight(k) * at(k)).sum::<f64>() / all
}

/// Measured and computed lift between these travels [chords], the computed one `late` chords later.
fn beside(
    (flight, edge): (&Flight, Edge),
    [s, lift]: &[Vec<f64>; 2],
    [from, to]: [f64; 2],
    late: f64,
) -> Comparison {
    let table = Table::new(include_str!("../../data/mancini2017_lift.csv"));
    let (travel, measured) = (table.numbers("s_over_c"), table.numbers(flight.column));
    let points = travel.iter().zip(measured);
    let points = points.filter(|(x, _)| (from..=to).contains(*x));
    Comparison {
        quantity: format!("lift coefficient, {}", flight.name).into(),
        along: "travel [chords]".into(),
        against: "measured".into(),
        name: edge.name().into(),
        points: points
            .map(|(x, y)| [*x, y, interpolate(s, lift, x - late)])
            .collect(),
    }
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    for edge in Edge::ALL {
        for flight in &FLIGHTS {
            rows.extend(compared(flight, edge)?);
        }
    }
    Ok(rows)
}

/// One ramp as it is described, and as late as the measured lift of the fast one is.
fn compared(flight: &Flight, edge: Edge) -> Result<Vec<Row>, VerifyError> {
    let coarse = lift(flight, edge, [6, 20], flight.last)?;
    let fine = match edge {
        Edge::Sheds => Some(lift(flight, edge, [9, 30], COMPARED)?),
        _ => None,
    };
    let name = format!("{}, {}", edge.name(), flight.name);
    let rms = |flown, late| beside((flight, edge), flown, [0.0, COMPARED], late).rms_error();
    let row = |quantity: String, late: f64| {
        let value = rms(&coarse, late);
        let row = Row::new(quantity, "1", value).against(0.0, SOURCE);
        match &fine {
            Some(fine) => row.uncertain(rms(fine, late) - value),
            None => row,
        }
    };
    let first = row(format!("{name}: rms error of lift coefficient"), 0.0);
    let first = first.drawn(beside((flight, edge), &coarse, [0.0, flight.last], 0.0));
    let late = row(format!("{name}, {LATE} chords later: the same"), LATE);
    let first = match edge == Edge::Sheds {
        true => first.within(flight.band, BAND),
        false => first,
    };
    Ok(vec![first, late.because(SHIFTED)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_filter_halves_the_frequency_of_the_cut_off() {
        let s: Vec<f64> = (0..=4000).map(|k| f64::from(k) * 1e-3).collect();
        let wave: Vec<f64> = s.iter().map(|s| (TAU * CUT_OFF * s).cos()).collect();
        let at = 7.0 / CUT_OFF;
        // The bell is cut off at three widths: 2e-3 too much is left.
        let left = filtered(&s, &wave, at);
        assert!((left - 0.5).abs() < 8e-3, "{left}");
    }
}
