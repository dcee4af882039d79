//! Wings that turn over on a passive hinge.
//!
//! A hinge along the span lets the air feather the wing: it is blown back by up to 90 deg from where its spring has
//! no moment, and stands edge on to the air there. Farther on the chord points the other way, the lower side leads, and
//! the force of a translating wing has another sign; a real hinge has struck its stop, or the body, before.

use std::f64::consts::FRAC_PI_2;

use wingbeat_dynamics::{ElementLaw, Joint, JointType, Mechanism};
use wingbeat_math::DVec3;

use crate::bodies::system_of;
use crate::setup::FlightSetup;

/// Cosine of the angle between an axis and the span up to which the chord turns about it \[1\]: 45 deg.
const ALONG_SPAN: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl FlightSetup {
    /// Says which wings turned over on a passive hinge: by more than 90 deg from its rest, about an axis along the
    /// span. `ranges`: least and largest coordinate along every free direction of every joint \[rad or m\], in the
    /// order of [`crate::Record::joints`].
    pub fn turned_over(&self, ranges: &[[f64; 2]]) -> Vec<String> {
        if ranges.is_empty() {
            return vec![];
        }
        let Ok(system) = system_of(self) else {
            return vec![];
        };
        let mechanism = Mechanism::of(&system);
        let joints = mechanism.joints().iter();
        let directions =
            joints.flat_map(|joint| (0..joint.model.kind.directions()).map(move |k| (joint, k)));
        let found = directions
            .zip(ranges)
            .filter_map(|((joint, k), range)| self.turned(joint, k, *range));
        found.collect()
    }

    /// The same of the free direction `k` of a joint.
    fn turned(&self, joint: &Joint, k: usize, range: [f64; 2]) -> Option<String> {
        let wing = joint.child.checked_sub(1)?;
        let wing = self.animal.wings.get(wing)?;
        let rest = rest(joint, k)?;
        let from_rest = range.map(|angle| angle - rest);
        let farthest = match from_rest[1] > -from_rest[0] {
            true => from_rest[1],
            false => from_rest[0],
        };
        (turns_chord(joint, k) && farthest.abs() > FRAC_PI_2).then(|| {
            format!(
                "wing `{}` turned by {:.0} deg from the rest of its hinge (joint `{}`), and beyond 90 deg its chord points the other way and its lower side leads: give the hinge a stop, a stiffer one, or a stiffer spring ([[joint.{}.element]])",
                wing.name,
                farthest.to_degrees(),
                joint.name,
                joint.name
            )
        })
    }
}

/// Whether the chord of the child turns about the free direction `k`.
fn turns_chord(joint: &Joint, k: usize) -> bool {
    let axis = match joint.model.kind {
        JointType::Revolute { axis } => axis,
        JointType::Universal { axes } => axes[k],
        JointType::Spherical => [DVec3::X, DVec3::Y, DVec3::Z][k],
        JointType::Weld | JointType::Prismatic { .. } | JointType::PointOnLine { .. } => {
            return false;
        }
    };
    axis.y.abs() >= ALONG_SPAN * axis.length()
}

/// Where the springs along the free direction `k` have no moment together \[rad or m\], without springs where the
/// coordinate is 0; none where a drive acts along it.
fn rest(joint: &Joint, k: usize) -> Option<f64> {
    let own = (joint.model.elements.iter()).filter(|element| element.direction == k);
    let (mut stiffness, mut moment) = (0.0, 0.0);
    for element in own {
        match &element.law {
            ElementLaw::Spring { stiffness: k, rest } => {
                stiffness += k;
                moment += k * rest;
            }
            ElementLaw::Effort(_) | ElementLaw::Follow { .. } => return None,
            ElementLaw::Damper { .. } | ElementLaw::Stop { .. } => {}
        }
    }
    Some(match stiffness > 0.0 {
        true => moment / stiffness,
        false => 0.0,
    })
}
