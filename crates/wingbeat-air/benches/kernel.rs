//! Rate of the Biot-Savart kernel, in pairs (edge, target) per second on one core.
//!
//! `cargo bench -p wingbeat-air --bench kernel`

use divan::{Bencher, counter::ItemsCount};
use wingbeat_air::kernel::{CoreModel, DirectSum, InstructionSet, Network, Points};
use wingbeat_math::DVec3;

fn main() {
    divan::main();
}

const MODELS: [(&str, CoreModel); 4] = [
    ("cut-off", CoreModel::CutOff { delta: 1e-4 }),
    ("vatistas", CoreModel::Vatistas { radius: 1e-3 }),
    ("scully", CoreModel::Scully { radius: 1e-3 }),
    (
        "lamb-oseen",
        CoreModel::LambOseen {
            radius: 1e-3,
            viscosity: 1.5e-5,
        },
    ),
];

/// A wavy sheet of 40 x 40 rings.
fn sheet(model: CoreModel) -> Network {
    let n = 40;
    let mut net = Network::default();
    for i in 0..=n {
        for j in 0..=n {
            let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
            net.nodes.push(DVec3::new(x, y, 0.1 * (7.0 * x).sin()));
        }
    }
    for i in 0..=n {
        for j in 0..=n {
            let a = i * (n + 1) + j;
            if j < n {
                net.push_edge(a, a + 1, 1.0, model.core(0.025, 0.0));
            }
            if i < n {
                net.push_edge(a, a + n + 1, 1.0, model.core(0.025, 0.0));
            }
        }
    }
    net
}

fn rate(bencher: Bencher, set: &InstructionSet, model: CoreModel, shared: bool) {
    let net = sheet(model);
    let targets = Points::from_iter((0..1024).map(|i| DVec3::splat(i as f64 / 1024.0)));
    let mut sum = DirectSum::with_instructions(model, *set).expect("available");
    match shared {
        true => sum.load_network(&net),
        false => sum.load_segments(&net.to_segments()),
    }
    let mut out = Points::zeros(targets.len());
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("one thread");
    bencher
        .counter(ItemsCount::new(net.len() * targets.len()))
        .bench_local(|| pool.install(|| sum.add_velocity(&targets, &mut out)));
}

#[divan::bench(args = InstructionSet::available(), consts = [0, 1, 2, 3], sample_count = 20)]
fn network<const MODEL: usize>(bencher: Bencher, set: &InstructionSet) {
    rate(bencher, set, MODELS[MODEL].1, true);
}

#[divan::bench(args = InstructionSet::available(), sample_count = 20)]
fn free_segments(bencher: Bencher, set: &InstructionSet) {
    rate(bencher, set, MODELS[0].1, false);
}
