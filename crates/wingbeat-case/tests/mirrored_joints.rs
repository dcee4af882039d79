//! Joints of wings: mirror images on the left, one place of the hinge, and what is not scaled or shifted with it.

use crate::common;
use wingbeat_analysis::{TrimRequest, trim};
use wingbeat_case::{LoadedCase, trimmed_case};
use wingbeat_flight::{AirModel, Record, Simulation};
use wingbeat_math::DVec3;

const FLYER: &str = "format = 1
[time]
steps_per_beat = 80
beats = 0.25
[motion]
frequency_hz = 25
stroke_plane_pitch_deg = 40
[flight]
mode = \"free\"
pitch_deg = 45
[dynamics]
integrator = \"bdf\"
[air]
model = \"blade_element\"
[body]
mass_kg = 1.5e-3
inertia_about_centre_kg_m2 = [1e-7, 2e-7, 2.1e-7, 0, 0, 0]
[wing.right]
hinge_m = [8e-3, 6e-3, -8e-3]
mass_kg = 5e-5
[wing.right.planform.rectangle]
chord_m = 18e-3
span_m = 48e-3
[wing.right.mesh]
chordwise = 2
spanwise = 6
[wing.right.motion]
phi.fourier = { sine_deg = [40.0] }
";

/// A spherical joint with something of each kind along each of its angles.
const BALL: &str = "joint.h={ child = \"right\", kind = \"spherical\", start_deg = [8, -4, 5], start_deg_s = [100, 200, -300], element = [
{ direction = 0, stiffness_newton_m_per_rad = 5e-4, rest_deg = 10, stop = { lower_deg = -3, upper_deg = 6, stiffness_newton_m_per_rad = 1e-3 } },
{ direction = 1, stiffness_newton_m_per_rad = 9e-4, rest_deg = -5, damping_newton_m_s_per_rad = 1e-6 },
{ direction = 2, moment_newton_m = { mean = 1e-5, sine = [2e-5] }, follow = { angle_deg = { mean = 4, cosine = [3] }, stiffness_newton_m_per_rad = 7e-4, damping_newton_m_s_per_rad = 1e-6 } },
] }";

fn load(set: &[&str]) -> Result<LoadedCase, String> {
    common::load(FLYER, set)
}

fn fly(set: &[&str]) -> Vec<Record> {
    common::fly(load(set).unwrap().setup)
}

fn place(record: &Record, body: usize) -> DVec3 {
    DVec3::from_slice(&record.coordinates[6 * body..])
}

#[test]
fn invariant_spherical_joints_of_both_wings_are_mirror_images() {
    let records = fly(&[BALL]);
    let mut largest = 0.0_f64;
    for r in &records {
        let [left, right] = [&r.joints[..3], &r.joints[3..]];
        for ((l, r), sign) in left.iter().zip(right).zip([-1.0, 1.0, -1.0]) {
            // The body's own rounding grows with the fall.
            assert!((l[0] - sign * r[0]).abs() < 1e-9, "{l:?} {r:?}");
            largest = largest.max((r[0] - records[0].joints[3][0]).abs());
        }
        assert!(place(r, 0).y.abs() < 1e-12, "{}", place(r, 0).y); // rounding of the steps
    }
    assert!(largest > 0.02); // the joints move
}

#[test]
fn exact_travel_of_the_right_wing_is_mirrored() {
    let travel = "joint.h={ child = \"right\", travel = { sine_m = [[1e-3, 2e-3, 3e-3]] } }";
    let records = fly(&[travel, "flight.mode=tethered", "air.model=none"]);
    for r in &records {
        let [left, right] = [1, 2].map(|wing| place(r, wing) - place(r, 0));
        // In the axes of the world: the body is pitched about the axis of the mirror.
        let image = DVec3::new(right.x, -right.y, right.z);
        assert!(left.distance(image) < 1e-15, "{left} {right}");
    }
    let [first, last] = [&records[0], &records[20]].map(|r| place(r, 2));
    assert!((last - first).y > 1.9e-3); // a quarter of a beat: all of the sine
}

fn refused(set: &[&str], words: &[&str]) {
    let text = load(set).map(|_| ()).unwrap_err();
    assert!(words.iter().all(|w| text.contains(w)), "{text}");
}

#[test]
fn refuses_another_place_for_the_hinge_of_a_wing() {
    let joint = |at: &str| format!("joint.h={{ child = \"right\", at_m = {at} }}");
    let words = ["joint.h.at_m", "wing.right.hinge_m", "remove at_m"];
    refused(&[&joint("[0.02, 0.01, 0]")], &words);
    load(&[&joint("[8e-3, 6e-3, -8e-3]")]).unwrap();
}

#[test]
fn refuses_a_point_on_a_wing_that_came_along_by_mirror_symmetry() {
    let joint = "joint.h={ child = \"left\", at_child_m = [0, 0.01, 0] }";
    refused(&[joint], &["joint.h.at_child_m", "closes loops there"]);
}

