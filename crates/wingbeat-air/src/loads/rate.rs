//! Rates of change from the circulations of the last steps.

use crate::lattice::Lattice;
use crate::settings::CirculationRate;
use crate::state::AirState;

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
