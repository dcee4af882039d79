//! The periodic beat of a flyer whose wings bend in air without memory: wings come back to shape and velocity as the body does.
//!
//! A beat is flown again and again, the body put back to its start after each and the wings going on from where they are: air
//! damps them so much that after a few beats they come back to where they began. What the body has changed by in such a beat
//! are the residuals of steady flight.

use wingbeat_flight::elastic::ElasticState;
use wingbeat_flight::{FlightSetup, Record, Simulation, system_of};
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::beat::check_steady;

/// Change of places over the wing length, of attitudes \[rad\], and of velocities over wing length and wingbeat, within which
/// wings count as back, over the residuals that count as trimmed; and some ten times what a step leaves unbalanced.
const BACK: [f64; 2] = [1e-2, 1e-9];

/// Beats within which they must be.
const MAX_BEATS: usize = 60;

/// Whether the past of a flight is in its wings alone.
pub(super) fn is_elastic(setup: &FlightSetup) -> bool {
    setup.animal.is_elastic() && !setup.air.has_memory()
}

/// An error if a wingbeat of the setup is not like the next, or has a past beside that of its wings.
///
/// # Errors
/// Loads, feedback, wind that changes, joints that move freely.
pub(super) fn check_orbit(setup: &FlightSetup) -> Result<(), AnalysisError> {
    check_steady(setup)?;
    let changes = setup.air.clone().wind_mut().is_some_and(|w| !w.is_none());
    if changes {
        return Err(AnalysisError::not_covered(
            "the air changes with time or place (gust, shear): no wingbeat is like the next",
            "leave [air.gust] and shear out, or fly it with `run`",
        ));
    }
    let system = system_of(setup)?;
    match system.speeds() {
        0 => Ok(()),
        _ => Err(AnalysisError::not_covered(
            "joints move freely beside elastic wings, and the periodic motion of both is not sought",
            "prescribe the joints' motion, or make the wings rigid",
        )),
    }
}

/// A beat whose wings come back.
pub(super) struct PeriodicBeat {
    /// At its start and its end.
    pub ends: [Record; 2],
    /// The wings at its start and its end.
    pub wings: [Vec<ElasticState>; 2],
    /// Beats flown until then.
    pub beats: usize,
}

/// The beat of `setup`, which is `steps` long, its wings sought from `wings` on, or from rest, for residuals within
/// `tolerance`.
///
/// # Errors
/// What the flight reports; wings that do not come back.
pub(super) fn periodic_beat(
    setup: &FlightSetup,
    steps: usize,
    wings: Option<Vec<ElasticState>>,
    tolerance: f64,
) -> Result<PeriodicBeat, AnalysisError> {
    let mut wings = wings;
    let back = (BACK[0] * tolerance).max(BACK[1]);
    for beats in 1..=MAX_BEATS {
        let mut flight = match &wings {
            Some(wings) => Simulation::bent(setup.clone(), wings)?,
            None => Simulation::new(setup.clone())?,
        };
        let (before, first) = (flight.state().wings.clone(), flight.record().clone());
        for _ in 0..steps {
            flight.step()?;
        }
        let after = flight.state().wings.clone();
        if change(setup, &before, &after) <= back {
            let ends = [first, flight.record().clone()];
            return Ok(PeriodicBeat {
                ends,
                wings: [before, after],
                beats,
            });
        }
        wings = Some(after);
    }
    Err(AnalysisError::not_covered(
        format!("the elastic wings find no periodic motion within {MAX_BEATS} wingbeats"),
        "give them damping (wing.NAME.structure.damping_s), or look with `run` at what they do",
    ))
}

/// How much the wings have changed over a beat \[1\].
fn change(setup: &FlightSetup, before: &[ElasticState], after: &[ElasticState]) -> f64 {
    let period = setup.time.period.unwrap_or(1.0);
    let mut largest = 0.0_f64;
    for (a, b) in before.iter().zip(after) {
        let (a, b) = (&a.structure, &b.structure);
        let places = a.configuration.position.iter();
        let size = places.clone().fold(0.0_f64, |m, r| m.max(r.length()));
        for (p, q) in places.zip(&b.configuration.position) {
            largest = larger(largest, (*p - *q).length() / size);
        }
        for (p, q) in a
            .configuration
            .rotation
            .iter()
            .zip(&b.configuration.rotation)
        {
            let turn = (p.inverse() * *q).to_scaled_axis();
            largest = larger(largest, turn.length());
        }
        for (u, v) in a
            .velocity
            .chunks_exact(3)
            .zip(b.velocity.chunks_exact(3))
            .step_by(2)
        {
            let apart = (DVec3::from_slice(u) - DVec3::from_slice(v)).length();
            largest = larger(largest, apart * period / size);
        }
    }
    largest
}

/// The larger of two numbers, or what is not a number.
fn larger(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}
