//! Evidence for the fast sum: the direct one.

mod common;
mod mesh;
mod soft;
mod wakes;

use wingbeat_vortex::DVec3;
use wingbeat_vortex::{
    CoreModel, FastSettings, FastSum, InstructionSet, Method, Network, Points, Tally,
};

use common::{bits, direct, error};

const MODELS: [CoreModel; 5] = [
    CoreModel::CutOff { delta: 4e-4 },
    CoreModel::Vatistas { radius: 0.02 },
    CoreModel::Scully { radius: 0.005 },
    CoreModel::LambOseen {
        radius: 0.02,
        viscosity: 0.0,
    },
    CoreModel::Algebraic {
        radius: 0.005,
        viscosity: 0.0,
    },
];

fn tree(model: CoreModel) -> FastSettings {
    FastSettings {
        method: Method::Tree,
        ..FastSettings::new(model)
    }
}

#[test]
fn agrees_with_the_direct_sum_for_every_core_model() {
    for model in MODELS {
        let mut net = wakes::hover(model, 10_000);
        // Cores of sources and targets that differ from place to place; only algebraic ones ask for them.
        let cores = (0..net.nodes.len()).map(|k| 2.5e-5 * (1.0 + (k % 7) as f64));
        net.nodes.core.extend(cores);
        let exact = direct(model, &net, &net.nodes);
        let mut fast = FastSum::new(tree(model));
        fast.load_network(&net);
        let mut v = Points::zeros(exact.len());
        let report = fast.add_velocity(&net.nodes, &mut v);
        let (rms, max) = error(&v, &exact);
        assert_eq!(report.method, Method::Tree);
        assert!(
            report.near < (net.len() * exact.len()) as u64,
            "{model:?} spares something"
        );
        // The tolerance is on the root mean square at 64 samples; the largest of some thousand
        // targets lies beside a vortex and is some ten times worse.
        assert!(
            rms < 1e-4 && max < 1e-3,
            "{model:?} {rms:e} {max:e} {report:?}"
        );
        assert!(
            report.error_rms < 1e-4 && report.error_rms > 0.1 * rms,
            "{model:?} {rms:e} {report:?}"
        );
    }
}

#[test]
fn agrees_at_any_tolerance_asked_for() {
    let model = CoreModel::CutOff { delta: 1e-6 };
    let net = wakes::hover(model, 6_000);
    let exact = direct(model, &net, &net.nodes);
    let mut far = vec![];
    for tolerance in [1e-2, 1e-3, 1e-5, 1e-7, 1e-9] {
        let mut fast = FastSum::new(FastSettings {
            tolerance,
            ..tree(model)
        });
        fast.load_network(&net);
        let mut v = Points::zeros(exact.len());
        let report = fast.add_velocity(&net.nodes, &mut v);
        let (rms, _) = error(&v, &exact);
        // 64 samples tell the root mean square of a long-tailed error to a factor of two.
        assert!(rms < 2.0 * tolerance, "{tolerance:e}: {rms:e} {report:?}");
        far.push(report.near);
    }
    assert!(
        far[0] < far[2] && far[2] < far[4],
        "a looser tolerance is cheaper: {far:?}"
    );
}

#[test]
fn invariant_bits_under_threads_and_instructions() {
    let model = MODELS[1];
    let net = wakes::hover(model, 5_000);
    let run = |threads: usize, instructions: InstructionSet, method: Method| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut fast = FastSum::new(FastSettings {
                instructions,
                method,
                ..FastSettings::new(model)
            });
            fast.load_network(&net);
            let mut v = Points::zeros(net.nodes.len());
            let report = fast.add_velocity(&net.nodes, &mut v);
            (bits(&v), report)
        })
    };
    for method in [Method::Tree, Method::Single] {
        let one = run(1, InstructionSet::Best, method);
        assert_eq!(one.1.method, method);
        assert_eq!(one, run(4, InstructionSet::Best, method));
        for set in InstructionSet::available() {
            assert_eq!(one, run(2, set, method), "{set:?}");
        }
    }
}

#[test]
fn invariant_second_use_gives_the_first_one_s_bits() {
    let model = MODELS[1];
    let (small, large) = (wakes::hover(model, 5_000), wakes::hover(model, 9_000));
    let mut fresh = FastSum::new(tree(model));
    fresh.load_network(&small);
    let mut expected = Points::zeros(small.nodes.len());
    fresh.add_velocity(&small.nodes, &mut expected);
    let mut used = FastSum::new(tree(model));
    used.load_network(&large);
    used.add_velocity(&large.nodes, &mut Points::zeros(large.nodes.len()));
    used.load_network(&small);
    let mut v = Points::zeros(small.nodes.len());
    used.add_velocity(&small.nodes, &mut v);
    assert_eq!(bits(&v), bits(&expected));
}

