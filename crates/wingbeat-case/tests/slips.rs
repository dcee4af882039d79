//! Slips that users make: units, names, signs, choices; each is named where it was made.

use std::path::Path;

use crate::common::{self, found, preset, refusal};
use wingbeat_case::{LoadedCase, presets};

#[test]
fn refuses_slips_by_name() {
    let twist = "wing.right.deformation.twist=[{ table_deg = [[0, 0], [40, 6], [100, 22]] }]";
    let beam = "wing.right.structure.beam";
    let shell = "wing.right.structure.shell";
    let table = format!(
        "{beam}={{ flap_newton_m2 = [1e-4, 1e-5], torsion_table_newton_m2 = [[0, 1e-4], [50, 1e-5], [100, 1e-6]] }}"
    );
    for (case, set, says) in [
        ("bird-cruise", &[twist][..], "per cent by 100"),
        ("hawkmoth-elastic", &[&table], "per cent by 100"),
        (
            "fruit-fly-blade", // has body.length_m
            &["body.part.thorax.profile={table=[[0,0.9],[0.2,0.6],[1,0]]}"],
            "body.part.thorax: thorax.profile, row 1",
        ),
        (
            "hawkmoth-elastic",
            &["dynamics.wings=massless"],
            "is elastic",
        ),
        (
            "hawkmoth-elastic",
            &["wing.right.mass_kg=0"],
            "wing.right.mass_kg = 0",
        ),
        (
            "hawkmoth-veins",
            &[&format!("{shell}.poisson=-1")],
            "shell.poisson = -1",
        ),
        (
            "hawkmoth-veins",
            &["wing.right.structure.region=[{}]"],
            "made of the same as the rest",
        ),
        ("fruit-fly-hover", &["wing=[1]"], "allowed: a table"),
        (
            "fruit-fly-hover",
            &["wing.rihgt.mass_kg=1e-9"],
            "did you mean wing.right?",
        ),
        (
            "fruit-fly-hover",
            &["wing.right.planform.rectangle.chord_m=1e-3"],
            "beta and rectangle at once",
        ),
        (
            "fruit-fly-hover",
            &["wing.right.motion.phi={}"],
            "none is chosen",
        ),
        (
            "bird-cruise",
            &["wing.right.motion.phi.constant_rad=1"],
            "phi = { constant_deg = ... }",
        ),
        (
            "fruit-fly-hover",
            &["air.wake_core.algebraic.radius_mm=0.05"],
            "try: `radius_m`",
        ),
        (
            "fruit-fly-hover",
            &["air.wake_core.algebraic.radius_inch=0.05"],
            "try: `radius_m`",
        ),
        (
            "fruit-fly-hover",
            &["air.wake_core.algebraic.radius_chord=0.05"],
            "try: `radius_chords`",
        ),
    ] {
        let said = refusal(case, set);
        assert!(
            said.contains(says) && said.contains("try: "),
            "{set:?}: {said}"
        );
    }
}

#[test]
fn refuses_strips_in_other_units() {
    let text = presets::find("bird-cruise").unwrap().text;
    let (before, after) = text.split_once("[wing.right]").unwrap();
    let mass = after.lines().find(|l| l.starts_with("mass_kg")).unwrap();
    let load = |rows: &str| {
        let strips = format!("areal_density_table_m_kg_m2 = {rows}");
        let text = format!("{before}[wing.right]{}", after.replacen(mass, &strips, 1));
        LoadedCase::from_text("strips", &text, Path::new("."), &[])
    };
    load("[[0.02, 0.5], [0.3, 0.1]]").unwrap();
    for rows in ["[[0, 0.5], [330, 0.1]]", "[[0, 0.5], [0.1, 0.1]]"] {
        let said = load(rows).unwrap_err().to_string();
        assert!(said.contains("distances are in metres"), "{said}");
    }
}

