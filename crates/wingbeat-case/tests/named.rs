//! Keys that change nothing in a flight, or do not fit each other: by name.

use wingbeat_case::LoadedCase;

use crate::common::{self, preset, refusal};

/// A joint of a left wing does not begin with what that of the right wing has.
#[test]
fn refuses_a_joint_that_names_no_child() {
    let joint = "joint.left={ kind = \"revolute\", axis = [0, 1, 0] }";
    let said = refusal("fruit-fly-hover", &[joint]);
    let missing = said.contains("joint.left.child") && said.contains("this key is missing");
    assert!(missing && said.contains("left, right"), "{said}");
}

/// Of a pair with laws of its own on each side none of the three angles is left out on one.
#[test]
fn refuses_an_angle_of_one_side_alone() {
    for lacking in ["phi", "theta", "psi"] {
        let sets = ["right", "left"].map(|side| {
            let angles = ["phi", "theta", "psi"].into_iter();
            let given = angles.filter(|angle| side == "right" || *angle != lacking);
            let laws: Vec<String> = given
                .map(|a| format!("{a}.fourier.cosine_deg = [9.0]"))
                .collect();
            format!("wing.{side}.motion={{ {} }}", laws.join(", "))
        });
        let said = refusal("fruit-fly-blade", &["motion.data=", &sets[0], &sets[1]]);
        assert!(
            said.contains(&format!("wing.left.motion.{lacking}")),
            "{said}"
        );
        assert!(said.contains("would stand still at 0"), "{said}");
    }
}

/// What `[motion.adjust]` of a preset adds to measured angles.
#[test]
fn exact_adjustments_of_tables_are_listed() {
    let law = "wing.right.motion.phi={ table = { rows_deg = [[0,10],[0.25,3],[0.5,-10],[0.75,3],[1,10]] } }";
    let found = |name: &str, set: &[&str]| preset(name, set).adjusted_tables();
    assert_eq!(
        found("fruit-fly-hover", &[law]),
        ["motion.adjust.stroke_offset_deg = -5.2"]
    );
    assert_eq!(found("fruit-fly-hover", &[]), [""; 0]);
    assert_eq!(found("fruit-fly-hover", &[law, "motion.adjust="]), [""; 0]);
}

#[test]
fn behaves_biases_that_the_flight_that_is_held_has_too_are_named() {
    let said = |hold: &str, bias: &str| {
        let set = [
            format!("control.hold={hold}"),
            format!("control.sensors={{{bias}}}"),
        ];
        let case = LoadedCase::find("fruit-fly-controlled", &set).unwrap();
        case.idle_keys()
    };
    for key in ["velocity_bias_m_s", "tilt_bias_deg", "rate_bias_deg_s"] {
        let bias = format!("{key}=[0,0.5,0]");
        let [doubt] = &said("start", &bias)[..] else {
            panic!("{key}")
        };
        assert!(
            doubt.contains(key) && doubt.contains("control.hold"),
            "{doubt}"
        );
        assert_eq!(said("trim", &bias), [""; 0]);
    }
    assert_eq!(said("start", "tilt_noise_deg=1"), [""; 0]);
}

/// Angles that do not vary have no phase and no start, whatever joints do; blade elements leave camber out.
#[test]
fn behaves_keys_that_change_nothing_in_this_flight_are_named() {
    let said = |name: &str, set: &[&str]| preset(name, set).idle_keys();
    let still =
        "wing.right.motion={ phi.constant_deg = 0, theta.constant_deg = 0, psi.constant_deg = 0 }";
    let hinge = "joint.hinge={ child = \"right\", kind = \"revolute\", axis = [0, 1, 0], element = [{ moment_newton_m = { sine = [1e-6] } }] }";
    for (set, key) in [
        ("motion.phase=0.3", "motion.phase"),
        ("motion.start=impulsive", "motion.start"),
        ("motion.start_beats=0.5", "motion.start_beats"),
    ] {
        let all = [&["motion={ frequency_hz = 200 }", still, hinge][..], &[set]].concat();
        let [doubt] = &said("fruit-fly-blade", &all)[..] else {
            panic!("{key}")
        };
        assert!(
            doubt.starts_with(&format!("{key} changes nothing")),
            "{doubt}"
        );
        assert_eq!(
            said("fruit-fly-blade", &["motion.start=smooth", set]),
            [""; 0]
        );
    }
    let camber = "wing.right.deformation={ camber = [{ linear = [0, 0.1] }], twist = [{ linear_deg = [0, 5] }] }";
    let [doubt] = &said("fruit-fly-blade", &[camber])[..] else {
        panic!("camber")
    };
    assert!(
        doubt.starts_with("wing.right.deformation.camber changes nothing"),
        "{doubt}"
    );
    assert_eq!(said("fruit-fly-hover", &[camber]), [""; 0]);
}

