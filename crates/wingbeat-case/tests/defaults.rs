//! What a case that says nothing about the air flies in, lengths in chords, presets that say what
//! differs, and keys without effect.

use crate::common::{found, load, refusal};
use wingbeat_air::{AirSettings, CoreModel, LeadingEdge};
use wingbeat_case::{LoadedCase, presets};
use wingbeat_flight::{AirModel, Simulation};

fn lattice(case: LoadedCase) -> AirSettings {
    match case.setup.air {
        AirModel::VortexLattice(air) => air.lattice,
        _ => panic!("a lattice"),
    }
}

/// The preset without its `[air]` table.
fn without_air(name: &str) -> String {
    let text = presets::find(name).unwrap().text;
    let (before, after) = text.split_once("[air]").unwrap();
    let rest = &after[after.find("\n[").unwrap()..];
    format!("{before}{rest}")
}

/// Size of a core [m].
fn size(core: CoreModel) -> f64 {
    match core {
        CoreModel::CutOff { delta } => delta,
        CoreModel::Vatistas { radius }
        | CoreModel::Scully { radius }
        | CoreModel::Algebraic { radius, .. }
        | CoreModel::LambOseen { radius, .. } => radius,
    }
}

#[test]
fn agrees_a_case_without_air_table_with_the_insect_presets() {
    for name in ["fruit-fly-hover", "fruit-fly-tethered", "fruit-fly-abdomen"] {
        let own = lattice(found(name, &[]).unwrap());
        let default = lattice(load(&without_air(name), &[]).unwrap());
        // The presets have round numbers: 0.7 mm for the chord, which is 0.69 mm on the mesh, and
        // 0.05 mm for 0.07 chords.
        let lengths = [
            (size(own.bound_core), size(default.bound_core), 0.02),
            (size(own.wake_core), size(default.wake_core), 0.05),
            (own.clearance, default.clearance, 0.02),
        ];
        for (a, b, tolerance) in lengths {
            assert!((a / b - 1.0).abs() < tolerance, "{name}: {a:e} {b:e}");
        }
        let implicit = LeadingEdge::SuctionImplicit {
            threshold: 0.15,
            efficiency: 0.0,
        };
        assert_eq!((default.leading, default.shedding.root), (implicit, true));
        // Nothing else differs but how closely sums are made.
        let same = AirSettings {
            bound_core: own.bound_core,
            wake_core: own.wake_core,
            clearance: own.clearance,
            tolerance: own.tolerance,
            ..default
        };
        assert_eq!(same, own, "{name}");
    }
}

#[test]
fn exact_lengths_in_chords_are_those_in_metres() {
    // A rectangle of 2 cm on a hinge: chord and mean chord are one.
    let wing = |air: &str| {
        format!(
            "format = 1\n[motion]\nfrequency_hz = 10\n[body]\nmass_kg = 0.1\n\
             inertia_about_centre_kg_m2 = [1e-4, 1e-4, 1e-4, 0, 0, 0]\n\
             [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0.01\n\
             [wing.right.planform.rectangle]\nchord_m = 0.02\nspan_m = 0.1\n[air]\n{air}\n"
        )
    };
    let both = [
        "bound_core.scully = { radius_m = 1e-4 }\nwake_core.scully = { radius_chords = 0.5 }\nwake_blob_length_chords = 2\nclearance_chords = 0.25\nmax_wake_distance_chords = 4",
        "bound_core.scully = { radius_m = 1e-4 }\nwake_core.scully = { radius_m = 0.01 }\nwake_blob_length_m = 0.04\nclearance_m = 0.005\nmax_wake_distance_m = 0.08",
    ];
    let [chords, metres] = both.map(|air| lattice(load(&wing(air), &[]).unwrap()));
    let of = |s: &AirSettings| {
        [
            size(s.wake_core),
            s.wake_blob_length.unwrap(),
            s.clearance,
            s.max_distance.unwrap(),
        ]
    };
    for (a, b) in of(&chords).iter().zip(of(&metres)) {
        assert!((a - b).abs() < 1e-14, "{a} {b}"); // roundings of the mesh's area
    }
}

