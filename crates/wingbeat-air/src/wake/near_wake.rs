//! The near wake: the newest row, between the shedding edge and the first free nodes.
//!
//! What leaves the edge within one step is spread over the row. The benchmark gives the row's rings
//! the circulation that their panels had when the row's far side left, so all that is shed within
//! the step sits on the edge itself. That is right for a step of one panel: the filament lies where
//! the lattice, continued into the wake, would have one. A longer row wants a filament every panel
//! length, or the loads are off at first order of the step, 15 % at two panels a step and k = 1.
//! [`NewestRow::Matched`] spreads what is shed so. What the panel has now is unknown, so
//! the row enters the influence matrix. A row that leaves the edge keeps the circulation that leaves
//! the centroid of what it shed where it was.
//!
//! A row of less than a panel length is the other way round: filaments closer together than the
//! lattice's act on the collocation point half a panel ahead of the edge with less than the lattice's
//! share, 1.27 / (2 pi) less of what a uniform sheet sheds in a panel length if the row is very short.
//! There part of what is shed waits on the edge ([`released`]).

use crate::geometry::opposite;
use crate::lattice::Lattice;
use crate::settings::{AirSettings, NewestRow};
use crate::state::AirState;
use wingbeat_math::DVec3;
use wingbeat_vortex::{Network, Points};

/// Strips of the newest row where its circulation varies.
const STRIPS: usize = 8;

/// What is shed in a row of `length` panel lengths: (place from the edge over the length of the row,
/// part).
fn filaments(length: f64) -> impl Iterator<Item = (f64, f64)> {
    let length = length.clamp(1.0, STRIPS as f64);
    let count = (length - 1e-9).ceil() as usize;
    (0..count).map(move |j| (j as f64 / length, (length - j as f64).min(1.0) / length))
}

/// Part of the change of circulation within the step that strip `k` from the edge has.
fn present(settings: &AirSettings, length: f64, k: usize) -> f64 {
    if settings.newest_row == NewestRow::Constant {
        return 0.0;
    }
    let behind = |(place, part): (f64, f64)| {
        // Shared between the two nearest borders of strips.
        let border = place * STRIPS as f64 - k as f64;
        part * border.clamp(0.0, 1.0)
    };
    filaments(length).map(behind).sum()
}

/// Part of the change of circulation within the step that a row keeps when it leaves the edge.
pub(crate) fn kept(length: f64) -> f64 {
    filaments(length).map(|(place, part)| place * part).sum()
}

/// Part of the difference between the panel's circulation and that of the newest row with which the
/// row that now leaves the edge differs from it: all of it, but for rows of less than a panel length.
///
/// A uniform sheet in filaments a panel apart, the first one on the edge, gives the collocation point
/// half a panel ahead what the lattice's rule wants (zero together with the lattice's own half). In
/// rows of `length` l < 1 it gives that if the edge holds, beside the filament of its row, what is
/// shed along e panel lengths: `2 e = psi(1/(2 l)) + ln l - psi(1/2)`, psi being the digamma function.
/// The row leaves with that delay if it takes l / (l + e) of the difference each step.
pub(crate) fn released(length: f64) -> f64 {
    let l = length.min(1.0);
    // Within 0.004 of the digamma functions.
    let e = 0.635 * (1.0 - l) * (1.0 + 0.18 * l);
    l / (l + e)
}

/// Shape of the newest row of a sheet, column by column.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowShape {
    /// Lengths in panel lengths; none while there is no row.
    pub lengths: Vec<f64>,
    /// How far the flow leaves the edges by itself \[1\], see [`Lattice::feeding`].
    pub feeding: Vec<f64>,
}

