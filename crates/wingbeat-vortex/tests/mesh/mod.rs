//! Wide algebraic cores: Gaussians on meshes.

use crate::{bits, error};
use wingbeat_vortex::{
    CoreModel, DVec3, FastSettings, FastSum, InstructionSet, MESH_TOLERANCE, Method, Network,
    Points, Report, Tally,
};

const MODEL: CoreModel = CoreModel::Algebraic {
    radius: 0.0,
    viscosity: 0.0,
};

fn settings(method: Method) -> FastSettings {
    FastSettings {
        method,
        tolerance: MESH_TOLERANCE,
        ..FastSettings::new(MODEL)
    }
}

/// A column of polygons joined by filaments that grow and spread with age: lengths and cores from 0.1 to
/// `wide`, cores that differ by a factor of three from node to node.
fn column(rings: usize, wide: f64) -> Network {
    const SIDES: usize = 16;
    let mut net = Network::default();
    for k in 0..rings {
        let (age, wave) = (k as f64 / rings as f64, (1.7 * k as f64).sin());
        let length = 0.1 + (wide - 0.1) * age;
        for j in 0..SIDES {
            let angle = std::f64::consts::TAU * j as f64 / SIDES as f64 + 0.3 * wave;
            let radius = 1.5 * length * (1.0 + 0.3 * (3.1 * (j + k) as f64).sin());
            let core = 1.2 * length * 3f64.powf(0.5 * (2.3 * (3 * j + k) as f64).sin());
            let down = 5.0 * wide * age + 0.2 * length * wave;
            let place = DVec3::new(radius * angle.cos(), radius * angle.sin(), down);
            net.nodes.push_with_core(place, core * core);
        }
    }
    for k in 0..rings {
        for j in 0..SIDES {
            let (here, next) = (SIDES * k + j, SIDES * k + (j + 1) % SIDES);
            let gamma = 1.0 + 0.5 * (0.3 * k as f64).sin() + 0.2 * (j as f64).cos();
            net.push_edge(here, next, gamma, 0.0);
            if k + 1 < rings {
                net.push_edge(here, here + SIDES, 0.3 * (0.7 * (j + k) as f64).sin(), 0.0);
            }
        }
    }
    net
}

/// Middles of all filaments.
fn middles(net: &Network) -> Points {
    let mut out = Points::default();
    for e in 0..net.len() {
        let (a, b) = net.ends(e);
        let [i, j] = net.edges[e].map(|n| net.nodes.core[n as usize]);
        out.push_with_core(0.5 * (a + b), 0.5 * (i + j));
    }
    out
}

fn loaded(method: Method, net: &Network) -> FastSum {
    let mut sum = FastSum::new(settings(method));
    sum.load_network(net);
    sum
}

fn velocity(sum: &mut FastSum, at: &Points) -> (Points, Report) {
    let mut u = Points::zeros(at.len());
    let report = sum.add_velocity(at, &mut u);
    (u, report)
}

fn both(sum: &mut FastSum, at: &Points) -> [Points; 2] {
    let [mut u, mut w] = [Points::zeros(at.len()), Points::zeros(at.len())];
    sum.add_velocity_and_vorticity(at, &mut u, &mut w);
    [u, w]
}

/// Filaments as long as their cores are wide, cores that differ from node to node: velocity and vorticity at
/// the nodes and between them.
#[test]
fn agrees_with_the_direct_sum_for_long_filaments_of_unequal_cores() {
    for wide in [0.1, 2.0] {
        let net = column(400, wide);
        let [mut mesh, mut direct] = [Method::Mesh, Method::Direct].map(|m| loaded(m, &net));
        let (u, report) = velocity(&mut mesh, &net.nodes);
        let rms = error(&u, &velocity(&mut direct, &net.nodes).0).0;
        let few = (net.len() * net.nodes.len()) as u64 / 3;
        assert!(
            report.method == Method::Mesh && report.near < few,
            "{report:?}"
        );
        println!("{wide}: {rms:e} {report:?}");
        assert!(rms < 0.7 * MESH_TOLERANCE, "{wide}: {rms:e}");
        assert!(
            report.error_rms > 0.4 * rms && report.error_rms < 2.5 * rms,
            "{rms:e} {report:?}"
        );
        let at = middles(&net);
        let [fast, exact] = [&mut mesh, &mut direct].map(|sum| both(sum, &at));
        let rms = [0, 1].map(|k| error(&fast[k], &exact[k]).0);
        println!("  {rms:?}");
        assert!(
            rms.iter().all(|e| *e < 0.7 * MESH_TOLERANCE),
            "{wide}: {rms:?}"
        );
    }
}