/// Scheme, side edges, bound core, wake core, overlap, clearance of the presets that fly in the
/// lattice, as they were before lengths in chords became the default.
const PINNED: [(&str, bool, f64, f64, f64, f64, f64); 13] = [
    ("benchmark-1", false, 0.0, 0.01, 0.01, 0.0, 0.0),
    ("benchmark-2", false, 0.0, 0.01, 0.01, 0.0, 0.0),
    ("bird-cruise", true, 0.25, 2e-3, 2e-3, 1.0, 0.0),
    ("dragonfly", true, 0.25, 1e-4, 7e-4, 1.0, 1e-3),
    ("flapping-rectangles", false, 0.0, 3e-3, 3e-3, 0.0, 0.0),
    ("fruit-fly-abdomen", true, 0.25, 7e-6, 5e-5, 1.0, 7e-5),
    ("fruit-fly-hover", true, 0.25, 7e-6, 5e-5, 1.0, 7e-5),
    ("fruit-fly-tethered", true, 0.25, 7e-6, 5e-5, 1.0, 7e-5),
    ("rectangular-wing", false, 0.0, 2.5e-4, 2.5e-4, 0.0, 0.0),
    ("robobee", true, 0.25, 3.3e-5, 2.3e-4, 1.0, 4e-4),
    ("robofly-advanced", true, 0.25, 8e-4, 6e-3, 1.0, 7e-3),
    ("robofly-delayed", true, 0.25, 8e-4, 6e-3, 1.0, 7e-3),
    ("robofly-symmetrical", true, 0.25, 8e-4, 6e-3, 1.0, 7e-3),
];

#[test]
fn regress_presets_fly_in_the_air_they_flew_in() {
    for (name, accurate, inset, bound, wake, overlap, clearance) in PINNED {
        let s = lattice(found(name, &[]).unwrap());
        let scheme = match accurate {
            true => AirSettings::accurate(s.density, s.free_stream),
            false => AirSettings::benchmark(s.density, s.free_stream),
        };
        assert_eq!(
            (s.rate, s.convection, s.newest_row),
            (scheme.rate, scheme.convection, scheme.newest_row),
            "{name}"
        );
        let found = [
            s.inset,
            size(s.bound_core),
            size(s.wake_core),
            s.wake_overlap,
            s.clearance,
        ];
        assert_eq!(found, [inset, bound, wake, overlap, clearance], "{name}");
    }
}

#[test]
fn refuses_keys_without_effect() {
    let cases: [(&str, &[&str], &str, &str); 24] = [
        (
            "fruit-fly-blade",
            &["air.ground={point_m=[0,0,1],normal=[0,0,1]}"],
            "air.ground",
            "vortex_lattice",
        ),
        (
            "fruit-fly-blade",
            &["air.mirror=true"],
            "air.mirror",
            "vortex_lattice",
        ),
        (
            "fruit-fly-blade",
            &["air.clearance_m=0"],
            "air.clearance_m",
            "vortex_lattice",
        ),
        (
            "fruit-fly-vacuum",
            &["air.gust=[{amplitude_m_s=[1,0,0],duration_s=1}]"],
            "air.gust",
            "blade_element",
        ),
        (
            "fruit-fly-blade",
            &["air.vortex_street={circulation_m2_s=1,spacing_m=1,drift_m_s=[0,1,0]}"],
            "air.vortex_street.axis",
            "square to drift_m_s",
        ),
        (
            "fruit-fly-blade",
            &["air.vortex_street={circulation_m2_s=1,spacing_m=1,drift_m_s=[0,0,0]}"],
            "air.vortex_street.drift_m_s",
            "other than 0",
        ),
        (
            "fruit-fly-vacuum",
            &["air.shear_1_s=[[0,0,1],[0,0,0],[0,0,0]]"],
            "air.shear_1_s",
            "blade_element",
        ),
        (
            "fruit-fly-vacuum",
            &["air.stream_m_s=[1,0,0]"],
            "air.stream_m_s",
            "vortex_lattice",
        ),
        (
            "fruit-fly-vacuum",
            &["wing.right.deformation.twist=[{linear_deg=[0,5]}]"],
            "wing.right.deformation",
            "vortex_lattice",
        ),
        (
            "fruit-fly-hover",
            &["air.blade.rotation=none"],
            "air.blade",
            "blade_element",
        ),
        (
            "fruit-fly-hover",
            &["air.leading_edge=always", "air.leading_edge_threshold=0.2"],
            "air.leading_edge_threshold",
            "suction",
        ),
        (
            "fruit-fly-hover",
            &[
                "air.loads=pressure",
                "air.leading_edge_suction_efficiency=1",
            ],
            "air.leading_edge_suction_efficiency",
            "joukowski",
        ),
        (
            "fruit-fly-hover",
            &["air.leading_edge_formation_chords=3"],
            "air.leading_edge_formation_chords",
            "vortex_lift",
        ),
        (
            "fruit-fly-hover",
            &["air.shed=[\"trailing\"]", "air.leading_edge=never"],
            "air.leading_edge",
            "leading",
        ),
        (
            "fruit-fly-hover",
            &["dynamics.baumgarte.step_factor=0.2"],
            "dynamics.baumgarte",
            "euler",
        ),
        (
            "fruit-fly-hover",
            &["dynamics.tolerance=1e-9"],
            "dynamics.tolerance",
            "order_eight",
        ),
        (
            "fruit-fly-hover",
            &["motion.start=impulsive"],
            "motion.start_beats",
            "smooth",
        ),
        (
            "fruit-fly-hover",
            &[
                "flight.tether.x={frequency_hz=1,sine_m=[1e-3]}",
                "flight.held_beats=0",
            ],
            "flight.tether",
            "tethered",
        ),
        (
            "fruit-fly-tethered",
            &["flight.held_beats=1"],
            "flight.held_beats",
            "free",
        ),
        (
            "fruit-fly-hover",
            &["air.clearance_chords=0.1"],
            "air.clearance_chords",
            "given twice",
        ),
        (
            "fruit-fly-hover",
            &["time.step_s=1e-4"],
            "time.step_s",
            "given twice",
        ),
        (
            "fruit-fly-hover",
            &["body.part.thorax.density_kg_m3=1000"],
            "body.part.thorax.density_kg_m3",
            "given twice",
        ),
        (
            "fruit-fly-hover",
            &["body.centre_m=[0,0,0]"],
            "body.centre_m",
            "inertia_about_centre_kg_m2",
        ),
        (
            "table1-bolender-2009",
            &["air.blade.own={lift=1,drag_0=0,drag_90=2}"],
            "air.blade.coefficients",
            "own",
        ),
    ];
    for (name, set, key, why) in cases {
        let report = found(name, set).map(|_| ()).expect_err(key);
        assert!(
            report.contains(key) && report.contains(why),
            "{key}: {report}"
        );
    }
}

