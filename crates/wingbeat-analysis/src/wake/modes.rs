//! Floquet's modes by disturbed flights.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::StartState;
use wingbeat_flight::{AirModel, FlightSetup, MotionMode, Record};
use wingbeat_math::{DMat3, DQuat, EulerSequence};

use super::free_beat::{free_beat, rotation, start, steps_per_beat};
use super::trim::WakeTrim;
use super::wings::map_between;
use crate::AnalysisError;
use crate::eigen::eigen;
use crate::level::{Level, Perturbation};
use crate::modes::{ModeSet, Scales};
use crate::progress;

/// What is held fixed when the state of the body is disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WakeMemory {
    /// The wake of the trimmed flight.
    Given,
    /// The disturbed motion during the hold: the wake goes with it.
    Carried,
}
/// The derivative of the free beat by the nine components of [`Perturbation`] at the release, 9 x 9
/// by rows, about the trimmed flight.
///
/// # Errors
/// A flight that fails; disturbances that do not reach all nine components.
pub fn wake_monodromy(trim: &WakeTrim, memory: WakeMemory) -> Result<Vec<f64>, AnalysisError> {
    if trim.is_orbit() {
        return Err(AnalysisError::not_covered(
            "this flight is periodic with its elastic wings or wakes of strips, and no wake is given or carried",
            "ask for the modes of body, wings and wakes (elastic_floquet; `wingbeat stability` without --wake)",
        ));
    }
    let steps = steps_per_beat(&trim.setup)?;
    let level = Level::new(start(&trim.setup).rotation(), trim.setup.gravity);
    let scales = scales(&trim.setup).array();
    let seen = |r: &Record| {
        let velocity = r.momentum / trim.setup.animal.mass();
        Perturbation::seen(&level, rotation(r), velocity, r.root_angular_velocity).to_array()
    };
    let (mut before, mut after) = (vec![0.0; 81], vec![0.0; 81]);
    for k in 0..9 {
        let h = 1e-3 * scales[k];
        let fly = |s: f64| -> Result<[[f64; 9]; 2], AnalysisError> {
            progress::task("disturbed flights", 2 * k + usize::from(s < 0.0), 18);
            let mut x = [0.0; 9];
            x[k] = s * h;
            let [a, b] = disturbed(trim, &level, &Perturbation::from_array(x), memory, steps)?;
            Ok([seen(&a), seen(&b)])
        };
        let (plus, minus) = (fly(1.0)?, fly(-1.0)?);
        for i in 0..9 {
            before[9 * i + k] = (plus[0][i] - minus[0][i]) / (2.0 * h);
            after[9 * i + k] = (plus[1][i] - minus[1][i]) / (2.0 * h);
        }
    }
    map_between(&before, &after, 9)
}

/// The free beat with a disturbance.
fn disturbed(
    trim: &WakeTrim,
    level: &Level,
    by: &Perturbation,
    memory: WakeMemory,
    steps: usize,
) -> Result<[Record; 2], AnalysisError> {
    // Rotation in N that carries the trimmed attitude to the disturbed one.
    let tilt = DMat3::from_quat(DQuat::from_scaled_axis(by.tilt));
    let turn = level.to_n * tilt * level.to_n.transpose();
    let push = level.to_n * tilt * by.velocity;
    let rate = level.to_root * by.rate;
    let trimmed = start(&trim.setup);
    let mut setup = trim.setup.clone();
    if let AirModel::VortexLattice(air) = &mut setup.air {
        air.mirror = false; // lateral disturbances need both sides
    }
    match memory {
        WakeMemory::Carried => {
            let attitude = turn * trimmed.rotation();
            setup.mode = MotionMode::Free(StartState {
                angles: EulerSequence::BODY_231.angles(attitude),
                velocity: turn * trimmed.velocity + push,
                angular_velocity: trimmed.angular_velocity + rate,
                ..trimmed.clone()
            });
            free_beat(&setup, steps, None)
        }
        WakeMemory::Given => {
            let change = |root: BodyMotion, record: &Record| {
                let arm = root.p - record.mass_centre;
                let r = turn * root.r;
                BodyMotion {
                    p: record.mass_centre + turn * arm,
                    r,
                    v: turn * root.v + push + (r * rate).cross(turn * arm),
                    w: root.w + rate,
                }
            };
            free_beat(&setup, steps, Some(&change))
        }
    }
}

fn scales(setup: &FlightSetup) -> Scales {
    let length = setup.animal.wing_length();
    let period = setup.time.period.unwrap_or(1.0);
    Scales {
        velocity: length / period,
        rate: 1.0 / period,
        period,
    }
}

/// Floquet's modes of the free beat about the trimmed flight.
///
/// # Errors
/// As [`wake_monodromy`].
pub fn wake_floquet(trim: &WakeTrim, memory: WakeMemory) -> Result<ModeSet, AnalysisError> {
    wake_modes(trim, &wake_monodromy(trim, memory)?)
}

/// The same of a derivative that is known, [`wake_monodromy`].
///
/// # Errors
/// Numbers that are not finite.
pub fn wake_modes(trim: &WakeTrim, monodromy: &[f64]) -> Result<ModeSet, AnalysisError> {
    let pairs = eigen(monodromy, 9)?;
    Ok(ModeSet::of_multipliers(pairs, &scales(&trim.setup), &[]))
}
