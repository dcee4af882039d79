//! Rate of the kernel with the cut-off beside that of its own instruction mix, for each instruction set.
//!
//! `cargo run --release -p wingbeat-vortex --example kernel_rates`
//!
//! Both take turns in bursts of a millisecond, so that what else the processor does meets both alike.

use fearless_simd::dispatch;
use std::hint::black_box;
use std::time::Instant;
use wingbeat_vortex::{CoreModel, FastSettings, FastSum, InstructionSet, Method, Points};

#[path = "../benches/mix/mod.rs"]
mod mix;
#[path = "../tests/wavy/mod.rs"]
mod wavy;

const BURSTS: usize = 1500;

fn main() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("one thread").install(|| {
        println!("million pairs a second: middle (best)");
        println!("set      mix          kernel       kernel / mix: middle of pairs, of bests");
        InstructionSet::available().into_iter().for_each(rates);
    });
}

fn rates(set: InstructionSet) {
    let model = CoreModel::CutOff { delta: 1e-4 };
    let net = wavy::sheet(model, 40);
    let targets =
        Points::from_iter((0..256).map(|i| wingbeat_vortex::DVec3::splat(i as f64 / 256.0)));
    let mut sum = FastSum::new(FastSettings {
        method: Method::Direct,
        instructions: set,
        ..FastSettings::new(model)
    });
    sum.load_network(&net);
    let mut out = Points::zeros(targets.len());
    let pairs = net.len() * targets.len();
    let level = set.level().expect("available");
    let edges = pairs / 8;
    let mut seen = Vec::new();
    for _ in 0..BURSTS {
        let mixed = time(|| {
            dispatch!(level, simd => black_box(mix::mix(simd, black_box(0.3), edges)));
        });
        let summed = time(|| {
            sum.add_velocity(black_box(&targets), &mut out);
        });
        seen.push([mixed, summed].map(|seconds| pairs as f64 / seconds / 1e6));
    }
    let sorted = |of: &dyn Fn(&[f64; 2]) -> f64| {
        let mut all: Vec<f64> = seen.iter().map(of).collect();
        all.sort_unstable_by(f64::total_cmp);
        [all[BURSTS / 2], all[BURSTS - 1]]
    };
    let (mix, kernel) = (sorted(&|s| s[0]), sorted(&|s| s[1]));
    let ratio = sorted(&|s| s[1] / s[0])[0];
    println!(
        "{:8} {:4.0} ({:4.0})  {:4.0} ({:4.0})  {:.2}, {:.2}",
        format!("{set:?}"),
        mix[0],
        mix[1],
        kernel[0],
        kernel[1],
        ratio,
        kernel[1] / mix[1],
    );
}

fn time(f: impl FnOnce()) -> f64 {
    let start = Instant::now();
    f();
    start.elapsed().as_secs_f64()
}
