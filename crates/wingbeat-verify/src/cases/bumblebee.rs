//! A bumblebee in forward flight, in the setting of all insects.

use crate::lab::insect::{Choice, DEFAULT, Flown, Insect, MODELS, STEP_BEFORE, fourier, middle};
use crate::lab::series::mean;
use crate::{Case, Part, Row, VerifyError};
use wingbeat_case::raw;
use wingbeat_case::raw::WingMotionCase;
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[Case {
    name: "bumblebee-forward",
    about: "A bumblebee in level flight at 2.5 m/s, its stroke plane inclined by 28 deg: vertical force of both wings \
            over the weight, horizontal force and power.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const MASS: f64 = 175e-6;
const WEIGHT: f64 = MASS * 9.81;
const SPEED: f64 = 2.5;
const SOURCE: &str = "Dudley & Ellington 1990, J. Exp. Biol. 148:19, as simplified in the bumblebee case of FluSI \
                      (Engels et al. 2016): level flight, so the weight";
const BAND: &str = "a quarter, as asked of dragonflies: wings flat, angles of a few harmonics, the force of the body left \
                    out; uncertainty: half the change over the last two beats";
/// Beats flown; the last two are measured.
const BEATS: usize = 5;

/// Wings of the outline's area and moments; angles in the convention of `wingbeat_model::kinematics::convert::flusi`.
fn bee() -> Insect {
    let length = 13.2e-3;
    Insect {
        length,
        area: 0.30315 * length * length,
        r2_hat: 0.57687,
        root: 0.05267 * length,
        frequency: 152.0,
        density: 1.177,
        viscosity: 1.568e-5,
        motion: WingMotionCase {
            phi: fourier(-24.0, &[-57.5], &[]),
            theta: fourier(-6.277, &[], &[]),
            psi: fourier(
                -15.0,
                &[],
                &[
                    -67.8694, 0.0, -17.4794, 0.0, -5.9638, 0.0, -1.4957, 0.0, -0.0269, 0.0, 0.1670,
                ],
            ),
            ..WingMotionCase::default()
        },
    }
}

/// The wings in level flight: the body, not in the air, has its nose up by 24.5 deg and the stroke plane is at 37.5
/// deg to it.
fn case(with: Choice) -> raw::Case {
    let mut case = bee().case(with);
    case.motion.stroke_plane_pitch_deg = (24.5 + 37.5).into();
    case.air.stream_m_s = [-SPEED, 0.0, 0.0];
    case
}

/// Vertical and forward force [weights] and power over the mass [W/kg] of the last two beats, and half their
/// differences.
fn flown(with: Choice) -> Result<[[f64; 2]; 3], VerifyError> {
    let flown = Flown::of(case(with))?;
    let beats = |series: &[f64]| -> [f64; 2] {
        middle(&[2, 1].map(|last| {
            let from = series.len() - 1 - last * with.steps;
            mean(&series[from..=from + with.steps])
        }))
    };
    let along =
        |axis: DVec3| -> Vec<f64> { (flown.force.iter()).map(|f| f.dot(axis) / WEIGHT).collect() };
    let power: Vec<f64> = flown.power.iter().map(|p| p / MASS).collect();
    Ok([
        beats(&along(-DVec3::Z)),
        beats(&along(DVec3::X)),
        beats(&power),
    ])
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    let long = |(name, with): (&'static str, Choice)| {
        let beats = BEATS;
        (name, Choice { beats, ..with })
    };
    let models = [MODELS[0], STEP_BEFORE, MODELS[2], MODELS[3], MODELS[5]].map(long);
    for (name, with) in models {
        let [lift, thrust, power] = flown(with)?;
        let row = Row::new(format!("{name}: mean vertical force"), "weights", lift[0])
            .against(1.0, SOURCE)
            .uncertain(lift[1]);
        rows.push(match name.starts_with("leading-edge sheets") {
            true => row.within_part(0.25, BAND),
            false => row,
        });
        let forward = format!("{name}: mean forward force");
        rows.push(Row::new(forward, "weights", thrust[0]).uncertain(thrust[1]));
        let over_mass = format!("{name}: mean power over the mass of the animal");
        rows.push(Row::new(over_mass, "W/kg", power[0]).uncertain(power[1]));
    }
    for (form, base) in [
        long(("roots hold", STEP_BEFORE.1)),
        long(("roots free", DEFAULT)),
    ] {
        for (what, with) in [
            ("step x 2", Choice { steps: 20, ..base }),
            ("step x 0.5", Choice { steps: 80, ..base }),
            (
                "mesh x 0.5",
                Choice {
                    mesh: [3, 5],
                    ..base
                },
            ),
            ("core x 2", Choice { core: 2.0, ..base }),
            ("core x 0.5", Choice { core: 0.5, ..base }),
        ] {
            let [lift, ..] = flown(with)?;
            let quantity = format!("{form}, {what}: mean vertical force");
            rows.push(Row::new(quantity, "weights", lift[0]).uncertain(lift[1]));
        }
    }
    Ok(rows)
}
