//! Residuals of energy and momentum do not depend on the inertial frame, nor on masses that do not take part.

use wingbeat_case::LoadedCase;
use wingbeat_flight::{Record, Simulation};
use wingbeat_math::DVec3;
use wingbeat_results::summary::Verdict;
use wingbeat_results::{Outcome, Summary};

use crate::flights::{flown, preset, says};

/// A wing that bends, held in air that passes at 6 m/s.
const WING: &str = r#"
format = 1
name = "wing"
gravity_m_s2 = [0, 0, 0]
time = { steps_per_beat = 40, beats = 1 }
motion = { frequency_hz = 3.0, start = "impulsive" }
flight.mode = "tethered"
air = { model = "blade_element", density_kg_m3 = 1.225 }
dynamics.integrator = "bdf"
output = { frames_every = 0, figures = false, page = false }
body = { mass_kg = 0.5, inertia_about_centre_kg_m2 = [0.004, 0.006, 0.008, 0, 0, 0] }
[wing.right]
hinge_m = [0.02, 0.05, 0.01]
motion.phi.constant_deg = 5
motion.psi.fourier = { mean_deg = 3, cosine_deg = [5] }
planform.rectangle = { chord_m = 0.1, span_m = 0.5, axis_fraction = 0.3 }
mesh = { chordwise = 4, spanwise = 8 }
[wing.right.structure.beam]
axis_fraction = 0.3
mass_fraction = 0.42
flap_newton_m2 = [1.5, 0.3]
lag_newton_m2 = [60, 20]
torsion_newton_m2 = [0.6, 0.2]
mass_kg_per_m = [0.2, 0.08]
"#;

fn summary(set: &[&str]) -> Summary {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    flown(&LoadedCase::from_text("wing", WING, std::path::Path::new("."), &set).unwrap())
}

fn residuals(s: &Summary) -> [f64; 2] {
    [s.energy_residual_relative, s.momentum_residual_relative]
}

/// In a stream, towed through still air, and towed with a body two thousand times as heavy, a wing bends the same way:
/// its balances close as well, and its verdict is one.
#[test]
fn invariant_residuals_in_a_stream_are_those_of_a_tow_whatever_the_body_weighs() {
    let stream = "air.stream_m_s=[-6,0,0]";
    let tow = "flight.velocity_m_s=[6,0,0]";
    let held = summary(&[stream]);
    for set in [
        &[tow][..],
        &[tow, "body.mass_kg=1000"],
        &[stream, "body.mass_kg=1000"],
    ] {
        let other = summary(set);
        assert_eq!(other.verdict, held.verdict, "{:?}", other.warnings);
        for (a, b) in residuals(&held).into_iter().zip(residuals(&other)) {
            println!("{set:?}: {a:e} {b:e}");
            assert!((a / b - 1.0).abs() < 1e-3, "{set:?}: {a:e} {b:e}");
        }
    }
}

/// What flies freely, seen from air that goes along.
#[test]
fn invariant_residuals_of_a_free_flight_do_not_depend_on_the_frame() {
    let free = ["flight.mode=\"free\"", "wing.right.mirror=true"];
    let fly = |set: &str| summary(&[&free[..], &[set]].concat());
    let [one, other] = ["air.stream_m_s=[-6,0,0]", "flight.velocity_m_s=[6,0,0]"].map(fly);
    let (a, b) = (residuals(&one)[0], residuals(&other)[0]);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-3, "{a:e} {b:e}");
}

/// A body that is released turning about a point beside its mass centre has another momentum at once: no force makes it,
/// and seen from the air it is no work.
#[test]
fn invariant_energy_residual_of_a_turning_release_does_not_depend_on_the_frame() {
    let fly = |set: &str| {
        summary(&[
            "flight.mode=\"free\"",
            "wing.right.mirror=true",
            "flight.held_beats=0.25",
            "flight.angular_velocity_deg_s=[0,-200,0]",
            "body.centre_m=[0,0,0.05]",
            set,
        ])
    };
    let [one, other] = ["air.stream_m_s=[-6,0,0]", "flight.velocity_m_s=[6,0,0]"].map(fly);
    let (a, b) = (residuals(&one)[0], residuals(&other)[0]);
    println!("{a:e} {b:e}");
    // Measured 9e-12: roundings of momenta.
    assert!((a / b - 1.0).abs() < 9e-11, "{a:e} {b:e}");
}

