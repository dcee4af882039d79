//! Joints whose springs and dampers act faster than the steps of an integrator bear.

use std::path::Path;

use crate::common::go_on;
use wingbeat_case::LoadedCase;
use wingbeat_flight::{FlightError, FlightSetup, Record, Simulation, growing_joint, inertia_about};

/// A wing on a hinge with this damping \[N m s/rad\] and stiffness \[N m/rad\] that is let go at 1 deg, on a
/// body that is held, in 40 steps of 1.25e-4 s a beat.
fn setup(damping: f64, stiffness: f64, set: &[&str]) -> FlightSetup {
    let element = format!(
        "joint.hinge-right.element=[{{ damping_newton_m_s_per_rad = {damping:e}, stiffness_newton_m_per_rad = {stiffness:e} }}]"
    );
    let own = [
        "dynamics.integrator=hamming",
        "time.steps_per_beat=40",
        element.as_str(),
    ];
    let all: Vec<String> = own.iter().chain(set).map(|s| (*s).to_owned()).collect();
    let text = "format = 1
gravity_m_s2 = [0, 0, 0]
[time]
beats = 3
[motion]
frequency_hz = 200.0
start = \"impulsive\"
[flight]
mode = \"tethered\"
[air]
model = \"none\"
[body]
mass_kg = 1e-6
inertia_about_centre_kg_m2 = [6e-14, 4e-13, 4e-13, 0, 0, 0]
[wing.right]
hinge_m = [0, 0.36e-3, 0]
mass_kg = 5.35e-9
planform.rectangle = { chord_m = 0.7e-3, span_m = 2.4e-3, root_offset_m = 0.1e-3 }
motion.phi.fourier = { cosine_deg = [0.0] }
[joint.hinge-right]
child = \"right\"
kind = \"revolute\"
axis = [0, 1, 0]
start_deg = [1.0]
";
    let case = LoadedCase::from_text("hinge", text, Path::new(""), &all);
    case.unwrap_or_else(|e| panic!("{e}")).setup
}

fn flown(setup: FlightSetup) -> Result<Vec<Record>, FlightError> {
    go_on(&mut Simulation::new(setup)?)
}

/// What is left of a wing on a spring and a damper grows as the largest root of the method has it: by a damper
/// alone it alternates. On a body that flies freely, and is no heavier than the wing, both give way.
#[test]
fn agrees_growth_of_flown_hinges_with_the_roots_of_the_method() {
    let free: &[&str] = &[
        "flight.mode=free",
        "wing.right.mirror=false",
        "body.mass_kg=4e-9",
        "body.inertia_about_centre_kg_m2=[4e-15,3e-16,4e-15,0,0,0]",
    ];
    let any = setup(1e-12, 1e-9, &[]);
    let hinge = &any.joints[0];
    let held = inertia_about(&any, hinge, hinge, 0).expect("it turns");
    let h = any.time.step;
    for (set, least) in [(&[][..], 1.0), (free, 1.5)] {
        let grows = |[c, k]: [f64; 2]| growing_joint(&setup(c, k, set)).expect("grows");
        let gives_way = grows([3.0 * held / h, 0.0]).damping / 3.0;
        println!("inertia of the wing over that which moves: {gives_way}");
        assert!(gives_way > least - 1e-12 && (least > 1.0 || gives_way < 1.0 + 1e-12));
        let inertia = held / gives_way;
        for (damping, vibration) in [(1.5, 0.05), (0.05, 1.25)] {
            let of = [damping * inertia / h, inertia * (vibration / h).powi(2)];
            let found = grows(of);
            assert!((found.damping / damping - 1.0).abs() < 1e-9); // roundings of differences
            assert!((found.vibration / vibration - 1.0).abs() < 1e-9);
            let shorter: Vec<&str> = set.iter().copied().chain(["time.beats=1.5"]).collect();
            let records = flown(setup(of[0], of[1], &shorter)).expect("flown");
            // Second differences: what does not alternate changes slowly.
            let rate = |k: usize| records[k].joints[0][1];
            let bend = |k: usize| (rate(k + 1) - 2.0 * rate(k) + rate(k - 1)).abs();
            let last = records.len() - 2;
            let most = |from: usize| (from - 10..from).map(bend).fold(0.0, f64::max);
            let growth = (most(last) / most(last - 20)).powf(0.05);
            println!("{growth} {found:?}");
            assert!(
                (growth / found.growth - 1.0).abs() < 5e-3,
                "{growth} {found:?}"
            );
        }
    }
}

/// Two links in line on a held body, with these dampers \[N m s/rad\] at their joints, the inner one let go at
/// 100 deg/s.
fn chain(dampers: [f64; 2]) -> FlightSetup {
    let [inner, outer] = dampers.map(|c| format!("[{{ damping_newton_m_s_per_rad = {c:e} }}]"));
    let link = "mass_kg = 0.5\ninertia_about_centre_kg_m2 = [0.04, 0.04, 0.04, 0, 0, 0]\n";
    let joint =
        "kind = \"revolute\"\naxis = [0, 1, 0]\nat_m = [0, 0, 0]\nat_child_m = [-0.3, 0, 0]\n";
    let text = format!(
        "format = 1\ngravity_m_s2 = [0, 0, 0]\ntime = {{ step_s = 1e-3, steps = 60 }}\nflight.mode = \"tethered\"\n\
         air.model = \"none\"\ndynamics.integrator = \"hamming\"\n\
         [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
         [segment.inner]\n{link}[segment.outer]\n{link}\
         [joint.one]\nchild = \"inner\"\n{joint}start_deg_s = [100]\nelement = {inner}\n\
         [joint.two]\nparent = \"inner\"\nchild = \"outer\"\n{joint}element = {outer}\n"
    );
    let case = LoadedCase::from_text("chain", &text, Path::new(""), &[]);
    case.unwrap_or_else(|e| panic!("{e}")).setup
}

