//! Joints and bodies that turn all the way round, and tethers that turn and move them.

use std::path::Path;

use crate::common::{self, go_on};
use wingbeat_case::LoadedCase;
use wingbeat_flight::{FlightError, FlightSetup, MotionMode, PrescribedMotion, Record, Simulation};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::Start;

/// A vane on a heavy body in vacuum that makes about two turns.
const VANE: &str = "format = 1
gravity_m_s2 = [0, 0, 0]
[time]
step_s = 1e-3
steps = 200
[flight]
mode = \"free\"
[air]
model = \"none\"
[body]
mass_kg = 1.0
inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]
[wing.right]
hinge_m = [0, 0, 0]
mirror = false
mass_kg = 5e-5
[wing.right.planform.rectangle]
chord_m = 0.01
span_m = 0.05
axis_fraction = 0.5
[wing.right.mesh]
chordwise = 1
spanwise = 10
[wing.right.motion]
psi.constant_deg = 0
";

const FREE: &str =
    "joint.h={ child = \"right\", kind = \"revolute\", axis = [1, 0, 0], start_deg_s = [4000] }";
const SPRUNG: &str = "joint.h={ child = \"right\", kind = \"revolute\", axis = [1, 0, 0], start_deg_s = [4000], element = [{ stiffness_newton_m_per_rad = 1e-6 }] }";
const QUATERNION: &str = "dynamics.formulation=quaternion";

fn setup(set: &[&str]) -> FlightSetup {
    let case = common::load(VANE, set);
    case.unwrap_or_else(|e| panic!("{e}")).setup
}

fn flown(set: &[&str]) -> Result<Vec<Record>, FlightError> {
    go_on(&mut Simulation::new(setup(set)).unwrap())
}

/// Largest step of the angle of the joint, and its last value \[deg\].
fn steps(records: &[Record]) -> [f64; 2] {
    let angle = |r: &Record| r.joints[0][0].to_degrees();
    let step = |pair: &[Record]| (angle(&pair[1]) - angle(&pair[0])).abs();
    let largest = records.windows(2).map(step).fold(0.0, f64::max);
    [largest, angle(records.last().unwrap())]
}

#[test]
fn refuses_oscillations_of_joints_at_no_frequency() {
    let kind = "child = \"right\", kind = \"revolute\", axis = [1, 0, 0]";
    for (key, law) in [
        ("travel", "travel = { sine_m = [[0, 0, 1e-3]] }"),
        (
            "element[0].moment_newton_m",
            "element = [{ moment_newton_m = { mean = 1e-6, cosine = [1e-6] } }]",
        ),
        (
            "element[0].follow.angle_deg",
            "element = [{ follow = { angle_deg = { sine = [9], frequency_hz = 0 }, stiffness_newton_m_per_rad = 1, damping_newton_m_s_per_rad = 0 } }]",
        ),
    ] {
        let set = [format!("joint.h={{ {kind}, {law} }}")];
        let said = LoadedCase::from_text("vane", VANE, Path::new(""), &set).unwrap_err();
        let said = said.to_string();
        let words = "its sines and cosines stand still at a frequency of 0";
        assert!(
            said.contains(words) && said.contains(&format!("joint.h.{key}")),
            "{said}"
        );
    }
}

#[test]
fn exact_angles_of_joints_go_on_past_half_a_turn() {
    let records = flown(&[SPRUNG]).unwrap();
    let [step, end] = steps(&records);
    assert!(step < 4.1 && end > 540.0, "{step} {end}"); // 4000 deg/s in steps of a millisecond
    // The spring counts the turns: its energy comes from the motion.
    let kinetic = records[0].kinetic_energy;
    let last = records.last().unwrap();
    let stored = 0.5e-6 * last.joints[0][0].powi(2);
    assert!((last.kinetic_energy + stored - kinetic).abs() < 1e-9 * kinetic);
    assert!(stored > 0.01 * kinetic);
    // A free vane turns alike in both formulations.
    let ends = [&[FREE][..], &[FREE, QUATERNION]].map(|set| steps(&flown(set).unwrap()));
    assert!((ends[0][1] - ends[1][1]).abs() < 1e-5, "{ends:?}"); // tolerance of the steps
    assert!(ends[1][1] > 700.0, "{ends:?}");
}