/// Correctors follow the motion to a tolerance: works are those of the accepted states, and so is the impulse by which
/// they are seen from another frame. The remainder is the rounding of momenta in a stream ten thousand times as fast.
#[test]
fn invariant_energy_residual_of_a_fly_does_not_depend_on_the_speed_of_a_stream_that_it_goes_with() {
    let fly = |set: &[&str]| {
        let more = ["time.steps_per_beat=40", "time.beats=2"];
        flown(&preset("fruit-fly-blade", &[&more, set].concat()))
    };
    let still = fly(&[]);
    let carried = fly(&[
        "flight.velocity_m_s=[3000,0,0]",
        "air.stream_m_s=[3000,0,0]",
    ]);
    let (a, b) = (residuals(&still)[0], residuals(&carried)[0]);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-3, "{a:e} {b:e}");
    assert_eq!(carried.verdict, still.verdict, "{:?}", carried.warnings);
}

/// What is missing in force and moment of a support does no work, however the support moves: at 40 steps a beat less
/// than a tenth of the tolerance is left of what that power was (1e-4 of a tow that rises from rest, 7e-5 of a turn).
#[test]
fn behaves_energy_of_a_tether_that_speeds_up_or_turns_closes_as_of_one_that_rests() {
    for motion in [
        &["flight.velocity_m_s=[1,0,0]", "flight.tether.start_s=0.02"][..],
        &["flight.tether.pitch.rate_deg_s=1e4"],
    ] {
        let tether = [
            "flight.mode=tethered",
            "time.steps_per_beat=40",
            "time.beats=4",
        ];
        let s = flown(&preset("fruit-fly-blade", &[&tether, motion].concat()));
        let energy = residuals(&s)[0];
        println!("{motion:?}: {energy:e}");
        assert!(energy < 5e-6, "{motion:?}: {energy:e}");
        assert_eq!(s.verdict, Verdict::Green, "{:?}", s.warnings);
    }
}

/// Eight steps do not follow the wings of a fly that is held, whatever its body weighs, and gravity does not hide how
/// sixteen turn it in vacuum.
#[test]
fn invariant_verdicts_do_not_depend_on_the_mass_of_a_held_body_nor_on_a_fall() {
    let held = |mass: &str| {
        let set = [
            "time.steps_per_beat=8",
            "time.beats=3",
            "flight.held_beats=2.5",
            "dynamics.integrator=hamming",
            mass,
        ];
        flown(&preset("fruit-fly-blade", &set))
    };
    let [light, heavy] = ["body.mass_kg=9.315e-7", "body.mass_kg=1e-3"].map(held);
    let (a, b) = (residuals(&light)[1], residuals(&heavy)[1]);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-6, "{a:e} {b:e}");
    assert_eq!([light.verdict, heavy.verdict], [Verdict::Red; 2]);
    let falls = |gravity: &str| {
        let set = [
            "dynamics.integrator=hamming",
            "time.steps_per_beat=16",
            "time.beats=50",
            gravity,
        ];
        residuals(&flown(&preset("fruit-fly-vacuum", &set)))[0]
    };
    let [a, b] = ["gravity_m_s2=[0,0,0]", "gravity_m_s2=[0,0,9.81]"].map(falls);
    println!("{a:e} {b:e}");
    assert!((a / b - 1.0).abs() < 1e-4, "{a:e} {b:e}");
}

