//! Gliders in air with a memory: the vortex lattice, strips with wakes, and wings that bend.

use std::path::Path;
use std::sync::LazyLock;

use wingbeat_analysis::wake::{
    WakeMemory, WakeSettings, WakeTrim, elastic_floquet, steady_controls, steady_flight,
    steady_inputs, steady_model, trim_with_wake, wake_floquet,
};
use wingbeat_analysis::{Plane, Trim, TrimRequest, Unknown, power_with_wake, table_model, trim};
use wingbeat_case::{LoadedCase, derivative_case, wake_trimmed_case};
use wingbeat_flight::{MotionMode, PrescribedMotion, Record, Simulation};
use wingbeat_math::DVec3;

/// A glider of joined wings and a tail above their wake, on a body whose mass centre is at its origin.
const LATTICE: &str = r#"
format = 1
name = "glider"
time = { step_s = 0.012, steps = 20 }
flight = { velocity_m_s = [6, 0, 0.5] }
body = { mass_kg = 0.03, inertia_about_centre_kg_m2 = [1e-4, 3e-4, 3.5e-4, 0, 0, 0] }
[air]
body = false
density_kg_m3 = 1.225
shed = ["trailing"]
section_drag = { friction = "none", cd0 = 0.02 }
[wing.right]
hinge_m = [0.02, 0, 0]
joined = true
mass_kg = 0
motion.psi.constant_deg = 4
motion.phi.constant_deg = 0
planform.outline = { leading_m = [[0, 0], [0.25, 0]], trailing_m = [[0, -0.08], [0.25, -0.08]] }
mesh = { chordwise = 1, spanwise = 3 }
[wing.right_tail]
hinge_m = [-0.25, 0, -0.06]
joined = true
mass_kg = 0
motion.psi.constant_deg = 0
motion.phi.constant_deg = 0
planform.outline = { leading_m = [[0, 0], [0.1, 0]], trailing_m = [[0, -0.05], [0.1, -0.05]] }
mesh = { chordwise = 1, spanwise = 1 }
"#;

fn case(text: &str, set: &[&str]) -> LoadedCase {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    LoadedCase::from_text("glider", text, Path::new(""), &set).unwrap_or_else(|e| panic!("{e}"))
}

/// Wings without a tail, with the cores of induced drag.
const FLYING_WING: &str = r#"
format = 1
name = "wing"
time = { step_s = 9e-3, steps = 40 }
flight = { velocity_m_s = [6, 0, 0.3] }
body = { mass_kg = 0.03, inertia_about_centre_kg_m2 = [1e-4, 3e-4, 3.5e-4, 0, 0, 0] }
[air]
body = false
density_kg_m3 = 1.225
shed = ["trailing"]
wake_core = { algebraic = { radius_chords = 0.01 } }
bound_core = { algebraic = { radius_chords = 0.01 } }
wake_overlap_slope = 0.03
section_drag = { friction = "none", cd0 = 0.01 }
[wing.right]
hinge_m = [0.015, 0, 0]
joined = true
mass_kg = 0
motion.phi.constant_deg = 0
planform.outline = { leading_m = [[0, 0], [0.25, 0]], trailing_m = [[0, -0.08], [0.25, -0.08]] }
mesh = { chordwise = 2, spanwise = 6, spanwise_spacing = "cosine" }
"#;

/// A glider of wings and a tail in blade elements.
const BLADES: &str = r#"
format = 1
name = "glider"
time = { step_s = 2e-3, steps = 100 }
flight = { velocity_m_s = [7, 0, 1.3] }
air.model = "blade_element"
air.density_kg_m3 = 1.225
air.blade.centre_of_pressure.fixed = 0.25
air.blade.own = { lift = 2.2, drag_0 = 0.03, drag_90 = 2.0 }
body = { mass_kg = 0.03, centre_m = [0, 0, 0], inertia_about_centre_kg_m2 = [1e-4, 3e-4, 3.5e-4, 0, 0, 0] }
[wing.right]
hinge_m = [2e-3, 0, 0]
mass_kg = 3e-3
planform.outline = { leading_m = [[0, 0], [0.25, 0]], trailing_m = [[0, -0.08], [0.25, -0.08]] }
mesh = { chordwise = 1, spanwise = 10 }
motion.psi.constant_deg = 4
[wing.right_tail]
hinge_m = [-0.25, 0, 0]
mass_kg = 1e-11
planform.outline = { leading_m = [[0, 0], [0.1, 0]], trailing_m = [[0, -0.05], [0.1, -0.05]] }
mesh = { chordwise = 1, spanwise = 4 }
motion.psi.constant_deg = 0
"#;

