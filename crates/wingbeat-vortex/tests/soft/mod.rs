//! The tree of algebraic cores: interpolation of the kernel between cells.

use crate::{bits, error, wakes};
use wingbeat_vortex::{
    CoreModel, DVec3, FastSettings, FastSum, InstructionSet, Method, Network, Points, Report,
};

const MODEL: CoreModel = CoreModel::Algebraic {
    radius: 0.0,
    viscosity: 0.0,
};

fn settings(tolerance: f64) -> FastSettings {
    FastSettings {
        method: Method::Tree,
        tolerance,
        ..FastSettings::new(MODEL)
    }
}

/// A wake whose cores grow from `thin` to `wide` with age, which runs along each of both sheets.
fn wake(edges: usize, [thin, wide]: [f64; 2]) -> Network {
    let mut net = wakes::hover(MODEL, edges);
    let half = net.nodes.len() / 2;
    let radius = |k: usize| thin + (wide - thin) * (k % half) as f64 / half as f64;
    net.nodes.core = (0..net.nodes.len()).map(|k| radius(k).powi(2)).collect();
    net
}

/// Velocity and vorticity.
fn both(settings: FastSettings, net: &Network, at: &Points) -> [Points; 2] {
    let mut sum = FastSum::new(settings);
    sum.load_network(net);
    let [mut u, mut w] = [Points::zeros(at.len()), Points::zeros(at.len())];
    sum.add_velocity_and_vorticity(at, &mut u, &mut w);
    [u, w]
}

fn exact(net: &Network, at: &Points) -> [Points; 2] {
    let direct = FastSettings {
        method: Method::Direct,
        ..FastSettings::new(MODEL)
    };
    both(direct, net, at)
}

fn velocity(settings: FastSettings, net: &Network, at: &Points) -> (Points, Report) {
    let mut sum = FastSum::new(settings);
    sum.load_network(net);
    let mut u = Points::zeros(at.len());
    let report = sum.add_velocity(at, &mut u);
    (u, report)
}

/// Velocity and vorticity alike, whatever the cores: from thin to wider than the wake.
#[test]
fn agrees_with_the_direct_sum_for_thin_wide_and_unequal_cores() {
    for cores in [[0.005, 0.01], [0.02, 0.5], [1.0, 2.0]] {
        let net = wake(10_000, cores);
        let [u, w] = exact(&net, &net.nodes);
        for tolerance in [2.5e-3, 1e-3] {
            let (fast, report) = velocity(settings(tolerance), &net, &net.nodes);
            assert_eq!(report.method, Method::Tree, "{cores:?} {report:?}");
            let rms = error(&fast, &u).0;
            // Measured: 2.4e-4 to 9.7e-4 of the laxer, 0.9e-4 to 4e-4 of the finer one.
            assert!(rms < 0.5 * tolerance, "{cores:?} {tolerance:e}: {rms:e}");
            assert!(report.error_rms > 0.3 * rms && report.error_rms < 3.0 * rms);
            let [fast, vorticity] = both(settings(tolerance), &net, &net.nodes);
            // Vorticities that are above the tolerance are summed in single precision, with the velocities.
            let of_both = [error(&fast, &u).0, error(&vorticity, &w).0];
            assert!(of_both[0] <= rms && of_both[1] < tolerance, "{of_both:?}");
        }
    }
}

/// The tolerance chooses the points of the interpolation: four along each direction, then five.
#[test]
fn order_finer_interpolation_has_a_smaller_error() {
    let net = wake(10_000, [0.02, 0.5]);
    let [u, _] = exact(&net, &net.nodes);
    let of = |tolerance| error(&velocity(settings(tolerance), &net, &net.nodes).0, &u).0;
    let (lax, fine) = (of(2.5e-3), of(1e-3));
    assert!(fine < 0.8 * lax, "{lax:e} {fine:e}");
}