impl RowShape {
    /// Takes that of sheet `s` at the time `t` [s], with the nodes of the rings.
    pub(crate) fn take(
        &mut self,
        (lattice, state): (&Lattice, &AirState),
        s: usize,
        nodes: &Points,
        t: f64,
    ) {
        self.lengths.clear();
        self.feeding.clear();
        let (sheet, root) = (&state.sheets[s], &lattice.sheets()[s]);
        let Some(newest) = sheet.rows().checked_sub(1) else {
            return;
        };
        let dt = t - sheet.shed_time[newest];
        for c in 0..sheet.columns {
            let edge = [root.nodes[c], root.nodes[c + 1]];
            let corners = lattice.topology().panels[root.panels[c]];
            let middle = |n: [usize; 2]| 0.5 * (nodes.get(n[0]) + nodes.get(n[1]));
            let free = 0.5 * (sheet.node(newest, c) + sheet.node(newest, c + 1));
            let panel = middle(edge).distance(middle(opposite(corners, edge)));
            let row = middle(edge).distance(free);
            self.lengths.push(row / panel.max(f64::MIN_POSITIVE));
            // The row's speed and a panel's length; between steps anything that has left counts.
            let scale = if dt > 0.0 { row / dt * panel } else { 0.0 };
            self.feeding.push(lattice.feeding(s, sheet, c, scale));
        }
    }
}

pub(crate) fn strips(settings: &AirSettings) -> usize {
    match settings.newest_row {
        NewestRow::Constant if settings.solves_suction() => 2,
        NewestRow::Constant => 1,
        NewestRow::Matched => STRIPS,
    }
}

/// Where the vortex lies that leaves a leading edge within a step, from the edge over the length of the row:
/// what an even stream of vorticity sheds has its middle there.
pub(crate) const NEW_VORTEX: f64 = 0.5;

/// Whether strip `k` from the edge of `strips` lies between a leading edge and the vortex that leaves it within
/// the step.
fn is_before_new_vortex(strips: usize, k: usize) -> bool {
    (k as f64) < NEW_VORTEX * strips as f64
}

/// How the net circulation of one filament of the row follows from the panels: `fixed` plus a share
/// of the circulation of up to two panels.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NearWakeShare {
    pub fixed: f64,
    pub panel: [usize; 2],
    pub part: [f64; 2],
    /// Strips of whose leaving circulation it has a part.
    pub strip: [usize; 2],
    pub leaving: [f64; 2],
    /// How far the flow leaves the edge by itself, of filaments along it \[1\].
    pub feeding: f64,
}

impl NearWakeShare {
    /// Adds `sign` times the circulation of strip `k` of a column.
    fn add(&mut self, at: usize, sign: f64, strip: &NearWakeStrip) {
        self.fixed += sign * strip.past;
        self.panel[at] = strip.panel;
        self.part[at] += sign * strip.part;
        if let Some((s, leaving)) = strip.leaving {
            self.strip[at] = s;
            self.leaving[at] += sign * leaving;
        }
    }

    /// How far the filament of the circulation `net` along the edge is one beside others, 0 to 1: as far as it
    /// takes part in what leaves the edge within the step, be its circulation zero, a rounding or more; where
    /// that is unknown with the circulations of the panels, it has one.
    pub(crate) fn joint(&self, net: f64) -> f64 {
        let [a, b] = self.part;
        let is_joint = match self.leaving {
            [0.0, 0.0] => a + b != 0.0,
            _ => return f64::from(net != 0.0),
        };
        if is_joint { self.feeding } else { 0.0 }
    }

    pub(crate) fn net(&self, [gamma, leaving]: [&[f64]; 2]) -> f64 {
        let of = |k: usize| self.part[k] * gamma[self.panel[k]];
        let net = self.fixed + (of(0) + of(1));
        match self.leaving {
            [0.0, 0.0] => net,
            parts => {
                net + (0..2)
                    .map(|k| parts[k] * leaving[self.strip[k]])
                    .sum::<f64>()
            }
        }
    }
}

/// The circulation of a strip: `past` plus `part` of the present one of `panel`, or of what leaves a leading edge.
#[derive(Clone, Copy, Debug)]
struct NearWakeStrip {
    past: f64,
    part: f64,
    panel: usize,
    leaving: Option<(usize, f64)>,
}

/// The newest row of one sheet.
#[derive(Clone, Copy)]
pub(crate) struct NearWakeRow<'a> {
    pub lattice: &'a Lattice,
    pub state: &'a AirState,
    /// The sheet.
    pub s: usize,
    pub shape: &'a RowShape,
}

