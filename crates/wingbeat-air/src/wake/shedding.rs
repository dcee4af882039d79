//! The row that leaves an edge: unsteady Kutta condition.

use crate::edges::EdgeKind;
use crate::geometry::WakeColumn;
use crate::lattice::Lattice;
use crate::settings::NewestRow;
use crate::state::{AirState, WakeSheet};
use crate::wake::near_wake::{NEW_VORTEX, RowShape, kept, released};

impl Lattice {
    /// Unsteady Kutta condition: the row that leaves carries the circulation of its panels, at leading edges
    /// less what these hold. What leaves edges within bodies is the mean of what leaves the wings there, whose
    /// sheets are among those `before`.
    pub(crate) fn shed(
        &self,
        k: usize,
        (before, sheet): (&[WakeSheet], &mut WakeSheet),
        state: &AirState,
        shape: &RowShape,
    ) {
        let root = &self.sheets()[k];
        self.finalise_newest(k, sheet, state, shape);
        let delays = self.settings().newest_row == NewestRow::Matched && sheet.rows() > 0;
        for (c, (&panel, &sign)) in root.panels.iter().zip(&root.signs).enumerate() {
            if let Some(beside) = self.leaving_beside(k, c) {
                carry(sheet, (c, sign), beside, before);
                continue;
            }
            let past = sheet.newest(c);
            if let Some(s) = self.suction().of_column(k, c) {
                leave_edge(sheet, c, sign * state.leaving[s]);
                continue;
            }
            let wanted = self.to_shed(state, (k, c), sign * state.gamma[panel], past);
            let gamma = match delays {
                false => wanted,
                true => past + released(shape.lengths[c]) * (wanted - past),
            };
            sheet.gamma.push(gamma);
        }
        sheet.shed_time.push(state.time);
    }

    /// How many rings with circulation the newest row of sheet `k` has from leading edges.
    pub(crate) fn leading_rings(&self, k: usize, sheet: &WakeSheet) -> u64 {
        let is_leading = |&c: &usize| self.sheets()[k].kinds[c] == EdgeKind::Leading;
        let columns = (0..sheet.columns).filter(is_leading);
        columns.filter(|&c| sheet.newest(c) != 0.0).count() as u64
    }

    /// The row that was the newest gets the circulation it keeps.
    fn finalise_newest(&self, k: usize, sheet: &mut WakeSheet, state: &AirState, shape: &RowShape) {
        let Some(newest) = sheet.rows().checked_sub(1) else {
            return;
        };
        if self.settings().newest_row == NewestRow::Constant {
            return;
        }
        let root = &self.sheets()[k];
        for c in 0..sheet.columns {
            if self.suction().of_column(k, c).is_none() && shape.feeding[c] > 0.0 {
                let ring = sheet.ring_mut(newest, c);
                let present = root.signs[c] * state.gamma[root.panels[c]];
                let wanted = self.to_shed(state, (k, c), present, *ring);
                *ring += shape.feeding[c] * kept(shape.lengths[c]) * (wanted - *ring);
            }
        }
    }
}

/// Sheds the mean of what just left the wings beside a panel within a body, whose ring is counted by this sign;
/// what they have changed of their rows before goes for its row before, too.
fn carry(
    sheet: &mut WakeSheet,
    (column, sign): (usize, f64),
    beside: [WakeColumn; 2],
    wings: &[WakeSheet],
) {
    let mean = |back: usize| {
        let of = |w: WakeColumn| {
            let wing = &wings[w.sheet];
            let row = wing.rows().checked_sub(back)?;
            Some(0.5 * sign * w.sign * wing.ring(row, w.column))
        };
        Some(of(beside[0])? + of(beside[1])?)
    };
    if let (Some(newest), Some(gamma)) = (sheet.rows().checked_sub(1), mean(2)) {
        *sheet.ring_mut(newest, column) = gamma;
    }
    sheet.gamma.push(mean(1).unwrap_or(0.0));
}

/// Sheds the ring of a column that differs by `leaving` from the newest one. The vortex that is the difference
/// lay part of the way from the edge to the nodes shed before: it goes to both lines of nodes, so that its
/// place remains.
fn leave_edge(sheet: &mut WakeSheet, column: usize, leaving: f64) {
    let before = sheet.newest(column);
    if let Some(newest) = sheet.rows().checked_sub(1) {
        *sheet.ring_mut(newest, column) += NEW_VORTEX * leaving;
    }
    sheet.gamma.push(before + leaving);
}
