//! Flyers whose wings all stand still: their steady flight is the same at all times, and any time is a period of it.

use wingbeat_flight::{FlightSetup, is_driven};
use wingbeat_model::Wing;

/// The time by which a glide is analysed over sqrt(R / g) \[1\]: that in which it flies by one to some wing lengths.
/// Motions of a few wing lengths are then neither slow beside a wingbeat nor gone within one.
const PART: f64 = 0.25;

/// Whether nothing of the flyer beats: it has wings, their angles and shapes are constant, and no joint is driven in
/// time.
pub fn glides(setup: &FlightSetup) -> bool {
    let wings = &setup.animal.wings;
    let is_still = |w: &Wing| w.is_still() || w.motion.frequency == 0.0;
    !wings.is_empty() && wings.iter().all(is_still) && !setup.joints.iter().any(is_driven)
}

/// The time that stands for the period of a wingbeat in a glide, sqrt(R / g) / 4 [s]; none where something beats or
/// there is no gravity.
pub fn period_of_glide(setup: &FlightSetup) -> Option<f64> {
    let g = setup.gravity.length();
    (glides(setup) && g > 0.0).then(|| PART * (setup.animal.wing_length() / g).sqrt())
}