/// The strips of a column by their number from the edge.
fn strips_of_column<'a>(
    row: &NearWakeRow<'a>,
    column: usize,
) -> impl Fn(usize) -> NearWakeStrip + use<'a> {
    let NearWakeRow {
        lattice,
        state,
        s,
        shape,
    } = *row;
    let (root, old) = (&lattice.sheets()[s], state.sheets[s].newest(column));
    let (panel, sign) = (root.panels[column], root.signs[column]);
    let (feeding, length) = (shape.feeding[column], shape.lengths[column]);
    let leading = lattice.suction().of_column(s, column);
    let now = sign * state.gamma[panel];
    // What the edge held at the last step it holds on.
    let held = match leading {
        Some(_) => 0.0,
        None => now - lattice.to_shed(state, (s, column), now, old),
    };
    move |k| {
        if let Some(strip) = leading {
            let is_before = is_before_new_vortex(strips(lattice.settings()), k);
            return NearWakeStrip {
                past: old,
                part: 0.0,
                panel,
                leaving: is_before.then_some((strip, sign)),
            };
        }
        let part = match feeding {
            0.0 => 0.0,
            feeding => feeding * present(lattice.settings(), length, k),
        };
        NearWakeStrip {
            past: (1.0 - part) * old - part * held,
            part: part * sign,
            panel,
            leaving: None,
        }
    }
}

/// Where the strips of all columns of a row are kept, those of a column one after the other from the edge on.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowStrips {
    all: Vec<NearWakeStrip>,
    per_column: usize,
}

impl RowStrips {
    fn take(&mut self, row: &NearWakeRow) {
        self.per_column = strips(row.lattice.settings());
        self.all.clear();
        for column in 0..row.state.sheets[row.s].columns {
            self.all
                .extend((0..self.per_column).map(strips_of_column(row, column)));
        }
    }

    fn at(&self, column: usize, k: usize) -> &NearWakeStrip {
        &self.all[column * self.per_column + k]
    }
}

/// Fills in the filaments of the row of a sheet beyond the shedding edge, whose nodes are `edge`, and their shares.
///
/// Where a wake begins ahead of the rings, at the very leading edge, its sides go on from there to the rings,
/// whose nodes come last (`inner`: column and place).
pub(crate) fn add_near_wake(
    (near_wake, shares, row_strips): (&mut Network, &mut Vec<NearWakeShare>, &mut RowStrips),
    row: &NearWakeRow,
    t: f64,
    edge: impl Iterator<Item = DVec3> + Clone,
    inner: impl Iterator<Item = (usize, DVec3)>,
) {
    let (sheet, settings) = (&row.state.sheets[row.s], row.lattice.settings());
    let Some(newest) = sheet.rows().checked_sub(1) else {
        return;
    };
    row_strips.take(row);
    let (base, width, strips) = (near_wake.nodes.len(), sheet.columns + 1, strips(settings));
    for level in (0..=strips).rev() {
        let part = level as f64 / strips as f64; // 1 at the free row
        for (c, x) in edge.clone().enumerate() {
            let free = sheet.node(newest, c);
            near_wake.nodes.push(if level == strips {
                free
            } else {
                x.lerp(free, part)
            });
        }
    }
    let node = |level: usize, c: usize| base + (strips - level) * width + c;
    let age = |level: f64| (t - sheet.shed_time[newest]) * level / strips as f64;
    let mut push = |a: usize, b: usize, age: f64, share: NearWakeShare| {
        let length = (near_wake.nodes.get(b) - near_wake.nodes.get(a)).length();
        let core = settings.wake_core.core(length, age);
        near_wake.push_edge(a, b, 0.0, core);
        shares.push(share);
    };
    for k in 0..strips {
        for c in 0..width {
            let share = across((row, row_strips), c, k);
            push(node(k + 1, c), node(k, c), age(k as f64 + 0.5), share);
        }
        for c in (0..sheet.columns).filter(|_| strips > 1) {
            let share = along((row, row_strips), c, k);
            push(
                node(k + 1, c),
                node(k + 1, c + 1),
                age(k as f64 + 1.0),
                share,
            );
        }
    }
    for (c, x) in inner {
        let ring = near_wake.nodes.len();
        near_wake.nodes.push(x);
        let root = node(0, c);
        let length = near_wake.nodes.get(root).distance(x);
        near_wake.push_edge(root, ring, 0.0, settings.wake_core.core(length, 0.0));
        shares.push(across((row, row_strips), c, 0));
    }
}

