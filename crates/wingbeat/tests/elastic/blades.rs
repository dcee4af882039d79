//! Wings that loads bend in blade elements.

use std::path::Path;
use std::sync::LazyLock;

use super::{LATTICE, beam, fly, goes_on, hawkmoth_extremes, strings};
use wingbeat::analysis::wake::{
    ElasticMonodromy, WakeSettings, WakeTrim, change_by_last_mode, elastic_floquet, elastic_modes,
    elastic_monodromy, trim_with_wake,
};
use wingbeat::analysis::{
    ModeSet, TrimProblem, TrimSettings, Unknown, floquet_of_trim, power_with_wake, trim,
};
use wingbeat::case::{LoadedCase, wake_trimmed_case};
use wingbeat::flight::{FlightSetup, MotionMode, Record, Simulation};
use wingbeat::math::{DQuat, DVec3};

const BLADES: [&str; 1] = ["air.model=\"blade_element\""];

/// Largest difference of the air's force on all bodies over the largest force.
fn apart(a: &[Record], b: &[Record]) -> f64 {
    let largest = (b.iter()).fold(0.0_f64, |m, r| m.max(r.air_force().length()));
    super::apart(a, b) / largest
}

#[test]
fn limit_stiff_wings_in_blade_elements_carry_what_rigid_ones_do() {
    for mode in ["tethered", "free"] {
        let air = [
            &strings(&BLADES)[..],
            &strings(&[&format!("flight.mode=\"{mode}\"")]),
        ]
        .concat();
        let rigid = fly(&air);
        let with = |structure: &[String]| apart(&fly(&[&air[..], structure].concat()), &rigid);
        let [soft, stiff] = [beam(2.0), beam(20.0)].map(|b| with(&b));
        // What is left goes with 1 / stiffness.
        assert!(stiff < 1e-2, "{mode}: {stiff}");
        assert!(
            (7.0..14.0).contains(&(soft / stiff)),
            "{mode}: {soft} {stiff}"
        );
    }
}

#[test]
fn conserves_momentum_in_blade_elements_and_agrees_between_integrators() {
    let last = ["hamming", "bdf"].map(|method| {
        let set = strings(&["time.beats=1", &format!("dynamics.integrator=\"{method}\"")]);
        let records = fly(&[&strings(&BLADES)[..], &set, &beam(5e-4)].concat());
        let tip = (records.iter()).fold(0.0_f64, |m, r| m.max(r.elastic[0].tip.length()));
        assert!(tip > 2e-3, "soft: {tip}");
        let largest = |of: fn(&Record) -> f64| records.iter().map(of).fold(0.0, f64::max);
        let linear = largest(|r| r.momentum_residual.length()) / largest(|r| r.momentum.length());
        let angular = largest(|r| r.angular_momentum_residual.length())
            / largest(|r| r.angular_momentum.length());
        // Momentum and impulse are integrated alike: some hundred roundings. Angular momentum is about the mass
        // centre, its impulse about the origin: the error of the method, rigid wings have it, too.
        assert!(linear < 1e-12 && angular < 5e-4, "{linear:e} {angular:e}");
        let passes = records.iter().map(|r| r.elastic[0].passes).max().unwrap();
        assert!(passes <= 8, "{passes}");
        records.last().unwrap().mass_centre
    });
    let [a, b] = last;
    assert!((a - b).length() < 1e-3 * a.length(), "{a} {b}");
}

#[test]
fn order_energy_in_blade_elements_closes_at_second_order() {
    let residual = |steps: usize| {
        let steps = format!("time.steps_per_beat={steps}");
        let set = strings(&[
            "flight.mode=\"tethered\"",
            "time.beats=1",
            "wing.right.structure.spectral_radius=1",
            &steps,
        ]);
        let records = fly(&[&strings(&BLADES)[..], &set, &beam(2e-3)].concat());
        let residual = |r: &Record| r.energy_residual.abs();
        records.iter().map(residual).fold(0.0, f64::max)
    };
    let ratio = residual(160) / residual(320);
    assert!((3.3..4.7).contains(&ratio), "{ratio}");
}

/// A sheet instead of a beam: every panel of the mesh.
fn sheet(young: f64) -> Vec<String> {
    strings(&[
        &format!("wing.right.structure.shell.young_pa={young}"),
        "wing.right.structure.shell.thickness_m=[1e-3,1e-3]",
    ])
}

