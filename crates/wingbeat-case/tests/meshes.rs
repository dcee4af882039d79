//! Flights whose wakes are summed on meshes.

use crate::common::{fly, preset};
use wingbeat_case::LoadedCase;
use wingbeat_flight::{Record, Simulation};

/// A fly on its tether for more than a beat, at the end 2,700 nodes of wake; `more` besides.
fn case(more: &[&str]) -> LoadedCase {
    let set = ["time.beats=1.2", "air.body=false"];
    preset("fruit-fly-tethered", &[&set[..], more].concat())
}

const MESH: [&str; 2] = ["air.summation=mesh", "air.summation_tolerance=1e-3"];

/// Largest difference of the force of the air over the largest force.
fn apart(a: &[Record], b: &[Record]) -> f64 {
    let force = |r: &Record| r.air_force();
    let largest = b.iter().map(|r| force(r).length()).fold(0.0, f64::max);
    let pairs = a.iter().zip(b);
    let gaps = pairs.map(|(a, b)| (force(a) - force(b)).length());
    gaps.fold(0.0, f64::max) / largest
}

#[test]
fn agrees_flights_on_meshes_with_sums_of_single_precision() {
    let ground = "air.ground={point_m=[0,0,3e-3],normal=[0,0,-1]}";
    for more in ["air.mirror=false", ground] {
        let [mesh, direct] = [&MESH[..], &["air.summation=single"]]
            .map(|how| fly(case(&[how, &[more]].concat()).setup));
        let apart = apart(&mesh, &direct);
        println!("{more:?}: {apart:e}");
        // Sums are good to 4e-4 of the velocity of the wake; measured up to 2e-4.
        assert!(apart > 0.0 && apart < 1e-3, "{more:?}: {apart:e}");
    }
}

#[test]
fn exact_flights_on_meshes_go_on_bit_for_bit() {
    let case = case(&MESH);
    let whole = fly(case.setup.clone());
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    for _ in 0..40 {
        flight.step().unwrap();
    }
    let mut flight = Simulation::resume(case.setup.clone(), flight.state().clone()).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    assert!(*flight.record() == whole[whole.len() - 1]);
}
