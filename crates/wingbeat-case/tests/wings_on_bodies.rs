//! Wings whose roots lie on a body: their circulation goes on through it, and what is said where it does not.

use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_case::presets::PRESETS;
use wingbeat_flight::{AirModel, FlightSetup, Simulation};
use wingbeat_math::DVec3;

/// Rectangular wings of chord 0.2 m at 4 deg in a stream of 10 m/s on a spheroid of length 1.6 m and diameter 0.2 m.
struct Case {
    /// Places of root and tip from the middle \[m\]; wings that meet there are joined.
    span: [f64; 2],
    /// Panels along the span.
    spanwise: usize,
    /// Stations of the body, of 16 meridians; none: no body in the air.
    stations: Option<usize>,
    /// Edges that shed.
    shed: &'static str,
    /// Lines more.
    more: &'static str,
}

const ON_BODY: Case = Case {
    span: [0.1, 0.5],
    spanwise: 8,
    stations: Some(24),
    shed: "\"trailing\"",
    more: "",
};

impl Case {
    fn setup(&self) -> FlightSetup {
        self.setup_with(&[])
    }

    /// With these keys set on top.
    fn setup_with(&self, keys: &[&str]) -> FlightSetup {
        let [root, tip] = self.span;
        let text = format!(
            "format = 1\ngravity_m_s2 = [0, 0, 0]\n[time]\nstep_s = 0.005\nsteps = 60\n[flight]\nmode = \"tethered\"\npitch_deg = 4\n\
             [air]\ndensity_kg_m3 = 1\nstream_m_s = [-10, 0, 0]\nshed = [{shed}]\nbody = {body}\n\
             wake_core.algebraic.radius_chords = 0.01\nwake_overlap = 0\nsection_drag = {{ friction = \"none\" }}\n\
             [body]\nmass_kg = 0.1\ninertia_about_centre_kg_m2 = [1e-2, 1e-2, 1e-2, 0, 0, 0]\n\
             [body.part.trunk]\ncentre_m = [0, 0, 0]\nlength_m = 1.6\ndiameter_m = 0.2\nmeridians = 16\nstations = {stations}\n\
             [wing.right]\nhinge_m = [0.05, {root}, 0]\nmass_kg = 0\njoined = {joined}\n\
             planform.rectangle = {{ chord_m = 0.2, span_m = {length}, axis_fraction = 0.25 }}\n\
             mesh = {{ chordwise = 4, spanwise = {spanwise} }}\n{more}",
            shed = self.shed,
            body = self.stations.is_some(),
            stations = self.stations.unwrap_or(6),
            joined = root == 0.0,
            length = tip - root,
            spanwise = self.spanwise,
            more = self.more,
        );
        let keys: Vec<String> = keys.iter().map(|k| (*k).into()).collect();
        LoadedCase::from_text("wing-body", &text, Path::new(""), &keys)
            .unwrap()
            .setup
    }

    fn fly(&self, keys: &[&str]) -> Simulation {
        let mut flight = Simulation::new(self.setup_with(keys)).unwrap();
        while !flight.finished() {
            flight.step().unwrap();
        }
        flight
    }

    /// Lift of the body, and of the wings, after six chords \[N\].
    fn lift(&self) -> [f64; 2] {
        let flight = self.fly(&["time.steps=24"]);
        let record = flight.record();
        let up = |forces: &[DVec3]| forces.iter().map(|f| -f.z).sum::<f64>();
        let forces: Vec<DVec3> = record.air.iter().map(|a| a.force).collect();
        [up(&forces[..1]), up(&forces[1..])]
    }
}

/// Roots whose circulation goes on through the body shed nothing, whatever `air.shed` says of roots.
#[test]
fn exact_roots_on_bodies_shed_nothing() {
    let [with, without] =
        ["\"trailing\", \"tip\", \"root\"", "\"trailing\", \"tip\""].map(|shed| {
            let flight = Case { shed, ..ON_BODY }.fly(&["time.steps=8"]);
            flight
                .record()
                .air
                .iter()
                .map(|a| a.force)
                .collect::<Vec<DVec3>>()
        });
    assert!(with[0].z < 0.0);
    assert_eq!(with, without);
}

