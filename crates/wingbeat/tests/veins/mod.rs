//! Wings of sheet with veins and regions, made from keys.

use std::f64::consts::PI;
use std::path::Path;

use wingbeat::analysis::{About, WingModes, wing_modes};
use wingbeat::case::LoadedCase;
use wingbeat::flight::Simulation;

use super::{CASE, strings};
use crate::support::case_of;

/// A sheet 2 cm x 6 cm without lateral contraction, of the mass of the wing.
const SHEET: [&str; 3] = [
    "wing.right.structure.shell.young_pa=3e9",
    "wing.right.structure.shell.poisson=0",
    "wing.right.structure.shell.thickness_m=[1e-4,1e-4]",
];

/// The case without air, with tables in lists behind it.
fn load(set: &[&str], lists: &str) -> Result<LoadedCase, String> {
    let text = CASE.replace(
        "[wing.right.motion.phi.fourier]",
        &format!("{lists}\n[wing.right.motion.phi.fourier]"),
    );
    let set = strings(&[&SHEET[..], &["air.model=\"none\""], set].concat());
    LoadedCase::from_text("veins", &text, Path::new("."), &set).map_err(|e| e.to_string())
}

/// The modes of both wings in vacuum.
fn both(case: &LoadedCase) -> Vec<WingModes> {
    wing_modes(&case.setup, About::Rest, 4).unwrap()
}

/// Those of the right wing.
fn right(set: &[&str], lists: &str) -> WingModes {
    both(&load(set, lists).unwrap()).pop().unwrap()
}

/// The first frequencies \[rad/s\].
fn frequencies(wing: &WingModes) -> Vec<f64> {
    wing.vacuum.iter().map(|m| m.frequency).collect()
}

/// Two carbon spars along the edges.
const SPARS: &str = "
[[wing.right.structure.vein]]
radius_m = [3e-4, 3e-4]
young_pa = 1e11
density_kg_m3 = 1600
[[wing.right.structure.vein]]
from = [0, 1]
to = [1, 1]
radius_m = [3e-4, 3e-4]
young_pa = 1e11
density_kg_m3 = 1600
";

/// `3.516 sqrt(EI / (m L^4))` of a composite section: sheet and two spars; the mass is that of the wing.
#[test]
fn exact_frequency_of_a_wing_with_two_spars() {
    // Stiff along the chord, so that the sheet does not sag between the spars.
    let set = [
        "wing.right.mesh.spanwise=12",
        "wing.right.structure.shell.young_chord_pa=3e12",
        "wing.right.structure.shell.shear_pa=1.5e9",
    ];
    let wing = right(&set, SPARS);
    let spar = 1e11 * PI / 4.0 * 3e-4_f64.powi(4);
    let sheet = 3e9 * 0.02 * 1e-4_f64.powi(3) / 12.0;
    let mass = wing.mass;
    assert!((mass / 1e-4 - 1.0).abs() < 1e-12, "{mass:e}");
    let exact = 3.516 * ((2.0 * spar + sheet) / (mass / 0.06 * 0.06_f64.powi(4))).sqrt();
    // Second order in the elements, and rotary inertia of the spars.
    let error = frequencies(&wing)[0] / exact - 1.0;
    assert!(error.abs() < 3e-3, "{error:e}");
}

/// Square plate clamped all around, `omega a^2 sqrt(m / D)` 35.985, 73.394 twice, 108.22 [Leissa 1973, J. Sound
/// Vib. 31:257].
#[test]
fn order_frequencies_of_a_plate_on_a_frame() {
    let rigidity = 3e9 * 1e-4_f64.powi(3) / (12.0 * 0.91);
    let plate = (rigidity * 0.06_f64.powi(2) / 1e-4).sqrt() / 0.06_f64.powi(2);
    let errors = |n: usize| -> Vec<f64> {
        let mesh = ["chordwise", "spanwise"].map(|k| format!("wing.right.mesh.{k}={n}"));
        let set = [
            "wing.right.structure.shell.clamped_perimeter=true",
            "wing.right.planform.rectangle.chord_m=6e-2",
            "wing.right.structure.shell.poisson=0.3",
            &mesh[0],
            &mesh[1],
        ];
        let exact = [35.985, 73.394, 73.394, 108.22].map(|k| k * plate);
        let found = frequencies(&right(&set, ""));
        (found.iter().zip(exact))
            .map(|(f, e)| f / e - 1.0)
            .collect()
    };
    let (coarse, fine) = (errors(6), errors(12));
    for (coarse, fine) in coarse.iter().zip(&fine) {
        assert!(fine.abs() < 0.06, "{fine:e}"); // 1.7, 2.9, 2.9, 5.4 %
        let order = (coarse / fine).log2();
        assert!((1.6..2.4).contains(&order), "{coarse:e} {fine:e}");
    }
}

