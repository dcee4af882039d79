//! What the prescribed motion tells of shedding edges.

use std::path::Path;

use wingbeat_air::LeadingEdge;
use wingbeat_case::{LoadedCase, presets::PRESETS};
use wingbeat_flight::{AirModel, FlightSetup, Simulation};
use wingbeat_math::DVec3;

/// Hovering strokes are alike back and forth, or nearly so; those of the tethered dragonfly, slowed and turned,
/// are not.
#[test]
fn behaves_one_sided_leading_edges_are_told_of_dragonflies_and_not_of_hovering_flight() {
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        let said = setup.one_sided_leading_edges();
        assert!(said.is_none(), "{}: {said:?}", preset.name);
    }
    let part = |name: &str| {
        let setup = LoadedCase::find(name, &[]).unwrap().setup;
        setup.one_sided_part(0)
    };
    let alike = part("robofly-symmetrical");
    println!("{alike:e} {}", part("fruit-fly-tethered"));
    assert!(alike < 1e-3 && part("fruit-fly-tethered") < 0.03); // measured 2e-4 and 0.015
    let with = |shed: &str| {
        let set = [
            format!("air.shed={shed}"),
            "air.leading_edge=suction".to_owned(),
        ];
        let setup = LoadedCase::find("dragonfly", &set).unwrap().setup;
        setup.one_sided_leading_edges()
    };
    let said = with(r#"["trailing", "tip", "leading"]"#).unwrap();
    assert!(
        said.contains("`fore-right`") && said.contains("`hind-left`"),
        "{said}"
    );
    // Free roots: the suction of the step before is left.
    let late = with(r#"["trailing", "tip", "leading", "root"]"#).unwrap();
    assert!(late.contains("the step before"), "{late}");
    let revolving = |more: &[&str]| {
        let set = [
            "flight.tether.yaw.rate_deg_s=6000",
            "motion.frequency_hz=0",
            "air.leading_edge=suction",
            r#"air.shed=["trailing", "tip", "leading"]"#,
        ];
        let still = ["phi", "theta", "psi"].map(|angle| {
            let deg = if angle == "psi" { 45 } else { 0 };
            format!("wing.right.motion.{angle}={{ constant_deg = {deg} }}")
        });
        let time = ["time={ step_s = 1e-4, steps = 100 }", "motion.data="];
        let all = set.iter().chain(&time).chain(more).map(|s| (*s).to_owned());
        let all: Vec<String> = all.chain(still).collect();
        LoadedCase::find("fruit-fly-tethered", &all).unwrap().setup
    };
    let said = revolving(&[]).one_sided_leading_edges().unwrap();
    assert!(
        said.contains("more one way than the other") && said.contains("100 %"),
        "{said}"
    );
    // A plate that heaves sheds as much of either sign, whatever part of a period the flight ends with.
    let heaves = [
        "flight.tether.yaw=",
        "flight.tether.z={ frequency_hz = 125, sine_m = [1e-3] }",
    ];
    assert_eq!(revolving(&heaves).one_sided_leading_edges(), None);
    let free = r#"air.shed=["trailing", "tip", "leading", "root"]"#;
    let implicit = [free, "air.leading_edge=suction_implicit"];
    assert_eq!(revolving(&implicit).one_sided_leading_edges(), None);
    // 6000 deg/s: 0.1 mm at a wing length of 2.4 mm in a step, a sixth of the chord, and eight times that.
    assert_eq!(revolving(&implicit).long_steps_one_way(), None);
    let long = [&implicit[..], &["time.step_s=2e-3"]].concat();
    let said = revolving(&long).long_steps_one_way().unwrap();
    assert!(said.contains("mean chords in a step"), "{said}");
    let heaving = [&long[..], &heaves].concat();
    assert_eq!(revolving(&heaving).long_steps_one_way(), None);
}

/// A glider at this incidence \[deg\], whose edges shed.
fn glider(incidence: f64, shed: &str) -> FlightSetup {
    let text = format!(
        "format = 1\n[time]\nstep_s = 0.025\nsteps = 50\n[flight]\nmode = \"tethered\"\npitch_deg = {incidence}\n\
         [air]\nstream_m_s = [-10, 0, 0]\nshed = {shed}\n\
         [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
         [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\njoined = true\n\
         planform.rectangle = {{ chord_m = 1, span_m = 2 }}\nmesh = {{ chordwise = 4, spanwise = 8 }}\n"
    );
    LoadedCase::from_text("glider", &text, Path::new(""), &[])
        .unwrap()
        .setup
}

/// The lift of such a glider at 2 deg.
fn lift(shed: &str) -> f64 {
    let mut flight = Simulation::new(glider(2.0, shed)).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let force: DVec3 = flight.record().air.iter().map(|a| a.force).sum();
    -force.z
}

/// Tips along which a wake goes carry a tenth too much at an aspect ratio of 4, and no preset flies so.
#[test]
fn agrees_tips_of_attached_wings_shed_what_is_told_of_them() {
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        let said = setup.tips_of_attached_wings();
        assert!(said.is_none(), "{}: {said:?}", preset.name);
    }
    let default = r#"["trailing", "tip", "leading"]"#;
    let more = lift(default) / lift(r#"["trailing"]"#);
    println!("{more}");
    assert!((1.08..1.13).contains(&more), "{more}");
    let said = |incidence, shed| glider(incidence, shed).tips_of_attached_wings();
    assert!(said(2.0, default).unwrap().contains("(`left`, `right`)"));
    assert_eq!(said(2.0, r#"["trailing"]"#), None);
    assert_eq!(said(10.0, default), None);
    let with = |choice: &str| {
        let mut setup = glider(2.0, default);
        let AirModel::VortexLattice(air) = &mut setup.air else {
            panic!("a lattice");
        };
        air.lattice.leading = match choice {
            "always" => LeadingEdge::Always,
            _ => LeadingEdge::Suction {
                threshold: 0.02,
                efficiency: 0.0,
            },
        };
        setup.tips_of_attached_wings()
    };
    assert_eq!(with("always"), None);
    assert_eq!(with("0.02"), None);
}

/// Without a wake from trailing edges there is no lift, whatever else sheds, and that is said in place of tips that make
/// it too high.
#[test]
fn limit_wings_whose_trailing_edges_shed_nothing_have_no_lift() {
    let part = lift(r#"["leading"]"#) / lift(r#"["trailing"]"#);
    assert!(part.abs() < 5e-3, "{part}"); // -9e-4: what the leading edge sheds
    for (shed, is_named) in [
        (r#"["leading"]"#, true),
        (r#"["tip", "root"]"#, true),
        (r#"["trailing", "tip", "leading"]"#, false),
        ("[]", false),
    ] {
        let setup = glider(2.0, shed);
        let said = setup.shed_without_trailing_edges();
        assert_eq!(said.is_some(), is_named, "{shed}: {said:?}");
        let of_tips = setup.tips_of_attached_wings();
        assert!(!is_named || of_tips.is_none(), "{shed}: {of_tips:?}");
    }
}

/// Edges that shed by the angle of attack shed nothing up to the threshold, and all beyond it.
#[test]
fn behaves_edges_that_shed_by_the_angle_of_attack_shed_beyond_it_alone() {
    let part = |incidence: f64| {
        let mut setup = glider(incidence, r#"["trailing", "leading"]"#);
        let AirModel::VortexLattice(air) = &mut setup.air else {
            panic!("a lattice");
        };
        air.lattice.leading = LeadingEdge::AngleOfAttack {
            threshold: 15.0_f64.to_radians(),
        };
        setup.one_sided_part(0)
    };
    assert_eq!([2.0, 14.9, 15.1].map(part), [0.0, 0.0, 1.0]);
}

/// Incidence beyond stall with leading edges that shed nothing, which attached presets do not have. A plate held at 20 deg is
/// beyond it, one at 10 deg is not; one that plunges fast by a twentieth of its chord, with more incidence than that for an
/// instant, has the forces of attached flow.
#[test]
fn behaves_attached_flow_beyond_stall_is_named() {
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        let said = setup.attached_beyond_stall();
        // 25 deg of flapping in a stream: tips meet the air at 38 deg.
        let is_beyond = preset.name == "flapping-rectangles";
        assert_eq!(said.is_some(), is_beyond, "{}: {said:?}", preset.name);
    }
    let foil = |pitch: f64, heave: f64, hertz: f64, shed: &str| {
        let text = format!(
            "format = 1\n[time]\nsteps_per_beat = 60\nbeats = 2\n[flight]\nmode = \"tethered\"\npitch_deg = {pitch}\n\
             tether.z = {{ frequency_hz = {hertz}, cosine_m = [{heave}] }}\n[motion]\nfrequency_hz = {hertz}\n\
             [air]\nstream_m_s = [-1, 0, 0]\nplane_wakes = {}\nshed = {shed}\n\
             [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
             [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\nmirror = false\nmotion.phi.constant_deg = 0\n\
             planform.rectangle = {{ chord_m = 1, span_m = 100 }}\n\
             mesh = {{ chordwise = 4, spanwise = 1, spanwise_spacing = \"uniform\" }}\n",
            !shed.contains("tip")
        );
        let case = LoadedCase::from_text("foil", &text, Path::new(""), &[]);
        case.unwrap().setup
    };
    let said =
        |pitch, heave, hertz| foil(pitch, heave, hertz, r#"["trailing"]"#).attached_beyond_stall();
    assert!(
        said(20.0, 1e-6, 0.1)
            .unwrap()
            .contains("19 deg of incidence") // the wake of the start has not left it altogether
    );
    assert_eq!(said(10.0, 1e-6, 0.1), None);
    // Reduced frequencies of 0.25 and 3.93: 27 deg, of which the wake leaves 20.57 (Duhamel's integral, apart), and 21 deg,
    // for an instant.
    let slow = 0.25 / std::f64::consts::PI;
    assert!(said(0.0, 1.0, slow).unwrap().contains("21 deg"));
    assert_eq!(said(0.0, 0.05, 3.93 / std::f64::consts::PI), None);
    let sheds = foil(20.0, 1e-6, 0.1, r#"["trailing", "leading"]"#);
    assert_eq!(sheds.attached_beyond_stall(), None);
    // Tips that shed make a note of it for wings that beat alone, and not of what is held or heaved by a tether.
    let tips = foil(20.0, 1e-6, 0.1, r#"["trailing", "tip"]"#);
    assert!(tips.attached_beyond_stall().is_some());
    assert_eq!(tips.attached_strokes_beyond_stall(), None);
    let fly = ["air.shed=[\"trailing\", \"tip\"]".to_owned()];
    let fly = LoadedCase::find("fruit-fly-hover", &fly).unwrap().setup;
    assert_eq!(fly.attached_beyond_stall(), None);
    assert!(fly.attached_strokes_beyond_stall().is_some());
    // Plane flow has neither roots nor tips that could hold: what is left is that edges shed by the step before.
    assert_eq!(sheds.one_sided_leading_edges(), None);
    let mut late = sheds;
    let AirModel::VortexLattice(air) = &mut late.air else {
        panic!("a lattice");
    };
    air.lattice.leading = LeadingEdge::Suction {
        threshold: 0.15,
        efficiency: 0.0,
    };
    let said = late.one_sided_leading_edges().unwrap();
    assert!(said.contains("the step before"), "{said}");
}

/// A foil that plunges at the reduced frequency 1 with 17 deg of incidence at most (a suction parameter of 0.29 without
/// its wake) is not beyond stall: Theodorsen's function leaves 0.55 of it. Flown with edges that hold 0.25 it sheds
/// nothing; one with twice the incidence is named, and sheds.
#[test]
fn agrees_what_is_beyond_stall_sheds_from_leading_edges_that_may() {
    for (heave, is_beyond) in [(0.15, false), (0.31, true)] {
        let foil = |edges: &str| {
            let text = format!(
                "format = 1\n[time]\nsteps_per_beat = 60\nbeats = 2\n[flight]\nmode = \"tethered\"\n\
                 tether.z = {{ frequency_hz = 0.318310, sine_m = [{heave}] }}\n[motion]\nfrequency_hz = 0.318310\n\
                 [air]\nstream_m_s = [-1, 0, 0]\nplane_wakes = true\n{edges}\n\
                 [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
                 [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\nmirror = false\nmotion.phi.constant_deg = 0\n\
                 planform.rectangle = {{ chord_m = 1, span_m = 100 }}\n\
                 mesh = {{ chordwise = 8, spanwise = 1, spanwise_spacing = \"uniform\" }}\n"
            );
            let case = LoadedCase::from_text("foil", &text, Path::new(""), &[]);
            case.unwrap().setup
        };
        let said = foil(r#"shed = ["trailing"]"#).attached_beyond_stall();
        assert_eq!(said.is_some(), is_beyond, "{said:?}");
        let mut flight = Simulation::new(foil(
            "shed = [\"trailing\", \"leading\"]\nleading_edge_threshold = 0.25",
        ))
        .unwrap();
        let mut shed = 0.0;
        while !flight.finished() {
            flight.step().unwrap();
            shed += flight.record().leading_rings;
        }
        assert_eq!(shed > 0.0, is_beyond, "{heave}: {shed}");
    }
}

/// Joined roots let circulation through, but tips that hold keep what strokes of one sign leave, too.
#[test]
fn behaves_tips_that_hold_are_told_where_leading_edges_shed_one_sign() {
    let plate = |shed: &str| {
        let text = format!(
            "format = 1\n[time]\nsteps_per_beat = 50\nbeats = 1\n[flight]\nmode = \"tethered\"\npitch_deg = 8\n\
             tether.z = {{ frequency_hz = 0.08, cosine_m = [-0.5] }}\n[motion]\nfrequency_hz = 0.08\n\
             [air]\nstream_m_s = [-1, 0, 0]\nleading_edge = \"suction_implicit\"\nshed = {shed}\n\
             [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
             [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\njoined = true\nmotion.phi.constant_deg = 0\n\
             planform.rectangle = {{ chord_m = 1, span_m = 3 }}\nmesh = {{ chordwise = 4, spanwise = 6 }}\n"
        );
        let case = LoadedCase::from_text("plate", &text, Path::new(""), &[]);
        case.unwrap().setup.one_sided_leading_edges()
    };
    let said = plate(r#"["trailing", "leading"]"#).unwrap();
    assert!(
        said.contains("as tips hold") && said.contains("let tips shed"),
        "{said}"
    );
    assert_eq!(plate(r#"["trailing", "tip", "leading"]"#), None);
}

/// A viscosity alone leaves the core its default radius; a liquid with the viscosity of air is named.
#[test]
fn behaves_liquids_with_the_viscosity_of_air_are_told() {
    let water = |more: &str| {
        let text = format!(
            "format = 1\n[time]\nstep_s = 0.1\nsteps = 5\n[flight]\nmode = \"tethered\"\npitch_deg = 5\n\
             [air]\nstream_m_s = [-1, 0, 0]\ndensity_kg_m3 = 1000\nshed = [\"trailing\"]\n{more}\n\
             [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
             [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\njoined = true\nmotion.phi.constant_deg = 0\n\
             planform.rectangle = {{ chord_m = 1, span_m = 3 }}\nmesh = {{ chordwise = 4, spanwise = 6 }}\n"
        );
        let case = LoadedCase::from_text("plate", &text, Path::new(""), &[]);
        case.unwrap().setup
    };
    let said = water("").foreign_viscosity_of_air().unwrap();
    assert!(said.contains("viscosity_m2_s (1e-6 for water)"), "{said}");
    let given = water("wake_core.algebraic.viscosity_m2_s = 1e-6");
    assert_eq!(given.foreign_viscosity_of_air(), None);
    let AirModel::VortexLattice(air) = &given.air else {
        panic!("a lattice");
    };
    let chord = given.animal.wings[0].report().mean_chord;
    let radius = air.lattice.wake_core.radius().unwrap();
    assert!((radius - 0.07 * chord).abs() < 1e-12 * chord); // roundings
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        assert_eq!(setup.foreign_viscosity_of_air(), None);
    }
}
