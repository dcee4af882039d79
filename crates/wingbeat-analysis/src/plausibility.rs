//! What a flight will be like, before it is flown: the numbers a biologist or engineer knows by
//! heart, the lift that blade elements expect, and what of it is implausible.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | R, c | `length`, `mean_chord` | wing length and mean chord | m |
//! | f, Phi | `frequency`, `stroke_amplitude` | wingbeats per second, stroke from end to end | Hz, rad |
//! | U_t | `tip_speed` | mean speed of the tip; of a stroke to and fro in a plane `2 Phi R f` [Ellington 1984] | m/s |
//! | U | `speed` | the largest of U_t, the flight speed and that of the tip on a moving tether | m/s |
//! | Re | `reynolds` | `U c / nu` | 1 |
//! | k | `reduced_frequency` | `pi f c / U` | 1 |
//!
//! The limits of [`Estimate::doubts`] are wide: they catch slips of unit, sign and scale, not
//! unusual animals. Nothing here is used by a flight.

mod behind;
mod doubts;
mod elastic;
mod joints;
mod lift;
mod limit;
mod numbers;
mod revolution;
mod sides;
mod sizes;
mod wake;

pub(crate) use elastic::bent_by_weight;
pub(crate) use joints::slowest_on_springs;
pub(crate) use lift::lift_over_weight;
pub use numbers::stroke_amplitude;
pub use numbers::{Estimate, WingEstimate};
pub use wake::{KeptWake, kept_wake, way_in_a_step};

use wingbeat_flight::FlightSetup;

use self::doubts::{doubts, reynolds_doubts};
use self::sizes::sizes;

/// Says which Reynolds numbers of the wings are so low that viscosity changes what the air of the flight computes, higher
/// than any animal's, or higher than those of the coefficients of blade elements where their drag counts.
pub fn doubtful_reynolds_numbers(setup: &FlightSetup) -> Vec<String> {
    let mut list = reynolds_doubts(&setup.air, &sizes(setup).wings);
    list.extend(setup.drag_of_slow_coefficients());
    list
}

/// Estimates what a flight will be like. Where the blade elements cannot be flown it says why, and leaves the lift out.
pub fn estimate(setup: &FlightSetup) -> Estimate {
    let mut estimate = sizes(setup);
    match lift_over_weight(setup) {
        Ok(lift) => estimate.lift_over_weight = lift,
        Err(e) => estimate.lift_left_out = Some(e.to_string()),
    }
    let first = elastic::first_frequencies(&setup.animal.wings);
    for (w, first) in estimate.wings.iter_mut().zip(first) {
        w.hides_frequency = first.is_err();
        w.first_frequency = first.unwrap_or_default();
        w.frequency_ratio = w
            .first_frequency
            .zip(estimate.frequency)
            .map(|(f, beat)| f / beat);
    }
    estimate.doubts = doubts(setup, &estimate);
    estimate
}
