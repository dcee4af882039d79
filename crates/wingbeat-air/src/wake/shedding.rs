//! The row that leaves an edge: unsteady Kutta condition.

use crate::lattice::Lattice;
use crate::settings::NewestRow;
use crate::state::{AirState, WakeSheet};
use crate::wake::near_wake::{NEW_VORTEX, kept, released};

impl Lattice {
    /// Unsteady Kutta condition: the row that leaves carries the circulation of its panels, at leading edges less what
    /// these hold.
    pub(crate) fn shed(&self, k: usize, sheet: &mut WakeSheet, state: &AirState, lengths: &[f64]) {
        let root = &self.sheets()[k];
        self.finalise_newest(k, sheet, state, lengths);
        let delays = self.settings().newest_row == NewestRow::Matched && sheet.rows() > 0;
        for (c, (&panel, &sign)) in root.panels.iter().zip(&root.signs).enumerate() {
            let before = sheet.newest(c);
            if let Some(s) = self.suction().of_column(k, c) {
                leave_edge(sheet, c, sign * state.leaving[s]);
                continue;
            }
            let wanted = self.to_shed(state, (k, c), sign * state.gamma[panel], before);
            let gamma = match delays {
                false => wanted,
                true => before + released(lengths[c]) * (wanted - before),
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
            if self.suction().of_column(k, c).is_none() && self.feeds(k, sheet, c) {
                let ring = &mut sheet.gamma[newest * sheet.columns + c];
                let present = root.signs[c] * state.gamma[root.panels[c]];
                let wanted = self.to_shed(state, (k, c), present, *ring);
                *ring += kept(lengths[c]) * (wanted - *ring);
            }
        }
    }
}

/// Sheds the ring of a column that differs by `leaving` from the newest one. The vortex that is the difference lay part of the
/// way from the edge to the nodes shed before: it goes to both lines of nodes, so that its place remains.
fn leave_edge(sheet: &mut WakeSheet, column: usize, leaving: f64) {
    let before = sheet.newest(column);
    if let Some(newest) = sheet.rows().checked_sub(1) {
        sheet.gamma[newest * sheet.columns + column] += NEW_VORTEX * leaving;
    }
    sheet.gamma.push(before + leaving);
}