#[test]
fn exact_angles_of_joints_go_on_in_resumed_flights() {
    let setup = setup(&[SPRUNG]);
    let mut whole = Simulation::new(setup.clone()).unwrap();
    let mut states = vec![];
    while !whole.finished() {
        states.push(whole.state().clone());
        whole.step().unwrap();
    }
    let mut again = Simulation::resume(setup, states.swap_remove(100)).unwrap();
    let end = go_on(&mut again).unwrap().pop().unwrap();
    assert_eq!(end.joints, whole.record().joints);
}

#[test]
fn refuses_springs_past_half_a_turn_where_turns_are_not_counted() {
    for set in [&[SPRUNG, QUATERNION][..], &[SPRUNG, "flight.mode=tethered"]] {
        let error = flown(set).map(|_| ()).unwrap_err();
        assert!(
            matches!(&error, FlightError::TurnedPast { joint, .. } if joint == "h"),
            "{error}"
        );
    }
}

/// A spring of stiffness 0 pulls at no angle: it flies past half a turn as without it.
#[test]
fn agrees_joints_with_springs_of_no_stiffness_with_those_without() {
    let idle = SPRUNG.replace("1e-6", "0.0");
    let [idle, free] =
        [[&idle[..], QUATERNION], [FREE, QUATERNION]].map(|set| flown(&set).unwrap());
    assert_eq!(idle.last().unwrap().joints, free.last().unwrap().joints);
}

/// The rotation vector of a ball joint goes over into the opposite one at half a turn, and moments of springs with it.
#[test]
fn refuses_springs_of_spherical_joints_past_half_a_turn() {
    let ball = |acts: &str| {
        format!(
            "joint.h={{ child = \"right\", kind = \"spherical\", start_deg_s = [4000], element = [{{ {acts} }}] }}"
        )
    };
    let spring = ball("stiffness_newton_m_per_rad = 1e-6");
    for mode in ["flight.mode=free", "flight.mode=tethered"] {
        let error = flown(&[&spring, mode]).map(|_| ()).unwrap_err();
        let time = match &error {
            FlightError::TurnedPast { joint, time } if joint == "h" => *time,
            _ => panic!("{error}"),
        };
        // Half a turn at 4000 deg/s, which the spring hardly slows down.
        assert!((0.045..0.047).contains(&time), "{time}");
    }
    // A damper asks for no angle.
    flown(&[&ball("damping_newton_m_s_per_rad = 1e-12")]).unwrap();
    let far = "joint.h={ child = \"right\", kind = \"spherical\", start_deg = [0, 200, 0] }";
    let error = LoadedCase::from_text("vane", VANE, Path::new(""), &[far.to_owned()]);
    let text = error.map(|_| ()).unwrap_err().to_string();
    assert!(
        text.contains("joint.h.start_deg") && text.contains("160"),
        "{text}"
    );
}

/// A body that only yaws, beyond half a turn and back, is said to yaw: the other triple of Euler angles, half a
/// turn of pitch and of roll off, is the same attitude and jumps there.
#[test]
fn exact_yaw_goes_on_beyond_a_quarter_turn() {
    let at = |start: &str| {
        let case = setup(&[
            "flight={ mode = \"tethered\", tether = { yaw = { rate_deg_s = 4000 } } }",
            start,
        ]);
        go_on(&mut Simulation::new(case).unwrap()).unwrap()
    };
    for (start, from) in [("flight.yaw_deg=0", 0.0_f64), ("flight.yaw_deg=171", 171.0)] {
        for record in at(start) {
            let angles = &record.coordinates[3..6];
            let yaw = (from + 4000.0 * record.time).to_radians();
            let off = [angles[0], angles[1] - yaw, angles[2]];
            assert!(
                off.iter().all(|x| x.abs() < 1e-9),
                "{start}: {angles:?} for {yaw}"
            );
        }
    }
}

