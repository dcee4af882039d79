//! The strip between a leading edge that wakes leave and the foremost vortices of the lattice.
//!
//! Where the suction of an edge is solved for, its wake begins at the very edge and the rings of the lattice
//! lie a quarter panel aft. Across the strip between them the potential jumps by the circulation G of all that
//! has left the edge, and as G grows there is a pressure `rho dG/dt` on it as on any panel. Without that force
//! the impulse of what leaves, which has the area of the strip, is not that of the forces.

use crate::lattice::Lattice;
use crate::loads::rate::rate_weights;
use crate::loads::values::AirLoads;
use crate::state::{AirState, WakeSheet};
use crate::wake::{Filaments, NEW_VORTEX};
use wingbeat_math::DVec3;

/// Adds the forces on the strips ahead of the rings to those of the leading panels.
pub(crate) fn add_front(
    lattice: &Lattice,
    state: &AirState,
    filaments: &Filaments,
    position: &[DVec3],
    out: &mut AirLoads,
) {
    let rho = lattice.settings().density;
    let edges = &lattice.topology().edges;
    for (k, strip) in lattice.strips().iter().enumerate() {
        let wake = edges[strip.edge].wake;
        let Some(wake) = wake.filter(|w| lattice.suction().of_column(w.sheet, w.column).is_some())
        else {
            continue;
        };
        let sign = lattice.sheets()[wake.sheet].signs[wake.column];
        let before = left_before(&state.sheets[wake.sheet], wake.column).map(|left| sign * left);
        let rate = rate_of_what_left(lattice, state, (out.leaving[k], before), out.dt);
        let [a, b] = strip.front().map(|n| position[n]);
        let [c, d] = strip.front().map(|n| filaments.bound.nodes.get(n));
        let p = strip.panels[0];
        let area = 0.5 * (d - a).cross(c - b);
        let force = rho * rate * area.length() * out.panels.normal[p];
        let middle = 0.25 * ((a + b) + (c + d));
        out.force[p] += force;
        out.couple[p] += (middle - out.panels.point[p]).cross(force);
    }
}

/// What left the edge of a column within the step before, counted as circulation of rings [m2/s]: it went to
/// the two newest rows. None where there are not as many, as in a wake that is cut to one.
fn left_before(sheet: &WakeSheet, column: usize) -> Option<f64> {
    let older = sheet.rows().checked_sub(2)?;
    let change = sheet.newest(column) - sheet.ring(older, column);
    Some(change / (1.0 - NEW_VORTEX))
}

/// Rate of change of all that has left an edge [m2/s2], from what leaves it within this step and left it within
/// the one before; to first order where that is not known.
fn rate_of_what_left(
    lattice: &Lattice,
    state: &AirState,
    (now, before): (f64, Option<f64>),
    h: f64,
) -> f64 {
    let [a, _, c] = rate_weights(lattice, state, h);
    match before {
        Some(before) => a * now - c * before,
        None if a == 0.0 => 0.0,
        None => now / h,
    }
}
