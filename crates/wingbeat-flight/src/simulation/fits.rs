//! Whether a saved state, perhaps read from a file, fits the flight that is to go on from it.

use wingbeat_structure::State;

use super::state::FlightState;
use crate::elastic::ElasticState;
use crate::equations::stages::Stage;
use crate::error::{FlightError, RESUME_AS_SAVED};
use crate::interface::memory::wakes_of;
use crate::simulation::recorder::Ledger;

/// No flight counts so many steps or events.
const MOST: u64 = 1 << 60;

/// Whether `state` fits a flight of these `stages` that begins with the ledger `own`, under feedback or not.
///
/// # Errors
/// What does not fit.
pub(super) fn check_fits(
    state: &FlightState,
    stages: &[Stage],
    (own, has_feedback): (&Ledger, bool),
) -> Result<(), FlightError> {
    let Some(stage) = stages.get(state.stage) else {
        let value = format!("stage {}", state.stage);
        return Err(FlightError::misfit(value, "the flight has no such stage"));
    };
    check_steps(state)?;
    let dim = stage.equations.dim();
    let past = &state.past;
    let vectors = past.y.iter().chain(&past.f);
    let mut vectors = vectors.chain([&past.predicted_minus_corrected]);
    if vectors.any(|v| v.len() != dim) {
        return Err(FlightError::misfit(
            format!("{} components", past.newest().len()),
            format!("the case has {dim}; {RESUME_AS_SAVED}"),
        ));
    }
    let scales = stage.equations.scales();
    let own_dim = scales.iter().filter(|s| s.is_finite()).count();
    if past.shown.iter().flatten().any(|v| v.len() != own_dim) {
        return Err(FlightError::misfit(
            "what passes have shown",
            format!("the case has {own_dim} components; {RESUME_AS_SAVED}"),
        ));
    }
    let ledger = &state.ledger;
    let lengths = |of: &Ledger| [of.coordinates.len(), of.rates.len(), of.joints.len()];
    let lengths = [ledger, own].map(lengths);
    if lengths[0] != lengths[1] {
        let value = format!("{:?} coordinates", lengths[0]);
        return Err(FlightError::misfit(value, "the case has others"));
    }
    check_wings(stage, &state.wings)?;
    check_control(state, has_feedback)?;
    if state.carried.len() != stage.equations.carried.initial().len() {
        return Err(others(format!(
            "{} wings that carry air along",
            state.carried.len()
        )));
    }
    stage.equations.air.check(state.air.as_ref())?;
    check_events(state)
}

/// Elastic wings have the nodes that the case gives them, and six numbers of each kind at every one.
pub(super) fn check_wings(stage: &Stage, wings: &[ElasticState]) -> Result<(), FlightError> {
    let own = stage.equations.elastic.initial();
    if own.len() != wings.len() {
        return Err(others(format!("{} elastic wings", wings.len())));
    }
    for (k, (own, saved)) in own.iter().zip(wings).enumerate() {
        let [own, saved] = [own, saved].map(|wing| lengths(&wing.structure));
        if own != saved {
            return Err(others(format!(
                "{saved:?} places, attitudes, velocities, accelerations of elastic wing {k}"
            )));
        }
    }
    Ok(())
}

/// A state with another number of something than the case has.
fn others(value: String) -> FlightError {
    FlightError::misfit(value, format!("the case has others; {RESUME_AS_SAVED}"))
}

/// Numbers of places, attitudes, velocities and both accelerations of a wing.
fn lengths(state: &State) -> [usize; 5] {
    let at = &state.configuration;
    let of_nodes = [&state.velocity, &state.acceleration, &state.algorithmic];
    let [v, a, own] = of_nodes.map(Vec::len);
    [at.position.len(), at.rotation.len(), v, a, own]
}

/// What feedback remembers is saved where the case has feedback, and nowhere else.
fn check_control(state: &FlightState, has_feedback: bool) -> Result<(), FlightError> {
    let (value, own) = match (has_feedback, &state.control) {
        (true, None) => ("no memory of feedback", "[control]"),
        (false, Some(_)) => ("a memory of feedback", "no [control]"),
        _ => return Ok(()),
    };
    let problem = format!("the case has {own}; {RESUME_AS_SAVED}");
    Err(FlightError::misfit(value, problem))
}

fn check_steps(state: &FlightState) -> Result<(), FlightError> {
    if state.step as u64 > MOST {
        let value = format!("step {}", state.step);
        return Err(FlightError::misfit(value, "no flight comes so far"));
    }
    match state.started_at > state.step {
        true => Err(FlightError::misfit(
            format!("stage begun at step {}", state.started_at),
            "it is not reached yet",
        )),
        false => Ok(()),
    }
}

/// Events that were recorded are among those that were counted.
fn check_events(state: &FlightState) -> Result<(), FlightError> {
    let counts = wakes_of(state.air.as_ref()).map_or([0; 7], |air| {
        let e = &air.events;
        [
            e.limited,
            e.near_surface,
            e.leading_rings,
            e.dropped_rows,
            e.new_particles,
            e.dropped_particles,
            air.step,
        ]
    });
    let [limited, near, leading, ..] = counts;
    let ledger = &state.ledger;
    let is_counted = ledger.events[0] <= limited + near
        && ledger.events[1] <= limited
        && ledger.leading_rings <= leading;
    if counts.iter().any(|n| *n > MOST) || !is_counted {
        let value = format!("{counts:?}");
        return Err(FlightError::misfit(value, "nothing can be counted so"));
    }
    Ok(())
}