#[test]
fn behaves_roots_on_bodies_are_carried_through_or_named() {
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        let said = setup.roots_on_bodies();
        assert!(said.is_empty(), "{}: {said:?}", preset.name);
        if let AirModel::VortexLattice(air) = &setup.air {
            assert_eq!(setup.carried_pairs(air), [], "{}", preset.name);
        }
    }
    let carried = |case: Case| {
        let setup = case.setup();
        let AirModel::VortexLattice(air) = &setup.air else {
            panic!("a lattice")
        };
        (setup.carried_pairs(air).len(), setup.roots_on_bodies())
    };
    assert_eq!(carried(ON_BODY), (1, vec![]));
    let (pairs, said) = carried(Case {
        stations: Some(6),
        ..ON_BODY
    });
    assert!(pairs == 1 && said[0].contains("2.0 chords long beside the roots"));
    assert!(said[0].contains("4.0 times as many stations (body.part.trunk.stations)"));
    let sheds = Case {
        shed: "\"trailing\", \"tip\", \"root\"",
        ..ON_BODY
    };
    assert_eq!(carried(sheds), (1, vec![]));
    let (pairs, said) = carried(Case {
        more: "mirror = false\n",
        ..ON_BODY
    });
    assert!(pairs == 0 && said[0].contains("root of wing `right` lies on the body part `trunk`"));
    for span in [[0.16, 0.5], [0.0, 0.5]] {
        let beside_or_inside = Case { span, ..ON_BODY };
        assert_eq!(carried(beside_or_inside), (0, vec![]));
    }
    // 0.15 chords off.
    let (pairs, said) = carried(Case {
        span: [0.13, 0.5],
        ..ON_BODY
    });
    assert!(pairs == 0 && said.len() == 1, "{said:?}");
    assert!(said[0].contains("roots off the body part `trunk`") && said[0].contains("`right`"));
}

/// What lies in the way of the circulation: thin bodies, hinges of their own, roots that bend away, that sit
/// high, wakes that end within the body.
#[test]
fn behaves_what_is_in_the_way_through_a_body_is_named() {
    let carried = |keys: &[&str]| {
        let setup = ON_BODY.setup_with(keys);
        let AirModel::VortexLattice(air) = &setup.air else {
            panic!("a lattice")
        };
        let said = setup.roots_on_bodies();
        assert!(said.len() < 2, "{said:?}");
        (setup.carried_pairs(air).len(), said.concat())
    };
    let thin = [
        "body.part.trunk.diameter_m=0.04",
        "wing.right.hinge_m=[0.05,0.02,0]",
    ];
    let (pairs, said) = carried(&thin);
    assert!(
        pairs == 0 && said.contains("a quarter of a chord wide"),
        "{said}"
    );
    let bent = [
        "wing.right.deformation.bending=[{ table_m = [[0,0.1],[1,0.1]], fourier = { mean = 1 } }]",
    ];
    let (pairs, said) = carried(&bent);
    assert!(
        pairs == 0 && said.contains("roots off the body part `trunk`"),
        "{said}"
    );
    let hinged = Case {
        more: "[joint.flap]\nchild = \"right\"\nkind = \"revolute\"\naxis = [1, 0, 0]\n",
        ..ON_BODY
    };
    let said = hinged.setup_with(&["wing.right.mass_kg=0.01"]);
    assert!(
        said.roots_on_bodies()
            .concat()
            .contains("no joints of their own")
    );
    let high = ["wing.right.hinge_m=[0.05,0.0866,-0.05]"];
    let short = ["air.max_wake_rows=10"];
    for (keys, says) in [
        (
            &high[..],
            "lie high or low on the body part `trunk`, 0.6 of its half width",
        ),
        (
            &short,
            "ends, or turns to particles, within a length of the body part `trunk`",
        ),
    ] {
        let (pairs, said) = carried(keys);
        assert!(
            pairs == 1 && said.contains(says),
            "{keys:?}: {pairs} {said}"
        );
    }
    assert_eq!(carried(&["air.max_wake_rows=40"]), (1, String::new()));
}

/// Slender-body theory: wings on a cylinder have K_W times their lift when put together, the cylinder K_B times
/// \[NACA Report 1307\]; r is its radius, s half the span.
#[test]
fn agrees_lift_of_wings_on_a_body_with_slender_body_theory() {
    for (r_over_s, wings, body) in [(0.2, 1.162, 0.278), (0.3, 1.253, 0.437)] {
        let half: f64 = 0.1 / r_over_s;
        let spanwise = (20.0 * (half - 0.1)).round() as usize;
        let on_body = Case {
            span: [0.1, half],
            spanwise,
            ..ON_BODY
        };
        let together = Case {
            span: [0.0, half - 0.1],
            spanwise,
            stations: None,
            ..ON_BODY
        };
        let [of_body, of_wings] = on_body.lift();
        let [_, alone] = together.lift();
        let [on_wings, on_body] = [of_wings / alone, of_body / alone];
        println!("r/s {r_over_s}: wings {on_wings:.3} of {wings}, body {on_body:.3} of {body}");
        // The theory is one of wings of no aspect ratio; these have 4 and 2.3.
        assert!((on_wings / wings - 1.0).abs() < 0.03, "{on_wings}");
        assert!((on_body / body - 1.0).abs() < 0.3, "{on_body}");
    }
}

