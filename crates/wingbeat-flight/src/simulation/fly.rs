//! From step to step.

use std::ops::ControlFlow;

use super::Simulation;
use crate::error::FlightError;

impl Simulation {
    /// Makes the steps to the end ([`Self::finished`]), or as long as `each`, which sees the flight before
    /// every step and at its end, lets it.
    ///
    /// # Errors
    /// Those of `each`, after which the flight may go on; those of [`Self::step`].
    pub fn fly<E: From<FlightError>>(
        &mut self,
        mut each: impl FnMut(&Self) -> Result<ControlFlow<()>, E>,
    ) -> Result<(), E> {
        loop {
            let stops = each(self)?.is_break();
            if stops || self.finished() {
                return Ok(());
            }
            self.step()?;
        }
    }
}
