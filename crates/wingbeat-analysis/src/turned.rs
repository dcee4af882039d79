//! Wings that turn over on passive hinges in a trimmed flight.

use wingbeat_flight::{FlightSetup, Past, Simulation, TurnedOver};

use crate::AnalysisError;
use crate::trim::Trim;
use crate::wake::WakeTrim;

/// Which wings turn over on a passive hinge in the trimmed wingbeat, see [`TurnedOver::found`].
///
/// # Errors
/// What the flight reports.
pub fn turned_over(trim: &Trim) -> Result<Vec<String>, AnalysisError> {
    in_free_beat(&trim.free(), 0, &Past::default())
}

/// The same in air with memory, or with elastic wings.
///
/// # Errors
/// What the flight reports.
pub fn turned_over_with_wake(trim: &WakeTrim) -> Result<Vec<String>, AnalysisError> {
    in_free_beat(&trim.setup, trim.start().held_steps, &trim.past)
}

/// The same of a free flight after `held` steps, which begins as in `past` if there is anything.
fn in_free_beat(
    setup: &FlightSetup,
    held: usize,
    past: &Past,
) -> Result<Vec<String>, AnalysisError> {
    let are_free = setup.joints.iter().any(|j| j.model.kind.directions() > 0);
    if !are_free {
        return Ok(vec![]);
    }
    let mut flight = match past.is_empty() {
        true => Simulation::new(setup.clone())?,
        false => Simulation::after(setup.clone(), past)?,
    };
    let mut turned = TurnedOver::default();
    for step in 0..setup.time.steps {
        let record = flight.step()?;
        if step >= held {
            turned.take(record, setup);
        }
    }
    Ok(turned.found(setup))
}