/// The glide at this speed forward [m/s], 0 not being given, by `unknowns` or the usual ones.
fn glide(
    case: &LoadedCase,
    forward: f64,
    unknowns: Option<Vec<Unknown>>,
    tolerance: f64,
) -> WakeTrim {
    let request = TrimRequest {
        velocity: DVec3::new(forward, 0.0, 0.0),
        unknowns,
        ..TrimRequest::default()
    };
    let problem = request.problem(&case.setup).unwrap();
    let settings = WakeSettings {
        tolerance,
        ..WakeSettings::of(&case.setup)
    };
    let found = trim_with_wake(&case.setup, &problem, &settings).unwrap_or_else(|e| panic!("{e}"));
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    found
}

static GLIDE: LazyLock<WakeTrim> = LazyLock::new(|| glide(&case(LATTICE, &[]), 0.0, None, 1e-7));

/// What is seen at the end of a tethered flight of the trimmed flyer along its glide.
fn tethered(trim: &WakeTrim) -> Record {
    let mut setup = trim.setup.clone();
    let angles = DVec3::new(trim.solution.body_pitch, 0.0, 0.0);
    setup.mode = MotionMode::Tethered(PrescribedMotion::straight(
        DVec3::ZERO,
        trim.velocity,
        angles,
    ));
    setup.time.steps = trim.start().held_steps;
    last(setup)
}

