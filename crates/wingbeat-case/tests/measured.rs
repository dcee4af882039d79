//! Slips in measurements are named before they are flown.

use std::f64::consts::TAU;
use std::path::Path;

use crate::common::preset;
use wingbeat_case::{LoadedCase, presets};

fn stroke(x: f64) -> f64 {
    70.0 * (TAU * x).cos() + 8.0 * (2.0 * TAU * x).sin()
}

fn table(angle: &str, rows: &[(f64, f64)], more: &str) -> String {
    let rows: Vec<String> = rows.iter().map(|(x, q)| format!("[{x}, {q}]")).collect();
    format!(
        "wing.right.motion.{angle}={{table={{rows_deg=[{}]{more}}}}}",
        rows.join(", ")
    )
}

fn fly(set: &[String]) -> LoadedCase {
    LoadedCase::find("fruit-fly-tethered", set).unwrap()
}

/// Fifty samples of a beat and the repetition of the first, each changed by `change`.
fn samples(change: impl Fn(usize, f64) -> f64) -> Vec<(f64, f64)> {
    let row = |k: usize| {
        let x = k as f64 / 50.0;
        (x, change(k, stroke(x)))
    };
    (0..=50).map(row).collect()
}

fn doubts(rows: &[(f64, f64)]) -> Vec<String> {
    fly(&[table("phi", rows, "")]).doubtful_measurements()
}

#[test]
fn behaves_lost_frames_and_wrapped_angles_of_tables_are_named() {
    assert_eq!(doubts(&samples(|_, q| q)), [""; 0]);
    for frames in [1, 2, 3, 6] {
        let lost = samples(|k, q| {
            if (20..20 + frames).contains(&k) {
                0.0
            } else {
                q
            }
        });
        let [said] = &doubts(&lost)[..] else {
            panic!("{frames} lost frames")
        };
        assert!(said.contains("exactly 0 from phase 0.4"), "{said}");
    }
    // Courses that cross zero or touch it at a sample have lost nothing.
    let coarse = |count: usize, q: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
        let row = |k: usize| k as f64 / count as f64;
        let rounded = |q: f64| (1e3 * q).round() / 1e3;
        (0..=count)
            .map(|k| (row(k), rounded(q(TAU * row(k)))))
            .collect()
    };
    let crosses = |x: f64| -60.0 * x.cos();
    let touches = |x: f64| 80.0 * (1.0 + x.cos());
    for course in [coarse(20, &crosses), coarse(12, &touches)] {
        assert_eq!(doubts(&course), [""; 0]);
    }
    let mut crossing = coarse(20, &crosses);
    crossing[4].1 = 0.0;
    let [said] = &doubts(&crossing)[..] else {
        panic!("two zeros")
    };
    assert!(said.contains("exactly 0 from phase 0.2 to 0.25"), "{said}");
    let wrapped = samples(|_, q| if q > 60.0 { q - 360.0 } else { q });
    let [said] = &doubts(&wrapped)[..] else {
        panic!("a turn")
    };
    assert!(said.contains("angles were wrapped there"), "{said}");
}

#[test]
fn behaves_tables_in_radians_are_named() {
    for offset in ["", ", offset_deg=-90"] {
        let rows = samples(|_, q| q.to_radians());
        let said = fly(&[table("phi", &rows, offset)]).doubtful_measurements();
        assert!(said.join("\n").contains("are they radians?"), "{said:?}");
    }
}

/// Small motions, and a wing that feathers about an axis at rest but for play of its bearing, are in degrees.
#[test]
fn behaves_small_motions_are_not_taken_for_radians() {
    let said = |phi: f64, psi: f64| {
        let wave = |angle: &str, size: f64| {
            table(
                angle,
                &samples(|k, _| size * (TAU * k as f64 / 50.0).cos()),
                "",
            )
        };
        let doubts = fly(&[wave("phi", phi), wave("psi", psi)]).doubtful_measurements();
        doubts.join("\n").contains("are they radians?")
    };
    for (phi, psi, is_asked) in [
        (0.1, 0.05, false),
        (0.5, 20.0, false),
        (1.05, 0.8, true),
        (0.35, 0.8, true), // mosquitoes: 20 deg
        (1.05, 45.0, true),
        (60.0, 0.8, true),
        (60.0, 0.15, false),
    ] {
        assert_eq!(said(phi, psi), is_asked, "{phi} {psi}");
    }
}