/// Wide cores have a far field: pairs that are spared.
#[test]
fn limit_of_cores_as_wide_as_the_wake_spares_most_pairs() {
    let net = wake(10_000, [3.0, 5.0]);
    let pairs = (net.len() * net.nodes.len()) as u64;
    let near = |cores| {
        let net = wake(10_000, cores);
        velocity(settings(1e-3), &net, &net.nodes).1.near
    };
    let [wide, thin] = [near([3.0, 5.0]), near([0.005, 0.01])];
    assert!(
        wide < pairs / 50 && thin < pairs / 2 + pairs / 8,
        "{wide} {thin} of {pairs}"
    );
}

/// Bare filaments: the expansions of the tree of other cores know them too.
#[test]
fn limit_of_no_cores_agrees_with_the_expansions() {
    let net = wake(10_000, [0.0, 0.0]);
    let places = net.edges.iter().map(|&[a, b]| {
        let (a, b) = (net.nodes.get(a as usize), net.nodes.get(b as usize));
        0.5 * (a + b) + DVec3::new(0.0, 0.0, 0.03)
    });
    let at: Points = places.step_by(3).collect();
    let bare = CoreModel::CutOff { delta: 0.0 };
    let mut expansions = FastSum::new(FastSettings {
        method: Method::Tree,
        tolerance: 1e-5,
        ..FastSettings::new(bare)
    });
    expansions.load_network(&net);
    let mut other = Points::zeros(at.len());
    expansions.add_velocity(&at, &mut other);
    let (u, report) = velocity(settings(1e-3), &net, &at);
    assert_eq!(report.method, Method::Tree);
    let rms = error(&u, &other).0;
    // Some tens of samples tell the root mean square of a long-tailed error to a factor of two.
    assert!(rms < 2e-3 && report.error_rms < 1e-3, "{rms:e} {report:?}");
}

#[test]
fn invariant_bits_under_threads_and_instructions_with_algebraic_cores() {
    let net = wake(6_000, [0.02, 0.5]);
    let run = |threads: usize, instructions: InstructionSet| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let settings = FastSettings {
            instructions,
            ..settings(1e-3)
        };
        let sums = pool
            .build()
            .unwrap()
            .install(|| both(settings, &net, &net.nodes));
        sums.map(|v| bits(&v))
    };
    let one = run(1, InstructionSet::Best);
    assert_eq!(one, run(3, InstructionSet::Best));
    for set in InstructionSet::available() {
        assert_eq!(one, run(2, set), "{set:?}");
    }
}

#[test]
fn invariant_second_use_gives_the_first_one_s_bits_with_algebraic_cores() {
    let [small, large] = [6_000, 9_000].map(|edges| wake(edges, [0.02, 0.5]));
    let expected = velocity(settings(1e-3), &small, &small.nodes).0;
    let mut used = FastSum::new(settings(1e-3));
    used.load_network(&large);
    used.add_velocity(&large.nodes, &mut Points::zeros(large.nodes.len()));
    used.load_network(&small);
    let mut v = Points::zeros(small.nodes.len());
    used.add_velocity(&small.nodes, &mut v);
    assert_eq!(bits(&v), bits(&expected));
}

/// Reflected sources make reflected velocities at reflected places: cells may be halved elsewhere, within the
/// tolerance.
#[test]
fn invariant_under_a_mirror_to_the_tolerance() {
    let net = wake(8_000, [0.02, 0.5]);
    let mut image = net.clone();
    image.nodes.y.iter_mut().for_each(|y| *y = -*y);
    image.gamma.iter_mut().for_each(|gamma| *gamma = -*gamma);
    let (v, _) = velocity(settings(1e-3), &net, &net.nodes);
    let (mut w, _) = velocity(settings(1e-3), &image, &image.nodes);
    w.y.iter_mut().for_each(|y| *y = -*y);
    assert!(error(&v, &w).0 < 1e-3);
}