fn last(setup: wingbeat_flight::FlightSetup) -> Record {
    let mut flight = Simulation::new(setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    flight.record().clone()
}

#[test]
fn balances_a_glide_in_the_lattice_has_the_lift_and_drag_of_a_tethered_flight() {
    let trim = &*GLIDE;
    let record = tethered(trim);
    let (force, along) = (record.air_force(), trim.velocity.normalize());
    let drag = -force.dot(along);
    let lift = (force + drag * along).length();
    let glide = trim.glide().unwrap();
    // Residuals of 1e-7, over a drag of a twelfth of the weight.
    assert!(
        (glide.angle - (drag / lift).atan()).abs() < 2e-7,
        "{glide:?}"
    );
    assert!((glide.ratio - lift / drag).abs() < 5e-6 * glide.ratio);
    assert!((force + 0.03 * trim.setup.gravity).length() < 2e-7 * 0.03 * 9.81);
    assert!(power_with_wake(trim).unwrap().peak.abs() < 1e-9 * glide.power);
    let tow = trim.tow.unwrap();
    assert!(tow.change < 1e-3 && tow.chords > 40.0, "{tow:?}");
}

/// The wake goes on growing after the release: what its start makes at the end of the tow, a third of the change over the
/// last half of it, is the acceleration over gravity.
#[test]
fn agrees_the_written_case_of_a_glide_in_the_lattice_with_its_glide() {
    let trim = &*GLIDE;
    let text = wake_trimmed_case(&case(LATTICE, &[]), trim);
    let written = case(&text, &[]);
    let start = trim.start();
    let MotionMode::Free(own) = &written.setup.mode else {
        panic!("{text}");
    };
    assert_eq!(own.held_steps, start.held_steps);
    assert_eq!(written.setup.time.steps, start.held_steps + 20);
    let end = last(written.setup.clone());
    let off = (end.momentum / 0.03 - trim.velocity).length();
    let flown = 20.0 * written.setup.time.step;
    let bound = 9.81 * trim.tow.unwrap().change / 3.0 * flown;
    assert!(off < bound && off > 1e-3 * bound, "{off:e} {bound:e}");
    // As it is written it is trimmed.
    let again = glide(&written, 0.0, None, 1e-6);
    assert!((again.velocity - trim.velocity).length() < 1e-4);
}

/// The elevator of two trims a little apart: what it does to the pitching moment and the forces is what pitch and
/// velocity do to them, by the derivatives of steady tows.
#[test]
fn agrees_control_derivatives_of_a_glider_in_the_lattice_with_the_difference_of_two_trims() {
    let trim = &*GLIDE;
    let [slow, fast] = [-0.02, 0.02].map(|by| {
        let speed = trim.velocity.x + by;
        glide(&case(LATTICE, &[]), speed, None, 1e-7)
    });
    let tail = |t: &WakeTrim| {
        let mut found = t.solution.unknowns.iter().zip(&t.solution.values);
        *found
            .find(|(u, _)| **u == Unknown::TailIncidence)
            .unwrap()
            .1
    };
    let by = tail(&fast) - tail(&slow);
    let model = steady_model(trim).unwrap();
    let controls = steady_controls(trim).unwrap();
    let b = steady_inputs(trim, &controls).unwrap();
    let elevator = |wing: &str| {
        let found = controls.iter();
        let mut found = found.enumerate();
        found
            .find(|(_, d)| d.control == "feathering_offset" && d.wing == wing)
            .unwrap()
            .0
    };
    let of_tail = ["right_tail", "left_tail"].map(elevator);
    // Velocity in axes that turn with the pitch, and the pitch itself.
    let pitch = fast.solution.body_pitch - slow.solution.body_pitch;
    let v = fast.velocity - slow.velocity - pitch * DVec3::Y.cross(trim.velocity);
    let state = [v.x, v.y, v.z, 0.0, 0.0, 0.0, 0.0, pitch, 0.0];
    // 0.4e-4 to 2.5e-4 measured: second order in the difference of the trims.
    for row in [0, 2, 4] {
        let own: f64 = (0..9).map(|k| model.matrix[9 * row + k] * state[k]).sum();
        let steered: f64 = of_tail
            .map(|k| b[controls.len() * row + k] * by)
            .iter()
            .sum();
        println!("{row}: {own:e} {steered:e}");
        assert!(
            (steered / -own - 1.0).abs() < 2e-3,
            "{row}: {own:e} {steered:e}"
        );
    }
    // Wings that are steered one by one do together what they do at once, right and left the same.
    let at = |wing: &str| &controls[elevator(wing)].derivative;
    let names = ["right", "left", "right_tail", "left_tail"];
    let sum: DVec3 = names.map(|n| at(n).force).iter().sum();
    assert!((sum - at("all").force).length() < 1e-3 * sum.length());
    assert!((at("right_tail").moment.y / at("left_tail").moment.y - 1.0).abs() < 1e-6);
    // Written as a table of derivatives, the model has the same modes.
    let text = derivative_case(&case(LATTICE, &[]), &steady_flight(trim).unwrap(), &model);
    let table = table_model(&case(&text, &[]).setup).unwrap();
    for name in ["stable phugoid", "stable short period"] {
        let [a, b] =
            [&model.modes, &table.modes].map(|m| m.find(Plane::Longitudinal, name).unwrap());
        let apart = (a.growth - b.growth).hypot(a.frequency - b.frequency);
        // The residuals of the trim, 1e-7, and what is left of the start of the wake.
        assert!(apart < 1e-3 * a.growth.hypot(a.frequency), "{a:?} {b:?}");
    }
}

/// A vortex across the span b at the distance L is felt by (b / L)^2.
#[test]
fn order_the_start_of_the_wake_is_felt_by_the_square_of_the_way() {
    let case = case(LATTICE, &[]);
    let mut problem = TrimRequest::default().problem(&case.setup).unwrap();
    (problem.velocity, problem.body_pitch) = (GLIDE.velocity, GLIDE.solution.body_pitch);
    let change = |held_beats: usize| {
        let settings = WakeSettings {
            held_beats,
            iterations: 0,
            ..WakeSettings::of(&case.setup)
        };
        let found = trim_with_wake(&case.setup, &problem, &settings).unwrap();
        found.tow.unwrap().change
    };
    let [near, far] = [change(16), change(32)];
    assert!((3.4..4.6).contains(&(near / far)), "{near:e} {far:e}");
}

/// Rectangular wings of the aspect ratio 6.25 about their quarter chord: induced drag and lift slope of the lifting line
/// [Glauert 1926, ch. 11: delta 0.05, tau 0.17], of which surfaces of that ratio have some 7 % less slope.
#[test]
fn limit_a_flying_wing_glides_as_the_lifting_line_has_it() {
    let unknowns = vec![Unknown::BodyPitch, Unknown::Climb, Unknown::MassCentre];
    let trim = glide(&case(FLYING_WING, &[]), 6.0, Some(unknowns), 1e-5);
    let glide = trim.glide().unwrap();
    let pressure = 0.5 * 1.225 * glide.airspeed.powi(2);
    let lift = 0.03 * 9.81 * glide.angle.cos() / (pressure * 0.04);
    let ratio = 0.5 / 0.08;
    let line = std::f64::consts::PI * ratio;
    let induced = glide.angle.tan() * lift - 0.01;
    assert!(
        (induced / (1.05 * lift * lift / line) - 1.0).abs() < 0.03,
        "{induced}"
    );
    let incidence = trim.solution.body_pitch + glide.angle;
    let slope = 2.0 * std::f64::consts::PI / (1.0 + 2.0 * 1.17 / ratio);
    let found = lift / incidence / slope;
    assert!((0.9..1.0).contains(&found), "{found}");
    // The lift of a flat wing acts at a quarter of its chord, as far as it is high beside its span.
    let behind = (0.015 - trim.solution.mass_centre - 0.02) / 0.08;
    assert!(behind.abs() < 0.02, "{behind}");
    let neutral = steady_model(&trim).unwrap().neutral_point();
    assert!(neutral.abs() < 0.01 * 0.08, "{neutral}");
}

/// Wings far behind the mass centre: to them pitching is a velocity along their normal, at three quarters of the chord,
/// and their lift acts at a quarter.
#[test]
fn limit_derivatives_of_wings_far_behind_are_those_of_their_distance() {
    let far = [
        "wing.right.hinge_m=[-0.8, 0, 0]",
        "wing.right.mesh.spanwise=4",
    ];
    let case = case(FLYING_WING, &far);
    let mut problem = TrimRequest::default().problem(&case.setup).unwrap();
    (problem.velocity, problem.body_pitch) = (DVec3::new(6.0, 0.0, 0.0), 0.0);
    let settings = WakeSettings {
        held_beats: 8,
        iterations: 0,
        ..WakeSettings::of(&case.setup)
    };
    let d = steady_model(&trim_with_wake(&case.setup, &problem, &settings).unwrap())
        .unwrap()
        .derivatives;
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 0.01, "{a} {b}");
    near(d[4][2] / d[2][2], 0.82);
    near(d[2][4] / d[2][2], 0.86);
    near(d[4][4] / d[2][4], 0.82);
}