/// A square plate held at its leading edge is one held at its root, turned by a quarter; `omega a^2 sqrt(m /
/// D)` of the cantilever 3.471, 8.507 [Leissa 1969, table 4.46].
#[test]
fn agrees_a_plate_clamped_at_its_leading_edge_with_one_clamped_at_its_root() {
    let plate = [
        "wing.right.planform.rectangle.chord_m=6e-2",
        "wing.right.structure.shell.poisson=0.3",
        "wing.right.mesh.chordwise=8",
        "wing.right.mesh.spanwise=8",
    ];
    let leading = [
        "wing.right.structure.shell.clamped_root=false",
        "wing.right.structure.shell.clamped_leading_edge=true",
    ];
    let at_root = frequencies(&right(&plate, ""));
    let at_front = frequencies(&right(&[&plate[..], &leading].concat(), ""));
    for (a, b) in at_root.iter().zip(&at_front) {
        assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}"); // rounding of eigenvalues
    }
    let rigidity = 3e9 * 1e-4_f64.powi(3) / (12.0 * 0.91);
    let unit = (rigidity * 0.06_f64.powi(2) / 1e-4).sqrt() / 0.06_f64.powi(2);
    for (found, known) in at_front.iter().zip([3.471, 8.507]) {
        let error = found / (known * unit) - 1.0;
        assert!(error.abs() < 0.01, "{error:e}"); // 8 x 8 elements
    }
}

/// A stretched square film whose bending is a millionth of a solid sheet's, `omega = pi sqrt((i^2 + j^2) T / m)
/// / a`: nodes that turn by themselves vibrate below, and are left out.
#[test]
fn limit_frequencies_of_a_film_without_those_of_turning_nodes() {
    let set = [
        "wing.right.structure.shell.clamped_perimeter=true",
        "wing.right.planform.rectangle.chord_m=6e-2",
        "wing.right.mesh.chordwise=10",
        "wing.right.mesh.spanwise=10",
        "wing.right.structure.shell.prestress_newton_per_m=[3,3]",
        "wing.right.structure.shell.bending_factor=1e-6",
    ];
    let film = right(&set, "");
    let unit = PI * (3.0 / (film.mass / 0.06_f64.powi(2))).sqrt() / 0.06;
    let exact = [2.0_f64, 5.0, 5.0, 8.0].map(|s| unit * s.sqrt());
    println!("{:?} {exact:?} {:?}", frequencies(&film), film.left_out);
    for (found, exact) in frequencies(&film).iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 0.05, "{found} {exact}"); // 4.8 % less, 10 x 10 elements
    }
    assert!(film.left_out[0] > 0, "{:?}", film.left_out);
    // Of a solid sheet they are faster than what is asked for.
    assert_eq!(right(&set[..4], "").left_out, [0; 2]);
}

/// Tension along the span, which the free tip cannot hold, is gone before the wing vibrates; tension along the
/// chord, which the clamped root holds, pushes the sheet together there, and a thin one buckles.
#[test]
fn limit_tension_that_nothing_holds_changes_no_frequency() {
    let tense = |tension: &str| {
        right(
            &[&format!(
                "wing.right.structure.shell.prestress_newton_per_m={tension}"
            )],
            "",
        )
    };
    let (slack, along, across) = (tense("[0,0]"), tense("[100,0]"), tense("[0,1000]"));
    for (a, b) in frequencies(&slack).iter().zip(frequencies(&along)) {
        assert!((a / b - 1.0).abs() < 2e-3, "{a} {b}"); // it shortens by 3e-4
    }
    assert!(
        slack
            .vacuum
            .iter()
            .chain(&along.vacuum)
            .all(|m| m.growth == 0.0)
    );
    assert!(across.vacuum[0].growth > 0.0 && across.vacuum[0].frequency == 0.0);
}

