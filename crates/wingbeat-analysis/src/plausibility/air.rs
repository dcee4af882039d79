//! What is known of the air before a flight.

use wingbeat_flight::AirModel;
use wingbeat_math::DVec3;

/// Velocity of the undisturbed air, N components [m/s].
pub(super) fn stream(air: &AirModel) -> DVec3 {
    air.stream().unwrap_or(DVec3::ZERO)
}