/// A body with two still wings that a tether speeds up to 72 deg/s in four steps of 7.5 deg; its moments of
/// inertia [kg m2], and the density of what is around it [kg/m3].
fn rotor(inertia: f64, density: f64, set: &[&str]) -> LoadedCase {
    let text = format!(
        "format = 1\nname = \"rotor\"\n[time]\nstep_s = 0.10416666666666667\nsteps = 12\n[flight]\nmode = \"tethered\"\n\
         tether.yaw.rate_deg_s = -72\ntether.start_s = 0.4166666666666667\n[output]\nframes_every = 0\nfigures = false\npage = false\n\
         [air]\nmodel = \"blade_element\"\ndensity_kg_m3 = {density}\n\
         [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [{inertia}, {inertia}, {inertia}, 0, 0, 0]\n\
         [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\nmotion.psi.constant_deg = 40\n\
         planform.rectangle = {{ chord_m = 0.16, span_m = 0.46, root_offset_m = 0.06, axis_fraction = 0.25 }}\n\
         mesh = {{ chordwise = 4, spanwise = 8 }}\n[wing.left]\nmotion.psi.constant_deg = 140\n"
    );
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    LoadedCase::from_text("rotor", &text, std::path::Path::new("."), &set).unwrap()
}

fn records(case: &LoadedCase) -> Vec<Record> {
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut all = vec![flight.record().clone()];
    while !flight.finished() {
        all.push(flight.step().unwrap().clone());
    }
    all
}

/// At every step the tether has done `I w^2 / 2` on the body, and what the air took: whatever the body's
/// inertia I and the steps of the ramp, to rounding. By quadrature the first was 7 % off at four steps.
#[test]
fn exact_work_of_a_tether_that_speeds_a_body_up_in_four_steps() {
    for (inertia, density) in [(1.0, 1.2), (1.0, 1000.0), (1e-9, 1.2), (1e-9, 1000.0)] {
        let case = rotor(inertia, density, &[]);
        let all = records(&case);
        for r in &all {
            let turned = 0.5 * inertia * r.root_angular_velocity.length_squared();
            let error = r.applied_work - (turned - r.air_work);
            let scale = turned.max(r.air_work.abs());
            assert!(
                error.abs() <= 1e-12 * scale,
                "{inertia} {density}: {error:e} of {scale:e}"
            );
        }
        let w = all[12].root_angular_velocity.length();
        assert!((w - 72_f64.to_radians()).abs() < 1e-12, "{w}");
        let s = Summary::of(&case.setup, &all, &Outcome::Finished);
        println!("{inertia} {density}: {:e}", s.energy_residual_relative);
        assert!(s.energy_residual_relative < 1e-12, "{inertia} {density}");
    }
}

/// A tether that lifts and drops the same rotor as it turns has done `m v^2 / 2 + I w^2 / 2 - m g z` on the
/// body, and what the air took, to rounding. By quadrature the part of the weight was 3 % off.
#[test]
fn exact_work_of_a_tether_that_lifts_a_body_in_four_steps() {
    let lifted = "flight.tether.z={frequency_hz=1.2,sine_m=[0.1]}";
    for (mass, density) in [(1.0, 1.2), (1.0, 1000.0), (1e-9, 1.2)] {
        let weight = format!("body.mass_kg={mass}");
        let all = records(&rotor(mass, density, &[lifted, &weight]));
        let gained = |r: &Record| {
            let v = DVec3::from_slice(&r.rates[..3]);
            let squares = v.length_squared() + r.root_angular_velocity.length_squared();
            mass * (0.5 * squares - 9.81 * r.coordinates[2])
        };
        for r in &all {
            let body = gained(r) - gained(&all[0]);
            let error = r.applied_work - (body - r.air_work);
            let scale = (0.1 * mass).max(r.air_work.abs());
            assert!(
                error.abs() <= 1e-12 * scale,
                "{mass} {density}: {error:e} of {scale:e}"
            );
        }
    }
}