/// Fibres of a sheet alike in all directions have no direction; those of one that is not have.
#[test]
fn refuses_fibres_without_direction() {
    let shell = "wing.right.structure.shell";
    let film =
        format!("{shell}={{ young_pa = 3e9, thickness_m = [1e-4, 1e-4], fibre_angle_deg = 20 }}");
    let load = |more: &[&str]| {
        let set = [&[&film[..]], more].concat();
        found("hawkmoth-veins", &set).map(drop)
    };
    let said = load(&[]).unwrap_err();
    let says = "wing.right.structure.shell.fibre_angle_deg = 20: must be 0 in a sheet alike";
    assert!(said.contains(says), "{said}");
    for (key, value) in [
        ("young_chord_pa", "1e9"),
        ("shear_pa", "5e8"),
        ("prestress_newton_per_m", "[1, 0]"),
    ] {
        load(&[&format!("{shell}.{key}={value}")]).unwrap();
    }
    // A region that takes its fibres from the sheet gives them an effect, too.
    load(&["wing.right.structure.region=[{ young_pa = 1e9, young_chord_pa = 2e9 }]"]).unwrap();
    let own = "wing.right.structure.region=[{ fibre_angle_deg = 3, young_pa = 1e9 }]";
    let said = load(&[&format!("{shell}.fibre_angle_deg=0"), own]).unwrap_err();
    assert!(said.contains("region[0].fibre_angle_deg = 3"), "{said}");
}

/// Left wings have the signs of their mirror images; deformation in millimetres for metres.
#[test]
fn behaves_implausible_motions_are_doubted() {
    let doubts = |case: &str, set: &[&str]| {
        let case = preset(case, set);
        wingbeat_analysis::estimate(&case.setup).doubts.join("\n")
    };
    let both = |left: f64| {
        let [left, right] = [("left", left), ("right", 60.0)].map(|(wing, angle)| {
            format!("wing.{wing}.motion.phi={{ fourier = {{ sine_deg = [{angle}] }} }}")
        });
        doubts("fruit-fly-hover", &["air.mirror=false", &left, &right])
    };
    let against = "stroke against each other";
    assert!(both(60.0).contains(against) && !both(-60.0).contains(against));
    let feathered = "wing.right.motion.psi.constant_deg=2";
    let crossing = "pass through each other";
    for air in ["vortex_lattice", "blade_element"] {
        let model = format!("air.model={air}");
        let said = doubts("bird-cruise", &[feathered, &model]);
        assert!(!said.contains(crossing), "{air}: {said}");
    }
    assert!(doubts("bird-cruise", &[feathered, "wing.right.joined=false"]).contains(crossing));
    let inside = "wings `left` and `right` are inside the body part `trunk` in 100 % of the beat";
    for (body, told) in [("true", true), ("false", false)] {
        let said = doubts("bird-cruise", &[&format!("air.body={body}")]);
        assert_eq!(said.contains(inside), told, "{said}");
    }
    let bent = "wing.right.deformation.bending=[{ table_m = [[0, 0], [0.5, 4], [1, 25]], fourier = { sine = [1] } }]";
    let twisted = "wing.right.deformation.twist=[{ table_deg = [[0, 0], [1, 120]], fourier = { sine = [1] } }]";
    for (set, says) in [
        (bent, "bending is in metres"),
        (twisted, "twist is in degrees"),
    ] {
        let said = doubts("bird-cruise", &[set]);
        assert!(said.contains(says), "{said}");
        assert!(!doubts("bird-cruise", &[]).contains(says));
    }
}

/// Cores that do not spread say nothing of the air around them.
#[test]
fn exact_reynolds_number_beside_cores_that_stay_as_they_are_is_that_of_air() {
    let reynolds = |set: &[String]| {
        let case = LoadedCase::find("fruit-fly-hover", set).unwrap();
        wingbeat_analysis::estimate(&case.setup).wings[0].reynolds
    };
    let still = "air.wake_core.algebraic.viscosity_m2_s=0".to_owned();
    assert!(reynolds(&[]).is_some_and(f64::is_finite));
    assert_eq!(reynolds(&[still]), reynolds(&[]));
}

/// Minutes of blade elements are no estimate.
#[test]
fn refuses_to_estimate_lift_in_a_million_steps() {
    let set = ["time.steps_per_beat=1000000".to_owned()];
    let case = LoadedCase::find("robobee", &set).unwrap();
    let estimate = wingbeat_analysis::estimate(&case.setup);
    let why = estimate.lift_left_out.unwrap();
    for word in ["1000000 steps", "at most 10000", "time.steps_per_beat"] {
        assert!(why.contains(word), "{why}");
    }
}

