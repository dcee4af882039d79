//! Instructions of the kernel, counted by valgrind: a gate that no other work on the machine disturbs.
//!
//! The test starts itself again under valgrind's callgrind, with few sums and with many; the difference
//! is theirs alone. Valgrind knows no AVX-512, so the AVX2 kernel is counted. Where AVX2 or a valgrind that
//! works is missing, the test says so and passes.

mod wavy;

use std::process::Command;
use wingbeat_vortex::DVec3;
use wingbeat_vortex::{CoreModel, FastSettings, FastSum, InstructionSet, Method, Points};

const MODEL: &str = "WINGBEAT_COUNTED_MODEL";
const SUMS: &str = "WINGBEAT_COUNTED_SUMS";

/// Core models and the most instructions a pair of edge and target may take: what was counted with
/// Rust 1.95, and a tenth more, for compilers differ.
const MODELS: [(CoreModel, f64); 4] = [
    (CoreModel::CutOff { delta: 1e-4 }, 27.3),
    (lamb_oseen(1e-2), 33.2), // most targets are far from most cores
    (lamb_oseen(1.0), 45.4),  // none is
    (ALGEBRAIC, 10.3),        // velocity and vorticity in single precision, with the check
];

const ALGEBRAIC: CoreModel = CoreModel::Algebraic {
    radius: 1e-2,
    viscosity: 1.5e-5,
};

const fn lamb_oseen(radius: f64) -> CoreModel {
    let viscosity = 1.5e-5;
    CoreModel::LambOseen { radius, viscosity }
}

/// Panels along a side of the sheet, and targets: single precision begins at 500 edges and targets.
fn sizes(model: CoreModel) -> [usize; 2] {
    if model == ALGEBRAIC {
        [16, 4096]
    } else {
        [12, 64]
    }
}

/// Pairs of edge and target in a sum.
fn pairs(model: CoreModel) -> f64 {
    let [n, targets] = sizes(model);
    (2 * n * (n + 1) * targets) as f64
}

/// What is counted.
fn sum(model: CoreModel, times: usize) {
    let [n, count] = sizes(model);
    let net = wavy::sheet(model, n);
    let line = |i: usize| DVec3::splat(i as f64 / count as f64);
    let targets: Points = (0..count).map(line).collect();
    let [mut out, mut more] = [0; 2].map(|_| Points::zeros(count));
    let is_single = model == ALGEBRAIC;
    let mut kernel = FastSum::new(FastSettings {
        method: if is_single {
            Method::Single
        } else {
            Method::Direct
        },
        ..FastSettings::new(model)
    });
    kernel.load_network(&net);
    if is_single {
        let mut add = || kernel.add_velocity_and_vorticity(&targets, &mut out, &mut more);
        (0..times).for_each(|_| add());
    } else {
        (0..times).for_each(|_| {
            kernel.add_velocity(&targets, &mut out);
        });
    }
    assert!(out.iter().chain(more.iter()).all(|v| v.is_finite()));
}

/// Instructions of this test when it sums so many times; None without a valgrind that works.
fn instructions(model: usize, times: usize) -> Option<f64> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe().expect("a path of its own"))
        .args(["--exact", "regress_instructions_of_a_pair"])
        .env(MODEL, model.to_string())
        .env(SUMS, times.to_string())
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .ok()?;
    let text = String::from_utf8_lossy(&output.stderr);
    let line = text.lines().find(|line| line.contains("Collected"));
    line.and_then(|line| line.split_whitespace().last()?.parse().ok())
}

#[test]
fn regress_instructions_of_a_pair() {
    let number = |key: &str| std::env::var(key).ok()?.parse::<usize>().ok();
    if let (Some(model), Some(times)) = (number(MODEL), number(SUMS)) {
        return sum(MODELS[model].0, times);
    }
    if !InstructionSet::available().contains(&InstructionSet::Avx2) {
        println!("skipped: no AVX2 is here whose instructions could be counted");
        return;
    }
    for (i, (model, most)) in MODELS.into_iter().enumerate() {
        // As much work for all of them.
        let times = if model == ALGEBRAIC { 2 } else { 200 };
        let Some((few, many)) = instructions(i, 1).zip(instructions(i, 1 + times)) else {
            println!("skipped: no valgrind that works is here");
            return;
        };
        let per_pair = (many - few) / (times as f64 * pairs(model));
        println!("{model:?}: {per_pair:.2} instructions a pair");
        assert!(
            per_pair < most,
            "{model:?}: {per_pair} instructions a pair, {most} allowed"
        );
    }
}