/// A series is that of its samples, in whatever beats they were taken.
#[test]
fn invariant_a_fit_of_several_beats_is_that_of_one() {
    let fitted = |rows: &[(f64, f64)]| {
        let case = fly(&[table("phi", rows, ", harmonics=4")]);
        let angles = |x: f64| case.setup.animal.wings[0].motion.angles.phi.at(x)[0];
        (0..20)
            .map(|k| angles(f64::from(k) / 20.0))
            .collect::<Vec<f64>>()
    };
    let one = fitted(&samples(|_, q| q));
    // 12.5 samples a beat: those of four beats lie between each other; then every sample twice.
    let four: Vec<(f64, f64)> = (0..50)
        .map(|k| f64::from(k) * 0.08)
        .map(|x| (x, stroke(x)))
        .collect();
    let twice: Vec<(f64, f64)> = samples(|_, q| q).into_iter().flat_map(|r| [r, r]).collect();
    for other in [fitted(&four), fitted(&twice[..100])] {
        for (a, b) in one.iter().zip(&other) {
            assert!((a - b).abs() < 1e-12, "{a} {b}"); // roundings of a fit
        }
    }
}

/// A point by phase, row and place in the row, and where it stands.
type Change<'a> = &'a dyn Fn(usize, usize, usize, [f64; 3]) -> [f64; 3];

#[test]
fn behaves_surfaces_in_another_order_and_lost_phases_are_named() {
    let surface = |change: Change<'_>| {
        let point = |t: usize, i: usize, j: usize| {
            let bent = 1e-4 * (TAU * t as f64 / 20.0).sin() * j as f64;
            let x = change(
                t,
                i,
                j,
                [2e-4 - 8e-4 * i as f64 / 2.0, 8e-4 * j as f64, bent],
            );
            format!("[{}, {}, {}]", x[0], x[1], x[2])
        };
        let row = |t, i| (0..4).map(|j| point(t, i, j)).collect::<Vec<_>>().join(",");
        let at = |t| {
            (0..3)
                .map(|i| format!("[{}]", row(t, i)))
                .collect::<Vec<_>>()
                .join(",")
        };
        let nodes = (0..20)
            .map(|t| format!("[{}]", at(t)))
            .collect::<Vec<_>>()
            .join(",");
        let phases = (0..20)
            .map(|t| (f64::from(t) / 20.0).to_string())
            .collect::<Vec<_>>()
            .join(",");
        let set = format!("wing.right.deformation.surface={{phases=[{phases}],nodes_m=[{nodes}]}}");
        fly(&[set]).doubtful_measurements().join("\n")
    };
    assert_eq!(surface(&|_, _, _, x| x), "");
    let cases: [(&str, Change<'_>); 9] = [
        ("are they in millimetres?", &|_, _, _, x| x.map(|x| 1e3 * x)),
        ("check their unit", &|_, _, _, x| x.map(|x| 10.0 * x)),
        ("divided by 1000 once too often", &|_, _, _, x| {
            x.map(|x| 1e-3 * x)
        }),
        ("m in chord, and the wing at rest", &|_, _, _, [x, y, z]| {
            [5.0 * x, y, z]
        }),
        (
            "points are counted from the hinge",
            &|_, _, _, [x, y, z]| [x + 1.0, y, z],
        ),
        ("from the tip to the root", &|_, _, _, [x, y, z]| {
            [x, 2.4e-3 - y, z]
        }),
        ("inboard of the hinge", &|_, _, _, [x, y, z]| [x, -y, z]),
        ("at the trailing edge", &|_, _, _, [x, y, z]| [-x, y, z]),
        ("of the points at phase 0.35", &|t, _, _, x| {
            if t == 7 { [0.0; 3] } else { x }
        }),
    ];
    for (words, change) in cases {
        let said = surface(change);
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn refuses_a_second_column_that_is_named_after_another_angle() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("measured");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("angles.csv");
    let rows = samples(|_, q| q);
    let rows: Vec<String> = rows.iter().map(|(x, q)| format!("{x},{q},{q}")).collect();
    let text = format!("phase,phi_deg,psi_deg\n{}\n", rows.join("\n"));
    std::fs::write(&file, text).unwrap();
    let case = |more: &str| {
        let law = format!("wing.right.motion.psi={{table={{file={file:?}{more}}}}}");
        LoadedCase::find("fruit-fly-tethered", &[law])
    };
    let said = case("").unwrap_err().to_string();
    let words = "its second column is `phi_deg`, and this is the table of psi";
    assert!(said.contains(words), "{said}");
    case(", angle_column=\"psi_deg\"").unwrap();
}

#[test]
fn refuses_a_column_whose_name_two_have() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("measured");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("twice.csv");
    std::fs::write(&file, "phase,phi_deg,phi_deg\n0,1,9\n0.5,2,8\n1,1,9\n").unwrap();
    let law = format!("wing.right.motion.phi={{table={{file={file:?},angle_column=\"phi_deg\"}}}}");
    let said = LoadedCase::find("fruit-fly-tethered", &[law]).unwrap_err();
    let words = "two of its columns are named `phi_deg`";
    assert!(said.to_string().contains(words), "{said}");
}

