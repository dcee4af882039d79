//! Keys without effect are refused by name.

use std::path::Path;

use crate::common;
use wingbeat_case::LoadedCase;

pub(crate) const ANIMAL: &str = "format = 1
[time]
steps_per_beat = 20
beats = 1
[motion]
frequency_hz = 100
[body]
[body.part.thorax]
length_m = 2e-3
diameter_m = 1e-3
density_kg_m3 = 1000
[body.part.tail]
centre_m = [-1.5e-3, 0, 0]
length_m = 1e-3
diameter_m = 0.5e-3
density_kg_m3 = 1000
[wing.right]
hinge_m = [0, 0.5e-3, 0]
mass_kg = 1e-9
[wing.right.planform.rectangle]
chord_m = 1e-3
span_m = 3e-3
[wing.right.mesh]
chordwise = 2
spanwise = 3
[wing.right.motion]
phi.fourier = { sine_deg = [60.0] }
[air]
";

pub(crate) fn load(set: &[&str]) -> Result<LoadedCase, String> {
    common::load(ANIMAL, set)
}

pub(crate) const VACUUM: &str = "air.model=none";
pub(crate) const BLADE: &str = "air.model=blade_element";
pub(crate) const JOINT: &str = "joint.tail={ child = \"tail\", at_m = [-1e-3, 0, 0] }";
pub(crate) const SEGMENT: &str = "segment.tail.parts=[\"tail\"]";
const MASS: &str = "body.mass_kg=2e-6";
const INERTIA: &str = "body.inertia_about_centre_kg_m2=[1e-12, 2e-12, 2e-12, 0, 0, 0]";
const WING: &str = "wing.right.inertia_about_centre_kg_m2=[1e-15, 1e-16, 1e-15, 0, 0, 0]";
const STILL: &str = "wing.right.motion.phi={ constant_deg = 5 }";

