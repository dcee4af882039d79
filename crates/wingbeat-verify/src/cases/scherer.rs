//! A wing that heaves and pitches in a stream: mean thrust, where suction and pressure drag nearly balance.

use crate::lab::rig::{Edge, Fluid, Nose, Pose, Wing, forces};
use crate::lab::series::{Table, mean};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::TAU;
use wingbeat_air::{Friction, SectionDrag};
use wingbeat_math::{DVec3, r2};

pub(super) const CASES: &[Case] = &[Case {
    name: "scherer-1968",
    about: "A wing of aspect ratio 3 with a round leading edge that heaves by 0.6 chords and pitches about three quarters of its \
            chord at a Strouhal number of 0.2: mean thrust coefficient of 12 motions with the profile drag of the \
            section.",
    part: Part::Experiments,
    quick: false,
    run,
}];

/// Chords that the stream goes in a period.
const PERIOD: f64 = 6.0;
const HEAVE: f64 = 0.6;
const HALF_SPAN: f64 = 1.5;
const AXIS: f64 = 0.75;
/// Radius of the nose of NACA 63A015 over the chord [Loftin 1948, NACA Report 903].
const NOSE: f64 = 0.0163;
/// Panels along chord and half span, steps a period, periods.
const MESH: [usize; 4] = [12, 12, 80, 2];

const SOURCE: &str =
    "Scherer 1968, Hydronautics TR-662-1-F, as replotted by Izraelevitz et al. 2017, fig. 14";
const BAND: &str = "lifting lines and lattices of others reach 0.018 to 0.050 with this profile drag, \
                    that of Izraelevitz et al.; the bars of the measurement are 0.011";
const CHANGE: &str = "profile drag of Scherer's own static table; uncertainty: larger change, at 15 and \
                      75 deg, by 6 x 12 panels and 40 steps for 12 x 24 and 80, and by a third period";

/// Heave up `cos`, pitch `amplitude cos(. + lead)` nose up [rad].
fn pose(amplitude: f64, lead: f64, t: f64) -> Pose {
    let w = TAU / PERIOD;
    Pose {
        turn: r2(amplitude * (w * t + lead).cos()),
        spin: -amplitude * w * (w * t + lead).sin() * DVec3::Y,
        shift: HEAVE * (w * t).cos() * DVec3::Z,
        velocity: -HEAVE * w * (w * t).sin() * DVec3::Z,
    }
}

/// Mean thrust coefficient over the last period, of the lattice alone and lost by a profile drag coefficient of 1.
fn thrust(
    motion: [f64; 2],
    edge: Edge,
    [rows, cols, steps, periods]: [usize; 4],
) -> Result<[f64; 2], VerifyError> {
    let [amplitude, lead] = motion.map(f64::to_radians);
    let stations: Vec<f64> = (0..=cols)
        .map(|j| HALF_SPAN * (0.5 * std::f64::consts::PI * j as f64 / cols as f64).sin())
        .collect();
    let wing = Wing {
        nose: Nose::Aerofoil(NOSE),
        ..Wing::rectangle(rows, &stations, AXIS, true)
    };
    let none = SectionDrag {
        friction: Friction::None,
        cd0: 0.0,
        cd2: 0.0,
    };
    let fluid = Fluid {
        drag: none,
        ..Fluid::unit(3.1e5)
    };
    let (dt, pose) = (PERIOD / steps as f64, |t| pose(amplitude, lead, t));
    let force = forces(&fluid, &wing, edge, pose, [0.0, dt], periods * steps)?;
    let ahead: Vec<f64> = force.iter().map(|f| -2.0 * f.x / HALF_SPAN).collect();
    // A rigid section has the velocity of its mid chord, and its drag is linear in the coefficient.
    let lost = |k: usize| {
        let p = pose(k as f64 * dt);
        let middle = p.turn * ((0.5 - AXIS) * DVec3::X);
        let wind = fluid.stream - p.velocity - p.spin.cross(middle);
        wind.length() * wind.x
    };
    let lost: Vec<f64> = (0..=steps).map(lost).collect();
    Ok([mean(&ahead[(periods - 1) * steps..]), mean(&lost)])
}

/// The measurement: motions [deg] and thrust coefficients, two motions twice.
fn measured() -> Vec<([f64; 2], f64)> {
    let table = Table::new(include_str!("../../data/scherer1968_mean_thrust.csv"));
    let [amplitude, lead, thrust] =
        ["theta_max_deg", "psi_deg", "CT"].map(|name| table.numbers(name));
    let row = |k: usize| ([amplitude[k], lead[k]], thrust[k]);
    (0..thrust.len()).map(row).collect()
}

/// What [`thrust`] gives for the motions of all marks.
fn flown(marks: &[([f64; 2], f64)], edge: Edge) -> Result<Vec<[f64; 2]>, VerifyError> {
    let mut flown: Vec<[f64; 2]> = Vec::new();
    for (k, (motion, _)) in marks.iter().enumerate() {
        flown.push(match k.checked_sub(1).filter(|&j| marks[j].0 == *motion) {
            Some(twice) => flown[twice],
            None => thrust(*motion, edge, MESH)?,
        });
    }
    Ok(flown)
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let marks = measured();
    // Our own errors, for a motion in the middle.
    let middle = [15.0, 75.0];
    let mut rows = Vec::new();
    for edge in Edge::ALL {
        let name = edge.name();
        let mut change: f64 = 0.0;
        let [base, _] = thrust(middle, edge, MESH)?;
        for mesh in [[6, 6, 40, 2], [12, 12, 80, 3]] {
            let [other, _] = thrust(middle, edge, mesh)?;
            change = change.max((other - base).abs());
        }
        let flown = flown(&marks, edge)?;
        for cd0 in [0.057, 0.027] {
            let apart = flown.iter().zip(&marks);
            let apart = apart.map(|([t, lost], (_, mark))| (t - cd0 * lost - mark).abs());
            let error = apart.sum::<f64>() / marks.len() as f64;
            let quantity = format!("{name}, C_d0 {cd0}: mean absolute error of thrust coefficient");
            let row = Row::new(quantity, "1", error).against(0.0, SOURCE);
            let row = row.uncertain(change);
            rows.push(match (edge == Edge::Sheds, cd0) {
                (true, 0.057) => row.within(0.03, BAND),
                _ => row.because(CHANGE),
            });
        }
        if edge != Edge::Attached {
            for ((motion, mark), [t, lost]) in marks.iter().zip(&flown) {
                let [pitch, lead] = motion;
                let quantity = format!("{name}, C_d0 0.057: pitch {pitch} deg, lead {lead} deg");
                let row = Row::new(quantity, "1", t - 0.057 * lost).against(*mark, SOURCE);
                rows.push(row.uncertain(change));
            }
        }
    }
    Ok(rows)
}
