//! Which circulations are unknown: those of all panels, or of one half of a mirror-symmetric flow.

use crate::geometry::Edge;
use crate::lattice::Lattice;

/// Number of circulations to be found.
pub(crate) fn unknowns(lattice: &Lattice) -> usize {
    lattice
        .symmetry()
        .map_or(lattice.panel_count(), |s| s.computed.len())
}

/// Which circulation is that of a panel.
pub(crate) fn unknown(lattice: &Lattice, panel: usize) -> usize {
    lattice.symmetry().map_or(panel, |s| s.unknown[panel])
}

/// The panel of an unknown.
pub(crate) fn panel(lattice: &Lattice, unknown: usize) -> usize {
    lattice.symmetry().map_or(unknown, |s| s.computed[unknown])
}

/// Whether a panel is the one of its pair that is computed.
pub(crate) fn is_computed(lattice: &Lattice, panel: usize) -> bool {
    lattice.symmetry().is_none_or(|s| panel <= s.panel[panel])
}

/// The columns that the normal velocities of an edge go to, those of the panels it bounds, and what part of them:
/// none of an end of plane flow, which moves no air.
pub(crate) fn columns(
    lattice: &Lattice,
    edge: &Edge,
    keeps: f64,
) -> impl Iterator<Item = (usize, f64)> {
    let plus = (unknown(lattice, edge.plus), keeps);
    let minus = edge.minus.map(|p| (unknown(lattice, p), -1.0));
    let moves_air = !edge.is_end;
    let both = std::iter::once(plus).chain(minus);
    both.filter(move |_| moves_air)
}

/// Adds a part of the normal velocities of an edge or ring.
pub(crate) fn add_part(to: &mut [f64], part: f64, rates: &[f64]) {
    to.iter_mut().zip(rates).for_each(|(a, u)| *a += part * u);
}
