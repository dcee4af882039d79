//! The lift that blade elements expect of a flight.

use wingbeat_air::{Gust, GustShape, Wind};
use wingbeat_blade::BladeSettings;
use wingbeat_flight::{
    AirModel, BladeOptions, FlightSetup, MotionMode, PrescribedMotion, Simulation, TimeGrid,
    system_of,
};
use wingbeat_math::DVec3;
use wingbeat_model::Wing;

use crate::beat::steadied;
use crate::error::AnalysisError;

/// Steps per wingbeat with which the blade elements are flown at least.
const STEPS: usize = 60;

/// Most steps per wingbeat that are worth it.
const MAX_STEPS: usize = 10_000;

/// Whether a gust is wind that stays once it has come.
fn stays(gust: &Gust) -> bool {
    match &gust.shape {
        GustShape::OneMinusCosine { .. } | GustShape::Turbulence(_) => false,
        GustShape::Table(rows) => rows.last().is_some_and(|row| row.1 != 0.0),
    }
}

/// Steps of a wingbeat on trial: with free joints, which may be stiff, no longer than those of the flight.
fn steps(setup: &FlightSetup) -> Result<usize, AnalysisError> {
    let has_free_joints = system_of(setup).is_ok_and(|s| s.speeds() > 0);
    let own = setup.time.steps_per_beat().unwrap_or(0);
    match has_free_joints {
        true if own > MAX_STEPS => Err(AnalysisError::not_covered(
            format!(
                "joints ask for the {own} steps per wingbeat of the flight, of at most {MAX_STEPS} on trial"
            ),
            "lower time.steps_per_beat, or look at the lift of the flight itself",
        )),
        true => Ok(STEPS.max(own)),
        false => Ok(STEPS),
    }
}

/// Mean lift over weight of the second wingbeat of a tethered flight in blade elements, all wings rigid,
/// without gusts that pass and turbulence: what they do in those instants says nothing of the strokes. None
/// where these cannot follow a measured surface.
pub(crate) fn lift_over_weight(setup: &FlightSetup) -> Result<Option<f64>, AnalysisError> {
    let weight = setup.animal.mass() * setup.gravity.length();
    let (Some(period), Some(density)) = (setup.time.period, setup.air.density()) else {
        return Ok(None);
    };
    let wings = &setup.animal.wings;
    if weight == 0.0 || wings.is_empty() || wings.iter().any(Wing::has_measured_surface) {
        return Ok(None);
    }
    let blades = BladeOptions {
        blade: BladeSettings {
            free_stream: setup.air.stream().unwrap_or_default(),
            ..BladeSettings::insect(density)
        },
        body_drag: None,
        induced: DVec3::ZERO,
        wind: match &setup.air {
            AirModel::VortexLattice(air) => air.lattice.wind.clone(),
            _ => Wind::default(),
        },
        viscosity: None,
    };
    let mut tethered = steadied(setup);
    for wing in &mut tethered.animal.wings {
        wing.structure = None; // blade elements know no wings that bend
    }
    if !matches!(setup.air, AirModel::BladeElement(_)) {
        tethered.air = AirModel::BladeElement(blades);
    }
    if let Some(wind) = tethered.air.wind_mut() {
        wind.gusts.retain(stays);
    }
    tethered.feedback = None;
    tethered.mode = MotionMode::Tethered(held(setup));
    let steps = steps(setup)?;
    tethered.time = TimeGrid {
        step: period / steps as f64,
        steps: 2 * steps,
        period: Some(period),
    };
    let mut flight = Simulation::new(tethered)?;
    let (down, mut lift) = (setup.gravity / setup.gravity.length(), 0.0);
    while !flight.finished() {
        let record = flight.step()?;
        if record.step > steps {
            lift -= record.air.iter().map(|a| a.force.dot(down)).sum::<f64>();
        }
    }
    Ok(Some(lift / steps as f64 / weight))
}

/// The root as it is held once it moves, or as it starts, attitude and velocity kept.
fn held(setup: &FlightSetup) -> PrescribedMotion {
    match &setup.mode {
        MotionMode::Tethered(motion) => motion.impulsive(),
        MotionMode::Free(start) => start.hold(),
    }
}