#[test]
fn refuses_settings_of_the_lattice_that_do_not_fit_each_other_at_their_keys() {
    let air = |keys: &str| {
        let text = presets::find("rectangular-wing").unwrap().text;
        text.replace("[air]\n", &format!("[air]\n{keys}\n"))
    };
    for (keys, key, why) in [
        ("wake_overlap = 1", "wake_overlap", "cut-off"),
        (
            "wake_blob_length_m = 1",
            "wake_blob_length_m",
            "wake_overlap 0.5",
        ),
        (
            "wake_blob_length_chords = 1",
            "wake_blob_length_chords",
            "wake_overlap 0.5",
        ),
        (
            "max_wake_rows = 5\nparticles = { after_rows = 2, radius_m = 0.1 }",
            "max_wake_rows",
            "particles",
        ),
        (
            "ground = { point_m = [0, 0, 1], normal = [0, 0, 0] }",
            "ground",
            "direction",
        ),
        (
            "ground = { point_m = [9, 0, 0], normal = [1, 0, 0] }",
            "ground",
            "stream",
        ),
        ("ring_inset = 0.5", "ring_inset", "< 0.5"),
        (
            "shed = [\"trailing\", \"tip\"]\nplane_wakes = true",
            "plane_wakes",
            "tips and roots",
        ),
        (
            "shed = [\"leading\"]\nleading_edge_suction_efficiency = 1.1",
            "leading_edge_suction_efficiency",
            "<= 1",
        ),
        (
            "shed = [\"trailing\", \"leading\"]\nleading_edge = \"vortex_lift\"",
            "loads",
            "forces on segments",
        ),
        ("summation_tolerance = 0.2", "summation_tolerance", "<= 0.1"),
        ("summation = \"mesh\"", "summation", "algebraic cores"),
        (
            "shed = [\"leading\"]\nleading_edge = \"angle_of_attack\"\nleading_edge_threshold_deg = 200",
            "leading_edge_threshold_deg",
            "<= 180",
        ),
    ] {
        let text = air(keys).replacen(
            "shed = [\"trailing\"]\n",
            if keys.contains("shed") {
                ""
            } else {
                "shed = [\"trailing\"]\n"
            },
            1,
        );
        let report = load(&text, &[]).expect_err(key);
        let line = text.lines().position(|l| l.starts_with(key)).unwrap() + 1;
        assert!(
            report.contains(&format!("case.toml:{line}:")) && report.contains(why),
            "{key}, line {line}: {report}"
        );
    }
}

#[test]
fn behaves_a_model_chosen_on_the_command_line_leaves_the_settings_of_the_other_unused() {
    let case = found("fruit-fly-hover", &["air.model=none"]).unwrap();
    assert!(!case.setup.air.is_some());
    let resolved = case.resolved();
    assert!(
        !resolved.contains("wake_core") && resolved.contains("model = \"none\""),
        "{resolved}"
    );
    assert_eq!(load(&resolved, &[]).unwrap().resolved(), resolved);
    // What the air itself does is refused all the same.
    let gust = "[[air.gust]]\namplitude_m_s = [1, 0, 0]\nduration_s = 0.1\n";
    let text = format!("{}\n{gust}", presets::find("fruit-fly-hover").unwrap().text);
    let report = load(&text, &["air.model=none"]).expect_err("a gust in vacuum");
    assert!(report.contains("air.gust"), "{report}");
}

