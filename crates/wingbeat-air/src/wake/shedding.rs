//! The row that leaves an edge: unsteady Kutta condition.

use crate::edges::EdgeKind;
use crate::lattice::Lattice;
use crate::settings::{LeadingEdge, NewestRow};
use crate::state::{AirState, WakeSheet};
use crate::wake::near_wake::{kept, released};

impl Lattice {
    /// Unsteady Kutta condition: the row that leaves carries the circulation of its panels; none
    /// where the flow stays attached to a leading edge.
    pub(crate) fn shed(&self, k: usize, sheet: &mut WakeSheet, state: &AirState, lengths: &[f64]) {
        let root = &self.sheets()[k];
        self.finalise_newest(k, sheet, state, lengths);
        let delays = self.settings().newest_row == NewestRow::Matched && sheet.rows() > 0;
        for (c, (&panel, &sign)) in root.panels.iter().zip(&root.signs).enumerate() {
            let attached = root.kinds[c] == EdgeKind::Leading && !self.leaves(panel, state);
            let present = sign * state.gamma[panel];
            let gamma = match (attached, delays) {
                (true, _) => 0.0,
                (false, false) => present,
                (false, true) => {
                    let before = sheet.newest(c);
                    before + released(lengths[c]) * (present - before)
                }
            };
            sheet.gamma.push(gamma);
        }
        sheet.shed_time.push(state.time);
    }

    /// The row that was the newest gets the circulation it keeps.
    fn finalise_newest(&self, k: usize, sheet: &mut WakeSheet, state: &AirState, lengths: &[f64]) {
        let Some(newest) = sheet.rows().checked_sub(1) else {
            return;
        };
        if self.settings().newest_row == NewestRow::Constant {
            return;
        }
        let root = &self.sheets()[k];
        for c in 0..sheet.columns {
            let ring = &mut sheet.gamma[newest * sheet.columns + c];
            let stays_attached = root.kinds[c] == EdgeKind::Leading
                && self.settings().leading != LeadingEdge::Always
                && *ring == 0.0;
            if !stays_attached {
                let change = root.signs[c] * state.gamma[root.panels[c]] - *ring;
                *ring += kept(lengths[c]) * change;
            }
        }
    }
}
