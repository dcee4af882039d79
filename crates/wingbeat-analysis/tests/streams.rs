//! Flights that are disturbed and held, through still air and against a stream: the same from axes that move with the
//! air.

use crate::common::*;

use wingbeat_analysis::control::{
    Departure, Held, Law, ProportionalDerivative, Reference, Regulator, SteeredBeats, Steering,
    Stiffness, Weights, disturbed,
};
use wingbeat_analysis::episode::{Draw, Recovery, Start, Task, Tumbles};
use wingbeat_analysis::wake::{WakeMemory, WakeSettings, trim_with_wake, wake_floquet};
use wingbeat_analysis::*;
use wingbeat_blade::BodyDrag;
use wingbeat_flight::AirModel;
use wingbeat_math::DVec3;

const STEPS: usize = 40;

/// The fruit fly at this speed forward through air that moves at `stream` along n1 [m/s].
fn flying(forward: f64, stream: f64) -> Trim {
    let mut setup = fly();
    if let AirModel::BladeElement(air) = &mut setup.air {
        air.blade.free_stream = DVec3::new(stream, 0.0, 0.0);
    }
    let mut problem = hover(STEPS);
    problem.velocity = DVec3::new(forward, 0.0, 0.0);
    let found = trim(&setup, &problem).expect("a trim");
    assert!(found.solution.converged);
    found
}

/// A law laid out about a trimmed flight; none: the open loop.
fn law(trim: &Trim, name: &str) -> Option<Law> {
    Some(match name {
        "regulator" => Law::Regulator(Regulator::new(trim, &Weights::default(), 1).expect("gains")),
        "loops" => {
            let loops = ProportionalDerivative::new(trim, &Stiffness::default());
            Law::Stabiliser(loops.expect("loops"))
        }
        _ => return None,
    })
}

/// Departures at the ends of the wingbeats of a flight under a law from a tilt [rad].
fn flown(trim: &Trim, name: &str, tilt: DVec3) -> [Departure; 12] {
    let by = Perturbation {
        tilt,
        ..Perturbation::default()
    };
    let held = Held::Known(Reference::trimmed(trim).expect("a reference"));
    let steering = law(trim, name).map(|law| Steering::new(law, held, &trim.setup));
    let flight = SteeredBeats::new(trim, disturbed(trim, &by), steering, 1);
    let mut flight = flight.expect("a flight");
    std::array::from_fn(|_| {
        flight.beat().expect("a wingbeat");
        flight.departure()
    })
}

/// Galilei: towed through still air or held against a stream, air and flyer meet alike.
#[test]
fn invariant_a_disturbed_flight_against_a_stream_and_through_still_air() {
    let [still, stream] = [flying(0.5, 0.0), flying(0.0, -0.5)];
    let length = still.beat.wing_length();
    let speed = length / still.beat.period();
    let tilt = 10_f64.to_radians();
    for name in ["none", "loops", "regulator"] {
        for axis in DVec3::AXES {
            let [a, b] = [&still, &stream].map(|trim| flown(trim, name, tilt * axis));
            for (k, (a, b)) in a.iter().zip(&b).enumerate() {
                // Trims of 1e-9, differences over steps of 1e-4 in the gains, unstable flight over 12 wingbeats.
                const NEAR: f64 = 1e-5;
                let parts = [
                    (a.position - b.position) / length,
                    (a.state.velocity - b.state.velocity) / speed,
                    a.state.tilt - b.state.tilt,
                ];
                let apart = parts.map(DVec3::length);
                assert!(
                    apart.iter().all(|x| *x < NEAR),
                    "{name}, {axis}, beat {k}: {apart:?}"
                );
            }
        }
    }
}

#[test]
fn invariant_recoveries_against_a_stream_and_through_still_air() {
    let [still, stream] = [flying(0.5, 0.0), flying(0.0, -0.5)];
    let recoveries = |trim: &Trim| -> [Recovery; 8] {
        let tumbles = Tumbles::new(trim, law(trim, "regulator"), 1, 60).expect("tumbles");
        std::array::from_fn(|k| tumbles.recovery(k as u64 + 1).expect("a flight"))
    };
    let [a, b] = [&still, &stream].map(recoveries);
    let recovered = a.iter().filter(|r| r.beats.is_some()).count();
    assert!(recovered > 0);
    for (a, b) in a.iter().zip(&b) {
        assert_eq!((a.beats, a.tilt), (b.beats, b.tilt));
    }
}

/// A tilt turns the flyer about its mass centre, and neither moves that nor turns the flight.
#[test]
fn exact_a_tilt_leaves_the_flight_its_velocity() {
    let trim = flying(0.5, 0.0);
    let tilted = |by: Perturbation| {
        let y = disturbed(&trim, &by);
        (
            DVec3::from_slice(&y),
            DVec3::from_slice(&y[7..]) / trim.beat.mass(),
        )
    };
    let (_, steady) = tilted(Perturbation::default());
    let mut draw = Draw::new(5, 0);
    for _ in 0..8 {
        let by = Start::drawn(Task::Recover, &trim.beat, &mut draw).by;
        let (place, velocity) = tilted(by);
        assert_eq!(place, DVec3::ZERO);
        // What the mass centre sways within a beat turns along, and keeps its size.
        let sway = [velocity - by.velocity, steady].map(|v| (v - trim.velocity).length());
        assert!((sway[0] - sway[1]).abs() < 1e-12, "{sway:?}");
        assert!(sway[1] < 0.05 * trim.velocity.length(), "{sway:?}");
    }
}

