//! Flyers whose wings all stand still, and the elevator.

use std::path::Path;

use wingbeat_analysis::control::{Regulator, Weights};
use wingbeat_analysis::{
    Plane, SteadyFlight, Trim, TrimRequest, Unknown, floquet_of_trim, linear_model, power_of_trim,
    sweep, table_model, trim,
};
use wingbeat_case::{LoadedCase, derivative_case, trimmed_case};
use wingbeat_flight::Record;
use wingbeat_math::{DMat3, DVec3, EulerSequence};

use crate::common;

/// A glider of wings and a tail without mass, on a body whose mass centre is at its origin.
const GLIDER: &str = include_str!("data/glider.toml");

/// Coefficients of [`GLIDER`], its density [kg/m3] and weight \[N\].
const LIFT: f64 = 2.2;
const DRAG: [f64; 2] = [0.03, 2.0];
const RHO: f64 = 1.225;
const WEIGHT: f64 = 0.03 * 9.81;

fn case(text: &str, set: &[&str]) -> LoadedCase {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    LoadedCase::from_text("glider", text, Path::new(""), &set).unwrap_or_else(|e| panic!("{e}"))
}

/// The trim at these speeds forward and up [m/s], 0 not being given, by `unknowns` or the usual ones.
fn trimmed(case: &LoadedCase, [forward, up]: [f64; 2], unknowns: Option<Vec<Unknown>>) -> Trim {
    let request = TrimRequest {
        velocity: DVec3::new(forward, 0.0, -up),
        unknowns,
        ..TrimRequest::default()
    };
    let problem = request.problem(&case.setup).unwrap();
    let found = trim(&case.setup, &problem).unwrap_or_else(|e| panic!("{e}"));
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    found
}

/// Lift and drag over the dynamic pressure \[m2\], and the pitching moment about the origin over it [m3], of a glider
/// whose body meets the air at `alpha`, by the sum over wings and tail: of each the incidence, the area, the place of
/// the leading edge, and the distance of the quarter point from it.
fn by_hand(alpha: f64, [wing, tail]: [f64; 2]) -> [f64; 3] {
    let surfaces = [(wing, 0.04, 2e-3, 0.02), (tail, 0.01, -0.25, 0.0125)];
    let mut sum = [0.0; 3];
    for (incidence, area, hinge, quarter) in surfaces {
        let (s, c) = (alpha + incidence).sin_cos();
        let lift = area * LIFT * 2.0 * s * c;
        let drag = area * (DRAG[0] * c * c + DRAG[1] * s * s);
        let (x, z) = (hinge - quarter * incidence.cos(), quarter * incidence.sin());
        let (s, c) = alpha.sin_cos();
        let (ahead, down) = (lift * s - drag * c, -lift * c - drag * s);
        for (sum, part) in sum.iter_mut().zip([lift, drag, z * ahead - x * down]) {
            *sum += part;
        }
    }
    sum
}

/// That angle, speed and moment of the glide are those of the formulas.
fn check_by_hand(found: &Trim, tail: f64) {
    let glide = found.glide().unwrap().unwrap();
    let alpha = found.solution.body_pitch + glide.angle;
    let [lift, drag, moment] = by_hand(alpha, [4f64.to_radians(), tail]);
    // The trim is found to residuals of 1e-9.
    let angle = -(1.0 / (lift / drag)).atan();
    assert!(
        (glide.angle + angle).abs() < 1e-8,
        "{} {angle}",
        glide.angle
    );
    let speed = (2.0 * WEIGHT * angle.cos() / (RHO * lift)).sqrt();
    assert!((glide.airspeed / speed - 1.0).abs() < 1e-8, "{speed}");
    let pressure = 0.5 * RHO * speed * speed;
    assert!((pressure * moment / (WEIGHT * 0.25)).abs() < 1e-8);
    assert!((glide.ratio - lift / drag).abs() < 1e-7 * glide.ratio);
    let sink = speed * angle.sin();
    assert!((glide.power + WEIGHT * sink).abs() < 1e-8 * glide.power);
    assert!(power_of_trim(found).unwrap().peak.abs() < 1e-12);
}

#[test]
fn exact_a_glide_is_that_of_lift_over_drag_at_its_incidence() {
    // Found from the release of the case, and from a guess by the area where it is at rest.
    for set in [&[][..], &["flight.velocity_m_s=[0,0,0]"]] {
        let case = case(GLIDER, set);
        check_by_hand(&trimmed(&case, [0.0; 2], None), 0.0);
    }
    // In a stream the way through the air is the same.
    let blown = case(GLIDER, &["air.stream_m_s=[-2, 0, -1]"]);
    let found = trimmed(&blown, [0.0; 2], None);
    check_by_hand(&found, 0.0);
    let still = trimmed(&case(GLIDER, &[]), [0.0; 2], None);
    let apart = found.velocity - still.velocity - DVec3::new(-2.0, 0.0, -1.0);
    assert!(apart.length() < 1e-7, "{apart}");
}

