//! What a flight will be like, before it is flown: the numbers a biologist or engineer knows by
//! heart, the lift that blade elements expect, and what of it is implausible.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | R, c | `length`, `mean_chord` | wing length and mean chord | m |
//! | f, Phi | `frequency`, `stroke_amplitude` | wingbeats per second, stroke from end to end | Hz, rad |
//! | U_t | `tip_speed` | mean speed of the tip from flapping, `2 Phi R f` [Ellington 1984] | m/s |
//! | U | `speed` | the larger of U_t and the flight speed | m/s |
//! | Re | `reynolds` | `U c / nu` | 1 |
//! | k | `reduced_frequency` | `pi f c / U` | 1 |
//!
//! The limits of [`Estimate::doubts`] are wide: they catch slips of unit, sign and scale, not
//! unusual animals. Nothing here is used by a flight.

mod air;
mod doubts;
mod elastic;
mod joints;
mod lift;
mod limit;
mod numbers;
mod sides;
mod wake;

pub use doubts::jumping_rotation;
pub(crate) use joints::{chain, slowest_on_springs};
pub use numbers::stroke_amplitude;
pub use numbers::{Estimate, WingEstimate};
pub use wake::{KeptWake, kept_wake, way_in_a_step};

use wingbeat_flight::{FlightSetup, MotionMode};
use wingbeat_math::{DVec3, RotationLaw};
use wingbeat_model::Wing;

use self::air::{stream, viscosity};
use self::doubts::{doubts, reynolds_doubts};
use self::lift::lift_over_weight;

/// Says which Reynolds numbers of the wings are so low that friction rules, or higher than any animal's.
pub fn doubtful_reynolds_numbers(setup: &FlightSetup) -> Vec<String> {
    reynolds_doubts(&sizes(setup).wings)
}

/// Estimates what a flight will be like. Where the blade elements cannot be flown it says why, and leaves the lift out.
pub fn estimate(setup: &FlightSetup) -> Estimate {
    let mut estimate = sizes(setup);
    match lift_over_weight(setup) {
        Ok(lift) => estimate.lift_over_weight = lift,
        Err(e) => estimate.lift_left_out = Some(e.to_string()),
    }
    let first = elastic::first_frequencies(&setup.animal.wings);
    for (w, first) in estimate.wings.iter_mut().zip(first) {
        w.hides_frequency = first.is_err();
        w.first_frequency = first.unwrap_or_default();
        w.frequency_ratio = w
            .first_frequency
            .zip(estimate.frequency)
            .map(|(f, beat)| f / beat);
    }
    estimate.doubts = doubts(setup, &estimate);
    estimate
}

/// Sizes, speeds and what follows from them.
fn sizes(setup: &FlightSetup) -> Estimate {
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
    let past = |k: usize| {
        let root = motion.at(k as f64 * time.step);
        let turned = root.rotation * root.angular_velocity.cross(tip);
        (root.velocity + turned - air).length()
    };
    (0..=time.steps).map(past).fold(0.0, f64::max)
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
