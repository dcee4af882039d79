//! The linear model of an animal whose air is a table of stability derivatives, and such a table
//! from the cycle means of a flapping one.

use wingbeat_blade::DerivativeTable;
use wingbeat_flight::{AirModel, FlightSetup};
use wingbeat_math::{BodyMotion, DMat3, DVec3, Wrench, six_by_six, tilde};

use crate::AnalysisError;
use crate::beat::check_weights;
use crate::stability::LinearModel;
use crate::stability::eigen::eigen;
use crate::stability::jacobian::jacobian;
use crate::stability::modes::{ModeSet, Scales};
use crate::stability::rigid_body::RigidBody;
use crate::stability::steady::SteadyFlight;
use crate::stability::welded::Welded;

/// The linear model of a rigid animal, its welded segments with it, under its table of derivatives about the table's
/// reference flight, level. Times in wingbeats refer to the setup's period, else to a second.
///
/// # Errors
/// Other air; wings with mass, joints that leave anything free and segments that move, for the table is that of a
/// rigid body; numbers not finite.
pub fn table_model(setup: &FlightSetup) -> Result<LinearModel, AnalysisError> {
    let AirModel::Derivatives(table) = setup.air else {
        return Err(AnalysisError::not_covered(
            "the air is no table of derivatives",
            "use air.model = \"derivatives\"",
        ));
    };
    if setup.animal.wings.iter().any(|w| w.mass.mass > 0.0) {
        return Err(AnalysisError::not_covered(
            "the animal has wings with mass beside its table of derivatives",
            "leave the wings out, or set dynamics.wings = \"massless\"",
        ));
    }
    check_weights(setup)?;
    let welded = Welded::of(setup)?;
    let table = table.about(welded.mass.centre());
    let body = rigid_body(setup, &table, &welded);
    let mut reference = [0.0; 9];
    table.velocity.write_to_slice(&mut reference);
    let rates = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        Ok(body
            .rates(x, |state| Ok(load(&table, state.velocity, state.rate)))?
            .to_vec())
    };
    let period = setup.time.period.unwrap_or(1.0);
    let rate = 1.0 / period;
    // Speed by which components are compared: that of a fall over a wingbeat.
    let speed = setup.gravity.length() * period;
    let scales = Scales {
        velocity: if speed > 0.0 { speed } else { 1.0 },
        rate,
        period,
    };
    let steps = scales.array().map(|s| 1e-3 * s);
    let matrix = jacobian(rates, &reference, &steps)?;
    let modes = ModeSet::of_exponents(eigen(&matrix, 9)?, &scales);
    Ok(LinearModel {
        velocity: table.velocity,
        matrix,
        derivatives: table.derivatives,
        added_mass: body.added_mass,
        momentum: body.momentum,
        imbalance: [0.0; 2],
        modes,
    })
}

/// The body and the weights on it in the axes of the table.
fn rigid_body(setup: &FlightSetup, table: &DerivativeTable, welded: &Welded) -> RigidBody {
    let (body, along) = (&welded.mass, setup.gravity.normalize_or_zero());
    let (inertia, centre) = (body.inertia_about_centre(), body.centre());
    let weight = |[point, force]: &[DVec3; 2]| {
        [
            table.to_body.transpose() * (*point - centre),
            force.dot(along) * DVec3::Z,
        ]
    };
    RigidBody {
        mass: body.mass,
        inertia: table.to_body.transpose() * inertia * table.to_body,
        gravity: DVec3::Z * setup.gravity.length(),
        weights: welded.weights.iter().map(weight).collect(),
        momentum: DVec3::ZERO,
        added_mass: table.added_mass,
        length: (inertia.col(0).length() / body.mass).sqrt(),
    }
}

/// Loads about the mass centre, axes of the table, when the body stands in its reference
/// attitude and its velocities do not change in these axes.
fn load(table: &DerivativeTable, velocity: DVec3, rate: DVec3) -> Wrench {
    let (v, w) = (table.to_body * velocity, table.to_body * rate);
    let still = DerivativeTable {
        stream: DVec3::ZERO,
        added_mass: six_by_six::ZERO,
        ..*table
    };
    let load = still.load(&BodyMotion {
        r: DMat3::IDENTITY,
        v: v - w.cross(table.point),
        w,
        ..BodyMotion::REST
    });
    let to_table = table.to_body.transpose();
    Wrench {
        force: to_table * load.force,
        moment: to_table * (load.moment - table.point.cross(load.force)),
    }
}

/// The rigid animal with the mean mass properties of a trimmed flight, and its derivatives: mass [kg], inertia
/// about the mass centre in body axes [kg m2], table. The table is that of still air, velocities being those
/// through the air of the trim.
pub fn rigid_animal(
    flight: &SteadyFlight<'_>,
    model: &LinearModel,
) -> (f64, DMat3, DerivativeTable) {
    let (beat, level) = (flight.beat(), &flight.level);
    // The trimmed flight is in balance.
    let mut f = -beat.mass() * (level.to_n.transpose() * beat.gravity());
    let mut m = DVec3::ZERO;
    for [point, force] in beat.mean_weights() {
        let force = level.to_n.transpose() * force;
        f -= force;
        m -= (level.to_root.transpose() * point).cross(force);
    }
    let mut derivatives = model.derivatives;
    // Wings that carry angular momentum along turn a body that turns.
    let gyroscopic = tilde(model.momentum);
    for (i, row) in derivatives[3..].iter_mut().enumerate() {
        (0..3).for_each(|j| row[3 + j] += gyroscopic.col(j)[i]);
    }
    let table = DerivativeTable {
        to_body: level.to_root,
        point: DVec3::ZERO,
        velocity: flight.through,
        reference: [f.x, f.y, f.z, m.x, m.y, m.z],
        derivatives,
        added_mass: model.added_mass,
        stream: DVec3::ZERO,
    };
    (beat.mass(), beat.mean_inertia(), table)
}
