//! Wings whose roots lie on a body: their circulation goes on through it to the other wing.
//!
//! No air passes between a wing and the body that it stands on, and circulation does not end there: outside it
//! goes on over the skin, and what the rings of the skin make inside is the flow about vortices that go on
//! through the body. A wing that ends at the skin has a root vortex there instead, to which panels of finite
//! size hardly answer. So a strip of panels leads from each of the two roots to the middle between them
//! ([`crate::Surface::carry_through`]). Its rings have the mean circulation of the panels beside the two roots,
//! in place of a condition on the flow through them, and from its front and rear edges leaves the mean of what
//! leaves the wings beside it.

use crate::edges::EdgeKind;
use crate::error::AirError;
use crate::geometry::surface::Surface;
use crate::geometry::topology::{Sheet, Topology, WakeColumn};

/// A panel within a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Carried {
    pub panel: usize,
    /// The panels beside the two roots.
    pub beside: [usize; 2],
    /// What leaves the leading edges there, and the trailing edges, if these are the first or last panels and
    /// their edges shed.
    pub leaving: [Option<[WakeColumn; 2]>; 2],
}

impl Carried {
    /// What leaves the edges of this kind beside both roots.
    pub fn leaving(&self, kind: EdgeKind) -> Option<[WakeColumn; 2]> {
        match kind {
            EdgeKind::Leading => self.leaving[0],
            EdgeKind::Trailing => self.leaving[1],
            EdgeKind::Tip | EdgeKind::Root => None,
        }
    }
}

/// All panels within bodies.
///
/// # Errors
/// [`AirError::CarryThrough`] names the first that does not lie between the roots of two surfaces before its own.
pub(crate) fn carried(topology: &Topology, surfaces: &[Surface]) -> Result<Vec<Carried>, AirError> {
    let is_within = |p: usize| surfaces[topology.panel_surface[p]].carry_through;
    let leaving = |panels: [usize; 2], kind: EdgeKind| {
        let of = |panel: usize| {
            let edges = topology.panel_edges[panel].iter();
            let mut wakes = edges.filter_map(|e| topology.edges[e.edge].wake);
            wakes.find(|w| topology.sheets[w.sheet].kinds[w.column] == kind)
        };
        Some([of(panels[0])?, of(panels[1])?])
    };
    let of = |panel: usize| {
        let is_root = |p: usize| !is_within(p) && p < panel;
        let own = beyond(topology, panel, is_root);
        let half = beyond(topology, panel, is_within);
        let other = half.and_then(|half| beyond(topology, half, is_root));
        let (Some(a), Some(b)) = (own, other) else {
            let (surface, panel) = topology.locate_panel(panel);
            return Err(AirError::CarryThrough { surface, panel });
        };
        Ok(Carried {
            panel,
            beside: [a, b],
            leaving: [EdgeKind::Leading, EdgeKind::Trailing].map(|kind| leaving([a, b], kind)),
        })
    };
    let all = 0..topology.panels.len();
    all.filter(|&p| is_within(p)).map(of).collect()
}

/// The panel of this kind on another surface that shares an edge with `panel`.
fn beyond(topology: &Topology, panel: usize, is: impl Fn(usize) -> bool) -> Option<usize> {
    let surface = |p: usize| topology.panel_surface[p];
    let sides = topology.panel_edges[panel].iter().flat_map(|e| {
        let edge = &topology.edges[e.edge];
        [Some(edge.plus), edge.minus]
    });
    let mut others = sides.flatten().filter(|&p| surface(p) != surface(panel));
    others.find(|&p| is(p))
}

/// Of each wake sheet that left a body within: the column of nodes, 0 or 1, in the middle between the roots.
pub(crate) fn middle_columns(topology: &Topology, surfaces: &[Surface]) -> Vec<Option<usize>> {
    let is_within = |sheet: usize| surfaces[topology.sheets[sheet].surface].carry_through;
    let of = |(k, _): (usize, &Sheet)| {
        let joins = topology.joined_columns.iter().map(|j| j.0);
        let halves = joins.filter(|j| j.iter().all(|(s, _)| is_within(*s)));
        let mut here = halves.flatten().filter(|(s, _)| *s == k);
        here.next().map(|(_, column)| column)
    };
    topology.sheets.iter().enumerate().map(of).collect()
}
