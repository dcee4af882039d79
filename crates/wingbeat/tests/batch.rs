//! Many flights over threads.

use std::ops::ControlFlow::{Break, Continue};

use wingbeat::prelude::*;
use wingbeat::{ensemble, ensemble_watched};

/// Flights of different starts, lengths and airs; the third cannot go on.
fn flights() -> Vec<Flight> {
    let blade = Flight::preset("fruit-fly-blade").expect("a preset");
    let mut flights: Vec<Flight> = (0..6)
        .map(|k| {
            let start = StartState {
                angles: DVec3::new(0.2 * f64::from(k), 0.1, -0.05 * f64::from(k)),
                angular_velocity: DVec3::new(20.0, -10.0 * f64::from(k), 5.0),
                ..StartState::default()
            };
            blade.clone().start(start).beats(f64::from(1 + (k * k) % 4))
        })
        .collect();
    flights[2].setup.corrector.max_passes = 1;
    let lattice = Flight::preset_with("fruit-fly-hover", &["time.beats=0.1"]);
    flights.insert(4, lattice.expect("a preset"));
    flights
}

#[test]
fn invariant_bits_and_order_of_many_flights_for_any_number_of_threads() {
    let flights = flights();
    let alone: Vec<Result<Run, Error>> = flights.iter().map(Flight::fly).collect();
    for threads in [1, 2, 3, 8] {
        let together = fly_all(&flights, threads, |run| run).expect("threads");
        assert_eq!(together.len(), flights.len());
        for (k, (a, b)) in together.iter().zip(&alone).enumerate() {
            match (a, b) {
                (Ok(a), Ok(b)) => assert!(a.records == b.records, "flight {k}, {threads} threads"),
                (Err(a), Err(b)) => {
                    assert!(k == 2 && a.to_string() == b.to_string(), "flight {k}: {a}");
                }
                _ => panic!("flight {k} flew on {threads} threads or alone, not both"),
            }
        }
        assert!(together[2].is_err());
    }
    assert!(fly_all(&[], 2, |run| run).expect("threads").is_empty());
}

/// Where no two members of an ensemble that is stopped have reached their end, the means are those of the
/// wingbeats that all have: bit for bit those of an ensemble of as many wingbeats.
#[test]
fn agrees_an_ensemble_that_is_stopped_with_one_of_so_many_wingbeats() {
    let flight = |beats: f64| {
        let fly = Flight::preset("fruit-fly-blade").expect("a preset");
        fly.beats(beats)
    };
    let beat = flight(1.0).setup.time.steps;
    // One after the other on one thread: the first flies to its end, and in the second wingbeat of the second
    // it is stopped.
    let until = |member: usize, f: &Simulation| match member < 2 || f.state().step < beat + 7 {
        true => Continue(()),
        false => Break(()),
    };
    let found = ensemble_watched(&flight(3.0), 3, 1, None, until).expect("it begins");
    assert_eq!(
        (&found.members[..], &found.unfinished[..]),
        (&[1, 2][..], &[2, 3][..])
    );
    let stopped = found.ensemble.expect("a wingbeat of two flights");
    // Streams of members lie in directions that are spread over the number of all.
    let alone = ensemble_watched(&flight(1.0), 3, 1, None, |member, _| match member < 3 {
        true => Continue(()),
        false => Break(()),
    });
    assert_eq!(
        stopped,
        alone.expect("it begins").ensemble.expect("two flights")
    );
    assert_eq!(stopped.beats.len(), 1);
    // Stopped at once there are no means.
    let none = ensemble_watched(&flight(3.0), 3, 2, None, |_, _| Break(())).expect("it begins");
    assert!(
        none.ensemble.is_none() && none.unfinished == [1, 2, 3],
        "{none:?}"
    );
    let said = none.found().map(|_| ()).expect_err("none").to_string();
    assert!(said.contains("two members or more"), "{said}");
    assert_eq!(ensemble(&flight(1.0), 2, 1).expect("flown").members, 2);
}

/// A flight without a step was no flight, and had an empty history.
#[test]
fn refuses_a_flight_without_a_step() {
    let fly = Flight::preset("fruit-fly-blade").expect("a preset");
    for beats in [0.0, 1e-9, -1.0, f64::NAN] {
        let said = fly.clone().beats(beats).fly().map(|_| ());
        let said = said.expect_err("no step").to_string();
        assert!(
            said.contains("time.steps = 0") && said.contains("Flight::beats"),
            "{said}"
        );
    }
    assert_eq!(fly.beats(0.006).fly().expect("a step").records.len(), 2);
}
