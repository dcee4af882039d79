//! Suction held in the solution, on wings that loads bend and on four wings.

use super::{LATTICE, apart, beam, fly, goes_on, strings};
use wingbeat::case::LoadedCase;
use wingbeat::flight::{Record, Simulation};

/// All edges but the root shed, leading ones what is beyond the suction they hold.
fn implicit() -> Vec<String> {
    let shed = strings(&[
        "air.shed=[\"trailing\",\"tip\",\"leading\"]",
        "air.leading_edge=\"suction_implicit\"",
        "air.leading_edge_threshold=0.1",
    ]);
    [strings(&LATTICE), shed].concat()
}

fn largest_force(records: &[Record]) -> f64 {
    (records.iter()).fold(0.0_f64, |m, r| m.max(r.air_force().length()))
}

#[test]
fn limit_stiff_wings_with_suction_in_the_solution_carry_what_rigid_ones_do() {
    let rigid = fly(&implicit());
    let attached = fly(&[implicit(), strings(&["air.leading_edge_threshold=9"])].concat());
    let largest = largest_force(&rigid);
    assert!(apart(&attached, &rigid) > 0.1 * largest); // edges do shed
    // Over 32 of 40 steps: wakes part flights that differ by a millionth by a thousandth within a few more.
    let early = &rigid[..=32];
    let with = |b: [String; 2]| apart(&fly(&[&implicit()[..], &b].concat()), early) / largest;
    let [soft, stiff] = [beam(2.0), beam(20.0)].map(with);
    println!("{soft:e}, ten times stiffer {stiff:e}");
    assert!(apart(&attached, early) > 100.0 * stiff * largest); // ... by then, too
    // What is left goes with 1 / stiffness (6.4e-5 measured).
    assert!(
        stiff < 5e-4 && (7.0..14.0).contains(&(soft / stiff)),
        "{soft} {stiff}"
    );
}

#[test]
fn invariant_a_saved_flight_with_suction_in_the_solution_goes_on_bit_for_bit() {
    goes_on(&[&implicit()[..], &strings(&["time.beats=0.25"]), &beam(2e-3)].concat());
}

/// The preset `dragonfly`, its leading edges shedding, on coarse panels.
fn dragonfly(set: &[&str]) -> Vec<Record> {
    let coarse = ["fore", "hind"].map(|w| format!("wing.{w}-right.mesh.spanwise=4"));
    let set = [&coarse[..], &implicit()[2..], &strings(set)].concat();
    let case = LoadedCase::find("dragonfly", &set).unwrap();
    let mut flight = Simulation::new(case.setup).unwrap();
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        records.push(flight.step().unwrap().clone());
    }
    records
}

#[test]
fn invariant_four_wings_with_suction_in_the_solution_fly_alike_on_either_side() {
    // Held: free, the whole flyer is light in roll, which the half cannot do, and the air's answer to
    // accelerations is a rate and no difference over steps.
    let set = [
        "flight={ mode = \"tethered\" }",
        "time.beats=1.25",
        "time.steps_per_beat=24",
    ];
    let half = dragonfly(&set);
    let whole = dragonfly(&[&set[..], &["air.mirror=false"]].concat());
    let attached = dragonfly(&[&set[..], &["air.leading_edge_threshold=9"]].concat());
    let largest = largest_force(&half);
    let [of_halves, of_shedding] = [&whole, &attached].map(|r| apart(r, &half) / largest);
    println!("halves {of_halves:e}, shedding {of_shedding}");
    assert!(of_shedding > 0.1); // edges do shed
    // Wakes' velocities are summed to 1e-4, and what they make of that grows (9e-5 measured).
    assert!(of_halves < 1e-3, "{of_halves:e}");
}
