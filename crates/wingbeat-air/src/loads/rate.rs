//! Rates of change from the circulations of the last steps.

use crate::lattice::Lattice;
use crate::settings::CirculationRate;
use crate::state::AirState;
use crate::wake::Filaments;
use wingbeat_math::DVec3;

/// Weights of the circulation now, one step and two steps before in its rate of change \[1/s\], `h` after the
/// last step.
pub(crate) fn rate_weights(lattice: &Lattice, state: &AirState, h: f64) -> [f64; 3] {
    let h0 = state.dt_before;
    match lattice.settings().rate {
        CirculationRate::BackwardSecond if state.step > 1 => [
            (2.0 * h + h0) / (h * (h + h0)),
            -(h + h0) / (h * h0),
            h / (h0 * (h + h0)),
        ],
        CirculationRate::Backward | CirculationRate::BackwardSecond if state.step > 0 => {
            [1.0 / h, -1.0 / h, 0.0]
        }
        _ => [0.0; 3],
    }
}

/// Couple about the control point of panel `p` [N m] of a force that follows from the rate of its circulation, which
/// acts in the middle of the ring; none where that is the control point.
pub(crate) fn couple_of_rate(
    lattice: &Lattice,
    filaments: &Filaments,
    p: usize,
    force: DVec3,
) -> Option<DVec3> {
    let corners = lattice.topology().panels[p];
    let at = |k: usize| filaments.bound.nodes.get(corners[k]);
    let way = lattice.controls().to_middle(p, at)?;
    Some(way.cross(force))
}
