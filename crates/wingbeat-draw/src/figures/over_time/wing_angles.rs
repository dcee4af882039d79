//! Angles of a wing: the prescribed ones, and what a joint at its hinge does to them.

use wingbeat_flight::FlightSetup;

use wingbeat_case::column_name;
use wingbeat_results::History;
use wingbeat_results::columns::column_stems;

/// How far the axis of a joint may be from that of feathering, as a sine \[1\].
const ASKEW: f64 = 1e-9;

/// Angles of a wing, row by row.
pub(crate) struct WingAngles {
    /// Stroke phi, deviation theta, feathering psi (Euler 1-3-2, wing against the stroke plane) \[rad\].
    pub angles: [Vec<f64>; 3],
    /// Whether the feathering is that of the wing: prescribed angle and that of its joint together.
    pub feathers: bool,
    /// Name and angle of a joint that turns the wing otherwise; `angles` are the prescribed ones then \[rad\].
    pub joint: Vec<(String, Vec<f64>)>,
}

/// The angles of wing number `wing`, from 0.
pub(crate) fn wing_angles(setup: &FlightSetup, history: &History, wing: usize) -> WingAngles {
    let name = &column_stems(&setup.animal)[wing + 1];
    let prescribed = |k: &str| {
        history
            .column(&format!("{name}_prescribed_{k}_rad"))
            .to_vec()
    };
    let mut found = WingAngles {
        angles: ["phi", "theta", "psi"].map(prescribed),
        feathers: false,
        joint: vec![],
    };
    let Some(joint) = setup.joints.iter().find(|j| j.child == wing + 1) else {
        return found;
    };
    // Feathering is the last of the rotations, about axis 2 of the wing: angles about it add up.
    let sign = match joint.model.kind.axes() {
        [axis] if joint.law.is_none() => {
            (axis.x.hypot(axis.z) < ASKEW * axis.length()).then(|| axis.y.signum())
        }
        _ => None,
    };
    let stem = format!("joint_{}_rotation", column_name(&joint.name));
    let is_of = |n: &&String| {
        let number = n.strip_prefix(&stem).and_then(|n| n.strip_suffix("_rad"));
        number.is_some_and(|n| ["", "_1", "_2", "_3"].contains(&n))
    };
    for column in history.names().iter().filter(is_of) {
        let turned = history.column(column);
        match sign {
            Some(sign) => {
                let psi = found.angles[2].iter_mut().zip(turned);
                psi.for_each(|(psi, q)| *psi += sign * q);
                found.feathers = true;
            }
            None => {
                let number = column[stem.len()..].trim_end_matches("_rad");
                let name = format!("joint {}{}", joint.name, number.replace('_', " "));
                found.joint.push((name, turned.to_vec()));
            }
        }
    }
    found
}
