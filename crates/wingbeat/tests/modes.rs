//! Modes of elastic wings: in vacuum, in air, about a deformed state; the command.

use std::f64::consts::PI;

use wingbeat::analysis::flutter::{FlutterSettings, condition};
use wingbeat::analysis::{About, WingModes, wing_modes};

use crate::support::{Scratch, case_of, said, wingbeat};

/// A wing of 20 chords of a metre, a beam along the middle of its chord.
const SLENDER: &str = r#"
format = 1
name = "slender"
[time]
step_s = 0.01
steps = 1
[flight]
mode = "tethered"
[air]
density_kg_m3 = 2.0
shed = ["trailing"]
body = false
mirror = true
[body]
mass_kg = 1.0
inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]
[wing.right]
hinge_m = [0, 0, 0]
joined = true
[wing.right.planform.rectangle]
chord_m = 1.0
span_m = 20.0
axis_fraction = 0.5
[wing.right.mesh]
chordwise = 8
spanwise = 24
[wing.right.structure.beam]
axis_fraction = 0.5
mass_fraction = 0.5
elements = 24
flap_newton_m2 = [1e4, 1e4]
lag_newton_m2 = [1e8, 1e8]
torsion_newton_m2 = [5e2, 5e2]
mass_kg_per_m = [1.5, 1.5]
inertia_kg_m = [0.1, 0.1]
"#;

/// A film between two spars under tension along the span.
const FILM: &str = r#"
format = 1
name = "film"
[time]
steps_per_beat = 60
beats = 1
[motion]
frequency_hz = 9.0
[flight]
mode = "tethered"
pitch_deg = 8
velocity_m_s = [5, 0, 0]
[air]
shed = ["trailing"]
body = false
mirror = false
[body]
mass_kg = 0.02
inertia_about_centre_kg_m2 = [1e-5, 1e-5, 1e-5, 0, 0, 0]
[wing.right]
hinge_m = [0, 0.012, 0]
mass_kg = 0.0015
[wing.right.planform.outline]
leading_m = [[0, 0], [0.06, 0.03], [0.17, 0]]
trailing_m = [[0, -0.06], [0.08, -0.05], [0.17, -0.015]]
[wing.right.mesh]
chordwise = 4
spanwise = 8
[wing.right.motion]
phi = { fourier = { mean_deg = -5, cosine_deg = [-35] } }
[wing.right.structure.shell]
young_pa = 5e6
thickness_m = [1e-4, 1e-4]
prestress_newton_per_m = [2, 0]
clamped_root = true
[[wing.right.structure.vein]]
radius_m = [1e-3, 5e-4]
young_pa = 15e9
density_kg_m3 = 1500
[[wing.right.structure.vein]]
from = [0, 0.5]
to = [1, 1]
radius_m = [8e-4, 2e-4]
young_pa = 10e9
"#;

/// A film whose tension nearly pulls its spars over has modes, and one that folds over in flight is named with
/// the key of what it is.
#[test]
fn behaves_films_that_buckle_have_modes_and_those_that_fold_are_named() {
    let scratch = Scratch::new("film");
    std::fs::write(scratch.0.join("film.toml"), FILM).unwrap();
    for tension in ["0.7", "1", "2"] {
        let set = format!("wing.right.structure.shell.prestress_newton_per_m=[{tension}, 0]");
        let out = wingbeat(&scratch.0, &["modes", "film.toml", "--set", &set]);
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(out.status.success(), "{tension}: {said}");
    }
    // Flown: how far a check goes on trial depends on the machine.
    let slack = "wing.right.structure.shell.prestress_newton_per_m=[1.5, 0]";
    let asked = [
        "run",
        "film.toml",
        "--set",
        slack,
        "--quiet",
        "--out",
        "film",
    ];
    let out = wingbeat(&scratch.0, &asked);
    let said = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(1), "{said}");
    for part in ["wing.NAME.structure", "has folded over", "steps_per_beat"] {
        assert!(said.contains(part), "{said}");
    }
}

fn modes(text: &str, set: &[&str], about: About) -> WingModes {
    wing_modes(&case_of("case", text, set).setup, about, 4)
        .unwrap()
        .swap_remove(1)
}