const SPRING: &str = "spring.t={ between = [\"body\", \"right\"], at_m = [[0, 0, 0], [0, 0.01, 0]], stiffness_newton_per_m = 1.0 }";
const PULL: &str = "load=[{ force_newton = [0, 0, 1e-3], point_m = [1e-3, 0, 0] }]";

#[test]
fn exact_points_of_loads_and_drag_areas_are_scaled_with_the_animal_and_springs_are_refused() {
    let drag = "air.blade.body_drag={ area_m2 = 1e-5, along = 0.5, across = 1.0, centre_m = [1e-3, 0, 2e-3] }";
    let large = load(&[PULL, drag, "animal.scale=2"]).unwrap().setup;
    assert_eq!(large.loads[0].point, DVec3::new(2e-3, 0.0, 0.0));
    let AirModel::BladeElement(air) = &large.air else {
        panic!("blade elements");
    };
    assert_eq!(air.body_drag.map(|d| d.area), Some(4e-5));
    let centre = air.body_drag.and_then(|d| d.centre);
    assert_eq!(centre, Some(DVec3::new(2e-3, 0.0, 4e-3)));
    refused(
        &[SPRING, "animal.scale=2"],
        &["animal.scale", "springs between points", "[spring.*]"],
    );
}

/// A body with springs and loads at places of its own has its mass centre shifted in itself: hinges, springs and loads
/// stay where they are.
#[test]
fn exact_mass_centre_is_shifted_beside_springs_and_loads() {
    let shift = "body.centre_shift_m=[2e-3, 0, -1e-3]";
    for set in [SPRING, PULL] {
        let [before, after] = [&[set][..], &[set, shift]].map(|set| load(set).unwrap().setup);
        let moved = after.animal.body.centre() - before.animal.body.centre();
        assert!(moved.distance(DVec3::new(2e-3, 0.0, -1e-3)) < 1e-17); // rounding
        let [a, b] = [&before, &after].map(|s| s.animal.body.inertia_about_centre());
        let gap = (a - b)
            .to_cols_array()
            .into_iter()
            .fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(gap < 1e-22, "{gap:e}"); // rounding of 1e-7
        assert_eq!(
            before.animal.wings[0].hinge_b,
            after.animal.wings[0].hinge_b
        );
        assert_eq!(before.loads, after.loads);
    }
}

/// One passive hinge: a wing that is not to be mirrored keeps its joint to itself, though the other side is given.
#[test]
fn behaves_joint_of_a_wing_that_is_not_mirrored_stays_on_its_side() {
    let hinge = "joint.h={ child = \"right\", kind = \"revolute\", axis = [0, 1, 0], element = [{ stiffness_newton_m_per_rad = 1e-3 }] }";
    let left = "wing.left.motion.phase=0.1";
    let joints = |set: &[&str]| -> Vec<String> {
        let joints = load(set).unwrap().setup.joints;
        joints.into_iter().map(|j| j.name).collect()
    };
    assert_eq!(joints(&[hinge, left]).len(), 2);
    assert_eq!(joints(&[hinge, left, "wing.right.mirror=false"]), ["h"]);
}

/// Stores on both wings, the left one being a mirror image or given: one animal, symmetric.
#[test]
fn exact_stores_on_a_wing_that_came_along_lie_where_they_are_given() {
    let store = |side: &str, sign: f64| {
        [
            format!(
                "segment.tip{side}={{ mass_kg = 2e-5, centre_m = [1e-3, {}, 3e-4], inertia_about_centre_kg_m2 = [1e-11, 2e-11, 2.5e-11, 0, 0, 0] }}",
                sign * 1e-3
            ),
            format!(
                "joint.t{side}={{ parent = \"{side}\", child = \"tip{side}\", at_m = [1e-3, {}, 0] }}",
                sign * 9e-3
            ),
        ]
    };
    let stores = [store("right", 1.0), store("left", -1.0)].concat();
    let flown = |more: &[&str]| {
        let set: Vec<&str> = stores
            .iter()
            .map(String::as_str)
            .chain(more.iter().copied())
            .collect();
        fly(&set).pop().unwrap().coordinates
    };
    let (image, given) = (flown(&[]), flown(&["wing.left.mass_kg=5e-5"]));
    assert_eq!(image, given);
    let aside = [image[1], image[4], image[5]];
    assert!(aside.iter().all(|x| x.abs() < 1e-12), "{aside:?}");
}

