//! Sums allocate nothing once they have been through a size.

mod wakes;

use allocation_counter::measure;
use wingbeat_vortex::DVec3;
use wingbeat_vortex::{Blob, CoreModel, FastSettings, FastSum, GaussianSum, Method, Points};

#[test]
fn exact_no_allocation_after_warm_up() {
    let model = CoreModel::Vatistas { radius: 0.02 };
    let net = wakes::hover(model, 6_000);
    let mut sums = [Method::Tree, Method::Single, Method::Direct].map(|method| {
        FastSum::new(FastSettings {
            method,
            ..FastSettings::new(model)
        })
    });
    let mut v = Points::zeros(net.nodes.len());
    on_one_thread(|| {
        let mut step = || {
            for sum in &mut sums {
                sum.load_network(&net);
                sum.add_velocity(&net.nodes, &mut v);
            }
        };
        step();
        assert_eq!(measure(step).count_total, 0);
    });
}

/// Tree, meshes and single precision of algebraic cores.
#[test]
fn exact_no_allocation_of_algebraic_cores_after_warm_up() {
    let model = CoreModel::Algebraic {
        radius: 0.1,
        viscosity: 0.0,
    };
    let mut net = wakes::hover(model, 6_000);
    let cores = (0..net.nodes.len()).map(|k| 0.01 * (1.0 + (k % 7) as f64));
    net.nodes.core = cores.collect();
    let [mut u, mut w] = [
        Points::zeros(net.nodes.len()),
        Points::zeros(net.nodes.len()),
    ];
    on_one_thread(|| {
        for (method, tolerance) in [
            (Method::Tree, 1e-3),
            (Method::Mesh, 1e-3),
            (Method::Single, 1e-4),
        ] {
            let mut sum = FastSum::new(FastSettings {
                method,
                tolerance,
                ..FastSettings::new(model)
            });
            let mut step = || {
                sum.load_network(&net);
                assert_eq!(sum.add_velocity(&net.nodes, &mut u).method, method);
                sum.add_velocity_and_vorticity(&net.nodes, &mut u, &mut w);
            };
            step();
            assert_eq!(measure(step).count_total, 0, "{method:?}");
        }
    });
}

/// Expansions know no vorticities, and few targets are none of theirs: nothing is made ready for them then.
#[test]
fn exact_no_tree_where_nobody_asks_for_it() {
    let model = CoreModel::Algebraic {
        radius: 0.1,
        viscosity: 0.0,
    };
    let net = wakes::hover(model, 6_000);
    let held = |method: Method| {
        let settings = FastSettings {
            method,
            ..FastSettings::new(model)
        };
        let (mut sum, few) = (FastSum::new(settings), 600);
        let [mut u, mut w] = [0; 2].map(|_| Points::zeros(net.nodes.len()));
        let (at, mut v) = (net.nodes.iter().take(few).collect(), Points::zeros(few));
        let used = measure(|| {
            sum.load_network(&net);
            sum.add_velocity_and_vorticity(&net.nodes, &mut u, &mut w);
            sum.add_velocity(&at, &mut v);
        });
        (used.count_total, used.bytes_total)
    };
    on_one_thread(|| assert_eq!(held(Method::Auto), held(Method::Single)));
}

/// The mesh of blobs that move within the same box.
#[test]
fn exact_no_allocation_of_blobs_after_warm_up() {
    let net = wakes::hover(CoreModel::Vatistas { radius: 0.02 }, 6_000);
    let [low, high] = net
        .nodes
        .iter()
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        });
    let variance = (0.03 * (high - low).max_element()).powi(2);
    let cloud = |shift: f64| -> Vec<Blob> {
        let blob = |(i, x): (usize, DVec3)| Blob {
            position: low + (x - low) * shift,
            strength: DVec3::new(1.0, (i as f64).sin(), -1.0),
            core: variance * (1.0 + (i % 50) as f64),
        };
        net.nodes.iter().enumerate().map(blob).collect()
    };
    let clouds = [cloud(1.0), cloud(0.9)];
    let mut v = Points::zeros(net.nodes.len());
    on_one_thread(|| {
        let mut sum = GaussianSum::default();
        let mut step = |k: usize| {
            assert!(sum.load(&clouds[k], variance, [low, high], net.nodes.len()));
            assert!(sum.add_velocity(1e-4, &net.nodes, &mut v).is_mesh);
        };
        step(0);
        step(1);
        let again = measure(|| [0, 1].into_iter().for_each(step));
        assert_eq!(again.count_total, 0);
    });
}

/// Calls `f` on one thread: what rayon keeps for handing work to others is not ours to count.
fn on_one_thread<T: Send>(f: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    pool.install(f)
}