#[test]
fn invariant_to_the_bit_under_a_change_of_length_by_a_power_of_two() {
    // A fly's millimetres and a robot's metres: nothing in the sum knows an absolute length.
    let model = MODELS[1];
    let large = wakes::hover(model, 6_000);
    let k = 1.0 / 1024.0;
    let mut small = large.clone();
    small.nodes = large.nodes.iter().map(|p| p * k).collect();
    small.core.iter_mut().for_each(|c| *c *= k * k);
    let run = |net: &Network| {
        let mut fast = FastSum::new(tree(model));
        fast.load_network(net);
        let mut v = Points::zeros(net.nodes.len());
        let report = fast.add_velocity(&net.nodes, &mut v);
        (v, report)
    };
    let ((v, one), (w, two)) = (run(&large), run(&small));
    let back: Points = w.iter().map(|w| w * k).collect();
    assert_eq!((bits(&v), one), (bits(&back), two));
}

#[test]
fn limit_a_whole_wake_from_afar_is_one_cell() {
    let model = MODELS[0];
    let net = wakes::hover(model, 5_000);
    let ring = |i: usize| 400.0 * DVec3::new((i as f64).cos(), (i as f64).sin(), 0.3);
    let at: Points = (0..300).map(ring).collect();
    let exact = direct(model, &net, &at);
    let mut fast = FastSum::new(tree(model));
    fast.load_network(&net);
    let mut v = Points::zeros(at.len());
    let report = fast.add_velocity(&at, &mut v);
    // The first part left out is (2 / 400)^6 of the first; a wake of rings has little of that. Measured 4e-11.
    assert!(error(&v, &exact).1 < 1e-10, "{:?}", error(&v, &exact));
    assert!(report.far <= 3 * 300 && report.near == 0, "{report:?}");
}

#[test]
fn agrees_in_single_precision_for_every_core_model() {
    for model in MODELS {
        let mut net = wakes::hover(model, 4_000);
        // Far from the origin: single precision must not lose the place.
        for c in [&mut net.nodes.x, &mut net.nodes.y, &mut net.nodes.z] {
            c.iter_mut().for_each(|c| *c += 300.0);
        }
        let exact = direct(model, &net, &net.nodes);
        let single = |tolerance| {
            let mut fast = FastSum::new(FastSettings {
                method: Method::Single,
                tolerance,
                ..FastSettings::new(model)
            });
            fast.load_network(&net);
            let mut v = Points::zeros(exact.len());
            (fast.add_velocity(&net.nodes, &mut v), v)
        };
        let (report, v) = single(1e-4);
        let (rms, max) = error(&v, &exact);
        // A rounding is 6e-8 of a cluster some thirty edges wide; a target beside a filament feels it in
        // parts of its distance, which is a thousandth of an edge at the worst of these.
        assert_eq!(report.method, Method::Single);
        println!("{model:?} {rms:e} {max:e}");
        let allowed = match model {
            CoreModel::CutOff { .. } => [4e-5, 2e-3],
            CoreModel::Algebraic { .. } => [4e-5, 2e-4],
            _ => [1e-6, 4e-5], // wider than that beside the filament
        };
        assert!(
            rms < allowed[0] && max < allowed[1],
            "{model:?} {rms:e} {max:e}"
        );
        assert!(
            (1e-8..5e-5).contains(&report.error_rms),
            "{model:?} {report:?}"
        );
        let (report, v) = single(1e-7);
        assert_eq!(report.method, Method::Direct);
        assert_eq!(bits(&v), bits(&exact));
    }
}

#[test]
fn exact_double_precision_takes_over_where_the_range_of_single_ends() {
    // Places 1e25 edge lengths away: their squares are beyond 3e38.
    for model in MODELS {
        let net = wakes::hover(model, 2_000);
        let mut at = net.nodes.clone();
        at.x.iter_mut().for_each(|x| *x += 1e24);
        let exact = direct(model, &net, &at);
        let mut fast = FastSum::new(FastSettings {
            method: Method::Single,
            ..FastSettings::new(model)
        });
        fast.load_network(&net);
        let mut v = Points::zeros(at.len());
        let report = fast.add_velocity(&at, &mut v);
        assert_eq!(report.method, Method::Direct, "{model:?} {report:?}");
        assert_eq!(bits(&v), bits(&exact));
        let [checked, discarded] = [1, 1];
        assert_eq!(fast.tally(), Tally { checked, discarded });
        fast.add_velocity(&net.nodes, &mut v);
        let checked = 2;
        assert_eq!(fast.tally(), Tally { checked, discarded });
    }
}