/// Wings on free joints keep to the mirror: what parts one side from the other ends the flight, and is not left out.
#[test]
fn refuses_loads_and_speeds_of_one_side_where_half_of_the_air_is_computed() {
    let side = [
        "load=[{ force_newton = [0, 1e-6, 0] }]",
        "load=[{ on = \"right\", force_newton = [0, 0, 1e-6] }]",
        "load=[{ on = \"left\", force_newton = [0, 0, 1e-6] }]",
        "flight.velocity_m_s=[0, 0.01, 0]",
        "flight.angular_velocity_deg_s=[1, 0, 0]",
    ];
    let robot = |more: &str| {
        let set = ["wing.right.mesh.chordwise=2", "wing.right.mesh.spanwise=4"];
        let set: Vec<String> = set.iter().chain([&more]).map(|s| s.to_string()).collect();
        let case = LoadedCase::find("robobee", &set).unwrap();
        Simulation::new(case.setup)
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    for more in side {
        let text = robot(more).unwrap_err();
        let words = match more.split_once('=') {
            // Known before the first step, by its key.
            Some((key, _)) if key.starts_with("flight.") => [key, "compute both sides (false)"],
            _ => ["not mirror-symmetric", "air.mirror = false"],
        };
        assert!(words.iter().all(|w| text.contains(w)), "{more}: {text}");
    }
    // A load in the plane parts nothing.
    robot("load=[{ force_newton = [1e-6, 0, 1e-6] }]").unwrap();
}

#[test]
fn refuses_strokes_that_differ_beside_the_mirror_by_their_key() {
    let set = ["motion.difference.stroke_offset_deg=2.5", "air.mirror=true"];
    let said = common::refusal("fruit-fly-hover", &set);
    assert!(said.contains("motion.difference"), "{said}");
    assert!(said.contains("air.mirror = false"), "{said}");
}

/// A wing on a body of its own side: the other wing hangs on that of the other side, which is not made from the first.
#[test]
fn refuses_one_rotor_for_the_wings_of_both_sides() {
    let mass = "mass_kg = 1e-4, centre_m = [0, 0, 0], inertia_about_centre_kg_m2 = [1e-9, 1e-9, 1e-9, 0, 0, 0]";
    let rotor = |side: &str, y: f64| {
        [
            format!("segment.rotor-{side}={{ {mass} }}"),
            format!(
                "joint.shaft-{side}={{ child = \"rotor-{side}\", kind = \"revolute\", at_m = [0, {y}, 0], axis = [0, 0, 1], element = [{{ direction = 0, stiffness_newton_m_per_rad = 1e-3 }}] }}"
            ),
        ]
    };
    let wing = "joint.stroke={ child = \"right\", parent = \"rotor-right\", kind = \"revolute\", axis = [0, 1, 0], element = [{ direction = 0, stiffness_newton_m_per_rad = 1e-4 }] }";
    let right = rotor("right", 6e-3);
    let one: Vec<&str> = right.iter().map(String::as_str).chain([wing]).collect();
    let said = load(&one).unwrap_err();
    let words = [
        "joint.stroke.parent",
        "segment.rotor-left",
        "wing.right.mirror = false",
    ];
    assert!(words.iter().all(|w| said.contains(w)), "{said}");
    let left = rotor("left", -6e-3);
    let both: Vec<&str> = one
        .into_iter()
        .chain(left.iter().map(String::as_str))
        .collect();
    let setup = load(&both).unwrap().setup;
    assert_eq!(setup.joints.len(), 4);
}

/// A robot on hinges that give way, of which the file has the right one, sideways and straight ahead: what a trim writes
/// is back after a beat, with a joint of its own on the left where the sides part, and without where they do not.
#[test]
fn exact_written_trims_start_the_joints_of_either_side() {
    let preset = wingbeat_case::presets::find("robobee").unwrap().text;
    let (before, air) = preset.split_once("[air]").unwrap();
    let (_, after) = air.split_once("[output]").unwrap();
    let text = format!("{before}[air]\nmodel = \"blade_element\"\n[output]{after}");
    for (sideways, joints) in [(0.3, 2), (0.0, 1)] {
        let case = common::load(
            &text,
            &[
                "time.beats=1",
                "time.steps_per_beat=100",
                "output.frames_every=0",
            ],
        )
        .unwrap();
        let request = TrimRequest {
            velocity: DVec3::new(0.1, sideways, 0.0),
            ..TrimRequest::default()
        };
        let found = trim(&case.setup, &request.problem(&case.setup).unwrap()).unwrap();
        assert!(found.solution.converged);
        let written = common::load(&trimmed_case(&case, &found).unwrap(), &[]).unwrap();
        assert_eq!(written.raw.joint.len(), joints);
        let records = common::fly(written.setup);
        let [first, last] = [&records[0], &records[100]];
        let hinges = [first, last].map(|r| r.joints.iter().flatten());
        let states = [first, last].map(|r| &r.rates[..6]);
        let [start, end] = [0, 1].map(|k| states[k].iter().chain(hinges[k].clone()));
        let apart = start
            .zip(end)
            .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        let apart = apart / 160.0; // in a beat
        println!("{sideways}: {apart:.1e}");
        assert!(apart < 4e-10, "{apart:e}"); // 5e-11 measured: what a trim is found to
    }
}