/// (what makes a key idle, the idle key's setting, the key if the setting does not begin with it).
const TABLE: &[(&[&str], &str, &str)] = &[
    (&[VACUUM], "body.centre_m=[0, 0, 0]", ""),
    (&[VACUUM, MASS], "body.centre_m=[0, 0, 0]", ""),
    (
        &[VACUUM, MASS, INERTIA],
        "body.length_m=3e-3",
        "body.part.tail.density_kg_m3",
    ),
    (&[VACUUM], "body.part.tail.file_unit_m=1e-3", ""),
    (&[VACUUM], "body.part.tail.quads=[[0, 1, 2, 3]]", ""),
    (&[VACUUM, MASS], "wing.right.centre_m=[0, 1e-3, 0]", ""),
    (
        &[VACUUM, WING],
        "wing.right.mass_kg=0",
        "wing.right.inertia_about_centre_kg_m2",
    ),
    (
        &[VACUUM],
        "wing.left={ inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0] }",
        "wing.left.inertia_about_centre_kg_m2",
    ),
    (
        &[VACUUM],
        "wing.fin={ side = \"right\", mirror = true, hinge_m = [0, 0, 0], mass_kg = 1e-9, planform = { rectangle = { chord_m = 1e-3, span_m = 3e-3 } } }",
        "wing.fin.mirror",
    ),
    (&[VACUUM], "wing.right.deformation.axis_fraction=0.3", ""),
    (&[VACUUM], "wing.right.deformation.camber_peak=0.3", ""),
    (
        &[
            VACUUM,
            "wing.right.motion.theta.constant_deg=0",
            "wing.right.motion.psi.constant_deg=0",
        ],
        "wing.right.motion.data=fry-hover",
        "",
    ),
    (
        &[VACUUM],
        "wing.right.motion.psi.table={ rows_deg = [[0, 0], [0.3, 1], [0.6, 2], [1, 0]], phase_column = \"t\" }",
        "wing.right.motion.psi.table.phase_column",
    ),
    (
        &[VACUUM],
        "wing.right.planform={ outline = { leading_m = [[0, 0], [1e-3, 0]], trailing_m = [[0, -1e-3], [1e-3, -1e-3]], x_column = \"x\" } }",
        "wing.right.planform.outline.x_column",
    ),
    (
        &[VACUUM, "motion.start=impulsive"],
        "motion.start_beats=2",
        "",
    ),
    (
        &[VACUUM, "wing.right.motion.phase=0.5"],
        "motion.phase=0.25",
        "",
    ),
    (
        &[VACUUM, "wing.right.motion.stroke_plane_pitch_deg=40"],
        "motion.stroke_plane_pitch_deg=30",
        "",
    ),
    (&[VACUUM, STILL], "motion.adjust.stroke_amplitude=0.1", ""),
    (
        &[
            VACUUM,
            "wing.right.motion.phi={ fourier = { mean_deg = 5, cosine_deg = [0] } }",
        ],
        "motion.adjust.stroke_amplitude=0.1",
        "",
    ),
    (
        &[
            VACUUM,
            "wing.right.motion.psi={ fourier = { mean_deg = 5 } }",
        ],
        "motion.adjust.feathering_lead=0.1",
        "",
    ),
    (&[VACUUM, STILL], "motion.phase=0.5", ""),
    (&[VACUUM, STILL], "motion.start_beats=3", ""),
    (&[VACUUM, STILL], "wing.right.motion.phase=0.25", ""),
    (&[VACUUM], "motion.adjust.feathering_amplitude=0.1", ""),
    (&[VACUUM], "motion.difference.feathering_lead=0.1", ""),
    (&[VACUUM], "motion.adjust.feathering_lead=0.1", ""),
    (
        &[
            VACUUM,
            STILL,
            "motion.frequency_hz=0",
            "time={ step_s = 1e-3, steps = 3 }",
        ],
        "flight.held_beats=1",
        "",
    ),
    (
        &[VACUUM],
        "flight.tether.x={ frequency_hz = 3, sine_m = [1e-3] }",
        "flight.tether",
    ),
    (
        &[VACUUM, "flight.mode=tethered"],
        "flight.tether.x={ frequency_hz = 3 }",
        "flight.tether.x.frequency_hz",
    ),
    (
        &[VACUUM, "flight.mode=tethered"],
        "flight.tether.pitch={ sine_deg = [3] }",
        "flight.tether.pitch.sine_deg",
    ),
    (
        &[VACUUM, "flight.mode=tethered"],
        "dynamics.formulation=euler",
        "",
    ),
    (
        &[VACUUM],
        "dynamics.baumgarte={ step_factor = 0.2 }",
        "dynamics.baumgarte",
    ),
    (&[VACUUM], "dynamics.stabilisation=none", ""),
    (
        &[VACUUM, "dynamics.integrator=hamming"],
        "dynamics.tolerance=1e-9",
        "",
    ),
    (
        &[BLADE, "dynamics.integrator=runge_kutta"],
        "corrector.relaxation=0.5",
        "",
    ),
    (
        &[BLADE, "dynamics.integrator=runge_kutta"],
        "corrector.tolerance=1e-5",
        "",
    ),
    (
        &[BLADE, "dynamics.integrator=order_eight"],
        "corrector.max_passes=7",
        "",
    ),
    (&[VACUUM, SEGMENT, JOINT], "joint.tail.axis=[0, 1, 0]", ""),
    (
        &[VACUUM, SEGMENT, JOINT],
        "joint.tail.axes=[[0, 1, 0], [0, 0, 1]]",
        "",
    ),
    (&[VACUUM, SEGMENT, JOINT], "joint.tail.start_m=1e-4", ""),
    (
        &[VACUUM, SEGMENT, JOINT, "joint.tail.kind=revolute"],
        "joint.tail.start_m_s=1e-4",
        "",
    ),
    (
        &[VACUUM, SEGMENT, JOINT, "joint.tail.kind=prismatic"],
        "joint.tail.start_deg=[3]",
        "",
    ),
    (
        &[VACUUM, SEGMENT, JOINT, "joint.tail.kind=prismatic"],
        "joint.tail.start_deg_s=[3]",
        "",
    ),
    (
        &[VACUUM, SEGMENT, JOINT],
        "joint.tail.turn={ axis = [0, 1, 0], frequency_hz = 5 }",
        "joint.tail.turn.frequency_hz",
    ),
    (
        &[VACUUM, SEGMENT, JOINT],
        "joint.tail.travel={ }",
        "joint.tail.travel",
    ),
    (
        &[VACUUM, SEGMENT, JOINT],
        "joint.tail.turn={ axis = [0, 1, 0] }",
        "joint.tail.turn",
    ),
    (
        &[VACUUM, SEGMENT, JOINT],
        "joint.tail.element=[{ rest_deg = 3 }]",
        "joint.tail.element[0].rest_deg",
    ),
    (
        &[VACUUM, SEGMENT, JOINT],
        "joint.tail.element=[{ rest_m = 3 }]",
        "joint.tail.element[0].rest_m",
    ),
    (
        &[VACUUM, SEGMENT, JOINT, "joint.tail.kind=revolute"],
        "joint.tail.element=[{ moment_newton_m = { mean = 1, frequency_hz = 3 } }]",
        "joint.tail.element[0].moment_newton_m.frequency_hz",
    ),
    (
        &[VACUUM],
        "joint.hinge={ child = \"right\", at_child_m = [0, 0, 0] }",
        "joint.hinge.at_child_m",
    ),
    (
        &[VACUUM, SEGMENT, JOINT],
        "segment.tail.centre_m=[0, 0, 0]",
        "",
    ),
    (
        &[VACUUM],
        "load=[{ frequency_hz = 3 }]",
        "load[0].frequency_hz",
    ),
    (
        &[VACUUM],
        "load=[{ force_sine_newton = [[1, 0, 0]] }]",
        "load[0].force_sine_newton",
    ),
    (
        &[VACUUM],
        "load=[{ couple_sine_newton_m = [[1, 0, 0]] }]",
        "load[0].couple_sine_newton_m",
    ),
    (
        &[VACUUM],
        "load=[{ point_m = [1, 0, 0], couple_newton_m = [1, 0, 0] }]",
        "load[0].point_m",
    ),
    (&[VACUUM], "load=[{}]", "load[0]"),
    (&[VACUUM], "load=[{ on = \"body\" }]", "load[0]"),
    (
        &[VACUUM, "flight.mode=tethered"],
        "flight.tether.x={ frequency_hz = 0, sine_m = [0.1] }",
        "flight.tether.x.sine_m",
    ),
    (
        &[VACUUM, "flight.mode=tethered"],
        "flight.tether.roll={ frequency_hz = 0, cosine_deg = [1], sine_deg = [3] }",
        "flight.tether.roll.sine_deg",
    ),
    (&["air.shed=[\"trailing\"]"], "air.leading_edge=suction", ""),
    (&[], "air.leading_edge_threshold_deg=20", ""),
    (
        &["air.leading_edge=always"],
        "air.leading_edge_threshold=0.2",
        "",
    ),
    (
        &["air.loads=polhamus"],
        "air.leading_edge_suction_efficiency=0.5",
        "",
    ),
    (&[], "air.leading_edge_formation_chords=3", ""),
    (
        &["air.shed=[\"trailing\"]"],
        "air.particles={ leading_edge = true, radius_m = 1e-4 }",
        "air.particles.leading_edge",
    ),
    (
        &[],
        "air.section_drag={ friction = \"none\", viscosity_m2_s = 1e-5, cd0 = 0.1 }",
        "air.section_drag.viscosity_m2_s",
    ),
    (&["air.shed=[]"], "air.clearance_m=1e-4", ""),
    (&["air.shed=[]"], "air.wake_overlap=0.3", ""),
    (&["air.shed=[]"], "air.wake_overlap_slope=0.1", ""),
    (&["air.wake_overlap=0"], "air.wake_overlap_slope=0.1", ""),
    (
        &[
            "air.bound_core.lamb_oseen={ radius_m = 1e-5 }",
            "air.wake_core.lamb_oseen={ radius_m = 1e-4 }",
        ],
        "air.wake_overlap_slope=0.1",
        "",
    ),
    (&["air.shed=[]"], "air.convection=euler", ""),
    (
        &["air.shed=[]"],
        "air.wake_core.algebraic={ radius_chords = 0.3 }",
        "air.wake_core",
    ),
    (
        &["air.shed=[]"],
        "air.particles={ after_rows = 8, radius_m = 1e-4 }",
        "air.particles",
    ),
    (&["air.shed=[]"], "air.max_wake_rows=5", ""),
    (&["air.shed=[]"], "air.max_wake_age_s=5", ""),
    (&["air.shed=[]"], "air.max_wake_distance_m=5", ""),
    (&["air.shed=[]"], "air.max_displacement_m=5", ""),
    (&["air.shed=[]"], "air.plane_wakes=true", ""),
    (
        &["air.summation=direct"],
        "air.summation_tolerance=1e-3",
        "",
    ),
    (
        &[BLADE],
        "air.blade={ coefficients = \"dickinson-1999\", own = { lift = 1, drag_0 = 0, drag_90 = 2 } }",
        "air.blade.coefficients",
    ),
    (
        &[BLADE],
        "air.blade={ rotation = \"none\", rotation_coefficient = 1 }",
        "air.blade.rotation_coefficient",
    ),
    (&[BLADE], "air.blade={ states = 4 }", "air.blade.states"),
    (
        &[BLADE],
        "air.blade={ unsteady = \"jones\", states = 4 }",
        "air.blade.states",
    ),
    (
        &[BLADE],
        "air.ground={ point_m = [0, 0, 1], normal = [0, 0, 1] }",
        "air.ground",
    ),
    (
        &[
            "air.model=derivatives",
            "air.derivatives.moment_newton_m=[0, 0, 0]",
        ],
        "air.density_kg_m3=1",
        "",
    ),
    (
        &["air.model=derivatives"],
        "air.gust=[{ amplitude_m_s = [0, 0, 1], duration_s = 1 }]",
        "air.gust",
    ),
    (
        &["air.model=external"],
        "air.vortex_street={ circulation_m2_s = 1, spacing_m = 1, drift_m_s = [1, 0, 0] }",
        "air.vortex_street",
    ),
    (
        &["air.model=external"],
        "air.shear_1_s=[[0, 0, 1], [0, 0, 0], [0, 0, 0]]",
        "air.shear_1_s",
    ),
];