#[test]
fn agrees_modes_of_a_slender_wing_in_air_with_strips() {
    let found = modes(SLENDER, &[], About::Rest);
    let [m, i, l, rho] = [1.5, 0.1, 20.0, 2.0];
    let bending = 3.516_015 / (l * l) * (1e4_f64 / m).sqrt();
    let torsion = 0.5 * PI / l * (5e2_f64 / i).sqrt();
    // 24 elements: 3e-5 in bending; a linear twist in each, (pi / 2 / 24)^2 / 24.
    let near = |a: f64, b: f64, part: f64| assert!((a / b - 1.0).abs() < part, "{a} {b}");
    let vacuum = &found.vacuum;
    near(vacuum[0].frequency, bending, 3e-4);
    let twists = |all: &[wingbeat::analysis::WingMode]| {
        let edges = |m: &wingbeat::analysis::WingMode| {
            let n = m.displacement.len();
            (m.displacement[n - 1].z - m.displacement[24].z).abs()
        };
        let found = all.iter().find(|m| edges(m) > 1.0);
        found.map(|m| m.frequency).unwrap()
    };
    near(twists(vacuum), torsion, 1e-3);
    // Strips: pi / 4 rho c^2 and, about the middle, pi / 128 rho c^4; at 40 chords' span from tip to tip their
    // ends carry less, which raises frequencies by some 1 to 2 %.
    let air = found.air.as_ref().unwrap();
    let heavier = |m: f64, added: f64| (m / (m + added)).sqrt();
    near(
        air[0].frequency,
        bending * heavier(m, 0.25 * PI * rho),
        0.02,
    );
    near(twists(air), torsion * heavier(i, PI * rho / 128.0), 0.03);
    assert!(air[0].mass > vacuum[0].mass && air[0].likeness(&vacuum[0]) > 0.999);
}

/// At 0.45 of the length, between two of five nodes and at one of forty.
#[test]
fn agrees_a_lumped_mass_between_nodes_with_one_at_a_node() {
    let mass = "wing.right.structure.beam.mass=[{ at = 0.45, mass_kg = 20.0 }]";
    let frequencies = |elements: &str| {
        let elements = format!("wing.right.structure.beam.elements={elements}");
        let found = modes(SLENDER, &[mass, &elements, "air.model=none"], About::Rest);
        [0, 1].map(|k| found.vacuum[k].frequency)
    };
    let [coarse, fine] = ["5", "40"].map(frequencies);
    for (a, b) in coarse.iter().zip(fine) {
        println!("{a} {b}");
        assert!((a / b - 1.0).abs() < 0.03, "{a} {b}");
    }
}

#[test]
fn limit_modes_in_blade_elements_have_the_added_mass_of_strips() {
    let mut text = SLENDER.replace("joined = true\n", "");
    for key in [
        "shed = [\"trailing\"]\n",
        "body = false\n",
        "mirror = true\n",
    ] {
        text = text.replace(key, "");
    }
    let heavier = |m: f64, added: f64| (m / (m + added)).sqrt();
    // Bending: pi / 4 rho c^2 per span. Torsion about the middle: pi / 128 rho c^4.
    let (bends, twists) = (heavier(1.5, 0.5 * PI), heavier(0.1, PI / 64.0));
    let off = |strips: usize| {
        let strips = format!("wing.right.mesh.spanwise={strips}");
        let found = modes(
            &text,
            &["air.model=\"blade_element\"", &strips],
            About::Rest,
        );
        let both = found.air.unwrap().into_iter().zip(found.vacuum);
        both.fold(0.0_f64, |off, (a, v)| {
            let ratio = a.frequency / v.frequency;
            off.max(
                (ratio / bends - 1.0)
                    .abs()
                    .min((ratio / twists - 1.0).abs()),
            )
        })
    };
    // Two strips an element sum up what it carries: 1.5e-4 in four modes. One, the mean of its ends, has 7e-3.
    let (coarse, fine) = (off(24), off(48));
    assert!(fine < 1e-3 && fine < 0.1 * coarse, "{coarse} {fine}");
}

#[test]
fn limit_thin_air_leaves_modes_as_they_are() {
    let found = modes(SLENDER, &["air.density_kg_m3=1e-9"], About::Rest);
    for (a, b) in found.vacuum.iter().zip(found.air.as_ref().unwrap()) {
        assert!((a.frequency / b.frequency - 1.0).abs() < 1e-8);
    }
}

