//! The averaged model of a trimmed flight as a case file.

use wingbeat_analysis::{LinearModel, SteadyFlight, rigid_animal};
use wingbeat_blade::DerivativeTable;
use wingbeat_flight::LoadFrame;
use wingbeat_math::{DVec3, EulerSequence};

use super::trimmed::clear;
use crate::loaded::LoadedCase;
use crate::loaded::written_to_change as written;
use crate::raw::{
    AirCase, AirModel, BodyCase, DerivativesCase, FlightCase, LoadCase, MotionCase, WingInertia,
};

/// Angles of straight flights by rounding \[deg\], and parts of wing length by wingbeat that velocities of hover are by
/// rounding and by what a trim is good to \[1\].
const ROUNDING: f64 = 1e-9;

/// The rigid animal of a trimmed flight under the derivatives of its averaged model, as TOML.
pub fn derivative_case(
    case: &LoadedCase,
    flight: &SteadyFlight<'_>,
    model: &LinearModel,
) -> String {
    let (mass, inertia, table) = rigid_animal(flight, model);
    let beat = flight.beat();
    let j = |i: usize, k: usize| inertia.col(k)[i];
    // The table's axes are level: the body is pitched and rolled against them.
    let [ahead, down] = [table.to_body.x_axis, table.to_body.z_axis];
    let [roll, pitch] = [down.y.atan2(down.z), (-down.x).atan2(ahead.x)].map(clear_angle);
    // The flight begins in inertial axes, whose n3 gravity need not follow.
    let angles = EulerSequence::BODY_231.angles(flight.attitude).to_array();
    let [pitch_deg, yaw_deg, roll_deg] = angles.map(clear_angle);
    let velocity = flight.attitude * (table.to_body * table.velocity);
    let slow = ROUNDING * beat.wing_length() / beat.period();
    let velocity = velocity.to_array().map(|v| clear(v, slow));
    let mut raw = case.raw.clone();
    raw.name = Some(format!("{}-averaged", case.name));
    raw.control = None; // nothing steers a table of derivatives
    raw.output.frames_every = 0; // nor has it wakes
    // Bodies, joints and what acts between them have become one rigid body.
    raw.wing.clear();
    raw.segment.clear();
    raw.joint.clear();
    raw.spring.clear();
    // Buoyancy among them; the origin is at the mean mass centre.
    raw.load = beat.mean_weights().into_iter().map(weight).collect();
    raw.dynamics.wings = WingInertia::Massive; // the default: no wings are left
    raw.animal.scale = 1.0;
    raw.body = BodyCase {
        mass_kg: Some(mass),
        centre_m: Some([0.0; 3]),
        inertia_about_centre_kg_m2: Some([j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2)]),
        ..BodyCase::default()
    };
    // Of a glide, in which nothing beats, the period is a time for the equations alone.
    let frequency = case.setup.time.period.map_or(0.0, |_| 1.0 / beat.period());
    raw.motion = MotionCase {
        frequency_hz: frequency.into(),
        ..MotionCase::default()
    };
    raw.air = AirCase {
        model: AirModel::Derivatives,
        ..AirCase::default()
    };
    let mut of_table = derivatives(&table, [roll, pitch]);
    of_table.velocity_m_s = of_table.velocity_m_s.map(|v| clear(v, slow));
    raw.air.derivatives = Some(of_table);
    raw.flight = FlightCase {
        roll_deg,
        pitch_deg,
        yaw_deg,
        velocity_m_s: velocity,
        ..FlightCase::default()
    };
    let body = written(&raw);
    format!(
        "# `{}`, averaged over the wingbeat: a rigid body under stability derivatives.\n{body}",
        case.name
    )
}

/// The table as a case file has it; the angles are those of the body against its axes.
fn derivatives(
    table: &DerivativeTable,
    [body_roll_deg, body_pitch_deg]: [f64; 2],
) -> DerivativesCase {
    let part = |m: &[[f64; 6]; 6], i: usize, k: usize| -> [[f64; 3]; 3] {
        std::array::from_fn(|r| std::array::from_fn(|c| m[i + r][k + c]))
    };
    let block = |i: usize, k: usize| Some(part(&table.derivatives, i, k));
    let felt = table.added_mass.as_flattened().iter().any(|x| *x != 0.0);
    let added = |i: usize, k: usize| felt.then(|| part(&table.added_mass, i, k));
    let r = table.reference;
    DerivativesCase {
        body_pitch_deg,
        body_roll_deg,
        velocity_m_s: table.velocity.to_array(),
        force_newton: Some([r[0], r[1], r[2]]),
        moment_newton_m: [r[3], r[4], r[5]],
        force_by_velocity_newton_s_m: block(0, 0),
        force_by_rate_newton_s: block(0, 3),
        moment_by_velocity_newton_s: block(3, 0),
        moment_by_rate_newton_m_s: block(3, 3),
        added_mass_kg: added(0, 0),
        added_mass_by_turning_kg_m: added(0, 3),
        added_inertia_kg_m2: added(3, 3),
        dimensionless: None,
    }
}

/// A constant force \[N\], inertial axes, at a point of the body \[m\].
fn weight([point, force]: [DVec3; 2]) -> LoadCase {
    LoadCase {
        on: "body".to_owned(),
        frame: LoadFrame::Inertial,
        point_m: point.to_array(),
        force_newton: force.to_array(),
        couple_newton_m: [0.0; 3],
        frequency_hz: 0.0,
        force_cosine_newton: vec![],
        force_sine_newton: vec![],
        couple_cosine_newton_m: vec![],
        couple_sine_newton_m: vec![],
    }
}

/// An angle [rad] in degrees, likewise.
fn clear_angle(angle: f64) -> f64 {
    clear(angle.to_degrees(), ROUNDING)
}
