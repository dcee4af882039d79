//! The lift that blade elements expect of a flight.

use wingbeat_air::Wind;
use wingbeat_blade::BladeSettings;
use wingbeat_flight::{
    AirModel, BladeOptions, FlightSetup, MotionMode, PrescribedMotion, Simulation, TimeGrid,
};
use wingbeat_math::DVec3;
use wingbeat_model::Wing;

use super::air::{density, stream};
use crate::beat::steadied;
use crate::error::AnalysisError;

/// Steps per wingbeat with which the blade elements are flown.
const STEPS: usize = 60;

/// Mean lift over weight of the second wingbeat of a tethered flight in blade elements, all wings rigid; none where these cannot
/// follow a measured surface.
pub(super) fn lift_over_weight(setup: &FlightSetup) -> Result<Option<f64>, AnalysisError> {
    let weight = setup.animal.mass() * setup.gravity.length();
    let (Some(period), Some(density)) = (setup.time.period, density(&setup.air)) else {
        return Ok(None);
    };
    let wings = &setup.animal.wings;
    if weight == 0.0 || wings.is_empty() || wings.iter().any(Wing::has_measured_surface) {
        return Ok(None);
    }
    let blades = BladeOptions {
        blade: BladeSettings {
            free_stream: stream(&setup.air),
            ..BladeSettings::insect(density)
        },
        body_drag: None,
        induced: DVec3::ZERO,
        wind: match &setup.air {
            AirModel::VortexLattice(air) => air.lattice.wind.clone(),
            _ => Wind::default(),
        },
    };
    let mut tethered = steadied(setup);
    for wing in &mut tethered.animal.wings {
        wing.structure = None; // blade elements know no wings that bend
    }
    if !matches!(setup.air, AirModel::BladeElement(_)) {
        tethered.air = AirModel::BladeElement(blades);
    }
    tethered.feedback = None;
    tethered.mode = MotionMode::Tethered(held(setup));
    tethered.time = TimeGrid {
        step: period / STEPS as f64,
        steps: 2 * STEPS,
        period: Some(period),
    };
    let mut flight = Simulation::new(tethered)?;
    let (down, mut lift) = (setup.gravity / setup.gravity.length(), 0.0);
    while !flight.finished() {
        let record = flight.step()?;
        if record.step > STEPS {
            lift -= record.air.iter().map(|a| a.force.dot(down)).sum::<f64>();
        }
    }
    Ok(Some(lift / STEPS as f64 / weight))
}

/// The root as it is held or starts, attitude and velocity kept.
fn held(setup: &FlightSetup) -> PrescribedMotion {
    match &setup.mode {
        MotionMode::Tethered(motion) => motion.clone(),
        MotionMode::Free(start) => start.hold(),
    }
}
