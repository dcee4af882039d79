//! One coupled step of a free fly with two wings in the vortex lattice, 40 rows of wake kept.
//!
//! `cargo bench -p wingbeat-flight --bench step`

use divan::Bencher;
use wingbeat_flight::{AirModel, Simulation};

#[path = "../tests/common/mod.rs"]
mod common;

fn main() {
    divan::main();
}

#[divan::bench(sample_count = 50, sample_size = 1)]
fn coupled_step(bencher: Bencher) {
    let mut setup = common::Fly::default().setup(40, 10.0);
    if let AirModel::VortexLattice(air) = &mut setup.air {
        air.lattice.max_rows = Some(40);
    }
    let mut flight = Simulation::new(setup).expect("the little fly");
    for _ in 0..80 {
        flight.step().expect("a step");
    }
    bencher.bench_local(|| {
        flight.step().expect("a step");
    });
}
