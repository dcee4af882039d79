//! Joints that turn all the way round: whole turns are counted from record to record.

use std::f64::consts::{PI, TAU};

use wingbeat_dynamics::{ElementLaw, Joint, JointType, Mechanism};

use crate::error::FlightError;

/// Makes the angles of revolute and universal joints, `[q, u]` along all free directions, go on from those `last`
/// recorded without jumps of a whole turn; the first go on from the start of the joint.
pub fn count(mechanism: &Mechanism, joints: &mut [[f64; 2]], last: &mut Vec<f64>) {
    if last.len() != joints.len() {
        last.clear();
        last.extend(directions(mechanism).map(start));
    }
    for ((direction, [angle, _]), last) in directions(mechanism).zip(joints).zip(last) {
        let turns = ((*last - *angle) / TAU).round();
        if counts(direction.0) && turns != 0.0 {
            *angle += TAU * turns;
        }
        *last = *angle;
    }
}

/// An error if a joint has turned by more than half a turn that has a spring, stop or follower, where the equations of
/// motion know its angle within half a turn.
///
/// # Errors
/// [`FlightError::TurnedPast`].
pub fn check(mechanism: &Mechanism, time: f64, joints: &[[f64; 2]]) -> Result<(), FlightError> {
    let past = |((joint, k), [angle, _]): &((&Joint, usize), &[f64; 2])| {
        let mut elements = joint.model.elements.iter();
        let held = elements.any(|e| e.direction == *k && knows_angle(&e.law));
        counts(joint) && held && angle.abs() > PI
    };
    match directions(mechanism).zip(joints).find(past) {
        None => Ok(()),
        Some(((joint, _), _)) => Err(FlightError::TurnedPast {
            time,
            joint: joint.name.clone(),
        }),
    }
}

/// An error if a spherical joint that has a spring, stop or follower has turned past half a turn since the
/// angles `last` recorded: its rotation vector goes over into the opposite one there, and what acts along it
/// with it.
///
/// # Errors
/// [`FlightError::TurnedPast`].
pub fn check_spherical(
    mechanism: &Mechanism,
    time: f64,
    joints: &[[f64; 2]],
    last: &[f64],
) -> Result<(), FlightError> {
    let mut from = 0;
    for joint in mechanism.joints() {
        let own = from..from + joint.model.kind.directions();
        from = own.end;
        let mut laws = joint.model.elements.iter().map(|e| &e.law);
        if joint.model.kind != JointType::Spherical || !laws.any(knows_angle) {
            continue;
        }
        let (Some(now), Some(before)) = (joints.get(own.clone()), last.get(own)) else {
            continue;
        };
        let both = now.iter().zip(before);
        let moved = both.map(|([q, _], b)| (q - b).powi(2)).sum::<f64>().sqrt();
        if moved > PI {
            let joint = joint.name.clone();
            return Err(FlightError::TurnedPast { time, joint });
        }
    }
    Ok(())
}

/// Joints with the numbers of their free directions, in the order of [`Mechanism::coordinates`].
fn directions(mechanism: &Mechanism) -> impl Iterator<Item = (&Joint, usize)> {
    let joints = mechanism.joints().iter();
    joints.flat_map(|joint| (0..joint.model.kind.directions()).map(move |k| (joint, k)))
}

fn start((joint, k): (&Joint, usize)) -> f64 {
    joint.model.coordinates.get(k).copied().unwrap_or(0.0)
}

fn counts(joint: &Joint) -> bool {
    matches!(
        joint.model.kind,
        JointType::Revolute { .. } | JointType::Universal { .. }
    )
}

fn knows_angle(law: &ElementLaw) -> bool {
    match law {
        ElementLaw::Spring { stiffness, .. } | ElementLaw::Follow { stiffness, .. } => {
            *stiffness != 0.0
        }
        ElementLaw::Stop { .. } => true,
        ElementLaw::Damper { .. } | ElementLaw::Effort(_) => false,
    }
}