/// No sources, no targets, one of each, all in one place, without circulation, and places beyond the range of single
/// precision.
#[test]
fn exact_degenerate_sizes_of_algebraic_cores() {
    let one = |net: &Network, at: &Points| {
        let [u, w] = both(settings(1e-3), net, at);
        assert!(u.iter().chain(w.iter()).all(|v| v.is_finite()));
        u
    };
    let net = wake(600, [0.02, 0.5]);
    assert_eq!(
        one(&Network::default(), &net.nodes),
        Points::zeros(net.nodes.len())
    );
    assert!(one(&net, &Points::default()).is_empty());
    let mut single = Network::default();
    single.nodes.push_with_core(DVec3::ZERO, 0.04);
    single.nodes.push_with_core(DVec3::X, 0.04);
    single.push_edge(0, 1, 1.0, 0.0);
    let mut at = Points::default();
    at.push_with_core(DVec3::Y, 0.01);
    let (u, [v, _]) = (one(&single, &at), exact(&single, &at));
    assert!(u.get(0).distance(v.get(0)) < 1e-6 * v.get(0).length());
    for core in [0.0, 0.5] {
        let mut heap = Network::default();
        heap.nodes.push_with_core(DVec3::X, core);
        heap.nodes.push_with_core(DVec3::Y, core);
        (0..3000).for_each(|i| heap.push_edge(0, 1, 1.0 / (1 + i) as f64, 0.0));
        let mut at = Points::default();
        (0..2000).for_each(|i| at.push_with_core((i % 2) as f64 * DVec3::X, core));
        let (u, [v, _]) = (one(&heap, &at), exact(&heap, &at));
        assert!(error(&u, &v).0 < 1e-3);
    }
    let mut still = wake(600, [0.02, 0.5]);
    still.gamma.fill(0.0);
    assert!(one(&still, &still.nodes).iter().all(|v| v == DVec3::ZERO));
    let mut beyond = net.nodes.clone();
    beyond.x.iter_mut().for_each(|x| *x += 1e24);
    assert_eq!(one(&net, &beyond), exact(&net, &beyond)[0]);
}

/// Cells are taken only where they are the cheapest sum.
#[test]
fn behaves_auto_takes_cells_only_where_they_pay() {
    let auto = FastSettings {
        method: Method::Auto,
        ..settings(1e-3)
    };
    for (edges, cores, method) in [
        (8_000, [0.02, 0.5], Method::Single),
        (40_000, [0.02, 0.5], Method::Mesh),
        (40_000, [0.005, 0.01], Method::Tree), // too thin for meshes
    ] {
        let net = wake(edges, cores);
        assert_eq!(velocity(auto, &net, &net.nodes).1.method, method);
    }
    // At a tolerance that is too fine for them nothing changes.
    let net = wake(8_000, [0.02, 0.5]);
    let (fine, report) = velocity(FastSettings::new(MODEL), &net, &net.nodes);
    let single = FastSettings {
        method: Method::Single,
        ..FastSettings::new(MODEL)
    };
    assert_eq!(report.method, Method::Single);
    assert_eq!(bits(&fine), bits(&velocity(single, &net, &net.nodes).0));
}

/// Velocity and vorticity at a tolerance too fine for cells: the expansions of other cores know no vorticity, single
/// precision takes over.
#[test]
fn agrees_tree_below_the_tolerance_of_cells_takes_single_precision() {
    let net = wake(6_000, [0.02, 0.5]);
    let single = FastSettings {
        method: Method::Single,
        ..FastSettings::new(MODEL)
    };
    let [tree, single, double] = [
        both(settings(1e-4), &net, &net.nodes),
        both(single, &net, &net.nodes),
        exact(&net, &net.nodes),
    ];
    assert_eq!(tree, single, "the same bits");
    for (sum, exact) in tree.iter().zip(&double) {
        let rms = error(sum, exact).0;
        println!("{rms:e}");
        assert!(0.0 < rms && rms < 1e-5, "{rms:e}");
    }
}