#[test]
fn behaves_air_from_behind_and_drag_of_slow_coefficients_are_named() {
    let said = |name: &str, set: &[&str]| {
        let case = preset(name, set);
        wingbeat_analysis::estimate(&case.setup).doubts.join("\n")
    };
    let behind = said("bird-cruise", &["air.stream_m_s=[12,0,0]"]);
    assert!(
        behind.contains("the air comes from behind at 12.0 m/s"),
        "{behind}"
    );
    let turned = [
        "air.stream_m_s=[-12,0,0]",
        "flight.pitch_deg=0",
        "flight.yaw_deg=180",
        "flight.velocity_m_s=[0,0,0]",
    ];
    let faced = said("bird-cruise", &turned);
    assert!(faced.contains("air.stream_m_s = [12.0, 0, 0]"), "{faced}");
    let backwards = ["flight.velocity_m_s=[-12,0,0]", "flight.pitch_deg=0"];
    let moving = said("fruit-fly-tethered", &backwards);
    assert!(
        moving.contains("from behind") && moving.contains("flight.velocity_m_s"),
        "{moving}"
    );
    assert!(!moving.contains("= ["), "{moving}");
    let vacuum = said(
        "fruit-fly-tethered",
        &[&backwards[..], &["air.model=none"]].concat(),
    );
    assert!(!vacuum.contains("from behind"), "{vacuum}");
    // A hover by rounding, and a climb of tables without wings, whose air comes from ahead or from nowhere.
    let table = |velocity: &str| {
        let set = format!("flight.velocity_m_s={velocity}");
        said("table1-sun-2007", &[&set])
    };
    for none in ["[-1e-19,0,0]", "[-1e-17,0,-0.2]"] {
        assert!(!table(none).contains("from behind"), "{none}");
    }
    assert!(table("[-5,0,0]").contains("from behind"));
    let drag = said("bird-cruise", &["air.model=blade_element"]);
    assert!(drag.contains("drag is friction"), "{drag}");
    for name in presets::PRESETS.iter().map(|p| p.name) {
        let doubts = said(name, &[]);
        assert!(
            !doubts.contains("from behind") && !doubts.contains("drag is friction"),
            "{name}: {doubts}"
        );
        let case = LoadedCase::find(name, &[]).unwrap();
        assert_eq!(case.doubtful_measurements(), [""; 0], "{name}");
    }
}

#[test]
fn behaves_one_table_in_radians_beside_others_in_degrees_is_named() {
    let phi = table("phi", &samples(|_, q| q), "");
    let said = |psi: &dyn Fn(f64) -> f64| {
        let rows = samples(|k, _| psi(TAU * k as f64 / 50.0));
        fly(&[phi.clone(), table("psi", &rows, "")]).doubtful_measurements()
    };
    let [radians] = &said(&|x| -0.96 * x.sin())[..] else {
        panic!("a table in radians")
    };
    assert!(
        radians.contains("motion.psi.table swings by 0.96 deg") && radians.contains("radians?"),
        "{radians}"
    );
    // Held at a small angle, with the noise of a measurement or without; far from it; not small.
    for psi in [
        &|_| 1.5_f64,
        &|x: f64| 1.5 + 0.1 * x.sin(),
        &|x: f64| 30.0 + x.sin(),
        &|x: f64| 40.0 * x.sin(),
    ] as [&dyn Fn(f64) -> f64; 4]
    {
        assert_eq!(said(psi), [""; 0]);
    }
}

