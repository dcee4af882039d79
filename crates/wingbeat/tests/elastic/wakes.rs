//! Blade elements whose strips leave wakes: elastic wings, trimmed orbits and their modes.

use std::sync::LazyLock;

use super::blades::departures;
use super::{apart, beam, fly, goes_on, strings};
use wingbeat::analysis::flutter::realise;
use wingbeat::analysis::wake::{WakeSettings, WakeTrim, elastic_floquet, trim_with_wake};
use wingbeat::analysis::{Plane, TrimProblem, TrimSettings, power_with_wake};
use wingbeat::case::{LoadedCase, wake_trimmed_case};
use wingbeat::flight::{MotionMode, Past, Record, Simulation};
use wingbeat::math::DVec3;

/// Blade elements in a stream, strips with wakes.
fn wakes(set: &[&str], structure: &[String]) -> Vec<String> {
    let air = [
        "air.model=\"blade_element\"",
        "air.blade.unsteady=\"peters\"",
        "air.stream_m_s=[-3,0,0.5]",
    ];
    [&strings(&air)[..], &strings(set), structure].concat()
}

#[test]
fn limit_stiff_wings_whose_strips_leave_wakes_carry_what_rigid_ones_do() {
    // A free flyer in a stream starts with a jolt, which elastic wings answer to in their own way.
    for mode in [
        ["flight.mode=\"tethered\"", "air.stream_m_s=[-3,0,0.5]"],
        ["flight.mode=\"free\"", "air.stream_m_s=[0,0,0]"],
    ] {
        let rigid = fly(&wakes(&mode, &[]));
        let largest = (rigid.iter()).fold(0.0_f64, |m, r| m.max(r.air_force().length()));
        let with = |stiffness: f64| apart(&fly(&wakes(&mode, &beam(stiffness))), &rigid) / largest;
        let [soft, stiff] = [with(2.0), with(20.0)];
        // What is left goes with 1 / stiffness.
        assert!(stiff < 1e-2, "{mode:?}: {stiff}");
        assert!(
            (7.0..14.0).contains(&(soft / stiff)),
            "{mode:?}: {soft} {stiff}"
        );
    }
}

#[test]
fn order_energy_of_soft_wings_with_wakes_closes_at_second_order() {
    let residual = |steps: usize| {
        let steps = format!("time.steps_per_beat={steps}");
        let set = [
            "flight.mode=\"tethered\"",
            "time.beats=1",
            "wing.right.structure.spectral_radius=1",
            &steps,
        ];
        let records = fly(&wakes(&set, &beam(2e-3)));
        let residual = |r: &Record| r.energy_residual.abs();
        records.iter().map(residual).fold(0.0, f64::max)
    };
    let ratio = residual(160) / residual(320);
    assert!((3.3..4.7).contains(&ratio), "{ratio}");
}

#[test]
fn invariant_a_saved_flight_of_soft_wings_with_wakes_goes_on_bit_for_bit() {
    goes_on(&wakes(&["time.beats=0.3"], &beam(2e-3)));
}

#[test]
fn conserves_momentum_of_a_flyer_with_soft_wings_and_wakes() {
    let records = fly(&wakes(&["time.beats=1"], &beam(5e-4)));
    let largest = |of: fn(&Record) -> f64| records.iter().map(of).fold(0.0, f64::max);
    let open = largest(|r| r.momentum_residual.length()) / largest(|r| r.momentum.length());
    assert!(open < 1e-12, "{open:e}");
    let passes = records.iter().map(|r| r.elastic[0].passes).max().unwrap();
    assert!(passes <= 10, "{passes}");
}

/// The fruit fly in forward flight, four strips a wing with wakes, trimmed.
static FLY: LazyLock<WakeTrim> = LazyLock::new(|| trimmed(&fly_forward(4)));

fn fly_forward(strips: usize) -> LoadedCase {
    fly_with(strips, "time.steps_per_beat=40")
}

fn fly_with(strips: usize, time: &str) -> LoadedCase {
    let set = strings(&[
        "air.blade.unsteady=\"jones\"",
        time,
        &format!("wing.right.mesh.spanwise={strips}"),
    ]);
    LoadedCase::find("fruit-fly-blade", &set).unwrap()
}

fn trimmed(case: &LoadedCase) -> WakeTrim {
    // The speed through the air is 1 m/s.
    let stream = case.setup.air.stream().unwrap_or_default();
    let mut problem = TrimProblem::straight(DVec3::X + stream, 40_f64.to_radians());
    problem.settings = TrimSettings {
        steps: 40,
        ..TrimSettings::default()
    };
    let settings = WakeSettings {
        tolerance: 1e-8,
        ..WakeSettings::default()
    };
    let found = trim_with_wake(&case.setup, &problem, &settings).unwrap();
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    assert!(found.is_orbit() && found.past.wings.is_empty());
    found
}