#[test]
fn exact_the_elevator_for_a_speed_is_that_of_the_balance_of_moments() {
    let case = case(GLIDER, &[]);
    for forward in [6.0, 8.0, 11.0] {
        let found = trimmed(&case, [forward, 0.0], None);
        assert!((found.velocity.x - forward).abs() < 1e-12);
        let tail = found.solution.value(Unknown::TailIncidence).unwrap();
        check_by_hand(&found, tail);
        let text = trimmed_case(&case, &found).unwrap();
        let written = LoadedCase::from_text("glider", &text, Path::new(""), &[]).unwrap();
        assert_eq!(written.setup.time, case.setup.time);
        for wing in &written.setup.animal.wings {
            let psi = wing.motion.angles(0.0)[2][0];
            let own = if wing.name.ends_with("tail") {
                tail
            } else {
                4f64.to_radians()
            };
            assert!((psi - own).abs() < 1e-12, "{}", wing.name);
        }
        check_by_hand(&trimmed(&written, [0.0; 2], None), tail);
    }
}

/// Lanchester's phugoid keeps its angle of attack: heavy flyers, whose paths are wide beside the arm of the tail, come
/// near it by g l / U^2. Of a glide at the angle e the rates of speed and path have the determinant 2 (g / U)^2 and the
/// trace -3 g sin e / U [Lanchester 1908; Etkin & Reid 1996, sec. 6.3].
#[test]
fn limit_heavy_gliders_have_the_phugoid_of_lanchester() {
    let errors = [0.3, 1.2, 4.8].map(|mass| {
        let set = [
            &format!("body.mass_kg={mass}"),
            "air.blade.own.drag_0=0.01",
            "wing.right.hinge_m=[-0.03, 0, 0]",
            "wing.right_tail.motion.psi.constant_deg=-6",
            "flight.velocity_m_s=[0, 0, 0]",
        ];
        let found = trimmed(&case(GLIDER, &set), [0.0; 2], None);
        let glide = found.glide().unwrap().unwrap();
        let modes = floquet_of_trim(&found).unwrap();
        let mode = modes.find(Plane::Longitudinal, "stable phugoid").unwrap();
        let rate = 9.81 / glide.airspeed;
        let frequency = mode.growth.hypot(mode.frequency) / (2f64.sqrt() * rate);
        let growth = mode.growth / (-1.5 * rate * glide.angle.sin());
        [frequency - 1.0, growth - 1.0]
    });
    // At 74 m/s, with an arm of 0.25 m.
    let [frequency, growth] = errors[2];
    assert!(frequency.abs() < 3e-3 && growth.abs() < 8e-3, "{errors:?}");
    for pair in errors.windows(2) {
        for (before, now) in pair[0].iter().zip(pair[1]) {
            assert!((now / before - 0.25).abs() < 0.02, "{errors:?}");
        }
    }
}

#[test]
fn agrees_modes_of_a_glide_with_those_of_wings_that_hardly_beat() {
    let still = trimmed(&case(GLIDER, &[]), [0.0; 2], None);
    let beating = GLIDER
        .replace(
            "{ step_s = 2e-3, steps = 500 }",
            "{ steps_per_beat = 50, beats = 10 }\nmotion.frequency_hz = 10",
        )
        .replace(
            "motion.psi.constant_deg = 4",
            "motion.psi.constant_deg = 4\nmotion.phi.fourier.sine_deg = [1e-4]",
        );
    let unknowns = vec![Unknown::BodyPitch, Unknown::Forward, Unknown::Climb];
    let beating = trimmed(&case(&beating, &[]), [0.0; 2], Some(unknowns));
    assert!((still.velocity - beating.velocity).length() < 1e-6);
    for [a, b] in [
        [&still, &beating].map(|t| floquet_of_trim(t).unwrap()),
        [&still, &beating].map(|t| linear_model(&t.beat, &t.state).unwrap().modes),
    ] {
        for name in ["stable phugoid", "stable short period"] {
            let [a, b] = [&a, &b].map(|m| m.find(Plane::Longitudinal, name).unwrap());
            let apart = (a.growth - b.growth).hypot(a.frequency - b.frequency);
            // Differences of the maps over 0.04 s and 0.1 s.
            assert!(
                apart < 3e-7 * a.growth.hypot(a.frequency),
                "{name}: {apart:e}"
            );
        }
    }
}

/// The polar of a sweep is that of single trims; sink is least below the speed of the flattest glide.
#[test]
fn agrees_sweeps_of_a_glider_with_single_trims() {
    let case = case(GLIDER, &["flight.pitch_deg=2"]);
    let request = TrimRequest {
        velocity: DVec3::new(6.0, 0.0, 0.0),
        ..TrimRequest::default()
    };
    let problem = request.problem(&case.setup).unwrap();
    let at = |k: usize| DVec3::new(3.8 + 0.2 * k as f64, 0.0, problem.velocity.z);
    let speeds: Vec<DVec3> = (0..12).map(at).collect();
    let found = sweep(&case.setup, &problem, &speeds).unwrap();
    assert_eq!(found.flights.len(), 12, "{:?}", found.lost);
    for flight in &found.flights {
        let single = trimmed(&case, [flight.velocity.x, 0.0], None);
        // Residuals of 1e-9 of either.
        let apart = (flight.velocity - single.velocity).length();
        assert!(apart < 1e-6, "{apart:e} at {}", flight.velocity);
    }
    let [sink, flat] = [found.least_sink(), found.flattest()].map(|f| f.unwrap().velocity.x);
    assert!(sink < flat, "{sink} {flat}");
}

