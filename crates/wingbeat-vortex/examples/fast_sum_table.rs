//! Cost and error of the fast sum against the direct one on hover-like wakes.
//!
//! `cargo run --release -p wingbeat-vortex --example fast_sum_table -- [wide] [EDGES ...]`
//!
//! With `wide` cores are algebraic and widen with age from 0.02 to 0.5 wing lengths, velocity and vorticity are
//! summed by tree and by meshes with a tolerance of 1e-3, and the other sum is that in single precision.
//!
//! Seconds are processor seconds of all threads where the system tells them (Linux), so that other
//! work on the machine disturbs little.

#[path = "../tests/wakes/mod.rs"]
mod wakes;

use std::time::Instant;
use wingbeat_vortex::{
    CoreModel, FastSettings, FastSum, Method, Network, Points, Report, add_velocity,
};

fn main() {
    let is_wide = std::env::args().nth(1).is_some_and(|a| a == "wide");
    let sizes: Vec<usize> = std::env::args()
        .skip(1 + usize::from(is_wide))
        .map(|a| a.parse().expect("edges"))
        .collect();
    let sizes = if sizes.is_empty() {
        vec![10_000, 20_000, 100_000]
    } else {
        sizes
    };
    if is_wide {
        return wide(&sizes);
    }
    println!(
        "   edges    nodes   load    sum   wall  direct      rms      max cells edges  (s, of velocity, per target)"
    );
    for edges in sizes {
        let model = CoreModel::Vatistas { radius: 0.02 };
        let net = wakes::hover(model, edges);
        let mut fast = FastSum::new(FastSettings {
            method: Method::Tree,
            ..FastSettings::new(model)
        });
        let (load, _, ()) = timed(|| fast.load_network(&net));
        let mut v = Points::zeros(net.nodes.len());
        let (sum, wall, report) = timed(|| fast.add_velocity(&net.nodes, &mut v));
        print_row(model, &net, &v, [load, sum, wall], report);
    }
}

/// The same of algebraic cores, both ways.
fn wide(sizes: &[usize]) {
    println!(
        "   edges    nodes   tree   mesh  single  rms of velocity, of vorticity, tree and mesh  (processor seconds, the loading included)"
    );
    for &edges in sizes {
        let model = CoreModel::Algebraic {
            radius: 0.0,
            viscosity: 0.0,
        };
        let mut net = wakes::hover(model, edges);
        let half = net.nodes.len() / 2;
        let radius = |k: usize| 0.02 + 0.48 * (k % half) as f64 / half as f64;
        net.nodes.core = (0..net.nodes.len()).map(|k| radius(k).powi(2)).collect();
        let n = net.nodes.len();
        let part = n.min(if edges > 50_000 { 4096 } else { n });
        let mut some = Points::default();
        for i in 0..part {
            let k = i * n / part;
            some.push_with_core(net.nodes.get(k), net.nodes.core[k]);
        }
        let sum = |method, at: &Points| {
            let mut fast = FastSum::new(FastSettings {
                method,
                tolerance: 1e-3,
                ..FastSettings::new(model)
            });
            let mut both = [Points::zeros(at.len()), Points::zeros(at.len())];
            let [u, w] = &mut both;
            let (seconds, _, ()) = timed(|| {
                fast.load_network(&net);
                fast.add_velocity_and_vorticity(at, u, w);
            });
            (seconds, both)
        };
        let (single, of_single) = sum(Method::Single, &some);
        let single = single * n as f64 / part as f64;
        let [(tree, of_tree), (mesh, of_mesh)] = [Method::Tree, Method::Mesh].map(|method| {
            let (seconds, sums) = sum(method, &net.nodes);
            let error = |k: usize| {
                let pair = |i: usize| (of_single[k].get(i), sums[k].get(i * n / part));
                let pairs = || (0..part).map(pair);
                let square: f64 = pairs().map(|(a, _)| a.length_squared()).sum();
                let error: f64 = pairs().map(|(a, b)| a.distance_squared(b)).sum();
                (error / square).sqrt()
            };
            (seconds, [0, 1].map(error))
        });
        let ([u, w], [v, x], edges) = (of_tree, of_mesh, net.len());
        println!(
            "{edges:>8} {n:>8} {tree:>6.2} {mesh:>6.2} {single:>7.2} {u:>9.1e} {w:>9.1e} {v:>9.1e} {x:>9.1e}"
        );
    }
}

/// One line: the direct sum is done at a part of the targets and its time scaled up.
fn print_row(
    model: CoreModel,
    net: &Network,
    v: &Points,
    [load, sum, wall]: [f64; 3],
    report: Report,
) {
    let (n, part) = (net.nodes.len(), net.nodes.len().min(2048));
    let some: Points = (0..part).map(|i| net.nodes.get(i * n / part)).collect();
    let mut exact = Points::zeros(part);
    let (seconds, _, ()) = timed(|| add_velocity(model, net, &some, &mut exact));
    let all = seconds * n as f64 / part as f64;
    let error = |i: usize| exact.get(i).distance_squared(v.get(i * n / part));
    let square = exact.iter().map(|v| v.length_squared()).sum::<f64>() / part as f64;
    let rms = ((0..part).map(error).sum::<f64>() / part as f64 / square).sqrt();
    let max = ((0..part).map(error).fold(0.0, f64::max) / square).sqrt();
    let (far, near) = (report.far / n as u64, report.near / n as u64);
    println!(
        "{:>8} {n:>8} {load:>6.2} {sum:>6.2} {wall:>6.2} {all:>7.2} {rms:>8.1e} {max:>8.1e} {far:>5} {near:>5}  sampled {:.1e} {:.1e}, attempts {}",
        net.len(),
        report.error_rms,
        report.error_max,
        report.attempts
    );
}

/// Processor seconds, wall seconds, result.
fn timed<T>(f: impl FnOnce() -> T) -> (f64, f64, T) {
    let (start, cpu) = (Instant::now(), processor_seconds());
    let result = f();
    let wall = start.elapsed().as_secs_f64();
    let cpu = processor_seconds()
        .zip(cpu)
        .map_or(wall, |(end, start)| end - start);
    (cpu, wall, result)
}

/// User time of the process so far, from the kernel's count of ticks of 10 ms.
fn processor_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let ticks: f64 = stat
        .rsplit(')')
        .next()?
        .split_whitespace()
        .nth(11)?
        .parse()
        .ok()?;
    Some(ticks / 100.0)
}