#[test]
fn limit_stiff_sheets_in_blade_elements_carry_what_rigid_wings_do() {
    let air = [&strings(&BLADES)[..], &strings(&LATTICE[..1])].concat();
    let rigid = fly(&air);
    let with = |young: f64| apart(&fly(&[&air[..], &sheet(young)].concat()), &rigid);
    let [soft, stiff] = [1e12, 1e13].map(with);
    assert!(stiff < 1e-2, "{stiff}");
    assert!((7.0..14.0).contains(&(soft / stiff)), "{soft} {stiff}");
}

#[test]
fn invariant_a_saved_flight_in_blade_elements_goes_on_bit_for_bit() {
    for structure in [beam(2e-3).to_vec(), sheet(3e9)] {
        let set = [
            &strings(&BLADES)[..],
            &strings(&["time.beats=0.3"]),
            &structure,
        ]
        .concat();
        goes_on(&set);
    }
}

#[test]
fn invariant_flights_in_blade_elements_have_the_same_bits_on_any_threads() {
    for structure in [beam(2e-3).to_vec(), sheet(3e9)] {
        let set = [
            &strings(&BLADES)[..],
            &strings(&["time.beats=0.2"]),
            &structure,
        ]
        .concat();
        let [one, three] = [1, 3].map(|n| {
            let threads = rayon::ThreadPoolBuilder::new().num_threads(n).build();
            threads.unwrap().install(|| fly(&set))
        });
        assert!(one == three);
    }
}

#[test]
fn balances_shape_and_loads_of_a_hawkmoth_in_blade_elements() {
    let set = strings(&["air.model=\"blade_element\"", "time.beats=3"]);
    let (twist, passes) = hawkmoth_extremes(&set);
    assert!((0.2..1.0).contains(&twist), "{twist}");
    assert!(passes <= 10, "{passes}");
}

/// A coarse hawkmoth in blade elements, its wings `factor` times as stiff as those of the preset.
fn hawkmoth(factor: f64) -> FlightSetup {
    hawkmoth_case(factor).setup
}

fn hawkmoth_case(factor: f64) -> LoadedCase {
    let stiffness = |key: &str, value: f64| {
        let value = factor * value;
        format!("wing.right.structure.beam.{key}_newton_m2=[{value},{value}]")
    };
    let set = strings(&[
        "air.model=\"blade_element\"",
        "time.steps_per_beat=32",
        "wing.right.mesh.chordwise=1",
        "wing.right.mesh.spanwise=4",
        "wing.right.structure.beam.elements=3",
        "wing.right.structure.damping_s=3e-4",
        &stiffness("flap", 1.8e-4),
        &stiffness("torsion", 2.6e-5),
    ]);
    LoadedCase::find("hawkmoth-elastic", &set).unwrap()
}

fn problem() -> TrimProblem {
    let mut problem = TrimProblem::straight(DVec3::ZERO, 45_f64.to_radians());
    problem.settings = TrimSettings {
        steps: 32,
        ..TrimSettings::default()
    };
    problem
}

fn trimmed(setup: &FlightSetup) -> WakeTrim {
    let settings = WakeSettings {
        tolerance: 1e-6,
        ..WakeSettings::default()
    };
    let found = trim_with_wake(setup, &problem(), &settings).unwrap();
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    found
}

/// The hawkmoth with the wings of the preset, trimmed.
static HAWKMOTH: LazyLock<WakeTrim> = LazyLock::new(|| trimmed(&hawkmoth(1.0)));

#[test]
fn agrees_a_trimmed_orbit_of_body_and_wings_with_flights_that_go_on_from_it() {
    let trim = &*HAWKMOTH;
    let mut setup = trim.setup.clone();
    let steps = setup.time.steps;
    setup.time.steps = 2 * steps;
    let mut flight = Simulation::bent(setup.clone(), &trim.past.wings).unwrap();
    let size = setup.animal.wings[0].report().length;
    let speed = size / setup.time.period.unwrap();
    let first = flight.record().clone();
    // The beat that was trimmed, and one that goes on without a new start of its method: its error in 32 steps.
    for closes in [1e-6, 5e-3] {
        for _ in 0..steps {
            flight.step().unwrap();
        }
        let now = flight.record();
        let drift = (now.mass_centre - first.mass_centre).length() / size;
        let change = (now.momentum - first.momentum).length() / setup.animal.mass() / speed;
        let tip = (now.elastic[0].tip - first.elastic[0].tip).length() / size;
        assert!(
            drift.max(change).max(tip) < closes,
            "{drift:e} {change:e} {tip:e}"
        );
    }
    // What the muscles pay: work of the hinges in the beat, by another sum.
    let power = power_with_wake(trim).unwrap();
    let mut flight = Simulation::bent(trim.setup.clone(), &trim.past.wings).unwrap();
    let before = flight.record().driving_work();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let mean = (flight.record().driving_work() - before) / setup.time.period.unwrap();
    assert!(
        (power.perfect_storage / mean - 1.0).abs() < 1e-2,
        "{power:?} {mean}"
    );
    // Damping takes a part, the air the rest: the energy of elastic wings closes to second order, within 8 % in
    // 32 steps.
    let dissipated = flight.record().dissipated / setup.time.period.unwrap();
    let rest = mean - power.aerodynamic - dissipated;
    assert!(
        dissipated > 0.0 && rest.abs() < 0.12 * mean,
        "{mean} {power:?} {dissipated}"
    );
}