#[test]
fn refuses_what_a_glide_has_not() {
    let case = case(GLIDER, &[]);
    let unknowns = vec![Unknown::BodyPitch, Unknown::Forward, Unknown::Climb];
    let found = trimmed(&case, [0.0; 2], Some(unknowns));
    let said = Regulator::new(&found, &Weights::default(), 1).unwrap_err();
    assert!(said.to_string().contains("no wing beats"), "{said}");
    let request = TrimRequest::default();
    let problem = request.problem(&case.setup).unwrap();
    let said = sweep(&case.setup, &problem, &[DVec3::X]).unwrap_err();
    assert!(said.to_string().contains("`forward` is among"), "{said}");
    // Gravity off n3 is named by its angle.
    let mut across = case.setup.clone();
    across.gravity = DVec3::new(9.81, 0.0, 0.0);
    let said = trim(&across, &problem).unwrap_err().to_string();
    assert!(said.contains("gravity points 90 degrees off n3"), "{said}");
    across.gravity = DVec3::new(0.0, 0.0, -9.81);
    let said = trim(&across, &problem).unwrap_err().to_string();
    assert!(said.contains("gravity points 180 degrees off n3"), "{said}");
    across.gravity = DVec3::new(0.0, 3.0, 9.3);
    let said = trim(&across, &problem).unwrap_err().to_string();
    assert!(
        said.contains("let wind and gravity lie in the plane"),
        "{said}"
    );
}

/// Span and body along n1 and n2 are where angles of wings and body lose two of their digits' meaning, and no attitude.
#[test]
fn invariant_recorded_angles_have_the_attitudes_at_any_heading() {
    let headed = |set: &[&str]| common::fly(case(GLIDER, set).setup);
    let north = headed(&[
        "time.steps=100",
        "wing.right_tail.motion.psi.constant_deg=8",
    ]);
    let east = headed(&[
        "time.steps=100",
        "wing.right_tail.motion.psi.constant_deg=8",
        "flight.yaw_deg=90",
        "flight.velocity_m_s=[0, 6, 0.7]",
    ]);
    let attitude = |r: &Record, body: usize| {
        let eta = DVec3::from_slice(&r.coordinates[6 * body + 3..]);
        match body {
            0 => EulerSequence::BODY_231.rotation(eta),
            _ => EulerSequence::WING_132.rotation(eta),
        }
    };
    let turned = DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z);
    for (n, e) in north.iter().zip(&east) {
        for body in 0..5 {
            let apart = turned * attitude(n, body) - attitude(e, body);
            assert!(apart.abs_diff_eq(DMat3::ZERO, 1e-6), "{apart}");
        }
    }
    let pitch = |r: &Record| attitude(r, 0).x_axis.z;
    assert!((pitch(&north[100]) - pitch(&north[0])).abs() > 0.3);
}

/// The table of a glide beats as little as the glide does, and has its modes; that of massless wings, which it has not,
/// can be loaded.
#[test]
fn agrees_tables_of_flyers_without_beats_or_massive_wings_with_their_models() {
    let table = |case: &LoadedCase, found: &Trim| {
        let model = linear_model(&found.beat, &found.state).unwrap();
        let text = derivative_case(case, &SteadyFlight::of(found).unwrap(), &model);
        let table = common::load(&text, &[]).unwrap_or_else(|e| panic!("{e}"));
        let modes = table_model(&table.setup).unwrap().modes;
        let kinds = [
            (Plane::Longitudinal, "stable phugoid"),
            (Plane::Longitudinal, "stable short period"),
        ];
        for (plane, kind) in kinds {
            let [a, b] = [&model.modes, &modes].map(|all| all.find(plane, kind).unwrap());
            let apart = (a.growth - b.growth).hypot(a.frequency - b.frequency);
            let size = a.growth.hypot(a.frequency);
            println!("{kind}: {:e}", apart / size);
            assert!(apart < 1e-9 * size, "{kind}: {apart:e} of {size:e}"); // differences in other units
        }
        table
    };
    let glider = case(GLIDER, &[]);
    let of_glide = table(&glider, &trimmed(&glider, [0.0; 2], None));
    assert_eq!(of_glide.setup.time.period, None);
    assert_eq!(of_glide.idle_keys(), Vec::<String>::new());
    let massless = case(GLIDER, &["dynamics.wings=massless"]);
    table(&massless, &trimmed(&massless, [0.0; 2], None));
}
