//! What a case that is no contradiction should still be looked at for: fits, likely slips, keys without effect,
//! waypoints out of reach.

pub mod fitted;
mod keys_without_effect;
mod measurement_checks;
pub mod mixed_angles;
mod waypoint_speeds;
