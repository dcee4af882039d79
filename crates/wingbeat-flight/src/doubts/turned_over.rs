//! Wings that turn over on a passive hinge.
//!
//! A hinge along the span lets the air feather the wing: it is blown back by up to 90 deg from where it stands upright
//! on its stroke plane (psi = 0), and stands edge on to its stroke there. Farther on the chord points the other way,
//! the lower side leads, and the force of a translating wing has another sign; a real hinge has struck its stop, or
//! the body, before. What counts is the chord, whatever joints turn it. A wing that makes no strokes has no side that
//! leads: it has turned over where its chord turns through more than half a circle.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_6, PI, TAU};

use serde::{Deserialize, Serialize};
use wingbeat_dynamics::{ElementLaw, Joint, JointType, Mechanism};
use wingbeat_math::{DVec3, EulerSequence, larger, smaller};
use wingbeat_model::Wing;

use crate::bodies::system_of;
use crate::interface::record::Record;
use crate::setup::{AirModel, FlightSetup};

/// Cosine of the angle between an axis and the span up to which the chord turns about it \[1\]: 45 deg.
const ALONG_SPAN: f64 = FRAC_1_SQRT_2;

/// Range of the stroke angle from which on a wing strokes \[rad\].
const STROKE: f64 = FRAC_PI_6;

/// How a wing was turned in its stroke-plane frame.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Turn {
    /// Stroke angle phi and feathering angle psi at the last step, without jumps \[rad\].
    last: [f64; 2],
    /// Least and largest stroke angle phi and feathering angle psi \[rad\].
    phi: [f64; 2],
    psi: [f64; 2],
}

impl Turn {
    fn starting([phi, psi]: [f64; 2]) -> Self {
        Self {
            last: [phi, psi],
            phi: [phi; 2],
            psi: [psi; 2],
        }
    }

    /// Takes the angles of the next step. Those with a deviation `pi - theta` beyond 90 deg are found as half a turn more
    /// of both and the deviation theta, which stand for the same rotation: what is nearer to the last step counts.
    fn take(&mut self, angles: [f64; 2]) {
        let near = |half: f64| {
            [0, 1].map(|k| {
                let (x, last) = (angles[k] + half, self.last[k]);
                x + TAU * ((last - x) / TAU).round()
            })
        };
        let away = |a: [f64; 2]| [0, 1].map(|k: usize| (a[k] - self.last[k]).abs());
        let [same, other] = [near(0.0), near(PI)];
        let [a, b] = [away(same), away(other)].map(|d| d[0] + d[1]);
        let [phi, psi] = if b < a { other } else { same };
        self.last = [phi, psi];
        self.phi = wider(self.phi, phi);
        self.psi = wider(self.psi, psi);
    }

    fn farthest(&self) -> f64 {
        larger(self.psi[1], -self.psi[0])
    }

    fn strokes(&self) -> bool {
        self.phi[1] - self.phi[0] > STROKE
    }

    fn is_over(&self) -> bool {
        match self.strokes() {
            true => self.farthest() > FRAC_PI_2,
            false => self.psi[1] - self.psi[0] > PI,
        }
    }
}

/// Gathered step by step: how far the chord of every wing turned.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct TurnedOver {
    wings: Vec<Turn>,
}

impl TurnedOver {
    /// Takes the next step of a flight of `setup`.
    pub fn take(&mut self, r: &Record, setup: &FlightSetup) {
        let is_first = self.wings.is_empty();
        for k in 0..setup.animal.wings.len() {
            let Some(eta) = r.coordinates.get(6 * k + 9..6 * k + 12) else {
                return;
            };
            let plane = setup.stroke_plane_pitch(k);
            let angles = angles(r, plane, DVec3::from_slice(eta));
            match self.wings.get_mut(k) {
                Some(turn) => turn.take(angles),
                None if is_first => self.wings.push(Turn::starting(angles)),
                None => return,
            }
        }
    }

    /// Says which wings turned over on a passive hinge: by more than 90 deg from upright on their stroke plane, or
    /// without strokes through more than 180 deg.
    pub fn found(&self, setup: &FlightSetup) -> Vec<String> {
        if !self.wings.iter().any(Turn::is_over) {
            return vec![];
        }
        let Ok(system) = system_of(setup) else {
            return vec![];
        };
        let mechanism = Mechanism::of(&system);
        let wings = setup.animal.wings.iter().zip(&self.wings).enumerate();
        let over = wings.filter(|(_, (_, turn))| turn.is_over());
        let found = over.filter_map(|(k, (wing, turn))| {
            let hinge = feathering_hinge(mechanism.joints(), k + 1)?;
            Some(said(setup, wing, turn, hinge))
        });
        found.collect()
    }
}

