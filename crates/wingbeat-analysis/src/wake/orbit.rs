//! The periodic beat of a flyer whose wings bend or whose strips leave wakes, in air without wakes in space:
//! wings come back to shape and velocity, and wakes to their states, as the body does.
//!
//! A beat is flown again and again, the body put back to its start after each and the wings going on from where
//! they are: air damps them so much that after a few beats they come back to where they began. States of wakes
//! decay by their ways, which a beat tells: they go on from where they would be if the strips' motion repeated
//! itself for ever. What the body has changed by in such a beat are the residuals of steady flight.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::air::BladeAir;
use wingbeat_flight::elastic::ElasticState;
use wingbeat_flight::{AirMemory, AirModel, FlightSetup, Past, Record, Simulation, system_of};
use wingbeat_math::{DVec3, larger, rotation_vector};

use super::free_beat::scales;
use crate::AnalysisError;
use crate::beat::glide::{glides, period_of_glide};
use crate::beat::periodic::check_periodic;
use crate::beat::{changing_air, check_steady, steadied};

/// Change of places over the wing length, of attitudes \[rad\], and of velocities over wing length and
/// wingbeat, within which wings count as back, over the residuals that count as trimmed; and some ten times
/// what a step leaves unbalanced.
const BACK: [f64; 2] = [1e-2, 1e-9];

/// Beats within which they must be.
const MAX_BEATS: usize = 60;

/// Whether the past of a flight is in its wings and their strips alone.
pub(super) fn has_orbit(setup: &FlightSetup) -> bool {
    setup.has_memory() && !setup.air.keeps_wake()
}

/// An error if the setup neither beats nor glides, or a wingbeat is not like the next.
///
/// # Errors
/// No wingbeat, and no glide; loads, feedback; air that changes with time or place; joints of a glider that move.
pub fn check_alike(setup: &FlightSetup) -> Result<(), AnalysisError> {
    let period = setup.time.period.filter(|period| *period > 0.0);
    let Some(period) = period.or_else(|| period_of_glide(setup)) else {
        return Err(AnalysisError::not_covered(
            "no wing beats, and nothing glides: joints are driven in time, or there is no gravity or no wing",
            "give the frequency of the wings or of the drives as that of the wingbeat (motion.frequency_hz); what glides has wings, gravity and no drives",
        ));
    };
    check_steady(setup)?;
    check_periodic(&system_of(&steadied(setup))?, period)?;
    if glides(setup) {
        check_welded(setup)?;
    }
    let has_wind = setup.air.wind().is_some_and(|w| !w.is_none());
    let changes = match &setup.air {
        AirModel::VortexLattice(air) => !air.lattice.images.is_empty(),
        AirModel::Own(air) => !air.is_steady_and_uniform(),
        _ => false,
    };
    match has_wind || changes {
        false => Ok(()),
        true => Err(changing_air(setup)),
    }
}

/// An error if a glider has joints that move freely: where they come to rest is not sought with the wake.
fn check_welded(setup: &FlightSetup) -> Result<(), AnalysisError> {
    match system_of(setup)?.speeds() {
        0 => Ok(()),
        _ => Err(AnalysisError::not_covered(
            "a glider has joints that move freely, and where they come to rest is not sought in air with a memory or beside elastic wings",
            "prescribe the joints' motion, or trim it in blade elements (air.model = \"blade_element\", rigid wings, no air.blade.unsteady)",
        )),
    }
}

/// An error if the periodic motion of the setup is not that of its body, wings and strips alone.
///
/// # Errors
/// Joints that move freely.
pub(super) fn check_orbit(setup: &FlightSetup) -> Result<(), AnalysisError> {
    let system = system_of(setup)?;
    match system.speeds() {
        0 => Ok(()),
        _ => Err(AnalysisError::not_covered(
            "joints move freely beside elastic wings or wakes of strips, and the periodic motion of both is not sought",
            "prescribe the joints' motion, or make the wings rigid and leave air.blade.unsteady out",
        )),
    }
}

