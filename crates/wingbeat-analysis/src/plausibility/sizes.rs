//! Sizes and speeds that an estimate begins with.

use wingbeat_flight::{FlightSetup, LOOKS, MotionMode};
use wingbeat_math::{DVec3, RotationLaw};
use wingbeat_model::Wing;

use super::air::{stream, viscosity};
use super::numbers::Estimate;

/// Sizes, speeds and what follows from them.
pub(super) fn sizes(setup: &FlightSetup) -> Estimate {
    let animal = &setup.animal;
    let reports = animal.wing_reports();
    let area: f64 = reports.iter().map(|r| r.area).sum();
    let weight = animal.mass() * setup.gravity.length();
    let inertia = animal.body.inertia_about_centre();
    let flight_speed = (start_velocity(setup) - stream(&setup.air)).length();
    let mut estimate = Estimate {
        mass: animal.mass(),
        frequency: setup.time.period.map(|p| 1.0 / p),
        flight_speed,
        wing_loading: (weight > 0.0 && area > 0.0).then(|| weight / area),
        inertia: DVec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z),
        viscosity: viscosity(&setup.air),
        wings: vec![],
        lift_over_weight: None,
        lift_left_out: None,
        doubts: vec![],
    };
    let wings = animal.wings.iter().zip(reports);
    let wing = |(w, r)| estimate.wing(w, r, carried(setup, w));
    estimate.wings = wings.map(wing).collect();
    estimate
}

/// Fastest speed through the undisturbed air at which a tether moves the tip of the wing, strokes left out
/// [m/s]; 0 in free flight.
fn carried(setup: &FlightSetup, wing: &Wing) -> f64 {
    let MotionMode::Tethered(motion) = &setup.mode else {
        return 0.0;
    };
    let (air, time) = (stream(&setup.air), &setup.time);
    let tip = wing.mesh.nodes.iter().copied();
    let tip = tip.max_by(|a, b| a.length().total_cmp(&b.length()));
    let tip = wing.hinge_b + tip.map_or(DVec3::ZERO, |x| wing.motion.at(0.0).c * x);
    let past = |t: f64| {
        let root = motion.at(t).motion;
        (root.v + root.r * root.w.cross(tip) - air).length()
    };
    time.instants(LOOKS).map(past).fold(0.0, f64::max)
}

/// Velocity of the body at the start, N components [m/s].
fn start_velocity(setup: &FlightSetup) -> DVec3 {
    match &setup.mode {
        MotionMode::Free(start) => start.velocity,
        MotionMode::Tethered(motion) => {
            let [x, y, z] = &motion.position;
            DVec3::new(x.rate, y.rate, z.rate)
        }
    }
}