/// Steps on trial that are too long for a stiff hinge have the lift of short ones.
#[test]
fn agrees_lift_beside_stiff_hinges_with_that_of_short_steps() {
    let text = include_str!("data/stiff-hinge.toml");
    let estimate = |set: &[&str]| {
        let case = common::load(text, set).unwrap();
        wingbeat_analysis::estimate(&case.setup)
    };
    let lift = |set: &[&str]| {
        let all = estimate(set);
        assert!(all.lift_left_out.is_none() && all.wings.len() == 2);
        all.lift_over_weight.unwrap()
    };
    let [fine, coarse] = [&[][..], &["time.steps_per_beat=40"]].map(lift);
    // 400 and 60 steps, of second order and more.
    assert!((coarse / fine - 1.0).abs() < 1e-4, "{coarse} {fine}");
}

/// A wing that a tether revolves meets air at its tip's speed, one that is pitched about its span in a stream
/// at that of the stream, and one wing alone may span both sides of the body.
#[test]
fn behaves_wings_on_tethers_have_the_speed_of_their_tips() {
    let text = "format = 1
[time]
step_s = 0.01
steps = 50
[body]
mass_kg = 0.1
inertia_about_centre_kg_m2 = [1e-4, 1e-4, 1e-4, 0, 0, 0]
[wing.right]
mirror = false
hinge_m = [0, -1, 0]
mass_kg = 0
planform.rectangle = { chord_m = 0.1, span_m = 3 }
[flight]
mode = \"tethered\"
";
    let estimate = |set: &[&str]| {
        let case = common::load(text, set);
        wingbeat_analysis::estimate(&case.unwrap_or_else(|e| panic!("{e}")).setup)
    };
    let speed = |set: &[&str]| estimate(set).wings[0].speed;
    let turned = speed(&["flight.tether.yaw.rate_deg_s=180"]);
    // The tip is at 2 m; half a panel's diagonal farther for its corner.
    assert!(
        (turned / (2.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3,
        "{turned}"
    );
    let pitched = speed(&[
        "air.stream_m_s=[-1, 0, 0]",
        "flight.tether.pitch={ frequency_hz = 2, sine_deg = [5] }",
    ]);
    assert!((pitched - 1.0).abs() < 0.1, "{pitched}");
    let doubts = estimate(&[]).doubts;
    assert!(
        !doubts.iter().any(|d| d.contains("hinge_m[1]")),
        "{doubts:?}"
    );
}

#[test]
fn refuses_hinges_that_differ_where_half_of_the_air_is_computed() {
    let left = |stiffness: &str| {
        format!(
            "joint.hinge-left={{ child = \"left\", kind = \"revolute\", axis = [0, 1, 0], element = [{{ stiffness_newton_m_per_rad = {stiffness}, damping_newton_m_s_per_rad = 2e-10 }}, {{ stop = {{ lower_deg = -75, upper_deg = 75, stiffness_newton_m_per_rad = 2e-5, damping_s_per_rad = 1e-4 }} }}] }}"
        )
    };
    let said = refusal("robobee", &[&left("2.4")]);
    for part in [
        "joint.hinge-left.element[0].stiffness_newton_m_per_rad",
        "joint.hinge-right",
        "air.mirror",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let wholly = ["air.mirror=false".to_owned(), left("2.4")];
    LoadedCase::find("robobee", &wholly).unwrap();
    LoadedCase::find("robobee", &[left("2.4e-6")]).unwrap();
}

#[test]
fn behaves_hinges_in_other_units_and_beyond_their_stops_are_doubted() {
    let doubts = |set: &str| {
        let case = LoadedCase::find("robobee", &[set.to_owned()]).unwrap();
        wingbeat_analysis::estimate(&case.setup).doubts.join("; ")
    };
    let spring = doubts("joint.hinge-right.element[0].stiffness_newton_m_per_rad=2.4");
    assert!(
        spring.contains("joint `hinge-right`: frequency of what hangs on its spring")
            && spring.contains("is above 100:"),
        "{spring}"
    );
    let start = doubts("joint.hinge-right.start_deg=[90]");
    let says = "joint `hinge-right` starts at 90.0 deg, beyond its stop from -75.0 to 75.0 deg";
    assert!(start.contains(says), "{start}");
    let sound = doubts("joint.hinge-right.start_deg=[70]");
    assert!(!sound.contains("joint `"), "{sound}");
}

#[test]
fn refuses_numbers_without_digits_and_keys_of_other_tables() {
    for (set, says) in [
        (
            "air.stream_m_s=[.1,.3,-.2]",
            &["air.stream_m_s=[0.1,0.3,-0.2]", "no numbers like .5"][..],
        ),
        ("flight.pitch_deg=5.", &["flight.pitch_deg=5.0"]),
        (
            "dynamics.corrector.tolerance=1e-9",
            &["unknown key `corrector`", "did you mean `corrector`?"],
        ),
        ("flight.frequency_hertz=3", &["remove it"]),
    ] {
        let said = refusal("fruit-fly-blade", &[set]);
        for words in says {
            assert!(said.contains(words), "{set}: {said}");
        }
        assert!(!said.contains("takes it away"), "{said}");
    }
}

#[test]
fn refuses_a_gust_through_the_ground_in_words() {
    let set = [
        "air.ground={ point_m = [0, 0, 1], normal = [0, 0, -1] }",
        "air.gust=[{ amplitude_m_s = [0, 0, 1], duration_s = 0.01 }]",
    ];
    let said = refusal("fruit-fly-tethered", &set);
    assert!(
        said.contains("air.gust") && said.contains("the gust blows through the ground"),
        "{said}"
    );
}

/// A place in millimetres for metres; half a metre in two seconds is flown.
#[test]
fn behaves_ways_that_no_flyer_covers_are_doubted() {
    let doubts = |waypoints: &str| {
        let set = format!("control.waypoint={waypoints}");
        let case = LoadedCase::find("fruit-fly-controlled", &[set]).unwrap();
        case.doubtful_ways(&wingbeat_analysis::estimate(&case.setup))
    };
    assert_eq!(doubts("[{time_s=2, position_m=[0.5, 0, 0]}]"), [""; 0]);
    let far = "{time_s=0.1, heading_deg=10}, {time_s=0.3, position_m=[7.5, 0, 0]}";
    let [said] = &doubts(&format!("[{far}, {{time_s=9, position_m=[8, 0, 0]}}]"))[..] else {
        panic!("one way is too fast");
    };
    // 35/16 of 7.5 m in 0.2 s.
    assert!(
        said.starts_with("control.waypoint[1]: the way there takes up to 82.031 m/s"),
        "{said}"
    );
    assert!(said.contains("is position_m in metres"), "{said}");
}

#[test]
fn refuses_a_choice_without_its_value_and_one_with_a_value_that_has_none() {
    for (set, says) in [
        (
            "air.blade.centre_of_pressure=fixed",
            "air.blade.centre_of_pressure.fixed = ...",
        ),
        (
            "wing.right.motion.phi=fourier",
            "wing.right.motion.phi.fourier = ...",
        ),
        (
            "air.blade.centre_of_pressure={cosine=1}",
            "air.blade.centre_of_pressure = \"cosine\"",
        ),
    ] {
        let said = refusal("fruit-fly-blade", &[set]);
        assert!(said.contains(says), "{said}");
        assert!(!said.contains("variant"), "{said}");
    }
}

/// Values of overrides that begin as a list or a table, or are numbers, and are no TOML.
#[test]
fn refuses_slips_of_lists_tables_and_numbers_where_they_are() {
    for (set, says) in [
        (
            "air.gust=[{amplitude_m_s=[0,0,1],duration_s=1]",
            "this is not TOML: ",
        ),
        ("air.gust=[{amplitude_m_s=[0,0,1],duration_s=1]", ", at `]`"),
        ("air.shed=[trailing]", "texts stand between quotes"),
        ("control={ controller = \"regulator\"", ", at its end"),
        (
            "air.gust=[{amplitude_m_s=[0,0,1], seed=9223372036854775808}]",
            "at `9223372036854775808}]`",
        ),
        (
            "output.frames_every=9223372036854775808",
            "this is not TOML",
        ),
        (
            "air.gust=[{amplitude_m_s=[0,0,1], turbulence={ time_scale_s=1, seed=-1 }}]",
            "a whole number >= 0",
        ),
    ] {
        let said = refusal("fruit-fly-blade", &[set]);
        assert!(said.contains(says), "{set}: {said}");
    }
}

/// What is no case and no preset, but something else that the program knows.
#[test]
fn refuses_species_and_campaigns_with_the_command_that_takes_them() {
    let said = refusal("honeybee", &[]);
    assert!(said.contains("`wingbeat new --species honeybee`"), "{said}");
    let text = "case = \"fruit-fly-blade\"\nkeep = [\"power_watt\"]\n[budget]\n";
    let map = LoadedCase::from_text("map.toml", text, Path::new(""), &[]);
    let said = map.expect_err("a campaign").to_string();
    assert!(said.contains("`wingbeat campaign run map.toml`"), "{said}");
}

/// A bound of a time is written without the rounding of its sum.
#[test]
fn refuses_waypoints_within_a_wingbeat_with_a_plain_bound() {
    let waypoints = "control.waypoint=[{time_s=0.1}, {time_s=0.101}]";
    let said = refusal(
        "fruit-fly-controlled",
        &[waypoints, "motion.frequency_hz=200"],
    );
    assert!(said.contains("allowed: a number >= 0.105\n"), "{said}");
}

/// What is rigid with the wing frame does not bend: veins and regions there have no effect but by their mass.
#[test]
fn refuses_veins_and_regions_where_the_sheet_is_held() {
    let film = "wing.right.structure={ shell={ young_pa = 3e9, thickness_m = [1e-4, 1e-4], rigid_fraction = 0.5 } }";
    let vein = |more: &str| {
        format!(
            "wing.right.structure.vein=[{{ radius_m = [1e-4, 1e-4], young_pa = 1e9, from = [0, 0], to = [0, 1]{more} }}]"
        )
    };
    let region = |x: f64| {
        format!(
            "wing.right.structure.region=[{{ chord_range = [0, {x}], prestress_newton_per_m = [1, 0] }}]"
        )
    };
    let said = |key: &str| refusal("hawkmoth-veins", &[film, key]);
    assert!(said(&vein("")).contains("vein[0]: this has no effect"));
    assert!(said(&region(0.4)).contains("region[0]: this has no effect"));
    for key in [vein(", density_kg_m3 = 1200"), region(0.8)] {
        let set = [film.to_owned(), key];
        LoadedCase::find("hawkmoth-veins", &set).unwrap();
    }
    let rule = "wing.right.structure={ shell={ rule = \"combes_daniel\", density_kg_m3 = 1200 } }";
    let said = refusal("hawkmoth-veins", &[rule]);
    assert!(said.contains("shell.density_kg_m3 = 1200"), "{said}");
}

/// Masses of parts that only share out that of the body are doubted where they are in another unit than it.
#[test]
fn behaves_masses_of_parts_in_another_unit_are_doubted() {
    let doubts = |set: &[&str]| {
        let found = preset("fruit-fly-blade", set).doubtful_measurements();
        found.join("\n")
    };
    let grams = doubts(&["body.part.thorax.mass_kg=0.4372e-3"]);
    assert!(grams.contains("weigh 4.377e-4 kg together"), "{grams}");
    assert!(!doubts(&[]).contains("weigh"), "rounded shares");
}

/// What is missing or too large is said in words that can be acted on.
#[test]
fn refuses_too_many_steps_by_their_number_and_cases_without_a_format() {
    let said = refusal("fruit-fly-blade", &["time.beats=1e300"]);
    assert!(said.contains("1.000e302 steps are too many"), "{said}");
    let said = refusal("fruit-fly-blade", &["time.beats=1e8"]);
    assert!(said.contains("10000000000 steps are too many"), "{said}");
    let bare = LoadedCase::from_text("bare", "name = \"x\"", Path::new(""), &[]);
    let said = bare.expect_err("no format").to_string();
    assert!(said.contains("add `format = 1`"), "{said}");
}

/// What begins as a number and is none, or none that a computer has, is not called a text.
#[test]
fn refuses_numbers_that_are_too_large_or_none() {
    for (typed, says) in [
        ("1e999", "this number is too large: the largest is 1.8e308"),
        ("-1.8e308", "this number is too large"),
        ("--1", "this is not TOML"),
    ] {
        let said = refusal("fruit-fly-blade", &[&format!("flight.pitch_deg={typed}")]);
        assert!(said.contains(says) && !said.contains("a text\n"), "{said}");
    }
}