/// A tether that starts smoothly: at rest at first, by velocities and accelerations that are derivatives of the
/// motion, late by half of the rise from then on; what drives it is the change of the momentum of the whole
/// flyer.
#[test]
fn exact_tether_starts_from_rest() {
    let mode = "flight={ mode = \"tethered\", velocity_m_s = [2, 0, 0], tether = { z = { frequency_hz = 9, sine_m = [0.01] }, yaw = { rate_deg_s = 700 }, start_s = 0.05 } }";
    let setup = setup(&[mode]);
    let MotionMode::Tethered(motion) = &setup.mode else {
        panic!("a tether");
    };
    let at_once = PrescribedMotion {
        start: Start::Impulsive,
        ..motion.clone()
    };
    let first = motion.at(0.0);
    assert_eq!([first.motion.v, first.motion.w], [DVec3::ZERO; 2]);
    let (late, whole) = (motion.at(0.1), at_once.at(0.075));
    assert!(late.motion.p.distance(whole.motion.p) < 1e-15);
    assert!(late.motion.v.distance(whole.motion.v) < 1e-15);
    let turned = late.motion.r.transpose() * whole.motion.r;
    assert!((turned - DMat3::IDENTITY).col(0).length() < 1e-15);
    let h = 1e-5;
    for t in [0.01, 0.027, 0.049] {
        let [before, now, after] = [t - h, t, t + h].map(|t| motion.at(t));
        let by_place = (after.motion.p - before.motion.p) / (2.0 * h);
        let by_velocity = (after.motion.v - before.motion.v) / (2.0 * h);
        // Differences of second order: a sixth of the third derivative times h^2.
        assert!(by_place.distance(now.motion.v) < 1e-6, "{t}");
        assert!(by_velocity.distance(now.acceleration.linear) < 1e-3, "{t}");
        let by_turn = (after.motion.w - before.motion.w) / (2.0 * h);
        assert!(by_turn.distance(now.acceleration.angular) < 1e-3, "{t}");
    }
    let motion = motion.clone();
    let whole = go_on(&mut Simulation::new(setup.clone()).unwrap()).unwrap();
    // With a free joint the root is supported by multipliers; it follows the same motion.
    let mut hinged = self::setup(&[mode, FREE]);
    hinged.time = setup.time;
    for records in [
        whole.clone(),
        go_on(&mut Simulation::new(hinged).unwrap()).unwrap(),
    ] {
        for r in &records {
            let root = motion.at(r.time).motion;
            let [x, v] = [&r.coordinates, &r.rates].map(|list| DVec3::from_slice(&list[..3]));
            assert!(x.distance(root.p) < 1e-9, "{} {x} {}", r.time, root.p);
            assert!(v.distance(root.v) < 1e-7, "{} {v} {}", r.time, root.v);
        }
    }
    let records = whole;
    let residual = |r: &Record| r.momentum_residual.length();
    let worst = records.iter().map(residual).fold(0.0, f64::max);
    println!("{worst:e}");
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn refuses_starts_of_tethers_that_move_nothing() {
    let refused = |flight: &str| {
        let set = [format!("flight={flight}")];
        let case = LoadedCase::from_text("vane", VANE, Path::new(""), &set);
        match case {
            Ok(_) => panic!("{flight} is accepted"),
            Err(why) => why.to_string(),
        }
    };
    let still = refused("{ mode = \"tethered\", tether = { start_s = 0.1 } }");
    assert!(
        still.contains("flight.tether.start_s") && still.contains("at rest"),
        "{still}"
    );
    for length in ["0.0", "-1.0", "nan"] {
        let text = format!(
            "{{ mode = \"tethered\", velocity_m_s = [1, 0, 0], tether = {{ start_s = {length} }} }}"
        );
        let bad = refused(&text);
        assert!(bad.contains("flight.tether.start_s"), "{bad}");
    }
}
