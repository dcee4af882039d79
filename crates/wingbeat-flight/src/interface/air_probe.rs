//! The air that a controller feels at a look.

use std::sync::Arc;

use wingbeat_air::Points;

use crate::error::FlightError;

/// Velocities [m/s] at points [m], N components; none where there are none.
type Velocities = dyn Fn(&Points) -> Result<Option<Points>, FlightError> + Send + Sync;

/// The vortex lattice and its wakes at a look, as they are at the end of the step in which it falls. It can be
/// kept: the flight goes on without it.
#[derive(Clone)]
pub struct AirProbe(Arc<Velocities>);

impl AirProbe {
    /// Air of these velocities.
    pub fn new(
        velocity: impl Fn(&Points) -> Result<Option<Points>, FlightError> + Send + Sync + 'static,
    ) -> Self {
        Self(Arc::new(velocity))
    }

    /// Velocity of the air [m/s] at `points` [m], N components, as [`crate::Simulation::air_velocity`] has it
    /// after the step.
    ///
    /// # Errors
    /// What the air reports.
    pub fn velocity(&self, points: &Points) -> Result<Option<Points>, FlightError> {
        self.0(points)
    }
}
