//! Tables of derivatives with the added mass of the air, against closed forms.

use crate::common::{found, preset};
use wingbeat_analysis::{Plane, table_model};
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

/// Inertia in roll [kg m2].
const J: f64 = 6e-8;
/// Moment by roll rate [N m s].
const L: f64 = -2e-5;
/// Added inertia [kg m2].
const A: f64 = 4e-8;

/// A body that rolls in air which hinders that and goes with it, `more` set besides.
fn rolling(more: &[&str]) -> Result<LoadedCase, String> {
    let damping = format!(
        "air.derivatives={{moment_by_rate_newton_m_s=[[{L},0,0],[0,0,0],[0,0,0]],added_inertia_kg_m2=[[{A},0,0],[0,0,0],[0,0,0]]}}"
    );
    let own = [
        "flight.pitch_deg=0",
        "flight.velocity_m_s=[0,0,0]",
        "flight.angular_velocity_deg_s=[0.01,0,0]",
        "time.steps_per_beat=100",
        "time.beats=0.2",
        &format!("body.inertia_about_centre_kg_m2=[{J},{J},{J},0,0,0]"),
        &damping,
    ];
    found("table1-taylor-thomas-2003", &[&own[..], more].concat())
}

/// `(J + A) p' = L p`: flown by every formulation, and as a mode.
#[test]
fn exact_roll_of_a_body_that_carries_air_along() {
    let wanted = L / (J + A);
    for formulation in ["momentum", "quaternion", "euler"] {
        let set = format!("dynamics.formulation={formulation}");
        let case = rolling(&[&set]).unwrap();
        let mut flight = Simulation::new(case.setup).unwrap();
        let first = flight.root().w.x;
        while !flight.finished() {
            flight.step().unwrap();
        }
        let growth = (flight.root().w.x / first).ln() / flight.record().time;
        // Runge-Kutta, 0.09 of the time of decay a step: (0.09)^4 / 120.
        let apart = (growth / wanted - 1.0).abs();
        assert!(apart < 2e-6, "{formulation}: {growth} {wanted}");
    }
    let modes = table_model(&rolling(&[]).unwrap().setup).unwrap().modes;
    let mut lateral = modes.plane(Plane::Lateral);
    let found = lateral.find(|m| !m.is_neutral()).unwrap().growth;
    assert!((found / wanted - 1.0).abs() < 1e-9, "{found} {wanted}");
}

/// `u' = -q w`, `(m + A) w' = m q u`: the velocity through the air goes round an ellipse; by every formulation,
/// in still air and carried along by a stream.
#[test]
fn exact_turn_of_a_body_that_carries_air_along() {
    const M: f64 = 0.0018;
    const A: f64 = 0.0006;
    const U: f64 = 4.0;
    const Q: f64 = 8.0;
    let added = format!("air.derivatives={{added_mass_kg=[[0,0,0],[0,0,0],[0,0,{A}]]}}");
    for (formulation, stream) in [
        ("momentum", [0.0; 2]),
        ("quaternion", [0.0; 2]),
        ("euler", [0.0; 2]),
        ("momentum", [-1.5, 0.7]),
    ] {
        let [ahead, down] = stream;
        let own = [
            "gravity_m_s2=[0,0,0]",
            "flight.pitch_deg=0",
            "time.steps_per_beat=100",
            "time.beats=2",
            &format!("body.mass_kg={M}"),
            &format!("body.inertia_about_centre_kg_m2=[{J},{J},{J},0,0,0]"),
            &format!("dynamics.formulation={formulation}"),
            &format!("flight.velocity_m_s=[{},0,{down}]", U + ahead),
            &format!("flight.angular_velocity_deg_s=[0,{},0]", Q.to_degrees()),
            &format!("air.stream_m_s=[{ahead},0,{down}]"),
            &added,
        ];
        let case = preset("table1-taylor-thomas-2003", &own);
        let mut flight = Simulation::new(case.setup).unwrap();
        while !flight.finished() {
            flight.step().unwrap();
        }
        let root = flight.root();
        let through = root.r.transpose() * (root.v - DVec3::new(ahead, 0.0, down));
        let k = (M / (M + A)).sqrt();
        let (sin, cos) = (k * Q * flight.record().time).sin_cos();
        let wanted = DVec3::new(U * cos, 0.0, k * U * sin);
        // Hamming of fourth order, 0.63 rad in 200 steps; rounding.
        let apart = (through - wanted).length() / U;
        assert!(apart < 2e-13, "{formulation}: {through} {wanted} {apart:e}");
    }
}

