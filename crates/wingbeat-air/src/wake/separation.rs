//! How much circulation the leading edge of a strip holds before flow leaves it, by what the state has kept.
//!
//! The net circulation at the edge, that of the leading panel less what has left so far, is the strength of the
//! suction there. As long as the edge can hold it nothing leaves and the suction acts; what is beyond that
//! leaves with the next row, so that the suction stays at what the edge holds [Ramesh et al. 2014, J. Fluid
//! Mech. 751:500]. What has left does not come back: an edge that ceases to shed keeps the circulation of its
//! newest ring (Kelvin's theorem of the strip).

use crate::edges::EdgeKind;
use crate::geometry::{Edge, WakeColumn};
use crate::lattice::Lattice;
use crate::settings::{LeadingEdge, NewestRow};
use crate::state::{AirState, WakeSheet};
use crate::wake::near_wake::{RowShape, released};
use wingbeat_math::smoothstep;

/// Part of the circulations of a flow below which those of the step before say nothing of it, far above
/// roundings: so wings that start from rest fly as those that start from next to rest do.
const HARDLY: f64 = 1e-6;

impl Lattice {
    /// Circulation [m2/s] that the edge of a column of a wake sheet holds: none but at leading edges with a
    /// criterion, and within bodies.
    pub(crate) fn hold(&self, state: &AirState, sheet: usize, column: usize) -> f64 {
        let root = &self.sheets()[sheet];
        if self.leads_within(sheet, column) {
            return f64::MAX; // nothing leaves but what leaves the wings beside it
        }
        if root.kinds[column] != EdgeKind::Leading || self.settings().leading == LeadingEdge::Always
        {
            return 0.0;
        }
        let strip = self.led_by(root.panels[column]);
        strip.map_or(0.0, |s| state.hold[s])
    }

    /// What the row that leaves the edge of a column is to have, where the panel's circulation is `present`,
    /// counted as that of rings, and that of the newest ring `past` [m2/s].
    pub(crate) fn to_shed(
        &self,
        state: &AirState,
        (sheet, column): (usize, usize),
        present: f64,
        past: f64,
    ) -> f64 {
        let hold = self.hold(state, sheet, column);
        if hold == 0.0 {
            return present;
        }
        let net = present - past;
        past + (net - net.clamp(-hold, hold))
    }

    /// How far the flow leaves the edge of a column of wake sheet `k`, which is `sheet`, by itself, 0 to 1: the
    /// newest ring differs from the one before. Where flow has hardly left, by less than [`HARDLY`] of the
    /// circulation `scale` [m2/s], it does so by as much: a rounding, or a flow at rest but for one, decides
    /// nothing.
    pub(crate) fn feeding(&self, k: usize, sheet: &WakeSheet, column: usize, scale: f64) -> f64 {
        if self.leads_within(k, column) {
            return 0.0;
        }
        if self.sheets()[k].kinds[column] != EdgeKind::Leading
            || self.settings().leading == LeadingEdge::Always
        {
            return 1.0;
        }
        let left = (sheet.newest(column) - sheet.before_newest(column)).abs();
        smoothstep(left / (HARDLY * scale).max(f64::MIN_POSITIVE))
    }

    /// How far the circulations that the state has kept tell what leading edges hold in a flow in which the
    /// panels have these [m2/s], 0 to 1: not after a start from rest, and not at all where all of them are
    /// zero.
    pub(crate) fn known_part(&self, state: &AirState, gamma: &[f64]) -> f64 {
        let most = |list: &[f64]| list.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
        smoothstep(most(&state.gamma) / (HARDLY * most(gamma)).max(f64::MIN_POSITIVE))
    }

    /// Part of the circulation at the leading edge of strip `k` that the edge holds, 0 to 1, by what the state
    /// has kept; `newest` are the newest rows.
    pub(crate) fn held_of_strip(&self, state: &AirState, k: usize, newest: &[RowShape]) -> f64 {
        if self.settings().leading == LeadingEdge::Always {
            return 0.0;
        }
        let [held, beside] = self.held_and_beside(state, k, newest);
        match beside == 0.0 {
            true => 1.0,
            false => held / (held + beside.abs()),
        }
    }

    /// What the leading edge of strip `k` holds by what the state has kept, and what is beside it, counted as
    /// circulation of panels [m2/s]: what left while the flow went on by a panel length, or more if that is
    /// about to leave. Of an edge with a criterion, or one that does not shed.
    pub(crate) fn held_and_beside(
        &self,
        state: &AirState,
        k: usize,
        newest: &[RowShape],
    ) -> [f64; 2] {
        let strip = &self.strips()[k];
        let Some(wake) = self.topology().edges[strip.edge].wake else {
            return [1.0, 0.0];
        };
        let (root, sheet) = (&self.sheets()[wake.sheet], &state.sheets[wake.sheet]);
        let Some(&length) = newest[wake.sheet].lengths.get(wake.column) else {
            return [1.0, 0.0]; // nothing has left yet
        };
        let ring = sheet.newest(wake.column);
        let net = root.signs[wake.column] * state.gamma[strip.panels[0]] - ring;
        let held = net.abs().min(state.hold[k]);
        let left = (ring - sheet.before_newest(wake.column)) / length.max(f64::MIN_POSITIVE);
        let leaves = net.abs() - held;
        let beside = match left.abs() > leaves {
            true => left,
            false => leaves.copysign(net),
        };
        [held, root.signs[wake.column] * beside]
    }

    /// Part of the net circulation `net` [m2/s] of an edge that it holds, 0 to 1: what is beyond it is about to leave.
    fn held_part(&self, state: &AirState, edge: &Edge, net: f64) -> f64 {
        let wake = edge.wake;
        if wake.is_some_and(|w| self.suction().of_column(w.sheet, w.column).is_some()) {
            return 1.0; // what leaves is beside the edge already
        }
        let hold = wake.map_or(0.0, |w| self.hold(state, w.sheet, w.column));
        if hold >= net.abs() && hold > 0.0 {
            return 1.0;
        }
        hold / net.abs().max(f64::MIN_POSITIVE)
    }

    /// Part of the net circulation `net` [m2/s] of an edge that each of its panels feels, `newest` being the
    /// newest rows: half of an edge shared by two, all of a free one; of one that sheds all that it
    /// holds, and of what is about to leave all but half of what leaves within a step.
    ///
    /// What leaves with the next row stands for a sheet from half a row ahead of the edge to half a row behind it. What
    /// waits on the edge of a short row ([`released`]) stands for a sheet ahead of the edge, on the wing.
    pub(crate) fn felt_part(
        &self,
        state: &AirState,
        edge: &Edge,
        net: f64,
        newest: &[RowShape],
    ) -> f64 {
        if edge.minus.is_some() {
            return 0.5;
        }
        let Some(WakeColumn { sheet, column, .. }) = edge.wake else {
            return 1.0;
        };
        let leaves = match newest[sheet].lengths.get(column) {
            Some(&length) if self.settings().newest_row == NewestRow::Matched => released(length),
            _ => 1.0,
        };
        1.0 - 0.5 * leaves * (1.0 - self.held_part(state, edge, net))
    }
}