/// A stretched film on a frame, without weight or air, has the frequencies of a membrane, `sqrt(T / m) pi
/// sqrt(1 / a^2 + 1 / b^2)` and so on, and flies: nothing loads it, and what is left unbalanced is measured by
/// what holds it.
#[test]
fn limit_frequencies_of_a_film_under_tension_without_loads() {
    let film = |chordwise: usize, spanwise: usize| {
        let text = format!(
            "format = 1\ngravity_m_s2 = [0, 0, 0]\n[time]\nstep_s = 1e-3\nsteps = 3\n[flight]\nmode = \"tethered\"\n\
             [air]\nmodel = \"none\"\n[body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
             [wing.right]\nmirror = false\nhinge_m = [0, 0.1, 0]\nplanform.rectangle = {{ chord_m = 0.3, span_m = 0.6 }}\n\
             mesh = {{ chordwise = {chordwise}, spanwise = {spanwise} }}\n\
             structure.shell = {{ young_pa = 70e9, density_kg_m3 = 2700, thickness_m = [1e-3, 1e-3], \
             clamped_perimeter = true, prestress_newton_per_m = [500, 500], bending_factor = 1e-4 }}\n"
        );
        case_of("film", &text, &[])
    };
    let speed = (500.0_f64 / 2.7).sqrt();
    let errors = [[4, 8], [8, 16]].map(|[chordwise, spanwise]| {
        let found = both(&film(chordwise, spanwise)).pop().unwrap();
        [1.0, 2.0].map(|half_waves: f64| {
            let exact = speed * PI * (half_waves / 0.6).hypot(1.0 / 0.3);
            frequencies(&found)[half_waves as usize - 1] / exact - 1.0
        })
    });
    println!("{errors:?}");
    for (coarse, fine) in errors[0].iter().zip(&errors[1]) {
        assert!(
            fine.abs() < 0.03 && fine.abs() < 0.7 * coarse.abs(),
            "{errors:?}"
        );
    }
    let mut flight = Simulation::new(film(4, 8).setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
}

/// An outer half of twice the thickness weighs twice as much; a whole region is as if the sheet were of it.
#[test]
fn exact_mass_and_stiffness_of_regions() {
    let dense = ["wing.right.structure.shell.density_kg_m3=1200"];
    let made = |lists: &str, set: &[&str]| {
        let case = CASE.replace("mass_kg = 1e-4", "").replace(
            "[wing.right.motion.phi.fourier]",
            &format!("{lists}\n[wing.right.motion.phi.fourier]"),
        );
        let set = strings(&[&SHEET[..], &dense, &["air.model=\"none\""], set].concat());
        let case = LoadedCase::from_text("region", &case, Path::new("."), &set).unwrap();
        both(&case).pop().unwrap()
    };
    let text = |lists: &str| made(lists, &[]);
    let plain = text("");
    let outer = text("[[wing.right.structure.region]]\nspan_range = [0.5, 1]\nthickness_m = 2e-4");
    assert!((outer.mass / plain.mass - 1.5).abs() < 1e-12);
    let whole = text("[[wing.right.structure.region]]\nthickness_m = 2e-4");
    // Twice as thick: frequencies of bending twice as high, but for shear and rotary inertia, (h / c)^2.
    let [a, b] = [&plain, &whole].map(|w| frequencies(w)[0]);
    assert!((b / a - 2.0).abs() < 5e-5, "{}", b / a);
    // Another Poisson's ratio over all of it is that of a sheet alike in all directions, in twist, too.
    let region = text("[[wing.right.structure.region]]\npoisson = 0.49");
    let sheet = made("", &["wing.right.structure.shell.poisson=0.49"]);
    for (a, b) in frequencies(&region).iter().zip(frequencies(&sheet)) {
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
    let soft = "wing.right.structure.shell.bending_factor=0.01";
    let [a, b] = [&[][..], &[soft]].map(|set| frequencies(&right(set, ""))[0]);
    assert!((b / a - 0.1).abs() < 1e-6, "{}", b / a);
}

/// Fibres turned by a quarter turn are moduli exchanged; askew ones are mirrored on the other wing.
#[test]
fn invariant_directions_of_fibres() {
    let along = [
        "wing.right.structure.shell.young_chord_pa=3e8",
        "wing.right.structure.shell.shear_pa=5e8",
    ];
    let across = [
        "wing.right.structure.shell.young_pa=3e8",
        "wing.right.structure.shell.young_chord_pa=3e9",
        "wing.right.structure.shell.shear_pa=5e8",
        "wing.right.structure.shell.fibre_angle_deg=90",
    ];
    let [a, b] = [&along[..], &across].map(|set| frequencies(&right(set, "")));
    let askew = [
        &along[..],
        &["wing.right.structure.shell.fibre_angle_deg=30"],
    ]
    .concat();
    let case = load(&askew, SPARS).unwrap();
    let wings = both(&case);
    let [c, d] = [0, 1].map(|k| frequencies(&wings[k]));
    for (x, y) in a.iter().zip(&b).chain(c.iter().zip(&d)) {
        assert!((x / y - 1.0).abs() < 1e-9, "{x} {y}");
    }
    // Askew they couple bending with twist: another wing.
    assert!((c[0] / a[0] - 1.0).abs() > 1e-2);
}

#[test]
fn refuses_veins_and_regions_that_say_nothing() {
    let vein = "[[wing.right.structure.vein]]\n";
    let region = "[[wing.right.structure.region]]\n";
    let no_root = "wing.right.structure.shell.clamped_root=false";
    let leading = "wing.right.structure.shell.clamped_leading_edge=true";
    for (set, lists, says) in [
        (&[][..], format!("{vein}young_pa = 1e9"), "vein[0].radius_m"),
        (
            &[],
            format!("{vein}radius_m = [1e-4, 1e-4]"),
            "bending_newton_m2 with torsion_newton_m2",
        ),
        (
            &[],
            format!("{vein}radius_m = [1e-4, 0]\nyoung_pa = 1e9"),
            "vein[0].radius_m",
        ),
        (
            &[],
            format!("{vein}radius_m = [1e-4, 1e-4]\nyoung_pa = 1e9\nto = [0.01, 0]"),
            "same node",
        ),
        (
            &[],
            format!("{vein}radius_m = [1e-2, 1e-2]\nyoung_pa = 1e9\ndensity_kg_m3 = 1e3"),
            "nothing is left",
        ),
        (
            &[],
            format!("{region}span_range = [0.5, 0.5]\nthickness_m = 1e-4"),
            "region[0].span_range",
        ),
        (
            &[],
            format!("{region}span_range = [0.5, 0.51]\nthickness_m = 1e-4"),
            "no panel",
        ),
        (
            &[],
            format!("{vein}radius_m = [1e-4, 1e-4]\nyoung_pa = 1e9\nclamped = true"),
            "vein[0].clamped: true has no effect",
        ),
        (
            &[],
            format!("{region}thickness_m = 1e-4\n{region}thickness_m = 2e-4"),
            "region[0]: regions after it cover",
        ),
        (&[], format!("{region}density_kg_m3 = 1e3"), "spread evenly"),
        (
            &[
                "wing.right.structure.shell.clamped_perimeter=true",
                "wing.right.mesh.chordwise=1",
            ],
            String::new(),
            "lies on the perimeter",
        ),
        (
            &["wing.right.structure.shell.prestress_newton_per_m=[-1,0]"],
            String::new(),
            "prestress_newton_per_m",
        ),
        (&[no_root], String::new(), "something must hold"),
        (
            &[no_root, "wing.right.structure.shell.clamped_perimeter=true"],
            String::new(),
            "part of the perimeter",
        ),
        (
            &[leading, "wing.right.structure.shell.clamped_perimeter=true"],
            String::new(),
            "clamped_perimeter holds the leading edge",
        ),
        (
            &[leading, "wing.right.structure.shell.rigid_fraction=0.5"],
            String::new(),
            "rigid_fraction holds the leading edge",
        ),
    ] {
        let said = load(set, &lists).unwrap_err();
        assert!(said.contains(says), "{lists}: {said}");
    }
    // A later region that changes something else leaves the first what it is.
    let both = format!("{region}thickness_m = 1e-4\n{region}poisson = 0.2");
    load(&[], &both).unwrap();
    // A spar alone holds a wing.
    load(
        &[no_root],
        &format!("{vein}radius_m = [3e-4, 3e-4]\nyoung_pa = 1e11\nclamped = true"),
    )
    .unwrap();
    // Beside a beam there is nothing to stiffen.
    let beam = strings(&[
        "wing.right.structure.beam.flap_newton_m2=[1,1]",
        "wing.right.structure.beam.torsion_newton_m2=[1,1]",
    ]);
    let text = CASE.replace(
        "[wing.right.motion.phi.fourier]",
        &format!("{SPARS}\n[wing.right.motion.phi.fourier]"),
    );
    let said = LoadedCase::from_text("beam", &text, Path::new("."), &beam)
        .err()
        .unwrap();
    assert!(said.to_string().contains("without shell"), "{said}");
}