#[test]
fn refuses_camber_alone_in_blade_elements() {
    let camber = "wing.right.deformation={ camber = [{ linear = [0, 0.1] }] }".to_owned();
    let refused = LoadedCase::find("fruit-fly-blade", std::slice::from_ref(&camber))
        .err()
        .unwrap()
        .to_string();
    let key = "wing.right.deformation.camber";
    assert!(
        refused.contains(key) && refused.contains("do not take the camber"),
        "{refused}"
    );
    assert!(LoadedCase::find("fruit-fly-hover", &[camber]).is_ok());
}

#[test]
fn refuses_keys_of_the_lattice_by_what_they_do_not_fit() {
    for (set, said) in [
        (
            ["air.leading_edge=vortex_lift", "air.loads=pressure"],
            "pressure does not fit air.leading_edge = \"vortex_lift\"",
        ),
        (
            [
                "air.particles={after_rows=3,radius_m=1e-4}",
                "air.max_wake_rows=30",
            ],
            "30 does not fit air.particles",
        ),
        (
            ["air.leading_edge=suction", "air.max_wake_rows=1"],
            "1 does not fit air.leading_edge = \"suction\"",
        ),
    ] {
        let set = set.map(str::to_owned);
        let refused = LoadedCase::find("fruit-fly-hover", &set)
            .err()
            .unwrap()
            .to_string();
        assert!(refused.lines().next().unwrap().contains(said), "{refused}");
    }
}

/// Keys of any controller act on one of the user's own; those of another are refused beside it.
#[test]
fn behaves_control_without_a_controller_is_for_one_of_the_users_own() {
    let of = |set: &[&str]| {
        let set: Vec<String> = set.iter().map(|s| format!("control.{s}")).collect();
        let set = [vec!["time.steps_per_beat=40".to_owned()], set].concat();
        let case = LoadedCase::find("fruit-fly-blade", &set).unwrap();
        case.own_control()
    };
    assert_eq!(of(&[]).unwrap(), None);
    let own = of(&[
        "sensors={seed=5,tilt_noise_deg=1}",
        "looks_per_beat=2",
        "latency_beats=0.5",
    ]);
    let own = own.unwrap().expect("keys of any controller");
    assert_eq!((own.interval, own.every, own.latency), (20, 1, 1));
    assert_eq!(own.sensors.map(|s| s.seed), Some(5));
    for key in [
        "controller=regulator",
        "weights.sum=1",
        "amplitude_limit=0.1",
    ] {
        let error = of(&["sensors={tilt_noise_deg=1}", key]).unwrap_err();
        assert_eq!(error.key, "control.controller", "{key}");
    }
    // What stands by where the controller of a preset is switched off.
    let off = LoadedCase::find(
        "fruit-fly-controlled",
        &["control.controller=none".to_owned()],
    );
    let own = off
        .unwrap()
        .own_control()
        .unwrap()
        .expect("it has [control]");
    assert_eq!((own.interval, own.latency, own.sensors), (30, 1, None));
}

/// A wing that stands still on a body without parts.
const STILL: &str = "format = 1
time = { step_s = 2e-3, steps = 6 }
flight.mode = \"tethered\"
air = { stream_m_s = [-3, 0, 0], shed = [\"trailing\"] }
body = { mass_kg = 0.02, inertia_about_centre_kg_m2 = [1e-5, 1e-5, 1e-5, 0, 0, 0] }
[wing.right]
hinge_m = [0, 0.01, 0]
mass_kg = 5e-4
motion.psi.constant_deg = 5
planform.rectangle = { chord_m = 0.03, span_m = 0.09 }
mesh = { chordwise = 2, spanwise = 3 }
";

/// A body in the lattice that has no parts, and a frequency at which nothing beats and nothing is counted.
#[test]
fn behaves_bodies_and_frequencies_that_are_not_there_are_named() {
    let said = |set: &[&str]| common::load(STILL, set).unwrap().idle_keys();
    let records = |set: &[&str]| common::fly(common::load(STILL, set).unwrap().setup);
    let plain = records(&[]);
    for (set, key) in [
        ("air.body=true", "air.body = true changes nothing"),
        (
            "motion.frequency_hz=10",
            "motion.frequency_hz moves nothing",
        ),
    ] {
        let [doubt] = &said(&[set])[..] else {
            panic!("{set}")
        };
        assert!(doubt.starts_with(key), "{doubt}");
        assert!(records(&[set]) == plain, "{set} moves something");
    }
    let part = "body.part.trunk={ length_m = 0.05, diameter_m = 0.01 }";
    for set in [
        &[][..],
        &["air.body=false"],
        &["air.body=true", part],
        &[
            "motion.frequency_hz=10",
            "time={ steps_per_beat = 20, beats = 1 }",
        ],
        &[
            "motion.frequency_hz=10",
            "wing.right.motion.phi={ fourier = { sine_deg = [20] } }",
        ],
    ] {
        assert_eq!(said(set), [""; 0], "{set:?}");
    }
}
