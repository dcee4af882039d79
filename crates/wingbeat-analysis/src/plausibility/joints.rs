//! What of the joints is implausible: springs in other units, starts beyond stops.

use std::f64::consts::PI;

use wingbeat_dynamics::{ElementLaw, Joint, JointType};
use wingbeat_flight::{FlightSetup, system_of};
use wingbeat_math::DVec3;

use super::limit::{Doubts, Limit, rounded};

/// Hinges of insects and robots vibrate at one to ten times their wingbeat.
const RATIO: Limit = Limit {
    low: 0.0,
    high: 100.0,
    hints: ["", "it will not turn; is the stiffness in N m/rad?"],
};

/// How far beyond a stop a joint may start: rounding of degrees [rad or m].
const ROUNDING: f64 = 1e-9;

/// Doubts about the joints of a flight that beats so often \[Hz\].
pub(super) fn doubts(setup: &FlightSetup, frequency: Option<f64>, list: &mut Doubts) {
    for joint in &setup.joints {
        for element in &joint.model.elements {
            let k = element.direction;
            let start = joint.model.coordinates.get(k).copied().unwrap_or(0.0);
            match &element.law {
                ElementLaw::Stop { lower, upper, .. } => {
                    list.0.extend(beyond(joint, start, [*lower, *upper]));
                }
                ElementLaw::Spring { stiffness, .. } | ElementLaw::Follow { stiffness, .. } => {
                    let inertia = inertia(setup, joint, k);
                    let omega = inertia.map(|j| (stiffness / j).sqrt() / (2.0 * PI));
                    let what = format!(
                        "joint `{}`: frequency of what hangs on its spring over the wingbeat frequency",
                        joint.name
                    );
                    let ratio = omega.zip(frequency).map(|(f, beat)| f / beat);
                    list.see(&RATIO, &what, ratio, "");
                }
                ElementLaw::Damper { .. } | ElementLaw::Effort(_) => {}
            }
        }
    }
}

/// The joint on whose springs what it carries, rigid and in a vacuum, vibrates most slowly, and the period \[s\]; none
/// without springs.
pub(crate) fn slowest_on_springs(setup: &FlightSetup) -> Option<(String, f64)> {
    let of = |joint: &Joint| {
        let elements = joint.model.elements.iter();
        let periods = elements.filter_map(|element| match &element.law {
            ElementLaw::Spring { stiffness, .. } | ElementLaw::Follow { stiffness, .. } => {
                let inertia = inertia(setup, joint, element.direction)?;
                Some(2.0 * PI * (inertia / stiffness).sqrt()).filter(|t| t.is_finite())
            }
            _ => None,
        });
        let longest = periods.fold(0.0, f64::max);
        (longest > 0.0).then(|| (joint.name.clone(), longest))
    };
    let all = setup.joints.iter().filter_map(of);
    all.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// What is said of a joint that starts at `q`, beyond its stop.
fn beyond(joint: &Joint, q: f64, [lower, upper]: [f64; 2]) -> Option<String> {
    let is_inside = (lower - ROUNDING..=upper + ROUNDING).contains(&q);
    let slides = matches!(joint.model.kind, JointType::Prismatic { .. });
    let [shown, from, to] = match slides {
        true => [q, lower, upper],
        false => [q, lower, upper].map(f64::to_degrees),
    }
    .map(rounded);
    let unit = if slides { "m" } else { "deg" };
    (!is_inside).then(|| {
        format!(
            "joint `{}` starts at {shown} {unit}, beyond its stop from {from} to {to} {unit}: it is thrown back; look at start_{unit} and stop",
            joint.name
        )
    })
}

/// Moment of inertia \[kg m2\] of the child about the axis of free direction `k`, of one that turns; its mass
/// \[kg\] of one that slides.
fn inertia(setup: &FlightSetup, joint: &Joint, k: usize) -> Option<f64> {
    let system = system_of(setup).ok()?;
    let mass = system.bodies().get(joint.child)?.mass;
    let axis = match joint.model.kind {
        JointType::Prismatic { .. } => return Some(mass.mass).filter(|m| *m > 0.0),
        JointType::Revolute { axis } => axis,
        JointType::Universal { axes } => *axes.get(k)?,
        JointType::Spherical | JointType::PointOnLine { .. } => *DVec3::AXES.get(k)?,
        JointType::Weld => return None,
    };
    // Steiner, from the origin of the child to the joint.
    let [a, s] = [joint.anchor_child, mass.first_moment].map(|x| x - x.dot(axis) * axis);
    let about = axis.dot(mass.inertia * axis) - 2.0 * a.dot(s) + mass.mass * a.length_squared();
    Some(about).filter(|j| *j > 0.0)
}