/// The edge between the columns `c - 1` and `c` in strip `k`.
fn across((row, strips): (&NearWakeRow, &RowStrips), c: usize, k: usize) -> NearWakeShare {
    let mut share = NearWakeShare::default();
    if row.lattice.settings().plane_wakes {
        return share; // an end, which moves no air
    }
    if c > 0 {
        share.add(0, 1.0, strips.at(c - 1, k));
    }
    if c < row.state.sheets[row.s].columns {
        share.add(1, -1.0, strips.at(c, k));
    }
    share
}

/// The edge of column `c` between strip `k` and the next older one; at the free row the wake itself
/// has counted the circulation of the past already.
fn along((row, strips): (&NearWakeRow, &RowStrips), c: usize, k: usize) -> NearWakeShare {
    let mut share = NearWakeShare {
        feeding: row.shape.feeding[c],
        ..NearWakeShare::default()
    };
    share.add(0, 1.0, strips.at(c, k));
    if k + 1 < strips.per_column {
        share.add(1, -1.0, strips.at(c, k + 1));
    } else {
        share.fixed -= row.state.sheets[row.s].newest(c);
    }
    share
}

/// What the row's strip at the shedding edge takes from the circulation of a panel there: the fixed
/// part, and the part of the panel's own; what leaves a leading edge within the step comes on top.
pub(crate) fn at_edge(row: &NearWakeRow, column: usize) -> [f64; 2] {
    if row.shape.lengths.is_empty() {
        return [0.0; 2];
    }
    let first = strips_of_column(row, column)(0);
    let sign = row.lattice.sheets()[row.s].signs[column];
    [sign * first.past, sign * first.part]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A panel that has what it had when its row left, to a rounding or exactly: its row's filaments are joints
    /// either way.
    #[test]
    fn invariant_joints_of_the_newest_row_under_roundings_of_circulation() {
        let old = 0.1 + 0.2;
        let share = |part: f64| NearWakeShare {
            fixed: -part * old,
            part: [part, 0.0],
            feeding: 0.5,
            ..NearWakeShare::default()
        };
        for gamma in [old, 0.3] {
            let net = share(0.25).net([&[gamma], &[]]);
            assert!(net.abs() < 1e-16 && share(0.25).joint(net) == 0.5);
        }
        let of_one_strip = NearWakeShare {
            part: [0.25, -0.25],
            feeding: 0.5,
            ..NearWakeShare::default()
        };
        assert_eq!(of_one_strip.joint(1e-17), 0.0);
    }

    /// Filaments of a uniform sheet at distances l k from the edge, summed one by one at the collocation
    /// point half a panel ahead, and what the edge holds back.
    #[test]
    fn limit_delay_gives_short_rows_the_share_of_rows_of_a_panel() {
        let sheet = |l: f64| -> f64 {
            let rows = (1000.0 / l).round() as usize;
            (0..rows).map(|k| l / (0.5 + l * k as f64)).sum()
        };
        for l in [1.0, 0.7, 0.5, 0.25, 0.1, 0.01] {
            // In the steady state the edge lags by (1 - a) / a rows of length l.
            let a = released(l);
            let held = l * (1.0 - a) / a;
            let lack = sheet(1.0) - (sheet(l) + held / 0.5);
            // Twice the 0.004 of the fit, and where a sum of 1000 panels ends.
            assert!(lack.abs() < 0.009, "{l}: {lack}");
        }
        assert_eq!(released(1.0), 1.0);
        assert_eq!(released(3.0), 1.0);
    }
}
