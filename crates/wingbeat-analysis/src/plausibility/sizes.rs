//! Sizes and speeds that an estimate begins with.

use wingbeat_flight::{FlightSetup, LOOKS, MotionMode};
use wingbeat_math::{DVec3, RotationLaw};
use wingbeat_model::Wing;

use super::numbers::{ByJoints, Estimate, Moved, SAMPLES, stroke_amplitude};

/// Sizes, speeds and what follows from them.
pub(super) fn sizes(setup: &FlightSetup) -> Estimate {
    let animal = &setup.animal;
    let reports = animal.wing_reports();
    let area: f64 = reports.iter().map(|r| r.area).sum();
    let weight = animal.mass() * setup.gravity.length();
    let inertia = animal.body.inertia_about_centre();
    let flight_speed = (start_velocity(setup) - setup.air_at_start()).length();
    let mut estimate = Estimate {
        mass: animal.mass(),
        frequency: setup.time.period.map(|p| 1.0 / p),
        flight_speed,
        wing_loading: (weight > 0.0 && area > 0.0).then(|| weight / area),
        inertia: DVec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z),
        viscosity: setup.air.viscosity(),
        wings: vec![],
        lift_over_weight: None,
        lift_left_out: None,
        doubts: vec![],
    };
    let wings = animal.wings.iter().zip(reports).enumerate();
    let wing = |(k, (w, r))| {
        let moved = Moved {
            by_tether: carried(setup, k),
            by_joints: by_joints(setup, k),
        };
        estimate.wing(w, r, &moved)
    };
    estimate.wings = wings.map(wing).collect();
    estimate
}

/// Whether joints move wing `w`, which hangs on another one or has no stroke of its own, and how fast its tip
/// then goes on average over a beat, or over the flight where nothing beats.
fn by_joints(setup: &FlightSetup, w: usize) -> ByJoints {
    let hangs_on_joint = setup.joints.iter().any(|j| j.child == w + 1);
    let is_moved = hangs_on_joint && stroke_amplitude(&setup.animal.wings[w]) == 0.0;
    if !setup.rides_on_wing(w) && !is_moved {
        return ByJoints::No;
    }
    let tip = tip(&setup.animal.wings[w]);
    let speed = |t: f64| {
        let moving = setup.prescribed_in_body(w, t)?;
        Some((moving.v + moving.r * moving.w.cross(tip)).length())
    };
    let times: Vec<f64> = match setup.time.period {
        Some(period) => (0..SAMPLES)
            .map(|k| period * k as f64 / SAMPLES as f64)
            .collect(),
        None => setup.time.instants(LOOKS).collect(),
    };
    let speeds: Option<Vec<f64>> = times.into_iter().map(speed).collect();
    speeds.map_or(ByJoints::Free, |all| {
        ByJoints::Prescribed(all.iter().sum::<f64>() / all.len().max(1) as f64)
    })
}

/// The node farthest from the hinge, wing components \[m\].
fn tip(wing: &Wing) -> DVec3 {
    let nodes = wing.mesh.nodes.iter().copied();
    let tip = nodes.max_by(|a, b| a.length().total_cmp(&b.length()));
    tip.unwrap_or(DVec3::ZERO)
}

/// Fastest speed through the undisturbed air at which a tether moves the tip of wing `w`, strokes left out
/// [m/s]; 0 in free flight.
fn carried(setup: &FlightSetup, w: usize) -> f64 {
    let MotionMode::Tethered(motion) = &setup.mode else {
        return 0.0;
    };
    let (air, time) = (setup.air_at_start(), &setup.time);
    let wing = &setup.animal.wings[w];
    let tip = match setup.prescribed_in_body(w, 0.0) {
        Some(moving) => moving.p + moving.r * tip(wing),
        None => wing.hinge_b + wing.motion.at(0.0).c * tip(wing),
    };
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