/// A tether, or a hold, that heaves and pitches bends the wing in the same way whatever the body weighs: its
/// energy closes as well. The remainder is the rounding of the energy of 1000 kg.
#[test]
fn invariant_energy_residual_on_supports_that_heave_does_not_depend_on_the_weight_of_the_body() {
    for (gravity, held) in [
        ("gravity_m_s2=[0,0,9.81]", "flight.mode=\"tethered\""),
        ("gravity_m_s2=[0,0,0]", "flight.mode=\"tethered\""),
        (
            "gravity_m_s2=[0,0,9.81]",
            "flight={mode=\"free\",held_beats=2}",
        ),
    ] {
        let heaved = [
            held,
            gravity,
            "flight.tether={z={frequency_hz=3,sine_m=[0.05]},pitch={frequency_hz=3,cosine_deg=[10]}}",
            "flight.velocity_m_s=[3,0,-1]",
            "body.centre_m=[0.02,0,0.03]",
        ];
        let residual = |mass: &str| {
            let s = summary(&[&heaved[..], &[mass]].concat());
            println!("{gravity} {held} {mass}: {:e}", s.energy_residual_relative);
            s.energy_residual_relative
        };
        let light = residual("body.mass_kg=1e-3");
        for mass in ["body.mass_kg=1", "body.mass_kg=1e3"] {
            let heavy = residual(mass);
            assert!((heavy / light - 1.0).abs() < 2e-7, "{light:e} {heavy:e}");
        }
    }
}

/// Air that takes a tenth more than the tether gives, or the other way round, is a fault all the same, and so
/// is a body that has a hundredth of what the air takes from nowhere.
#[test]
fn behaves_a_tether_does_not_hide_what_is_missing_in_the_energy() {
    let case = rotor(1e-9, 1.2, &[]);
    let all = records(&case);
    let spoilt: [fn(&mut Record); 2] = [
        |r| {
            r.energy_residual -= 0.1 * r.air_work;
            r.air_work *= 1.1;
        },
        |r| {
            r.energy_residual += 0.02 * r.applied_work;
            r.kinetic_energy += 0.02 * r.applied_work;
        },
    ];
    for spoil in spoilt {
        let mut all = all.clone();
        all.iter_mut().for_each(spoil);
        let s = Summary::of(&case.setup, &all, &Outcome::Finished);
        println!("{:e}", s.energy_residual_relative);
        assert!(
            says(&s, "energy balance does not close"),
            "{:?}",
            s.warnings
        );
        assert_eq!(s.verdict, Verdict::Red);
    }
}

/// A body whose table of derivatives, weight and load balance but for rounding: nothing moves, and the balance of the
/// energy, 1e-40 J of 1e-40 J, says nothing.
#[test]
fn conserves_energy_of_a_body_that_rests_closes() {
    let text = r#"
format = 1
name = "rest"
time = { step_s = 2.5e-5, steps = 1000 }
output = { frames_every = 0, figures = false, page = false }
flight.pitch_deg = 47.3
body = { mass_kg = 9.4e-7, inertia_about_centre_kg_m2 = [1e-13, 4e-13, 4e-13, 0, 0, 0] }
load = [{ force_newton = [0, 0, 2e-6], frame = "inertial", point_m = [1.3e-3, 0, 0.8e-3] }]
air.model = "derivatives"
[air.derivatives]
body_pitch_deg = 47.3
force_newton = [0, 0, -1.12214e-5]
moment_newton_m = [0, 2.9390784938969193e-9, 0]
force_by_velocity_newton_s_m = [[-3e-6, 0, 1e-7], [0, -2e-6, 0], [1e-7, 0, -4e-6]]
force_by_rate_newton_s = [[0, 1e-10, 0], [0, 0, 0], [0, 2e-10, 0]]
moment_by_velocity_newton_s = [[0, 1e-9, 0], [2e-9, 0, 1e-10], [0, 1e-10, 0]]
moment_by_rate_newton_m_s = [[-1e-12, 0, 0], [0, -1e-12, 0], [0, 0, -1e-12]]
"#;
    let base = std::path::Path::new(".");
    let still = flown(&LoadedCase::from_text("rest", text, base, &[]).unwrap());
    let energy = still.energy_residual_relative;
    println!("{energy:e}");
    assert!(energy < 1e-21, "{energy:e}"); // 1e-22 measured
    assert_eq!(still.verdict, Verdict::Green, "{:?}", still.warnings);
}