#[test]
fn refuses_keys_without_effect_by_name() {
    let mut wrong = vec![];
    for (void, idle, key) in TABLE {
        let key = match *key {
            "" => idle.split_once('=').unwrap().0,
            key => key,
        };
        let all: Vec<&str> = void.iter().copied().chain([*idle]).collect();
        match load(&all) {
            Err(e) if e.contains(key) && e.contains("no effect") => {
                assert!(e.contains("allowed") && e.contains("try"), "{e}");
                // What it acts beside, not only that it does not here.
                assert!(!e.contains("no such key"), "{e}");
            }
            Err(e) => wrong.push(format!("{all:?}: {key} is not what is refused:\n{e}")),
            Ok(_) => wrong.push(format!("{all:?}: {key} is accepted")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn refuses_viscosity_of_surfaces_that_is_not_that_of_the_wakes() {
    let cores = |bound: &str| {
        [
            format!("air.bound_core.algebraic={{ radius_m = 1e-5{bound} }}"),
            "air.wake_core.algebraic={ radius_m = 7e-5, viscosity_m2_s = 1e-6 }".to_owned(),
        ]
    };
    let load = |bound: &str| LoadedCase::from_text("idle", ANIMAL, Path::new(""), &cores(bound));
    for other in [", viscosity_m2_s = 2e-6", ", viscosity_m2_s = 1.5e-5"] {
        let refused = load(other).err().unwrap().to_string();
        for word in [
            "air.bound_core.algebraic.viscosity_m2_s",
            "no effect",
            "0.000001",
        ] {
            assert!(refused.contains(word), "{refused}");
        }
    }
    let [left_out, same] = ["", ", viscosity_m2_s = 1e-6"]
        .map(|bound| format!("{:?}", load(bound).unwrap().setup.air));
    assert_eq!(left_out, same);
}

#[test]
fn refuses_leading_edges_alone_where_they_shed_nothing() {
    for choice in ["never", "vortex_lift"] {
        let choice = format!("air.leading_edge={choice}");
        let refused = load(&["air.shed=[\"leading\"]", &choice]).unwrap_err();
        assert!(
            refused.contains("air.shed") && refused.contains("other edges too"),
            "{refused}"
        );
        load(&["air.shed=[\"leading\", \"root\"]", &choice]).unwrap();
    }
}

/// The moments of a flat wing, rounded to three digits.
#[test]
fn exact_rounded_inertia_of_a_flat_wing_is_taken() {
    let given = |zz: &str| {
        let inertia =
            format!("wing.right.inertia_about_centre_kg_m2=[7.5e-16, 8.33e-17, {zz}, 0, 0, 0]");
        load(&[VACUUM, "wing.right.centre_m=[0, 1e-3, 0]", &inertia])
    };
    let case = given("8.36e-16").unwrap(); // 8.333e-16 would be the sum
    let moments = case.setup.animal.wings[0].mass.inertia_about_centre();
    let (sum, largest) = (7.5e-16 + 8.33e-17, moments.z_axis.z);
    assert!((largest - sum).abs() < 1e-12 * sum, "{largest:e}");
    assert!(
        given("8.5e-16")
            .unwrap_err()
            .contains("inertia_about_centre_kg_m2")
    );
}
