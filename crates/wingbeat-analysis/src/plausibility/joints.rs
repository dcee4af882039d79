//! What of the joints is implausible: springs in other units, starts beyond stops.

use std::f64::consts::PI;

use wingbeat_dynamics::{ElementLaw, Joint, JointType};
use wingbeat_flight::setup::carriers::chain;
use wingbeat_flight::{FlightSetup, growing_joint, inertia_about};

use super::limit::{Doubts, Limit, rounded};

/// Hinges of insects and robots vibrate at one to ten times their wingbeat.
const RATIO: Limit = Limit::at_most(100.0, "it will not turn; is the stiffness in N m/rad?");

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
                    let inertia = inertia_about(setup, joint, joint, k);
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
    let growing = growing_joint(setup).map(|j| format!("{}; take {}", j.said(setup), j.remedy));
    list.0.extend(growing);
}

/// The joint that carries a wing on whose springs what it carries vibrates most slowly, rigid and in a vacuum, and the
/// period \[s\]; none without springs. The inertia of the wing and of the bodies between is counted about the joint that
/// carries each: at least as much as that hangs on the spring.
pub(crate) fn slowest_on_springs(setup: &FlightSetup, wing: usize) -> Option<(String, f64)> {
    let chain = chain(&setup.joints, wing + 1);
    let of = |(place, joint): (usize, &&Joint)| {
        let stiffness = |k: usize| joint.model.damping_and_stiffness(k)[1];
        let inertia = |k: usize| -> f64 {
            let outward = chain[..=place].iter();
            outward
                .filter_map(|j| inertia_about(setup, j, joint, k))
                .sum()
        };
        let directions = 0..joint.model.kind.directions();
        let periods = directions
            .map(|k| 2.0 * PI * (inertia(k) / stiffness(k)).sqrt())
            .filter(|t| t.is_finite());
        let longest = periods.fold(0.0, f64::max);
        (longest > 0.0).then(|| (joint.name.clone(), longest))
    };
    let all = chain.iter().enumerate().filter_map(of);
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