/// The phugoid of a heavy glider is Lanchester's but for an arm of the tail over the radius of its path.
#[test]
fn limit_a_heavy_glider_in_the_lattice_has_the_phugoid_of_lanchester() {
    let set = [
        "body.mass_kg=1.2",
        "time.step_s=4e-3",
        "flight.velocity_m_s=[36, 0, 3]",
    ];
    let trim = glide(&case(LATTICE, &set), 0.0, None, 1e-5);
    let glide = trim.glide().unwrap();
    let rate = 9.81 / glide.airspeed;
    let steady = steady_model(&trim).unwrap().modes;
    let carried = wake_floquet(&trim, WakeMemory::Carried).unwrap();
    for modes in [&steady, &carried] {
        let mode = modes.find(Plane::Longitudinal, "stable phugoid").unwrap();
        let frequency = mode.growth.hypot(mode.frequency) / (2f64.sqrt() * rate);
        println!("{frequency}");
        assert!((frequency - 1.0).abs() < 0.02, "{frequency}");
    }
}

/// A wake of plane flow is no longer felt at constant incidence: what is left is the quasi-steady law.
#[test]
fn exact_wakes_of_strips_leave_the_glide_as_it_is() {
    let plain = case(BLADES, &[]);
    let request = TrimRequest::default();
    let quasi_steady: Trim = trim(&plain.setup, &request.problem(&plain.setup).unwrap()).unwrap();
    assert!(quasi_steady.solution.converged);
    for unsteady in ["jones", "peters"] {
        let with = case(BLADES, &[&format!("air.blade.unsteady=\"{unsteady}\"")]);
        let found = glide(&with, 0.0, None, 1e-9);
        let apart = (found.velocity - quasi_steady.velocity).length();
        // Residuals of 1e-9.
        assert!(apart < 1e-7, "{apart:e}");
        let turned = found.solution.body_pitch - quasi_steady.solution.body_pitch;
        assert!(turned.abs() < 1e-8, "{turned:e}");
        let modes = elastic_floquet(&found, 0).unwrap();
        let own = wingbeat_analysis::floquet_of_trim(&quasi_steady).unwrap();
        let [a, b] = [&modes, &own].map(|m| m.find(Plane::Longitudinal, "stable phugoid").unwrap());
        // Slow beside the wakes: 1.5 rad/s by a half chord over the speed is 0.008.
        assert!(
            (a.frequency / b.frequency - 1.0).abs() < 0.01,
            "{a:?} {b:?}"
        );
        // Written, it is towed until the wakes are there.
        let written = case(&wake_trimmed_case(&with, &found), &[]);
        let end = last(written.setup.clone());
        let mass = written.setup.animal.mass();
        assert!((end.momentum / mass - found.velocity).length() < 1e-6);
    }
}