#[test]
fn behaves_a_case_with_animal_and_motion_alone_flies() {
    let mesh = [
        "wing.right.mesh.chordwise=2",
        "wing.right.mesh.spanwise=3",
        "time.beats=0.1",
    ];
    let case = load(&without_air("fruit-fly-hover"), &mesh).unwrap();
    let mut flight = Simulation::new(case.setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
}

#[test]
fn refuses_at_its_key_what_only_the_flight_finds() {
    let hover = presets::find("fruit-fly-hover").unwrap().text;
    let blade = presets::find("fruit-fly-blade").unwrap().text;
    let (before, after) = blade.split_once("[air]").unwrap();
    let rest = &after[after.find("\n[body]").unwrap()..];
    let external = "[air]\nmodel = \"external\"\n[air.external]\ncommand = [\"/nowhere\"]\n";
    for (text, at) in [
        // A yawed body is not its own mirror image.
        (
            hover.replace("[flight]\n", "[flight]\nyaw_deg = 20\n"),
            "mirror",
        ),
        (format!("{before}{external}{rest}"), "command"),
    ] {
        let case = load(&text, &[]).unwrap();
        let error = Simulation::new(case.setup.clone())
            .map(|_| ())
            .expect_err(at);
        let report = case.refused(&error).to_string();
        let line = text.lines().position(|l| l.starts_with(at)).unwrap() + 1;
        assert!(report.contains(&format!("case.toml:{line}:")), "{report}");
    }
}

#[test]
fn behaves_air_without_wakes_has_no_frames() {
    let flown = |set: &[&str]| found("fruit-fly-hover", set).unwrap().output.frames_every;
    let [vacuum, blade] = ["air.model=none", "air.model=blade_element"];
    // What a file wants for the lattice stands by where the command line chooses another model.
    assert_eq!([flown(&[]), flown(&[vacuum]), flown(&[blade])], [2, 0, 0]);
    assert_eq!(flown(&[blade, "output.frames_every=0"]), 0);
    let said = found("fruit-fly-hover", &[blade, "output.frames_every=4"]);
    let said = said.map(|_| ()).unwrap_err().to_string();
    assert!(said.contains("no frames are written"), "{said}");
    // The resolved case is one of the same flight.
    let case = found("fruit-fly-hover", &[blade]).unwrap();
    let again = load(&case.resolved(), &[]).unwrap();
    assert_eq!(again.output, case.output);
}

/// So a script can put its own choices after those that it was given.
#[test]
fn behaves_of_a_key_that_is_set_twice_the_last_value_counts() {
    let beats = |set: &[&str]| {
        let set = [&["time.steps_per_beat=40"], set].concat();
        found("fruit-fly-hover", &set).unwrap().setup.time.steps
    };
    assert_eq!(beats(&["time.beats=1", "time.beats=3"]), 120);
    assert_eq!(beats(&["time.beats=3", "time.beats=1"]), 40);
    let said = found("fruit-fly-hover", &["time.beats=1", "time.beats=-2"]);
    let said = said.map(|_| ()).unwrap_err();
    assert!(said.contains("time.beats=-2 (set on top of"), "{said}");
}

/// What a file says of leading edges, wakes and sums may stand by where the edges that shed, how they do, or how velocities
/// are summed, are chosen on top of it; what is chosen on top itself has to act.
#[test]
fn behaves_files_keep_what_they_say_of_edges_that_are_chosen_otherwise() {
    for edges in ["[\"trailing\"]", "[\"trailing\", \"tip\"]", "[]"] {
        let shed = format!("air.shed={edges}");
        found("fruit-fly-tethered", &[&shed]).unwrap();
        let said = refusal("fruit-fly-tethered", &[&shed, "air.leading_edge=suction"]);
        assert!(
            said.contains("air.leading_edge") && said.contains("no effect"),
            "{said}"
        );
    }
    let said = refusal(
        "fruit-fly-tethered",
        &["air.shed=[]", "air.wake_core.algebraic.radius_m=1e-4"],
    );
    assert!(
        said.contains("air.wake_core") && said.contains("no effect"),
        "{said}"
    );
    found("fruit-fly-tethered", &["air.summation=direct"]).unwrap();
    let tolerance = "air.summation_tolerance=1e-4";
    let said = refusal("fruit-fly-tethered", &["air.summation=direct", tolerance]);
    assert!(said.contains("no effect with summation"), "{said}");
    // A file that contradicts itself is refused.
    let text = presets::find("fruit-fly-tethered").unwrap().text;
    let text = text.replace(
        "shed = [\"trailing\", \"tip\", \"leading\", \"root\"]",
        "shed = [\"trailing\"]",
    );
    let said = load(&text, &[]).unwrap_err();
    assert!(
        said.contains("air.leading_edge") && said.contains("no effect"),
        "{said}"
    );
}