/// Places without a core of their own see the narrow filaments one by one, the wide ones by meshes.
#[test]
fn agrees_at_bare_points() {
    let net = column(400, 1.0);
    let at: Points = middles(&net).iter().step_by(5).collect();
    let [mut mesh, mut direct] = [Method::Mesh, Method::Direct].map(|m| loaded(m, &net));
    let (u, report) = velocity(&mut mesh, &at);
    assert_eq!(report.method, Method::Mesh, "{report:?}");
    let rms = error(&u, &velocity(&mut direct, &at).0).0;
    assert!(rms < 0.7 * MESH_TOLERANCE, "{rms:e}");
}

/// In a wake that gets longer and wider, as old filaments stretch, pairs are for the most part those of what
/// was shed last, and targets read as many meshes as before.
#[test]
fn order_work_grows_little_faster_than_the_wake() {
    let work = |rings: usize, wide: f64| {
        let net = column(rings, wide);
        let report = velocity(&mut loaded(Method::Mesh, &net), &net.nodes).1;
        assert_eq!(report.method, Method::Mesh, "{report:?}");
        let n = net.nodes.len() as f64;
        [report.near as f64 / n, report.far as f64 / n, n]
    };
    let (few, many) = (work(300, 0.8), work(1200, 3.2));
    println!("{few:?} {many:?}");
    // In pairs, as measured: 250 for a mesh read, 500 for each of the two filaments of a node on it. The sum
    // one by one has a power of 2.
    let cost = |[near, far, n]: [f64; 3]| n * (near + (250.0 + 2.0 * 500.0) * far);
    let power = (cost(many) / cost(few)).ln() / (many[2] / few[2]).ln();
    println!("{power}");
    assert!(power < 1.2, "{power}");
}

#[test]
fn invariant_bits_under_threads_and_instructions_with_meshes() {
    let net = column(100, 1.0);
    let run = |threads: usize, instructions: InstructionSet| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            let mut sum = FastSum::new(FastSettings {
                instructions,
                ..settings(Method::Mesh)
            });
            sum.load_network(&net);
            assert_eq!(velocity(&mut sum, &net.nodes).1.method, Method::Mesh);
            both(&mut sum, &net.nodes).map(|v| bits(&v))
        })
    };
    let one = run(1, InstructionSet::Best);
    assert_eq!(one, run(3, InstructionSet::Best));
    for set in InstructionSet::available() {
        assert_eq!(one, run(2, set), "{set:?}");
    }
}

/// Meshes are kept between sums over the same sources: what is asked before does not count.
#[test]
fn invariant_of_what_was_summed_before() {
    let [small, large] = [150, 250].map(|rings| column(rings, 1.0));
    let expected = both(&mut loaded(Method::Mesh, &small), &small.nodes);
    let mut used = loaded(Method::Mesh, &large);
    velocity(&mut used, &large.nodes);
    used.load_network(&small);
    let mut beside = small.nodes.clone();
    beside.x.iter_mut().for_each(|x| *x += 3.0);
    velocity(&mut used, &beside);
    velocity(&mut used, &middles(&small));
    assert_eq!(both(&mut used, &small.nodes), expected);
}