#[test]
fn behaves_a_force_of_feathering_that_jumps_is_named() {
    let doubts = |set: &[String]| {
        let case = LoadedCase::find("bumblebee-blade", set).unwrap();
        wingbeat_analysis::estimate(&case.setup).doubts.join("\n")
    };
    let named = doubts(&["air.blade.rotation=sane_dickinson".to_owned()]);
    assert!(
        named.contains("air.blade.rotation") && named.contains("jumps"),
        "{named}"
    );
    assert!(!doubts(&[]).contains("jumps"));
}

/// Rotation angles of other conventions, or signs, hardly change the lift, which a plate has both ways round.
#[test]
fn behaves_wings_that_fly_with_the_trailing_edge_ahead_are_named() {
    let ahead = |name: &str, set: &[&str]| {
        let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
        let case = LoadedCase::find(name, &set).unwrap();
        case.setup.trailing_edges_ahead()
    };
    for preset in presets::PRESETS {
        assert_eq!(ahead(preset.name, &[]), [""; 0], "{}", preset.name);
    }
    let fly = "fruit-fly-blade";
    let psi = |law: &str| format!("wing.right.motion.psi={{fourier={{{law}}}}}");
    let phi = "wing.right.motion.phi={fourier={sine_deg=[70]}}";
    let plain = "wing.right.motion.theta={constant_deg=0}";
    let ahead_of = |psi: &str| ahead(fly, &["motion.data=", phi, plain, psi]);
    // Down at phases 0.75 to 0.25: there psi is below 0.
    let right = psi("cosine_deg=[-45]");
    assert_eq!(ahead_of(&right), [""; 0]);
    let broadside = psi("cosine_deg=[0]");
    assert_eq!(ahead_of(&broadside), [""; 0]);
    for (law, strokes) in [
        (
            "mean_deg=90,cosine_deg=[45]",
            "downstroke (psi = 135 deg at its fastest)",
        ),
        (
            "mean_deg=-90,cosine_deg=[45]",
            "upstroke (psi = -135 deg at its fastest)",
        ),
        (
            "mean_deg=180,cosine_deg=[-45]",
            "downstroke (psi = 135 deg at its fastest) and the upstroke (psi = 225 deg at its fastest)",
        ),
    ] {
        let [said] = &ahead_of(&psi(law))[..] else {
            panic!("{law}")
        };
        let wanted = format!("ahead in the {strokes} (wings `left`, `right`)");
        assert!(said.contains(&wanted), "{law}: {said}");
        assert!(said.contains("phi grows backward"), "{said}");
    }
    // Feathering a quarter of a beat late or early, or read from the column of the stroke; not a tenth of a
    // beat.
    for law in ["sine_deg=[-55]", "sine_deg=[55]", "sine_deg=[70]"] {
        let [said] = &ahead_of(&psi(law))[..] else {
            panic!("{law}")
        };
        assert!(
            said.contains("broadside")
                && said.contains("quarter of a beat off")
                && said.contains("`left`, `right`"),
            "{law}: {said}"
        );
    }
    for law in [
        "cosine_deg=[-36],sine_deg=[26]",
        "cosine_deg=[-36],sine_deg=[-26]",
        "sine_deg=[20]",
    ] {
        assert_eq!(ahead_of(&psi(law)), [""; 0], "{law}");
    }
    // Late by a quarter about a mean that is not zero; a rotation angle from the stroke plane that is small.
    for law in [
        "mean_deg=15,sine_deg=[45]",
        "mean_deg=25,sine_deg=[60]",
        "mean_deg=25,sine_deg=[80]",
        "mean_deg=15,sine_deg=[43],cosine_deg=[12]", // 15 deg beside a quarter
    ] {
        let said = ahead_of(&psi(law)).join("\n");
        assert!(said.contains("quarter of a beat off"), "{law}: {said}");
    }
    let said = ahead_of(&psi("mean_deg=90,cosine_deg=[28]")).join("\n");
    assert!(said.contains("counted from the stroke plane"), "{said}");
    // Broad wings in the right phase, which feathering moves faster than their stroke, and fins.
    for (chord, axis) in [("0.7e-3", "0.25"), ("1.67e-3", "0"), ("2.5e-3", "0")] {
        for stroke in [0, 2, 20, 60] {
            for feathering in [30, 60] {
                let phi = format!("wing.right.motion.phi={{fourier={{sine_deg=[{stroke}]}}}}");
                let psi = psi(&format!("cosine_deg=[-{feathering}]"));
                let chord = format!("wing.right.planform.beta.mean_chord_m={chord}");
                let axis = format!("wing.right.planform.beta.axis_fraction={axis}");
                let said = ahead(fly, &["motion.data=", &phi, plain, &psi, &chord, &axis]);
                assert_eq!(said, [""; 0], "{chord} {axis} {stroke} {feathering}");
            }
        }
    }
    // A stream that comes from behind faster than the wings stroke.
    let [said] = &ahead(
        "rectangular-wing",
        &["air.stream_m_s=[20,0,0]", "motion.frequency_hz=1"],
    )[..] else {
        panic!("a stream from behind")
    };
    assert!(said.contains("ahead"), "{said}");
}