/// A beam on its own of the flap and torsion stiffness [N m2] of wings about mid chord.
fn beam(flap: f64, torsion: f64) -> String {
    format!(
        "wing.right.structure={{damping_s=2e-3, beam={{flap_newton_m2=[{flap},{flap}], torsion_newton_m2=[{torsion},{torsion}], axis_fraction=0.5, mass_fraction=0.5}}}}"
    )
}

/// The lift at a quarter of the chord twists a wing about its middle: of a clamped wing of the length L the tip has the
/// incidence of the root over cos(k L), `k^2 = q c e C' / GJ`, until it diverges at k L = pi / 2.
#[test]
fn exact_the_twist_of_a_glider_is_that_before_divergence() {
    let found = glide(&case(BLADES, &[&beam(100.0, 0.06)]), 0.0, None, 1e-8);
    let flight = Simulation::after(found.setup.clone(), &found.past).unwrap();
    let twist = flight.record().elastic[0].twist;
    let path = found.glide().unwrap();
    let root = found.solution.body_pitch + 4f64.to_radians() + path.angle;
    let pressure = 0.5 * 1.225 * path.airspeed.powi(2);
    let k = (pressure * 0.08 * 0.02 * (4.4 + 0.03) / 0.06).sqrt();
    let expected = root * (1.0 / (0.25 * k).cos() - 1.0);
    // The sines of the law at 3.8 deg, and ten elements.
    assert!((twist / expected - 1.0).abs() < 0.01, "{twist} {expected}");
}

#[test]
fn limit_stiff_wings_glide_as_rigid_ones() {
    let coarse = "wing.right.mesh.spanwise=5";
    let rigid = case(BLADES, &[coarse]);
    let rigid = trim(
        &rigid.setup,
        &TrimRequest::default().problem(&rigid.setup).unwrap(),
    )
    .unwrap();
    let off = |stiffness: f64| {
        let found = glide(
            &case(BLADES, &[coarse, &beam(stiffness, stiffness)]),
            0.0,
            None,
            1e-9,
        );
        (found.velocity - rigid.velocity).length()
    };
    let [soft, stiff] = [off(2.0), off(20.0)];
    assert!((9.0..11.0).contains(&(soft / stiff)), "{soft:e} {stiff:e}");
}

#[test]
fn refuses_joints_of_a_glider_that_move_freely() {
    let joint = r#"
[joint.hinge]
child = "right_tail"
at_m = [-0.25, 0, -0.06]
kind = "revolute"
axis = [0, 1, 0]
"#;
    let setup = case(&format!("{LATTICE}{joint}"), &[]).setup;
    let problem = TrimRequest::default().problem(&setup).unwrap();
    let said = trim_with_wake(&setup, &problem, &WakeSettings::of(&setup)).unwrap_err();
    assert!(said.to_string().contains("a glider has joints"), "{said}");
}

/// On a tow wings that bend do not vibrate with the body, in the flight that follows they do.
#[test]
fn refuses_a_glide_by_an_integrator_by_which_its_flight_is_refused() {
    let set = [
        "wing.right.mass_kg=1e-4",
        &beam(100.0, 0.06),
        "dynamics.integrator=\"hamming\"",
    ];
    let setup = case(LATTICE, &set).setup;
    let problem = TrimRequest::default().problem(&setup).unwrap();
    let said = trim_with_wake(&setup, &problem, &WakeSettings::of(&setup)).unwrap_err();
    let Err(flown) = Simulation::new(setup) else {
        panic!("it flies")
    };
    assert!(said.to_string().contains("take bdf"), "{said}");
    assert_eq!(said.to_string(), flown.to_string());
}

/// Holds are counted in wingbeats where there are any.
#[test]
fn refuses_holds_in_seconds_of_wings_that_beat() {
    let load = |name: &str, set: &str| LoadedCase::find(name, &[set.to_owned()]).map(|_| ());
    let said = load("fruit-fly-hover", "flight.held_s=1").unwrap_err();
    assert!(said.to_string().contains("flight.held_s"), "{said}");
    let text = |set: &str| {
        let set = [set.to_owned()];
        LoadedCase::from_text("g", LATTICE, Path::new(""), &set).map(|case| case.setup.mode)
    };
    let said = text("flight.held_s=1e-3").unwrap_err().to_string();
    assert!(said.contains("shorter than half a step"), "{said}");
    let said = text("flight.held_beats=1").unwrap_err().to_string();
    assert!(said.contains("flight.held_s, in seconds"), "{said}");
    let MotionMode::Free(start) = text("flight.held_s=0.12").unwrap() else {
        panic!("it flies freely");
    };
    assert_eq!(start.held_steps, 10);
}