/// Modes of flight at the same speed through the air, in still air and in streams, with a body whose drag grows with the
/// square of the speed: exponents, names and shapes.
#[test]
fn invariant_modes_of_flight_in_streams() {
    let of = |forward: f64, stream: f64| {
        let mut setup = fly();
        if let AirModel::BladeElement(air) = &mut setup.air {
            air.blade.free_stream = DVec3::new(stream, 0.0, 0.0);
            air.body_drag = Some(BodyDrag {
                area: 1.8e-6,
                along: 0.6,
                across: 1.3,
                centre: None,
            });
        }
        let mut problem = hover(STEPS);
        problem.velocity = DVec3::new(forward + stream, 0.0, 0.0);
        let found = trim(&setup, &problem).expect("a trim");
        assert!(found.solution.converged);
        let model = linear_model(&found.beat, &found.state).expect("modes");
        // The matrix over the ground has the exponents of that through the air.
        let pairs = eigen(&model.matrix, 9).expect("numbers");
        let of_matrix = ModeSet::of_exponents(
            pairs,
            &Scales::new(found.beat.wing_length(), found.beat.period()),
        );
        let apart = of_matrix.modes.iter().zip(&model.modes.modes);
        let apart = apart.map(|(a, b)| (a.growth - b.growth).abs() * a.wingbeat);
        assert!(apart.fold(0.0, f64::max) < 1e-7);
        [
            model.modes,
            floquet(&found.beat, &found.state).expect("modes"),
        ]
    };
    for forward in [0.0, 0.5] {
        let still = of(forward, 0.0);
        for stream in [-forward, 3.0, 10.0] {
            for (a, b) in still.iter().zip(&of(forward, stream)) {
                for (a, b) in a.modes.iter().zip(&b.modes) {
                    assert_eq!((&a.name, a.plane), (&b.name, b.plane), "{stream}");
                    // Trims to 1e-9, their slopes by differences over steps of 1e-4 from numbers up to 20 times as
                    // large: 1e-16 x 20 / 1e-4.
                    const NEAR: f64 = 1e-7;
                    let apart = [a.growth - b.growth, a.frequency - b.frequency];
                    let apart = apart.map(|x| x * a.wingbeat);
                    assert!(apart.iter().all(|x| x.abs() < NEAR), "{stream}: {apart:?}");
                    for (a, b) in a.vector.iter().zip(&b.vector) {
                        // Neighbouring exponents are hundredths apart.
                        assert!((a.1 - b.1).abs() < 1e-5, "{stream}: {a:?} {b:?}");
                    }
                }
            }
        }
    }
}

/// Modes by flights of hold and release at the same speed through the air, in still air and in streams: exponents and
/// shapes.
#[test]
fn invariant_modes_by_flights_in_streams() {
    const FORWARD: f64 = 0.5;
    let of = |stream: f64| {
        let mut setup = fly();
        setup.time.step = 0.005 / STEPS as f64;
        if let AirModel::BladeElement(air) = &mut setup.air {
            air.blade.free_stream = DVec3::new(stream, 0.0, 0.0);
        }
        for wing in &mut setup.animal.wings {
            wing.motion.start = wingbeat_model::Start::Impulsive;
        }
        let mut problem = hover(STEPS);
        problem.velocity = DVec3::new(FORWARD + stream, 0.0, 0.0);
        let settings = WakeSettings {
            held_beats: 1,
            tolerance: 1e-7,
            ..WakeSettings::default()
        };
        let found = trim_with_wake(&setup, &problem, &settings).expect("a trim");
        assert!(found.solution.converged, "{:?}", found.solution.residual);
        [WakeMemory::Given, WakeMemory::Carried].map(|m| wake_floquet(&found, m).expect("modes"))
    };
    let still = of(0.0);
    for stream in [-FORWARD, 3.0] {
        for (a, b) in still.iter().zip(&of(stream)) {
            for (a, b) in a.modes.iter().zip(&b.modes) {
                assert_eq!((&a.name, a.plane), (&b.name, b.plane), "{stream}");
                let apart = [a.growth - b.growth, a.frequency - b.frequency];
                let apart = apart.map(|x| (x * a.wingbeat).abs());
                println!("{stream} {} {apart:?}", a.name);
                // Trims to 1e-7, differences over steps of 1e-3.
                assert!(apart.iter().all(|x| *x < 1e-5), "{stream}: {apart:?}");
                for (a, b) in a.vector.iter().zip(&b.vector) {
                    // Neighbouring exponents are hundredths apart.
                    assert!((a.1 - b.1).abs() < 1e-3, "{stream}: {a:?} {b:?}");
                }
            }
        }
    }
}