#[test]
fn agrees_modes_about_a_steady_state_with_those_flutter_begins_from() {
    let goland = include_str!("../../wingbeat-verify/data/goland.toml");
    let coarse = [
        "wing.right.mesh.chordwise=4",
        "wing.right.mesh.spanwise=8",
        "time.step_s=0.0028575",
        "air.max_wake_rows=40",
        "wing.right.motion.psi.constant_deg=1",
    ];
    let found = modes(goland, &coarse, About::Steady);
    let case = case_of("goland", goland, &coarse);
    let settings = FlutterSettings {
        modes: 2,
        ..FlutterSettings::default()
    };
    let flutter = condition(&case.setup, 160.0, &settings)
        .unwrap()
        .swap_remove(0);
    for (a, b) in found.vacuum.iter().zip(&flutter.steady.vacuum) {
        // The state is steady to 1e-7.
        assert!((a.frequency / b - 1.0).abs() < 1e-6, "{} {b}", a.frequency);
    }
    let bent = found.deflection.iter().map(|d| d.length());
    assert!((bent.fold(0.0, f64::max) / flutter.steady.tip.length() - 1.0).abs() < 0.2);
    assert!(found.air.unwrap()[0].frequency < found.vacuum[0].frequency);
}

#[test]
fn behaves_modes_of_wings_on_hinges_say_that_these_are_held() {
    let scratch = Scratch::new("hinged-modes");
    let dir = &scratch.0;
    let said = |text: &str| {
        std::fs::write(dir.join("c.toml"), text).unwrap();
        let told = wingbeat(dir, &["modes", "c.toml", "--count", "1"]);
        assert!(told.status.success(), "{told:?}");
        String::from_utf8_lossy(&told.stdout).into_owned()
    };
    let hinged = format!(
        "{}[joint.hinge]\nchild = \"right\"\nkind = \"revolute\"\naxis = [0, 1, 0]\n",
        FILM.replace("shed = [\"trailing\"]", "model = \"none\"")
            .replace("body = false\nmirror = false\n", "")
    );
    assert!(said(&hinged).contains("its hinge is held"));
    assert!(!said(FILM).contains("its hinge is held"));
    let welded = hinged.replace("kind = \"revolute\"\naxis = [0, 1, 0]\n", "");
    assert!(!said(&welded).contains("its hinge is held"));
}

#[test]
fn exact_report_and_shapes_of_the_command_hold_the_modes() {
    let scratch = Scratch::new("modes");
    let dir = &scratch.0;
    let told = wingbeat(
        dir,
        &[
            "modes",
            "hawkmoth-elastic",
            "--count",
            "3",
            "--json",
            "--shapes",
            "s.csv",
        ],
    );
    let report: serde_json::Value = serde_json::from_slice(&told.stdout).unwrap();
    let right = &report["wings"][1];
    assert_eq!(right["vacuum"].as_array().unwrap().len(), 3);
    let [vacuum, air] = ["vacuum", "air"].map(|k| right[k][0]["frequency_hz"].as_f64().unwrap());
    assert!(air < vacuum);
    let csv = std::fs::read_to_string(dir.join("s.csv")).unwrap();
    // Two wings, vacuum and air, 3 modes, 5 x 11 nodes.
    assert_eq!(csv.lines().count(), 1 + 2 * 2 * 3 * 55);
    let words = wingbeat(
        dir,
        &["modes", "hawkmoth-elastic", "--set", "air.model=\"none\""],
    );
    let words = String::from_utf8_lossy(&words.stdout).into_owned();
    assert!(
        words.contains("in vacuum") && !words.contains("added mass"),
        "{words}"
    );
    assert!(words.contains("as left"), "{words}");
}

/// Modes at rest need no step: a film so limp that none of the flight's ends has them, and `check` says what is
/// wrong with it.
#[test]
fn behaves_wings_too_limp_to_fly_have_modes_and_are_doubted() {
    let scratch = Scratch::new("limp");
    let shell = "wing.right.structure.shell={young_pa=2.2e6,thickness_m=[2e-4,2e-4]}";
    let limp = ["rectangular-wing", "--set", shell];
    let found = said(&scratch.0, &[&["modes"], &limp[..]].concat());
    assert!(found.contains("with the added mass of the air"), "{found}");
    let doubted = wingbeat(&scratch.0, &[&["check"], &limp[..]].concat());
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let [out, err] = [&doubted.stdout, &doubted.stderr].map(|b| text(b));
    assert!(
        !doubted.status.success() && out.contains("this case cannot be flown"),
        "{out}"
    );
    assert!(out.contains("a sheet of 55 nodes"), "{out}");
    assert!(
        err.contains("first frequency in vacuum times chord over speed 8.60e-5 is below"),
        "{err}"
    );
    assert!(err.contains("did not agree after"), "{err}");
}

