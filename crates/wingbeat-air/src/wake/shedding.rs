//! The row that leaves an edge: unsteady Kutta condition.

use crate::lattice::Lattice;
use crate::settings::NewestRow;
use crate::state::{AirState, WakeSheet};
use crate::wake::near_wake::{kept, released};

impl Lattice {
    /// Unsteady Kutta condition: the row that leaves carries the circulation of its panels, at leading edges less what
    /// these hold.
    pub(crate) fn shed(&self, k: usize, sheet: &mut WakeSheet, state: &AirState, lengths: &[f64]) {
        let root = &self.sheets()[k];
        self.finalise_newest(k, sheet, state, lengths);
        let delays = self.settings().newest_row == NewestRow::Matched && sheet.rows() > 0;
        for (c, (&panel, &sign)) in root.panels.iter().zip(&root.signs).enumerate() {
            let before = sheet.newest(c);
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
            if self.feeds(k, sheet, c) {
                let ring = &mut sheet.gamma[newest * sheet.columns + c];
                let present = root.signs[c] * state.gamma[root.panels[c]];
                let wanted = self.to_shed(state, (k, c), present, *ring);
                *ring += kept(lengths[c]) * (wanted - *ring);
            }
        }
    }
}