/// A beat whose wings and wakes come back.
pub(super) struct PeriodicBeat {
    /// At its start and its end.
    pub ends: [Record; 2],
    /// Wings and wakes at its start and its end.
    pub pasts: [Past; 2],
    /// Motion of the root over it, from step to step, both ends among them.
    pub roots: Vec<BodyMotion>,
    /// Beats flown until then.
    pub beats: usize,
}

/// The beat of `setup`, which is `steps` long, its wings and wakes sought from `past` on, or from rest, for
/// residuals within `tolerance`.
///
/// # Errors
/// What the flight reports; wings or wakes that do not come back.
pub(super) fn periodic_beat(
    setup: &FlightSetup,
    steps: usize,
    past: Option<Past>,
    tolerance: f64,
) -> Result<PeriodicBeat, AnalysisError> {
    let mut past = past;
    let back = (BACK[0] * tolerance).max(BACK[1]);
    for beats in 1..=MAX_BEATS {
        let mut flight = match &past {
            Some(past) => Simulation::after(setup.clone(), past)?,
            None => Simulation::new(setup.clone())?,
        };
        let (mut before, first) = (Past::of(flight.state()), flight.record().clone());
        // Where the body has been put back the strips' downwash jumps: a beat of the wakes begins before that.
        if let Some(past) = past.take() {
            before.air = past.air;
        }
        let mut roots = vec![flight.root()];
        for _ in 0..steps {
            flight.step()?;
            roots.push(flight.root());
        }
        let mut after = Past::of(flight.state());
        let changed = change(setup, &before.wings, &after.wings);
        let felt = change_of_wakes(setup, &before, &after);
        if larger(changed, felt) <= back {
            let ends = [first, flight.record().clone()];
            return Ok(PeriodicBeat {
                ends,
                pasts: [before, after],
                roots,
                beats,
            });
        }
        repeat_wakes(setup, &before, &mut after)?;
        past = Some(after);
    }
    Err(AnalysisError::NotPeriodic {
        what: format!(
            "elastic wings and wakes of strips find no periodic motion within {MAX_BEATS} wingbeats"
        ),
        remedy: "give elastic wings damping (wing.NAME.structure.damping_s), or look with `run` at what they do",
    })
}

/// Puts the wakes where they would be if the strips moved as between `before` and `after` for ever.
fn repeat_wakes(setup: &FlightSetup, before: &Past, after: &mut Past) -> Result<(), AnalysisError> {
    let AirModel::BladeElement(options) = &setup.air else {
        return Ok(());
    };
    let strips = |past: &Past| {
        past.air
            .as_ref()
            .and_then(AirMemory::strips)
            .map(<[_]>::to_vec)
    };
    let (Some(from), Some(to)) = (
        strips(before),
        after.air.as_mut().and_then(AirMemory::strips_mut),
    ) else {
        return Ok(());
    };
    let air = BladeAir::new(&setup.animal, options)?;
    for ((wing, from), to) in air.wings().iter().zip(&from).zip(to) {
        *to = wing.periodic(from, to);
    }
    Ok(())
}

/// How much the wakes of the strips have changed, over wing length and wingbeat \[1\].
fn change_of_wakes(setup: &FlightSetup, before: &Past, after: &Past) -> f64 {
    let unit = scales(setup).velocity;
    let both = numbers(before).into_iter().zip(numbers(after));
    both.map(|(a, b)| (a - b).abs() / unit).fold(0.0, larger)
}

/// States of the wakes of all strips \[m/s\].
pub(super) fn numbers(past: &Past) -> Vec<f64> {
    let wings = past.air.as_ref().and_then(AirMemory::strips);
    let wings = wings.unwrap_or_default().iter();
    wings
        .flat_map(wingbeat_blade::WingMemory::numbers)
        .collect()
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
            let turn = rotation_vector(p.inverse() * *q);
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