/// Beside the plane halfway between two opposite lines vorticities cancel to a few parts of ten thousand: there that of meshes is
/// above the tolerance, and single precision takes over.
#[test]
fn exact_single_precision_where_meshes_do_not_keep_the_tolerance() {
    let mut net = Network::default();
    for (y, gamma) in [(-1.0, 1.0), (1.0, -1.0)] {
        let first = net.nodes.len();
        for k in 0..=400 {
            let place = DVec3::new(0.01 * f64::from(k), y, 0.0);
            net.nodes.push_with_core(place, 0.1 + 1e-4 * f64::from(k));
        }
        (first..first + 400).for_each(|n| net.push_edge(n, n + 1, gamma, 0.0));
    }
    let mut at = Points::default();
    for k in 0..1200 {
        let [x, y] = [1.3, 2.1].map(|f| (f * f64::from(k)).sin());
        at.push_with_core(DVec3::new(2.0 + x, 2e-4 * y, 0.0), 0.1);
    }
    let [mut mesh, mut single, mut direct] =
        [Method::Mesh, Method::Single, Method::Direct].map(|m| loaded(m, &net));
    assert_eq!(velocity(&mut mesh, &at).1.method, Method::Mesh);
    let [by_mesh, by_single, exact] = [&mut mesh, &mut single, &mut direct].map(|s| both(s, &at));
    assert!(by_mesh == by_single, "the same bits");
    let [checked, discarded] = [2, 1];
    assert_eq!(mesh.tally(), Tally { checked, discarded });
    let rms = error(&by_single[1], &exact[1]).0;
    println!("{rms:e}");
    assert!(0.0 < rms && rms < MESH_TOLERANCE, "{rms:e}");
}

/// Targets beside the sources enlarge the meshes; far away ones, and sources that no mesh serves, are summed
/// one by one.
#[test]
fn limit_of_far_targets_and_thin_cores() {
    let net = column(150, 1.0);
    let shifted = |by: f64| {
        let mut at = net.nodes.clone();
        at.x.iter_mut().for_each(|x| *x += by);
        at
    };
    for (by, method) in [
        (4.0, Method::Mesh),
        (60.0, Method::Single),
        (1e24, Method::Direct),
    ] {
        let at = shifted(by);
        let (u, report) = velocity(&mut loaded(Method::Mesh, &net), &at);
        assert_eq!(report.method, method, "{by}: {report:?}");
        let exact = velocity(&mut loaded(Method::Direct, &net), &at).0;
        assert!(u == exact || error(&u, &exact).0 < MESH_TOLERANCE, "{by}");
    }
    let mut thin = net.clone();
    thin.nodes.core.fill(0.0);
    let report = velocity(&mut loaded(Method::Mesh, &thin), &shifted(0.37)).1;
    assert_eq!(report.method, Method::Single, "{report:?}");
}

#[test]
fn exact_degenerate_sizes_of_wide_cores() {
    let net = column(20, 1.0);
    let none = Network::default();
    let zeros = Points::zeros(net.nodes.len());
    assert_eq!(
        velocity(&mut loaded(Method::Mesh, &none), &net.nodes).0,
        zeros
    );
    let no_targets = velocity(&mut loaded(Method::Mesh, &net), &Points::default()).0;
    assert!(no_targets.is_empty());
    let mut still = net.clone();
    still.gamma.fill(0.0);
    assert_eq!(
        velocity(&mut loaded(Method::Mesh, &still), &net.nodes).0,
        zeros
    );
    // All in one place.
    let mut heap = Network::default();
    heap.nodes.push_with_core(DVec3::X, 0.5);
    heap.nodes.push_with_core(DVec3::X, 0.5);
    (0..3000).for_each(|i| heap.push_edge(0, 1, 1.0 / (1 + i) as f64, 0.0));
    let mut at = Points::default();
    (0..2000).for_each(|i| at.push_with_core((i % 2) as f64 * DVec3::X, 0.5));
    assert!(
        velocity(&mut loaded(Method::Mesh, &heap), &at)
            .0
            .iter()
            .all(|v| v == DVec3::ZERO)
    );
}

/// Where meshes are the cheapest sum they are taken, at tolerances that they keep.
#[test]
fn behaves_auto_takes_meshes_where_they_pay() {
    let (few, many) = (column(150, 1.0), column(1000, 1.0));
    let method = |net: &Network| {
        velocity(&mut loaded(Method::Auto, net), &net.nodes)
            .1
            .method
    };
    assert_eq!(method(&few), Method::Single);
    assert_eq!(method(&many), Method::Mesh);
    let mut fine = FastSum::new(FastSettings::new(MODEL));
    fine.load_network(&many);
    assert_eq!(velocity(&mut fine, &many.nodes).1.method, Method::Single);
}