/// The sentence.
fn said(setup: &FlightSetup, wing: &Wing, turn: &Turn, hinge: &Joint) -> String {
    let (wing, name) = (&wing.name, &hinge.name);
    let turned = match turn.strokes() {
        true => format!(
            "turned by {:.0} deg from upright on its stroke plane (joint `{name}`), and beyond 90 deg its chord points the other way",
            turn.farthest().to_degrees()
        ),
        false => format!(
            "turned through {:.0} deg on its hinge (joint `{name}`), more than half a circle",
            (turn.psi[1] - turn.psi[0]).to_degrees()
        ),
    };
    let leads = match (&setup.air, turn.strokes()) {
        (AirModel::None, _) | (_, false) => "",
        _ => " and its lower side leads",
    };
    let has_stops =
        (hinge.model.elements.iter()).any(|element| matches!(element.law, ElementLaw::Stop { .. }));
    let stop = match has_stops {
        true => "narrower or stiffer stops",
        false => "a stop",
    };
    format!(
        "wing `{wing}` {turned}{leads}: give the hinge {stop}, or a stiffer spring ([[joint.{name}.element]])"
    )
}

/// The passive joint that feathers the body `child`, nearest to it between it and the central body.
fn feathering_hinge(joints: &[Joint], mut child: usize) -> Option<&Joint> {
    for _ in joints {
        let joint = joints.iter().find(|joint| joint.child == child)?;
        if (0..joint.model.kind.directions()).any(|k| feathers(joint, k)) {
            return Some(joint);
        }
        child = joint.parent.filter(|&parent| parent > 0)?;
    }
    None
}

/// Whether the chord turns about the free direction `k` and no drive acts along it. Where no stroke turns it, the span
/// lies along axis 2 of all that carries the wing.
fn feathers(joint: &Joint, k: usize) -> bool {
    let axis = match joint.model.kind {
        JointType::Revolute { axis } => axis,
        JointType::Universal { axes } => axes[k],
        JointType::Spherical => [DVec3::X, DVec3::Y, DVec3::Z][k],
        JointType::Weld | JointType::Prismatic { .. } | JointType::PointOnLine { .. } => {
            return false;
        }
    };
    let is_driven = (joint.model.elements.iter())
        .filter(|element| element.direction == k)
        .any(|element| {
            matches!(
                element.law,
                ElementLaw::Effort(_) | ElementLaw::Follow { .. }
            )
        });
    !is_driven && axis.y.abs() >= ALONG_SPAN * axis.length()
}

/// Stroke angle phi and feathering angle psi of a wing with the Euler angles `eta` \[rad\] in the frame of a stroke plane
/// of this `pitch` in the body \[rad\].
fn angles(r: &Record, pitch: f64, eta: DVec3) -> [f64; 2] {
    let plane = DVec3::new(pitch, 0.0, 0.0);
    let plane = EulerSequence::BODY_231.rotation(plane); // phi of the body is about axis 2
    let wings = EulerSequence::WING_132;
    let relative = (r.root_rotation() * plane).transpose() * wings.rotation(eta);
    let angles = wings.angles(relative);
    [angles.x, angles.z]
}

fn wider([least, most]: [f64; 2], value: f64) -> [f64; 2] {
    [smaller(least, value), larger(most, value)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gathered over a motion of `[phi, theta, psi]` \[rad\] by its rotations.
    fn turned(motion: impl Fn(f64) -> [f64; 3]) -> Turn {
        let angles = |k: usize| {
            let eta = DVec3::from_array(motion(k as f64 / 50.0));
            let found = EulerSequence::WING_132.angles(EulerSequence::WING_132.rotation(eta));
            [found.x, found.z]
        };
        let mut turn = Turn::starting(angles(0));
        (1..=50).for_each(|k| turn.take(angles(k)));
        turn
    }

    /// A wing that deviates by 115 deg and feathers by 30 has not turned over; one that feathers by 100 has, and with a
    /// deviation as well.
    #[test]
    fn exact_deviations_beyond_a_right_angle_turn_nothing_over() {
        let beat = |t: f64| (TAU * t).sin();
        for (deviation, feathering) in [(2.0, 0.5), (-2.0, 0.5), (0.3, 1.75), (2.0, 1.75)] {
            let turn = turned(|t| [beat(t), deviation * beat(t), feathering * beat(t)]);
            let error = (turn.farthest() - feathering * beat(0.24))
                .abs()
                .max((turn.phi[1] - beat(0.24)).abs());
            assert!(error < 1e-12, "{deviation} {feathering}: {turn:?}"); // rounding
            assert_eq!(turn.is_over(), feathering > FRAC_PI_2);
        }
    }
}