/// Dampers of a chain take back the rates of its joints together: the fastest motion of two links by their
/// matrix of masses, in which each damper by itself is carried and both are not.
#[test]
fn exact_dampers_of_a_chain_act_faster_than_each_by_itself() {
    let (m, own, h): (f64, f64, f64) = (0.5 * 0.3 * 0.3, 0.04, 1e-3);
    let [p, q, r] = [5.0 * m + 2.0 * own, 2.0 * m + own, m + own];
    let det = p * r - q * q;
    let outer = 25.0;
    let c = [outer * p / r, outer]; // each is as fast
    let [one, other] = [c[0] * r / det, c[1] * p / det];
    let both = (c[0] * c[1]).sqrt() * q / det;
    let fastest = 0.5 * (one + other) + (0.25 * (one - other).powi(2) + both * both).sqrt();
    println!("{} {}", one * h, fastest * h);
    for alone in [[c[0], 0.0], [0.0, c[1]]] {
        assert_eq!(growing_joint(&chain(alone)), None, "{alone:?}");
    }
    let found = growing_joint(&chain(c)).expect("grows");
    assert!(found.is_together, "{found:?}");
    assert!(
        (found.damping / (fastest * h) - 1.0).abs() < 1e-9,
        "{found:?}"
    ); // roundings of differences
    let records = flown(chain(c)).expect("flown");
    let rate = |k: usize| records[k].joints[0][1];
    let bend = |k: usize| (rate(k + 1) - 2.0 * rate(k) + rate(k - 1)).abs();
    let growth = (bend(50) / bend(30)).powf(0.05);
    println!("{growth} {found:?}");
    // The links turn by some degrees.
    assert!(
        (growth / found.growth - 1.0).abs() < 5e-3,
        "{growth} {found:?}"
    );
    let said = found.said(&chain(c));
    assert!(said.contains("and others together"), "{said}");
}

/// Flights that such a joint ends name it, its numbers and a method that carries it, and so does what is
/// doubted beforehand; by that method they are flown.
#[test]
fn behaves_flights_that_a_damper_ends_name_it() {
    let damped = |set: &[&str]| setup(1.2e-11, 5e-9, set);
    let ended = flown(damped(&[])).expect_err("too fast");
    assert!(matches!(ended, FlightError::JointGrows { .. }), "{ended}");
    let said = ended.to_string();
    for words in [
        "joint `hinge-",
        "dynamics.integrator = \"hamming\"",
        "c h / I = ",
        "take dynamics.integrator = \"bdf\"",
        "times as many steps",
    ] {
        assert!(said.contains(words), "{said}\nhas no {words}");
    }
    let doubts = wingbeat_analysis::estimate(&damped(&[])).doubts.join("\n");
    assert!(
        doubts.contains("c h / I = ") && doubts.contains("\"bdf\""),
        "{doubts}"
    );
    let carried = damped(&["dynamics.integrator=bdf"]);
    assert_eq!(growing_joint(&carried), None);
    flown(carried).expect("flown");
    assert_eq!(growing_joint(&setup(1e-12, 1e-9, &[])), None, "slow enough");
}

/// A flight that ends for another reason says that reason, by every form of the equations, with joints and without.
#[test]
fn behaves_flights_that_do_not_converge_say_so_by_every_form() {
    for (preset, form) in [
        ("fruit-fly-blade", "momentum"),
        ("fruit-fly-blade", "euler"),
        ("fruit-fly-blade", "quaternion"),
        ("robobee", "momentum"),
        ("robobee", "quaternion"),
    ] {
        let set = [
            "corrector.max_passes=1".to_owned(),
            "corrector.tolerance=1e-15".to_owned(),
            "time.beats=0.5".to_owned(),
            "dynamics.integrator=hamming".to_owned(),
            format!("dynamics.formulation={form}"),
        ];
        let case =
            LoadedCase::find(preset, &set).unwrap_or_else(|e| panic!("{preset} {form}: {e}"));
        let steps = case.setup.time.steps;
        let flown = Simulation::new(case.setup)
            .and_then(|mut flight| (0..steps).try_for_each(|_| flight.step().map(|_| ())));
        let ended = flown.expect_err("one pass is none");
        assert!(
            matches!(ended, FlightError::NotConverged { .. }),
            "{preset} {form}: {ended:?}"
        );
    }
}

/// A spring beyond all that steps resolve is named at its joint: half a lattice was to be computed whole, and
/// then to take more steps.
#[test]
fn behaves_flights_that_a_stiff_spring_ends_name_it() {
    for mirror in [true, false] {
        let set = [
            "joint.hinge-right.element[0].stiffness_newton_m_per_rad=1e10".to_owned(),
            format!("air.mirror={mirror}"),
            "time.beats=0.1".to_owned(),
        ];
        let case = LoadedCase::find("robobee", &set).unwrap();
        assert_eq!(growing_joint(&case.setup), None, "bdf carries it");
        let ended = flown(case.setup.clone()).expect_err("too stiff");
        let refused = case.refused(&ended).to_string();
        for words in [
            "error: joint.hinge-right",
            "far stiffer than steps resolve: w h = ",
            "take less stiffness",
        ] {
            assert!(refused.contains(words), "{refused}\nhas no {words}");
        }
    }
}