/// Two ways to the mean force of a beat: what acts on wings, body and what leads through it, and the rate of
/// the impulse of all vorticity. Attached wings beat by 20 deg at 5 Hz.
#[test]
fn agrees_force_on_wings_and_body_with_the_rate_of_the_impulse() {
    let case = Case {
        more: "[motion]\nfrequency_hz = 5\n[wing.right.motion.phi.fourier]\nsine_deg = [20]\n",
        ..ON_BODY
    };
    let mut flight = Simulation::new(case.setup()).unwrap();
    let mut marks = vec![];
    while !flight.finished() {
        flight.step().unwrap();
        let record = flight.record();
        if [20, 60].contains(&record.step) {
            marks.push([-record.vortex_impulse, record.inviscid_impulse]);
        }
    }
    let [by_vortices, by_forces] = [0, 1].map(|k| marks[1][k] - marks[0][k]);
    let apart = (by_vortices - by_forces).length() / by_forces.length();
    println!("{by_vortices} and {by_forces} N s, {apart:.4} apart");
    // Panels of half a chord on the body; 0.003 to 0.012 for a bird's wings on three bodies.
    assert!(apart < 0.03, "{apart}");
}

/// Wings that shed from leading edges, too, for half a beat: both sides computed, with all sums direct and with
/// trees, and one side with its mirror image.
#[test]
fn invariant_left_is_right_and_one_side_with_its_image_is_both() {
    let case = Case {
        shed: "\"trailing\", \"leading\", \"tip\"",
        more: "[motion]\nfrequency_hz = 5\n[wing.right.motion.phi.fourier]\nsine_deg = [20]\n",
        ..ON_BODY
    };
    let forces = |keys: &[&str]| -> Vec<DVec3> {
        let mut flight = Simulation::new(case.setup_with(keys)).unwrap();
        while !flight.finished() {
            flight.step().unwrap();
        }
        flight.record().air.iter().map(|a| a.force).collect()
    };
    // Cores of the default; with small ones errors of trees grow a hundred times faster.
    let still = [
        "time.steps=20",
        "air.wake_core.algebraic.radius_chords=0.07",
        "air.wake_overlap=1",
    ];
    // Roundings, and the errors of trees, before the flow makes more of them.
    let sums = [
        (&["air.summation=direct"][..], 2e-14),
        (&["air.summation=tree", "time.steps=10"], 5e-7),
    ];
    for (sums, tolerance) in sums {
        let both = forces(&[&still[..], sums].concat());
        let [left, right] = [both[1], both[2]];
        let unlike = (left - DVec3::new(right.x, -right.y, right.z)).length() / right.length();
        println!("{sums:?}: left and right {unlike:.1e}");
        assert!(unlike < tolerance, "{sums:?}: {unlike}");
    }
    let [both, half] = ["false", "true"].map(|m| {
        let keys = ["air.summation=direct", &format!("air.mirror={m}")];
        forces(&[&still[..], &keys].concat())
    });
    let apart = both.iter().zip(&half).map(|(a, b)| (*a - *b).length());
    let apart = apart.fold(0.0, f64::max) / both[1].length();
    println!("one side and both {apart:.1e}");
    assert!(apart < 1e-11, "{apart}");
}

/// Where roots meet and are not joined air passes between them: lift is lost, which is said; no preset is flown so.
#[test]
fn behaves_roots_that_meet_and_are_not_joined_are_named() {
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        let said = setup.unjoined_roots();
        assert!(said.is_empty(), "{}: {said:?}", preset.name);
    }
    let case = Case {
        span: [0.0, 0.5],
        stations: None,
        ..ON_BODY
    };
    let lift = |keys: &[&str]| {
        let setup = case.setup_with(keys);
        let said = setup.unjoined_roots();
        let mut flight = Simulation::new(setup).unwrap();
        while !flight.finished() {
            flight.step().unwrap();
        }
        let wings = &flight.record().air[1..];
        (wings.iter().map(|a| -a.force.z).sum::<f64>(), said)
    };
    let (joined, none) = lift(&[]);
    let (apart, said) = lift(&["wing.right.joined=false"]);
    println!("lift joined {joined:.3} N, apart {apart:.3} N");
    assert!(apart < 0.9 * joined && none.is_empty());
    assert!(said.len() == 1 && said[0].contains("join them (joined = true of the wing)"));
    // Filaments of both that cancel, a fifth of the chord from root to root, and roots that are meant to shed.
    for keys in [
        "wing.right.mesh.spanwise_spacing=\"cosine\"",
        "air.scheme=\"benchmark\"",
        "wing.right.hinge_m=[0.05, 0.02, 0]",
        "air.shed=[\"trailing\", \"tip\", \"leading\", \"root\"]",
    ] {
        let setup = case.setup_with(&["wing.right.joined=false", keys]);
        assert!(setup.unjoined_roots().is_empty(), "{keys}");
    }
}
