//! Whether joints start as they are told, where loops have been closed.

use wingbeat_math::{BodyMotion, to_digits};

use std::f64::consts::TAU;

use super::Mechanism;
use crate::system::joint::Joint;
use crate::{DynamicsError, JointType};

/// Difference that counts as none \[rad, natural lengths, both over natural times for rates\], beside the same part of
/// what the loops ask for: what a reader types from a message is enough.
const TOLERANCE: f64 = 1e-5;

impl Mechanism {
    /// Checks that coordinates and rates of joints that are given for the start are those of `motions`, where
    /// the loops are closed.
    ///
    /// # Errors
    /// [`DynamicsError::NotTheStart`] names the first joint that starts otherwise.
    pub fn check_starts(&self, motions: &[BodyMotion]) -> Result<(), DynamicsError> {
        let mut closed = vec![];
        self.coordinates(0.0, motions, &mut closed);
        let mut rest = closed.as_slice();
        for joint in self.joints() {
            let (own, others) = rest.split_at(joint.model.kind.directions());
            let given = [&joint.model.coordinates, &joint.model.rates];
            for (k, list) in given.into_iter().enumerate() {
                let asked: Vec<f64> = own.iter().map(|c| c[k]).collect();
                let differs = |(given, asked): (&f64, &f64)| self.differs(joint, k, *given, *asked);
                if list.iter().zip(&asked).any(differs) {
                    return Err(not_the_start(joint, k == 1, list, &asked[..list.len()]));
                }
            }
            rest = others;
        }
        Ok(())
    }

    /// Whether a coordinate (k = 0) or its rate (1) is another than the loops ask for.
    fn differs(&self, joint: &Joint, k: usize, given: f64, asked: f64) -> bool {
        let units = self.units();
        let length = match joint.model.kind {
            JointType::Prismatic { .. } => units.length,
            _ => 1.0,
        };
        let size = if k == 1 { length / units.time } else { length };
        let is_angle = k == 0
            && matches!(
                joint.model.kind,
                JointType::Revolute { .. } | JointType::Universal { .. }
            );
        let gap = match given - asked {
            gap if is_angle => gap - TAU * (gap / TAU).round(),
            gap => gap,
        };
        gap.abs() > TOLERANCE * (size + asked.abs())
    }
}

fn not_the_start(joint: &Joint, is_rate: bool, given: &[f64], asked: &[f64]) -> DynamicsError {
    let (factor, unit) = match joint.model.kind {
        JointType::Prismatic { .. } => (1.0, "m"),
        _ => (1f64.to_degrees(), "deg"),
    };
    let per = if is_rate { "/s" } else { "" };
    let words = |list: &[f64]| {
        let each: Vec<String> = list.iter().map(|x| rounded(factor * x)).collect();
        format!("{} {unit}{per}", each.join(", "))
    };
    DynamicsError::NotTheStart {
        joint: joint.name.clone(),
        is_rate,
        given: words(given),
        asked: words(asked),
    }
}

/// Seven digits.
fn rounded(x: f64) -> String {
    format!("{}", to_digits(x, 7) + 0.0)
}