/// What the free beats of the case that a trim writes change of the body, one after the other: drift over the
/// wing length, attitude \[rad\].
pub(super) fn departures(case: &LoadedCase, trim: &WakeTrim, beats: usize) -> Vec<[f64; 2]> {
    let text = wake_trimmed_case(case, trim);
    let written = LoadedCase::from_text("written", &text, Path::new("."), &[]);
    let mut setup = written.unwrap().setup;
    let MotionMode::Free(start) = &setup.mode else {
        panic!("it is free");
    };
    let (held, steps) = (start.held_steps, trim.setup.time.steps);
    setup.time.steps = held + beats * steps;
    let size = setup.animal.wings[0].report().length;
    let mut flight = Simulation::new(setup).unwrap();
    (0..held).for_each(|_| _ = flight.step().unwrap());
    let first = flight.root();
    let orbit = trim.orbit.as_ref().unwrap();
    let way = DVec3::from_array(orbit.position.each_ref().map(|x| x.rate / x.frequency));
    let beat = |k: usize| {
        (0..steps).for_each(|_| _ = flight.step().unwrap());
        let now = flight.root();
        let turn = DQuat::from_mat3(&(first.r.transpose() * now.r)).to_scaled_axis();
        let drift = now.p - first.p - k as f64 * way;
        [drift.length() / size, turn.length()]
    };
    (1..=beats).map(beat).collect()
}

#[test]
fn invariant_a_hold_on_a_moving_tether_and_its_release_go_on_bit_for_bit() {
    // The run is cut at its seventh step: in the hold, and after it.
    for held in [0.3, 0.05] {
        let set = strings(&[
            BLADES[0],
            "time.beats=0.4",
            "flight.mode=\"free\"",
            &format!("flight.held_beats={held}"),
            "flight.tether.x={frequency_hz=26,cosine_m=[1e-3]}",
            "flight.tether.pitch={frequency_hz=26,sine_deg=[4,1]}",
        ]);
        goes_on(&[&set[..], &beam(2e-3)].concat());
    }
}

/// A tether that moves and turns the body works on it, with both force and moment.
#[test]
fn order_energy_of_a_hold_on_a_moving_tether_and_its_release_closes() {
    let residual = |steps: usize| {
        let set = [
            "time.beats=1.2",
            "flight.held_beats=0.5",
            "flight.tether.x={frequency_hz=200,cosine_m=[1e-4]}",
            "flight.tether.pitch={frequency_hz=200,sine_deg=[3]}",
        ];
        let steps = format!("time.steps_per_beat={steps}");
        let case = LoadedCase::find("fruit-fly-blade", &strings(&[&set[..], &[&steps]].concat()));
        let mut flight = Simulation::new(case.unwrap().setup).unwrap();
        let (mut most, mut turned) = (0.0_f64, 0.0_f64);
        while !flight.finished() {
            let record = flight.step().unwrap();
            most = most.max(record.energy_residual.abs());
            turned = turned.max(record.kinetic_energy);
        }
        most / turned
    };
    let [coarse, fine] = [100, 200].map(residual);
    println!("{coarse:e} {fine:e}");
    assert!(coarse < 1e-5 && fine < 0.1 * coarse, "{coarse:e} {fine:e}");
}

#[test]
fn agrees_the_written_case_of_a_trimmed_hawkmoth_with_its_orbit() {
    let case = hawkmoth_case(1.0);
    // What 32 steps leave: 0.002 and 0.008; 0.012 and 0.006.
    let found = departures(&case, &HAWKMOTH, 2);
    assert!(
        found
            .iter()
            .all(|[drift, turn]| *drift < 1e-2 && *turn < 2e-2),
        "{found:?}"
    );
}

