//! Where and when the flow leaves the leading edge of a wing that pitches up.

use crate::lab::fly;
use crate::lab::ramp::Ramp;
use crate::lab::rig::{Pose, Wing};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::FRAC_PI_4;
use wingbeat_air::{AirSettings, LeadingEdge, SheddingKinds};
use wingbeat_math::{DVec3, r2};

pub(super) const CASES: &[Case] = &[Case {
    name: "hirato-onset-2019",
    about: "Wings of aspect ratio 6 with the mean line of SD7003 pitch from 0 to 45 deg about the quarter chord of \
            their root, reduced rate 0.3: when and where the leading-edge suction parameter first exceeds 0.27, the \
            wing untwisted and with 10 deg more at its tip.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const HALF_SPAN: f64 = 3.0;
const AXIS: f64 = 0.25;
/// Rate of pitch [rad per chord of travel], from one chord on.
const RATE: f64 = 0.6;
const START: f64 = 1.0;
/// From [`START`] on, in chords.
const RAMP: Ramp = Ramp {
    height: FRAC_PI_4,
    length: FRAC_PI_4 / RATE,
    smoothing: 11.0,
};
const CRITICAL: f64 = 0.27;

const SOURCE: &str =
    "Hirato, Shen, Gopalarathnam & Edwards 2019, J. Aircraft 56(4), a vortex lattice of theirs";
const BAND: &str = "two steps of theirs; by how much another program of the same rules is off";
const CHANGE: &str = "8 x 24 panels and 40 steps a chord, on which others reproduce it; uncertainty: change by twice as many";

/// Mean line over the chord at the part `x` of the chord: two parabolas of the largest camber of SD7003, 1.46 %
/// at 0.35.
fn mean_line(x: f64) -> f64 {
    let (most, at) = (0.0146, 0.35);
    match x < at {
        true => most / (at * at) * (2.0 * at * x - x * x),
        false => most / (1.0 - at).powi(2) * (1.0 - 2.0 * at + 2.0 * at * x - x * x),
    }
}

/// A wing whose incidence grows by `twist` [rad] from root to tip.
fn wing(rows: usize, cols: usize, twist: f64) -> Wing {
    let stations: Vec<f64> = (0..=cols)
        .map(|j| HALF_SPAN * j as f64 / cols as f64)
        .collect();
    let mut wing = Wing::rectangle(rows, &stations, AXIS, true);
    for x in &mut wing.nodes {
        let section = DVec3::new(x.x, 0.0, mean_line(x.x + AXIS));
        *x = r2(twist * x.y / HALF_SPAN) * section + DVec3::new(0.0, x.y, 0.0);
    }
    wing
}

/// Time [chords of travel] and place [half spans] of the first strip beyond the critical value.
fn onset(twist: f64, [rows, cols, steps]: [usize; 3]) -> Result<[f64; 2], VerifyError> {
    let wing = wing(rows, cols, twist);
    let accurate = AirSettings::accurate(1.0, DVec3::X);
    let settings = AirSettings {
        shedding: SheddingKinds {
            leading: true,
            ..accurate.shedding
        },
        leading: LeadingEdge::Suction {
            threshold: CRITICAL,
            efficiency: 1.0,
        },
        ..accurate
    };
    let lattice = wing.lattice(settings)?;
    let motion = |t: f64| {
        let [angle, rate] = RAMP.at(t - START);
        wing.moved(&Pose {
            turn: r2(angle),
            spin: rate * DVec3::Y,
            shift: DVec3::ZERO,
            velocity: DVec3::ZERO,
        })
    };
    let dt = 1.0 / steps as f64;
    let (mut first, mut before) = (None, vec![0.0; cols]);
    fly(&lattice, motion, dt, 2 * steps, |step, _, loads, _| {
        let now = &loads.leading[..cols];
        let most = (0..cols).fold(0, |m, c| if now[c] > now[m] { c } else { m });
        if first.is_none() && step > 1 && now[most] > CRITICAL {
            let part = (CRITICAL - before[most]) / (now[most] - before[most]);
            first = Some([
                (step as f64 - 1.0 + part) * dt,
                (most as f64 + 0.5) / cols as f64,
            ]);
        }
        before.copy_from_slice(now);
    })?;
    Ok(first.unwrap_or([f64::NAN; 2]))
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    for (about, twist, time, place) in [
        ("untwisted", 0.0, 1.710, 0.0),
        ("tip twisted by 10 deg", 10.0, 1.575, 0.5),
    ] {
        let twist = f64::to_radians(twist);
        let [[when, at], [finer, _]] = [onset(twist, [8, 12, 40])?, onset(twist, [16, 24, 80])?];
        let quantity = format!("{about}: chords of travel until the flow leaves");
        rows.push(
            Row::new(quantity, "1", when)
                .against(time, SOURCE)
                .uncertain(finer - when)
                .within(0.05, BAND),
        );
        rows.push(
            Row::new(format!("{about}: where it leaves first"), "half spans", at)
                .against(place, SOURCE)
                .because(CHANGE),
        );
    }
    Ok(rows)
}
