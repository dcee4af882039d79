//! Wings that revolve with their body, trailing edge ahead.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::RotationLaw;
use wingbeat_model::Wing;

use super::air_past::strips;
use super::said::names;
use crate::setup::{FlightSetup, MotionMode};

/// Mean cosine of the angle of attack below which the trailing edge is ahead \[1\], as of beating wings.
const BACKWARDS: f64 = -0.2;

/// Part of the dynamic pressure past the wings that the rotation of the body makes at least to count \[1\].
const COUNTS: f64 = 0.1;

impl FlightSetup {
    /// Says which wings, which do not beat, revolve with the trailing edge ahead: on a tether that turns, or a body
    /// that is released turning. Of a mirrored pair that is one of them.
    pub fn revolves_backwards(&self) -> Option<String> {
        let (backwards, turning) = self.wings_that_revolve();
        if backwards.is_empty() {
            return None;
        }
        let key = match self.mode {
            MotionMode::Tethered(_) => "flight.tether, as yaw.rate_deg_s",
            MotionMode::Free(_) => "flight.angular_velocity_deg_s",
        };
        let remedy = match backwards.len() == turning {
            true => format!(
                "turn it the other way ({key} with the other sign), or take the mirror image of the wing (a left one for a right one)"
            ),
            false => "of a mirrored pair that turns one wing goes ahead, one back. Give the one that goes back a psi of its own, 180 deg less that of the other (right 45, left 135: [wing.left] with motion.psi.constant_deg = 135), or fly one wing alone (mirror = false)".to_owned(),
        };
        let wings = names(backwards.iter().map(|w| &w.name[..]), ", ");
        Some(format!(
            "the body turns so that the trailing edge is ahead (wings {wings}): {remedy}"
        ))
    }

    /// Whether `wing` revolves with the trailing edge ahead.
    pub(super) fn goes_back_as_body_turns(&self, wing: &Wing) -> bool {
        let (backwards, _) = self.wings_that_revolve();
        backwards.iter().any(|w| w.name == wing.name)
    }

    /// The still wings that revolve with the trailing edge ahead, and how many revolve.
    fn wings_that_revolve(&self) -> (Vec<&Wing>, usize) {
        let root = match &self.mode {
            MotionMode::Tethered(motion) => motion.impulsive().at(0.0).motion,
            MotionMode::Free(_) => self.root_at_start(),
        };
        let wings = self.animal.wings.iter().enumerate();
        let still = wings.filter(|(w, wing)| wing.is_still() && !self.has_own_joint(*w));
        let (mut backwards, mut turning) = (vec![], 0);
        for (_, wing) in still {
            let [all, along, of_turning] = self.pressures(wing, &root);
            if of_turning > COUNTS * all {
                turning += 1;
                if along < BACKWARDS * all {
                    backwards.push(wing);
                }
            }
        }
        (backwards, turning)
    }

    /// Dynamic pressure of the undisturbed air past a still wing times width over density, the same times the cosine of
    /// the angle of attack, and what the rotation of the `root` alone would make \[m3/s2\].
    fn pressures(&self, wing: &Wing, root: &BodyMotion) -> [f64; 3] {
        let c = wing.motion.at(0.0).c;
        let stream = root.r.transpose() * (self.air_at_start() - root.v);
        let mut sums = [0.0; 3];
        for [front, rear, across] in strips(wing) {
            let (mid, aft) = (front.midpoint(rear), (rear - front).normalize_or_zero());
            let of_turning = root.w.cross(wing.hinge_b + c * mid);
            let past = c.transpose() * (stream - of_turning);
            let width = across.reject_from(aft).length();
            sums[0] += width * past.length_squared();
            sums[1] += width * past.length() * past.dot(aft);
            sums[2] += width * of_turning.length_squared();
        }
        sums
    }
}