#[test]
fn agrees_the_written_case_of_a_fly_with_wakes_with_its_orbit() {
    let case = fly_forward(4);
    let trim = &*FLY;
    // The steps of a case may be given in seconds, in which those of another frequency are none.
    let step = case.setup.time.step;
    let seconds = fly_with(4, &format!("time={{step_s={step},steps=200}}"));
    for case in [case, seconds] {
        let text = wake_trimmed_case(&case, trim);
        assert!(text.contains("steps_per_beat = 40") && !text.contains("step_s"));
        let found = departures(&case, trim, 2);
        let close = |[drift, turn]: &[f64; 2]| *drift < 2e-3 && *turn < 2e-3;
        assert!(found.iter().all(close), "{found:?}");
    }
}

/// Records at the ends of `beats` beats that go on from the `past`.
fn beats(trim: &WakeTrim, past: &Past, velocity: DVec3, beats: usize) -> Vec<Record> {
    let mut setup = trim.setup.clone();
    let steps = setup.time.steps;
    setup.time.steps *= beats;
    if let MotionMode::Free(start) = &mut setup.mode {
        start.velocity += velocity;
    }
    let mut flight = Simulation::after(setup, past).unwrap();
    let mut found = vec![flight.record().clone()];
    for _ in 0..beats {
        (0..steps).for_each(|_| _ = flight.step().unwrap());
        found.push(flight.record().clone());
    }
    found
}

#[test]
fn agrees_orbit_and_modes_of_a_fly_with_wakes_with_flights_about_it() {
    let trim = &*FLY;
    let period = trim.setup.time.period.unwrap();
    let size = trim.setup.animal.wings[0].report().length;
    let (mass, speed) = (trim.setup.animal.mass(), size / period);
    // The beat comes back to its start, wakes and all; the next one, without a new start of its method, to the
    // error of 40 steps.
    let still = beats(trim, &trim.past, DVec3::ZERO, 16);
    let change = |k: usize| (still[k].momentum - still[0].momentum).length() / mass / speed;
    assert!(change(1) < 1e-7, "{:e}", change(1));
    assert!(change(2) < 2e-3, "{:e}", change(2));
    let power = power_with_wake(trim).unwrap();
    let work = still[1].driving_work() - still[0].driving_work();
    assert!((power.perfect_storage * period / work - 1.0).abs() < 1e-2);
    // Small departures in speed, flight by flight, and the linear system that they show.
    let by = 1e-3 * speed * DVec3::X;
    let [plus, minus] = [by, -by].map(|by| beats(trim, &trim.past, by, 16));
    let seen = |(a, b): (&Record, &Record)| {
        let v = (a.momentum - b.momentum) / mass / speed;
        let turn = a.root_angular_velocity - b.root_angular_velocity;
        let tilt = a.root_quaternion[2] - b.root_quaternion[2];
        vec![v.x, v.z, turn.y * period, tilt]
    };
    let samples: Vec<Vec<f64>> = plus.iter().zip(&minus).map(seen).skip(1).collect();
    let shown = realise(&samples, period).unwrap();
    let modes = elastic_floquet(trim, 0).unwrap();
    let oscillation = (modes.plane(Plane::Longitudinal))
        .filter(|m| m.frequency > 0.0)
        .max_by(|a, b| a.growth.total_cmp(&b.growth))
        .expect("an oscillation");
    let nearest = (shown.vibrations.iter())
        .map(|v| (v.growth - oscillation.growth).hypot(v.frequency - oscillation.frequency))
        .fold(f64::INFINITY, f64::min);
    // Beats without a new start differ from those of the map by the error of 40 steps.
    let rate = oscillation.growth.hypot(oscillation.frequency);
    assert!(nearest < 0.03 * rate, "{oscillation:?} {shown:?}");
}

/// Which motions are those of body and wings does not hang on how many states the wakes have.
#[test]
fn invariant_modes_that_are_shown_on_any_number_of_strips() {
    let seven = trimmed(&fly_forward(7));
    let shown = [&*FLY, &seven].map(|trim| {
        let modes = elastic_floquet(trim, 0).unwrap().modes;
        let fastest = modes.iter().map(|m| m.growth).fold(0.0, f64::min);
        (modes.len(), fastest)
    });
    let [(few, a), (many, b)] = shown;
    assert!(few == many, "{shown:?}");
    // The fast subsidence among them, some -330 1/s in hover.
    assert!(a < -200.0 && (a / b - 1.0).abs() < 0.2, "{shown:?}");
}

/// The fly with wakes at the same speed through the air, in still air and in a stream: exponents and shapes.
#[test]
fn invariant_modes_of_a_fly_with_wakes_in_a_stream() {
    let mut case = fly_forward(4);
    *case.setup.air.stream_mut().expect("a stream") = DVec3::new(2.0, 0.0, 0.0);
    let [still, stream] = [&*FLY, &trimmed(&case)].map(|t| elastic_floquet(t, 0).unwrap().modes);
    assert_eq!(still.len(), stream.len());
    for (a, b) in still.iter().zip(&stream) {
        let apart = (a.growth - b.growth).hypot(a.frequency - b.frequency) * a.wingbeat;
        let shapes = a.vector.iter().zip(&b.vector);
        let off = shapes.map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max);
        println!("{}: {apart:e} {off:e}", a.name);
        // Differences over steps of 1e-3, trims to 1e-8.
        assert!(apart < 1e-5 && off < 1e-3, "{}: {apart:e} {off:e}", a.name);
    }
}