#[test]
fn exact_auto_takes_the_sum_that_is_fastest_at_its_size() {
    let model = MODELS[1];
    for (edges, expected) in [
        (400, Method::Direct),
        (2_000, Method::Single),
        (40_000, Method::Tree),
    ] {
        let net = wakes::hover(model, edges);
        let mut fast = FastSum::new(FastSettings::new(model));
        fast.load_network(&net);
        let mut v = Points::zeros(net.nodes.len());
        assert_eq!(fast.add_velocity(&net.nodes, &mut v).method, expected);
        if expected == Method::Direct {
            assert_eq!(bits(&v), bits(&direct(model, &net, &net.nodes)));
        }
    }
}

/// Targets of loads keep the last digits, to which bodies and air come to agree, unless a tolerance of 1e-3 or more
/// allows single precision.
#[test]
fn exact_few_targets_are_in_single_precision_from_a_tolerance_of_1e_3() {
    let model = MODELS[4];
    let net = wakes::hover(model, 5_000);
    let targets: Points = net.nodes.iter().take(300).collect();
    let of = |tolerance: f64, targets: &Points| {
        let mut fast = FastSum::new(FastSettings {
            tolerance,
            ..FastSettings::new(model)
        });
        fast.load_network(&net);
        let mut v = Points::zeros(targets.len());
        (fast.add_velocity(targets, &mut v).method, v)
    };
    let exact = direct(model, &net, &targets);
    let (fine, rough) = (of(9e-4, &targets), of(1e-3, &targets));
    assert_eq!(fine.0, Method::Direct);
    assert_eq!(bits(&fine.1), bits(&exact));
    assert_eq!(rough.0, Method::Single);
    let (rms, _) = error(&rough.1, &exact);
    assert!(0.0 < rms && rms < 1e-4, "{rms:e}"); // 2e-5 beside nodes, whose roundings are largest
    let fewest: Points = targets.iter().take(99).collect();
    assert_eq!(of(1e-3, &fewest).0, Method::Direct);
}

/// Meshes serve algebraic cores alone, from a tolerance on.
#[test]
fn exact_single_precision_where_meshes_do_not_serve() {
    for model in MODELS {
        let net = wakes::hover(model, 5_000);
        let [mesh, single] = [Method::Mesh, Method::Single].map(|method| {
            let mut fast = FastSum::new(FastSettings {
                method,
                ..FastSettings::new(model)
            });
            fast.load_network(&net);
            let mut v = Points::zeros(net.nodes.len());
            (fast.add_velocity(&net.nodes, &mut v), bits(&v))
        });
        assert_eq!(mesh, single, "{model:?}");
        assert_eq!(mesh.0.method, Method::Single);
    }
}

#[test]
fn exact_nothing_moves_where_nothing_turns() {
    let model = MODELS[1];
    let mut net = wakes::hover(model, 5_000);
    net.gamma.fill(0.0);
    let mut fast = FastSum::new(tree(model));
    fast.load_network(&net);
    let mut v = Points::zeros(net.nodes.len());
    fast.add_velocity(&net.nodes, &mut v);
    assert!(v.iter().all(|v| v == DVec3::ZERO));
}

#[test]
fn exact_no_sources_no_targets_and_all_in_one_place() {
    let model = MODELS[1];
    let mut fast = FastSum::new(tree(model));
    fast.load_network(&Network::default());
    let mut v = Points::zeros(3);
    fast.add_velocity(&Points::zeros(3), &mut v);
    assert_eq!(v, Points::zeros(3));
    let mut heap = Network::default();
    (0..500).for_each(|i| heap.push_segment(DVec3::X, DVec3::Y, 1.0 / (1 + i) as f64, 4e-4));
    fast.load_network(&heap);
    fast.add_velocity(&Points::default(), &mut Points::default());
    let at: Points = (0..500)
        .map(|i| DVec3::new(0.0, 0.0, (i % 2) as f64))
        .collect();
    let (mut v, exact) = (Points::zeros(500), direct(model, &heap, &at));
    fast.add_velocity(&at, &mut v);
    assert!(error(&v, &exact).0 < 1e-6 && v.z[0] > 0.0); // roundings of single precision
}