#[test]
fn refuses_modes_of_what_does_not_bend() {
    let scratch = Scratch::new("no-modes");
    let dir = &scratch.0;
    for (args, says) in [
        (&["modes", "fruit-fly-hover"][..], "no wing is elastic"),
        (
            &["modes", "hawkmoth-elastic", "--steady"],
            "the flight is free",
        ),
        (&["modes", "hawkmoth-elastic", "--count", "0"], "1 to 100"),
    ] {
        let out = wingbeat(dir, args);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert!(
            !out.status.success() && said.contains(says),
            "{args:?}: {said}"
        );
    }
}

/// An even beam of 1 m that weight bends far: m g L^3 / EI = 9.81, in next to no air.
const SAGGING: &str = r#"
format = 1
name = "sagging"
[time]
step_s = 0.01
steps = 300
[flight]
mode = "tethered"
[air]
model = "blade_element"
density_kg_m3 = 1e-6
stream_m_s = [-1, 0, 0]
[air.blade]
unsteady = "jones"
own = { lift = 3.141592653589793, drag_0 = 0, drag_90 = 0 }
centre_of_pressure.fixed = 0.25
[output]
frames_every = 0
[body]
mass_kg = 1.0
inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]
[wing.right]
hinge_m = [0, 0, 0]
motion.psi.constant_deg = 0
[wing.right.planform.rectangle]
chord_m = 0.05
span_m = 1.0
axis_fraction = 0.5
[wing.right.mesh]
chordwise = 1
spanwise = 30
[wing.right.structure.beam]
axis_fraction = 0.5
mass_fraction = 0.5
elements = 30
flap_newton_m2 = [1, 1]
lag_newton_m2 = [1e3, 1e3]
axial_newton = [1e5, 1e5]
torsion_newton_m2 = [10, 10]
mass_kg_per_m = [1, 1]
"#;

/// Tip of a clamped bar of unit length and stiffness under the weight `q` across it: `theta'' = -q (1 - s) cos theta`,
/// `theta(0) = theta'(1) = 0`, by shooting with the classical method of Runge and Kutta.
fn elastica(q: f64) -> f64 {
    const STEPS: usize = 200;
    let h = 1.0 / STEPS as f64;
    let rates = |s: f64, y: [f64; 4]| [y[1], -q * (1.0 - s) * y[0].cos(), y[0].cos(), y[0].sin()];
    let shot = |bend: f64| {
        let mut y = [0.0, bend, 0.0, 0.0];
        for k in 0..STEPS {
            let s = k as f64 * h;
            let to = |f: [f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * f[i]);
            let a = rates(s, y);
            let b = rates(s + 0.5 * h, to(a, 0.5 * h));
            let c = rates(s + 0.5 * h, to(b, 0.5 * h));
            let d = rates(s + h, to(c, h));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
        }
        y
    };
    let (mut low, mut high) = (0.0, q);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match shot(middle)[1] > 0.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    let [.., x, z] = shot(low);
    (1.0 - x).hypot(z)
}

/// Steps four times as long do not carry its fall; those of the case do.
#[test]
fn agrees_steady_state_of_a_wing_that_weight_bends_far_with_the_elastica() {
    let coarse = [
        "wing.right.mesh.spanwise=8",
        "wing.right.structure.beam.elements=8",
    ];
    let case = case_of("sagging", SAGGING, &coarse);
    let found = wing_modes(&case.setup, About::Steady, 1).unwrap();
    let deflection = found[0].deflection.iter().map(|d| d.length());
    let bent = deflection.fold(0.0, f64::max);
    println!("{bent} {}", elastica(9.81));
    // The nodes of the mesh lie half a chord beside the beam's; the elements' own error is less.
    assert!((bent / elastica(9.81) - 1.0).abs() < 1e-2, "{bent}");
}

#[test]
fn behaves_weight_that_is_left_out_is_told_where_it_bends_far() {
    let scratch = Scratch::new("sagging");
    std::fs::write(scratch.0.join("sagging.toml"), SAGGING).unwrap();
    // 9.81 / 8 of the length.
    let note = "across the wing it would bend it by some 1.23 of its length";
    assert!(said(&scratch.0, &["modes", "sagging.toml"]).contains(note));
    let light = ["modes", "sagging.toml", "--set", "gravity_m_s2=[0,0,0.5]"];
    assert!(!said(&scratch.0, &light).contains("weight is left out"));
    let doubted = wingbeat(&scratch.0, &["check", "sagging.toml"]);
    let err = String::from_utf8_lossy(&doubted.stderr).into_owned();
    assert!(err.contains("by weight across the wing"), "{err}");
}
