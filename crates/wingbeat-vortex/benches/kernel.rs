//! Rate of the Biot-Savart kernel, in pairs (edge, target) per second on one core.
//!
//! `cargo bench -p wingbeat-vortex --bench kernel`

use divan::{Bencher, counter::ItemsCount};
use fearless_simd::dispatch;
use wingbeat_vortex::DVec3;
use wingbeat_vortex::{
    CoreModel, FastSettings, FastSum, InstructionSet, MESH_TOLERANCE, Method, Points,
};

mod mix;
#[path = "../tests/wakes/mod.rs"]
mod wakes;
#[path = "../tests/wavy/mod.rs"]
mod wavy;

fn main() {
    divan::main();
}

const MODELS: [(&str, CoreModel); 5] = [
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
    (
        "algebraic",
        CoreModel::Algebraic {
            radius: 1e-3,
            viscosity: 1.5e-5,
        },
    ),
];

/// In double precision.
#[divan::bench(args = InstructionSet::available(), consts = [0, 1, 2, 3, 4], sample_count = 20)]
fn network<const MODEL: usize>(bencher: Bencher, set: &InstructionSet) {
    let model = MODELS[MODEL].1;
    let net = wavy::sheet(model, 40);
    let targets = Points::from_iter((0..1024).map(|i| DVec3::splat(i as f64 / 1024.0)));
    let mut sum = FastSum::new(FastSettings {
        method: Method::Direct,
        instructions: *set,
        ..FastSettings::new(model)
    });
    sum.load_network(&net);
    let mut out = Points::zeros(targets.len());
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("one thread");
    bencher
        .counter(ItemsCount::new(net.len() * targets.len()))
        .bench_local(|| pool.install(|| sum.add_velocity(&targets, &mut out)));
}

/// In single precision, the check against double included.
#[divan::bench(args = InstructionSet::available(), consts = [0, 1, 2, 3, 4], sample_count = 20)]
fn single_precision<const MODEL: usize>(bencher: Bencher, set: &InstructionSet) {
    let model = MODELS[MODEL].1;
    let net = wavy::sheet(model, 40);
    let mut sum = FastSum::new(FastSettings {
        method: Method::Single,
        instructions: *set,
        ..FastSettings::new(model)
    });
    sum.load_network(&net);
    let mut out = Points::zeros(net.nodes.len());
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("one thread");
    bencher
        .counter(ItemsCount::new(net.len() * net.nodes.len()))
        .bench_local(|| {
            let report = pool.install(|| sum.add_velocity(&net.nodes, &mut out));
            assert_eq!(report.method, Method::Single);
        });
}

/// Velocity and vorticity in a hover-like wake of so many edges, as the wakes of insects are moved: algebraic cores
/// that widen with age, loading included.
#[divan::bench(args = [2_000, 10_000, 40_000], consts = [false, true], sample_count = 5, sample_size = 1)]
fn velocity_and_vorticity<const MESH: bool>(bencher: Bencher, edges: usize) {
    let model = MODELS[4].1;
    let mut net = wakes::hover(model, edges);
    let half = net.nodes.len() / 2;
    let radius = |k: usize| 0.02 + 0.48 * (k % half) as f64 / half as f64;
    net.nodes.core = (0..net.nodes.len()).map(|k| radius(k).powi(2)).collect();
    let mut sum = FastSum::new(FastSettings {
        method: if MESH { Method::Mesh } else { Method::Single },
        tolerance: MESH_TOLERANCE,
        ..FastSettings::new(model)
    });
    let [mut velocity, mut vorticity] = [0; 2].map(|_| Points::zeros(net.nodes.len()));
    bencher.counter(ItemsCount::new(net.len())).bench_local(|| {
        sum.load_network(&net);
        sum.add_velocity_and_vorticity(&net.nodes, &mut velocity, &mut vorticity);
    });
}

/// The bound: the instructions of the cut-off kernel on a sheet (one new node for two edges) with
/// all operands in registers.
#[divan::bench(args = InstructionSet::available(), sample_count = 20)]
fn instruction_mix(bencher: Bencher, set: &InstructionSet) {
    const EDGES: usize = 100_000;
    let level = set.level().expect("available");
    bencher
        .counter(ItemsCount::new(EDGES * 8))
        .bench_local(|| dispatch!(level, simd => mix::mix(simd, divan::black_box(0.3), EDGES)));
}