/// Angles over seconds that count the other way from another zero, in rows and in a file in radians, fly as the
/// same angles in this program's convention.
#[test]
fn exact_tables_in_other_conventions_are_converted() {
    let here = Path::new(env!("CARGO_TARGET_TMPDIR")).join("conventions");
    std::fs::create_dir_all(&here).unwrap();
    let phases = (0..=40).map(|k| f64::from(k) / 40.0);
    let psi: Vec<[f64; 2]> = phases.map(|x| [x, -45.0 * (TAU * x).cos()]).collect();
    let rotation: Vec<[f64; 2]> = psi.iter().map(|[x, q]| [x / 200.0, 90.0 - q]).collect();
    let rows = |list: &[[f64; 2]]| format!("rows_deg={list:?}");
    let lines = rotation
        .iter()
        .map(|[t, q]| format!("{t},{}\n", q.to_radians()));
    let text = "time_s,rotation_rad\n".to_owned() + &lines.collect::<String>();
    std::fs::write(here.join("rotation.csv"), text).unwrap();
    let convention = "beats_per_unit=200,factor=-1,offset_deg=90";
    for harmonics in ["", ",harmonics=3"] {
        let wing = |table: &str| {
            let set = format!("wing.right.motion.psi={{table={{{table}{harmonics}}}}}");
            let preset = presets::find("fruit-fly-tethered").unwrap().text;
            let case = LoadedCase::from_text("fly", preset, &here, &[set]).unwrap();
            // The resolved case is in the convention of this program, and says the same.
            let again =
                LoadedCase::from_text("again", &case.resolved(), Path::new("/"), &[]).unwrap();
            assert!(again.setup.animal == case.setup.animal);
            case.setup.animal.wings[1].motion.clone()
        };
        let known = wing(&rows(&psi));
        let by_rows = wing(&format!("{},{convention}", rows(&rotation)));
        let by_file = wing(&format!("file='rotation.csv',{convention}"));
        for k in 0..50 {
            let t = f64::from(k) / 50.0 / 200.0;
            for motion in [&by_rows, &by_file] {
                let pairs = known.angles(t)[2].into_iter().zip(motion.angles(t)[2]);
                for ((a, b), size) in pairs.zip([1.0, 1e3, 1e6]) {
                    assert!((a - b).abs() < 1e-11 * size, "{harmonics} {k}: {a} {b}");
                }
            }
        }
    }
    // Lost frames that were stored as 0 are those of the table, whatever 0 stands for.
    let doubts = |list: &[[f64; 2]]| {
        let set = format!(
            "wing.right.motion.psi={{table={{{},{convention}}}}}",
            rows(list)
        );
        fly(&[set]).doubtful_measurements().join("\n")
    };
    assert_eq!(doubts(&rotation), "");
    let mut lost = rotation.clone();
    lost[19..21].iter_mut().for_each(|row| row[1] = 0.0);
    let said = doubts(&lost);
    assert!(
        said.contains("exactly 90 from phase 0.475 to 0.5"),
        "{said}"
    );
    let refused = |key: &str| {
        let set = format!("wing.right.motion.psi={{table={{{},{key}}}}}", rows(&psi));
        let preset = presets::find("fruit-fly-tethered").unwrap().text;
        let error = LoadedCase::from_text("fly", preset, &here, &[set]).map(|_| ());
        error.unwrap_err().to_string()
    };
    for key in [
        "factor=0",
        "factor=inf",
        "offset_deg=nan",
        "beats_per_unit=0",
        "beats_per_unit=-1",
    ] {
        let name = key.split('=').next().unwrap();
        let said = refused(key);
        assert!(said.contains(&format!("psi.table.{name}")), "{key}: {said}");
    }
}
