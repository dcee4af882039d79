//! What joints are given for the start, as constraints beside those of the loops.

use wingbeat_math::{BodyMotion, DVec3};

use super::form::AbsoluteForm;
use crate::JointType;
use crate::system::joint::Joint;

/// Rows of what joints are given for the start, in scaled columns, and what is missing there.
#[derive(Default)]
pub(super) struct Given(pub Vec<Vec<f64>>, pub Vec<f64>);

impl AbsoluteForm {
    /// Coordinates (k = 0) or rates (1) that joints are given for the start, if that is to be kept.
    pub(super) fn given(&self, t: f64, motions: &[BodyMotion], k: usize, keeps: bool) -> Given {
        let mut out = Given::default();
        let mechanism = self.mechanism();
        let lists = |j: &Joint| [j.model.coordinates.len(), j.model.rates.len()][k];
        if !keeps || mechanism.joints().iter().all(|j| lists(j) == 0) {
            return out;
        }
        let length = mechanism.units().length;
        // Rates are linear in the velocities.
        let mut still = motions.to_vec();
        for m in &mut still {
            (m.v, m.w) = (DVec3::ZERO, DVec3::ZERO);
        }
        let [mut now, mut rest, mut moved] = [vec![], vec![], vec![]];
        mechanism.coordinates(t, motions, &mut now);
        mechanism.coordinates(t, &still, &mut rest);
        let mut columns = vec![];
        for c in 0..6 * motions.len() {
            let m = still[c / 6];
            let one = DVec3::AXES[c % 3];
            match c % 6 < 3 {
                true => still[c / 6].v = one * length,
                false => still[c / 6].w = one,
            }
            mechanism.coordinates(t, &still, &mut moved);
            still[c / 6] = m;
            columns.push(
                moved
                    .iter()
                    .zip(&rest)
                    .map(|(a, b)| a[1] - b[1])
                    .collect::<Vec<_>>(),
            );
        }
        let mut at = 0;
        for joint in mechanism.joints() {
            let list = [&joint.model.coordinates, &joint.model.rates][k];
            let unit = match joint.model.kind {
                JointType::Prismatic { .. } => 1.0 / length,
                _ => 1.0,
            };
            for (i, value) in list.iter().enumerate() {
                out.0
                    .push(columns.iter().map(|c| c[at + i] * unit).collect());
                out.1.push((value - now[at + i][k]) * unit);
            }
            at += joint.model.kind.directions();
        }
        out
    }
}
