//! Whether the flow leaves the leading edge, strip by strip, by what the state has kept.

use crate::edges::EdgeKind;
use crate::geometry::Edge;
use crate::lattice::Lattice;
use crate::settings::LeadingEdge;
use crate::state::AirState;

impl Lattice {
    /// Whether the flow leaves the leading edge of a strip, by the value kept in the state.
    pub fn is_separated(&self, strip: usize, state: &AirState) -> bool {
        let value = state.leading.get(strip).copied().unwrap_or(0.0);
        match self.settings().leading {
            LeadingEdge::Always => true,
            LeadingEdge::Never => false,
            LeadingEdge::AngleOfAttack { threshold } | LeadingEdge::Suction { threshold } => {
                value > threshold
            }
        }
    }

    /// Whether the flow leaves the leading edge at this leading panel.
    pub(crate) fn leaves(&self, panel: usize, state: &AirState) -> bool {
        let strip = self.strips().iter().position(|s| s.panels[0] == panel);
        strip.is_none_or(|s| self.is_separated(s, state))
    }

    /// Whether the flow stays attached at an edge that could shed: its newest ring was left
    /// without circulation by the separation criterion.
    pub(crate) fn is_attached(&self, state: &AirState, edge: &Edge) -> bool {
        edge.wake
            .is_some_and(|w| self.keeps_attached(state, w.sheet, w.column))
    }

    /// The same of a column of a wake sheet.
    pub(crate) fn keeps_attached(&self, state: &AirState, sheet: usize, column: usize) -> bool {
        self.sheets()[sheet].kinds[column] == EdgeKind::Leading
            && self.settings().leading != LeadingEdge::Always
            && state.sheets[sheet].newest(column) == 0.0
    }
}