/// The case that a trim wrote is trimmed where it begins: what is left is what the harmonics of the tether
/// leave of the orbit.
#[test]
fn agrees_a_trim_of_a_trimmed_case_with_the_first() {
    let first = &*HAWKMOTH;
    let text = wake_trimmed_case(&hawkmoth_case(1.0), first);
    let again = LoadedCase::from_text("written", &text, Path::new("."), &[]);
    let setup = again.unwrap().setup;
    let pitch = setup.angles_at_release().x;
    let begun = (pitch - first.solution.body_pitch).abs();
    assert!(begun < 1e-5, "{begun:e}"); // what the harmonics beyond those of 32 steps have: 4e-6
    let problem = TrimProblem {
        body_pitch: pitch,
        ..problem()
    };
    let settings = WakeSettings {
        tolerance: 1e-6,
        ..WakeSettings::default()
    };
    let second = trim_with_wake(&setup, &problem, &settings).unwrap();
    let turned = (second.solution.body_pitch - first.solution.body_pitch).abs();
    let amplitude = second.solution.adjustment.stroke_amplitude.abs();
    println!(
        "{} steps, {turned:e} {amplitude:e}",
        second.solution.iterations
    );
    assert!(second.solution.converged && second.solution.iterations <= 2);
    assert!(
        turned < 1e-6 && amplitude < 1e-6, // the tolerance of both
        "{turned:e} {amplitude:e}"
    );
}

/// The motions of flight with one, two and three modes of each wing: each changes less than the one before, and
/// the check without flights says by how much.
#[test]
fn agrees_motions_of_flight_with_ever_more_modes_of_the_wings() {
    let trim = &*HAWKMOTH;
    let [two, three] = [2, 3].map(|count| elastic_monodromy(trim, count).unwrap());
    // The check without flights has the map that fewer flights give.
    let fewer = |map: &ElasticMonodromy| map.with_fewer_modes().unwrap().unwrap();
    let (one, reduced) = (fewer(&two), fewer(&three));
    let both = reduced.matrix.iter().zip(&two.matrix);
    let apart = both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("maps of 2 modes: {apart:e} apart");
    assert!(reduced.order == two.order && apart < 1e-8);
    let maps = [one, two, three];
    let sets = maps
        .each_ref()
        .map(|map| largest(&elastic_modes(map).unwrap()));
    let apart = |a: &[[f64; 2]], b: &[[f64; 2]]| {
        let nearest = |v: &[f64; 2]| {
            let all = b.iter().map(|w| (v[0] - w[0]).hypot(v[1] - w[1]));
            all.fold(f64::INFINITY, f64::min)
        };
        a.iter().map(nearest).fold(0.0, f64::max)
    };
    let [second, third] = [apart(&sets[1], &sets[0]), apart(&sets[2], &sets[1])];
    let said = [1, 2].map(|k| change_by_last_mode(&maps[k]).unwrap().unwrap());
    println!("{second:e} {third:e}, said {said:?}");
    assert!(third < 0.5 * second, "{second:e} {third:e}");
    assert!(said[1] < 0.5 * said[0], "{said:?}");
}

/// The unstable and the neutral ones among the modes of flight: multipliers of most size.
fn largest(set: &ModeSet) -> Vec<[f64; 2]> {
    let modes = set.modes.iter().map(|m| m.multiplier);
    modes.filter(|m| m[0].hypot(m[1]) > 0.6).collect()
}

#[test]
fn limit_trim_and_modes_of_stiff_wings_are_those_of_rigid_ones() {
    let setup = hawkmoth(30.0);
    let bent = trimmed(&setup);
    let mut rigid = setup.clone();
    rigid
        .animal
        .wings
        .iter_mut()
        .for_each(|w| w.structure = None);
    let flat = trim(&rigid, &problem()).unwrap();
    let value = flat.solution.value(Unknown::StrokeAmplitude).unwrap();
    let apart = (bent.solution.adjustment.stroke_amplitude - value).abs();
    assert!(apart < 0.02, "{apart} of {value}");
    assert!((bent.solution.body_pitch - flat.solution.body_pitch).abs() < 0.02);
    let [a, b] = [
        largest(&elastic_floquet(&bent, 1).unwrap()),
        largest(&floquet_of_trim(&flat).unwrap()),
    ];
    assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
    for (a, b) in a.iter().zip(&b) {
        assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 0.03, "{a:?} {b:?}");
    }
}