#[test]
fn refuses_added_mass_that_is_not_symmetric() {
    let skew = "air.derivatives.added_mass_kg=[[1,2,0],[0,1,0],[0,0,1]]";
    let said = rolling(&[skew]).unwrap_err();
    for part in ["air.derivatives.added_mass_kg", "not symmetric: 2 and 0"] {
        assert!(said.contains(part), "{said}");
    }
}

/// Tables along the span of an elastic wing: the key and the row of the user.
#[test]
fn refuses_rows_of_elastic_wings_by_their_key() {
    let beam = "wing.right.structure.beam";
    for (rows, says) in [
        (
            "[[0, 9e-5], [0.9, 2e-5]]",
            "flap_table_newton_m2[1] = [0.9, 2e-5]: the table ends at r/R = 0.9",
        ),
        (
            "[[0, 9e-5], [0.5, -2e-5], [1, 2e-5]]",
            "flap_table_newton_m2[1] = [0.5, -2e-5]: along the span it comes to",
        ),
    ] {
        let set = [
            format!("{beam}.flap_newton_m2="),
            format!("{beam}.flap_table_newton_m2={rows}"),
        ];
        let said = LoadedCase::find("hawkmoth-elastic", &set).unwrap_err();
        let said = said.to_string();
        assert!(said.contains(&format!("{beam}.{says}")), "{said}");
        assert!(!said.contains("beam.flap.table"), "{said}");
    }
}

/// A body and its segment of the same mass [kg], welded this far ahead [m], in air that brakes the body alone, across;
/// `more` set besides.
const BALLAST: f64 = 0.0018;
const AHEAD: f64 = 0.01;

fn braked(more: &[&str]) -> LoadedCase {
    let braking =
        "air.derivatives={force_by_velocity_newton_s_m=[[0,0,0],[0,0,0],[0,0,-1e-3]]}".to_owned();
    let inertia = format!("inertia_about_centre_kg_m2=[{J},{J},{J},0,0,0]");
    let own = [
        braking,
        format!("body.mass_kg={BALLAST}"),
        format!("body.{inertia}"),
        format!("segment.ballast={{mass_kg={BALLAST},centre_m=[{AHEAD},0,0],{inertia}}}"),
        "joint.neck={child=\"ballast\",kind=\"weld\",at_m=[0.005,0,0]}".to_owned(),
    ];
    let own: Vec<&str> = own.iter().map(String::as_str).collect();
    preset("table1-taylor-thomas-2003", &[&own[..], more].concat())
}

/// `w' = Z (1 / 2 m + d^2 / 4 I) w` of the body's own velocity across, with the inertia I of both about the common mass
/// centre half way between them.
#[test]
fn exact_mode_of_a_body_with_a_welded_segment() {
    let inertia = 2.0 * J + 2.0 * BALLAST * (0.5 * AHEAD).powi(2);
    let wanted = -1e-3 * (0.5 / BALLAST + 0.25 * AHEAD * AHEAD / inertia);
    let modes = table_model(&braked(&[]).setup).unwrap().modes;
    let found = modes.modes.last().unwrap().growth;
    assert!((found / wanted - 1.0).abs() < 1e-8, "{found} {wanted}");
}

/// What moves against the body is not of a rigid one.
#[test]
fn refuses_modes_of_a_table_with_segments_that_move() {
    let said = |more: &str| {
        let case = braked(&[more]);
        table_model(&case.setup).unwrap_err().to_string()
    };
    let free = said("joint.neck={child=\"ballast\",kind=\"revolute\",axis=[0,1,0],at_m=[0,0,0]}");
    assert!(free.contains("joint `neck` leaves a motion free"), "{free}");
    let driven = said(
        "joint.neck={child=\"ballast\",kind=\"weld\",at_m=[0,0,0],turn={axis=[0,1,0],sine_deg=[5.0]}}",
    );
    assert!(driven.contains("segment `ballast` moves"), "{driven}");
}
