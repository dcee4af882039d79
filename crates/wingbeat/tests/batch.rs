//! Many flights over threads.

use wingbeat::prelude::*;

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
