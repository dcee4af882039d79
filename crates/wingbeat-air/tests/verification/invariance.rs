//! What may not change the answer: place, direction, handedness, speed of the observer, threads,
//! interruptions.

use crate::common::{Run, fly, rectangle, sphere, total_force, with_leading_edges};
use wingbeat_air::{
    AirLoads, AirSettings, Convection, CoreModel, Lattice, LeadingEdge, MirrorPairs, NodeMotion,
    Plane, SheddingKinds, Surface,
};
use wingbeat_math::{DMat3, DVec3, r1, r2, r3, smoothstep7};

const ALL: SheddingKinds = SheddingKinds {
    trailing: true,
    tip: true,
    leading: true,
    root: false,
};

/// A left and a right wing flapping about the x axis in a stream along x, z up.
fn pair(t: f64) -> NodeMotion {
    let (angle, rate) = (0.5 * (3.0 * t).cos(), -1.5 * (3.0 * t).sin());
    let mut motion = NodeMotion::default();
    for side in [1.0, -1.0] {
        let turn = r1(side * angle) * r2(0.1);
        for x in rectangle(3, 4, DVec3::X, side * 2.0 * DVec3::Y) {
            let x = turn * x + side * 0.1 * DVec3::Y;
            motion.position.push(x);
            motion.velocity.push(side * rate * DVec3::X.cross(x));
        }
    }
    motion
}

fn lattice(stream: DVec3) -> Lattice {
    let wings = ["right", "left"].map(|name| Surface::grid(name, 3, 4));
    let settings = AirSettings {
        shedding: ALL,
        ..AirSettings::benchmark(1.2, stream)
    };
    Lattice::new(wings.to_vec(), settings).unwrap()
}

const STREAM: DVec3 = DVec3::new(2.0, 0.0, 0.3);
const STEPS: usize = 8;

fn run(lattice: &Lattice, motion: impl Fn(f64) -> NodeMotion) -> Run {
    fly(lattice, motion, 0.1, STEPS, |_, _, _, _| {}).unwrap()
}

fn turned(motion: NodeMotion, r: DMat3, shift: DVec3, velocity: DVec3) -> NodeMotion {
    NodeMotion {
        position: motion.position.iter().map(|x| r * *x + shift).collect(),
        velocity: motion.velocity.iter().map(|v| r * *v + velocity).collect(),
    }
}

#[test]
fn invariant_under_rotation_and_translation() {
    let r = r1(0.7) * r3(-1.2) * r2(2.0);
    let a = run(&lattice(STREAM), pair);
    let b = run(&lattice(r * STREAM), |t| {
        turned(pair(t), r, DVec3::new(3.0, -2.0, 5.0), DVec3::ZERO)
    });
    let (fa, fb) = (total_force(&a.loads), total_force(&b.loads));
    // Roundings, amplified by eight steps of a free wake near its own filaments.
    assert!((r * fa - fb).length() < 1e-9 * fa.length());
}

#[test]
fn invariant_under_the_motion_of_the_observer() {
    let u = DVec3::new(0.5, -1.5, 0.8);
    let a = run(&lattice(STREAM), pair);
    let b = run(&lattice(STREAM + u), |t| {
        turned(pair(t), DMat3::IDENTITY, t * u, u)
    });
    let (fa, fb) = (total_force(&a.loads), total_force(&b.loads));
    assert!((fa - fb).length() < 1e-9 * fa.length()); // as above
    let moment = |run: &Run, p: DVec3| {
        let loads = &run.loads.surfaces[0];
        loads.moment - p.cross(loads.force)
    };
    let t = 0.1 * STEPS as f64;
    let (ma, mb) = (moment(&a, DVec3::ZERO), moment(&b, t * u));
    assert!((ma - mb).length() < 1e-9 * ma.length());
}

/// A body behind the right wing and the wake that goes by it at less than the clearance, seen by observers of
/// several times the speed of the flow: every node is pushed as far.
#[test]
fn invariant_wakes_kept_off_bodies_under_the_motion_of_the_observer() {
    let (nodes, quads) = sphere(2);
    let of = |u: DVec3| {
        let mut surfaces = lattice(STREAM).surfaces().to_vec();
        surfaces.push(Surface::closed("body", nodes.len(), quads.clone()));
        let settings = AirSettings {
            clearance: 0.3,
            ..lattice(STREAM + u).settings().clone()
        };
        let lattice = Lattice::new(surfaces, settings).unwrap();
        let motion = |t: f64| {
            let mut motion = pair(t);
            let place = DVec3::new(1.8, 0.8, 0.2);
            let body = nodes.iter().map(|x| place + DVec3::new(0.5, 0.3, 0.3) * *x);
            motion.position.extend(body);
            motion.velocity.resize(motion.position.len(), DVec3::ZERO);
            turned(motion, DMat3::IDENTITY, t * u, u)
        };
        let mut forces = Vec::new();
        let run = fly(&lattice, motion, 0.1, 2 * STEPS, |_, _, loads, _| {
            forces.push(total_force(loads));
        });
        (forces, run.unwrap().state.events.near_surface)
    };
    let (forces, count) = of(DVec3::ZERO);
    assert!(count > 20, "{count} nodes were held back");
    let most = forces.iter().fold(0.0_f64, |most, f| most.max(f.length()));
    for u in [-STREAM, DVec3::new(3.0, -8.0, 5.0)] {
        let (others, others_count) = of(u);
        let apart = forces.iter().zip(&others).map(|(a, b)| a.distance(*b));
        let largest = apart.fold(0.0, f64::max) / most;
        println!("{count} held back, apart by {largest:.1e}");
        // Roundings, amplified by steps of a free wake.
        assert!(largest < 1e-9 && count == others_count);
    }
}

/// Wings that begin to beat smoothly in air at rest fly as those whose air is next to at rest, whatever its
/// direction: of circulations that are next to zero it matters neither what left the edges nor what these held.
#[test]
fn invariant_start_from_rest_under_motions_that_are_next_to_none() {
    let suction = LeadingEdge::Suction {
        threshold: 0.12,
        efficiency: 1.0,
    };
    let core = |radius: f64| CoreModel::Algebraic {
        radius,
        viscosity: 0.0,
    };
    let of = |leading: LeadingEdge, drift: DVec3| {
        let settings = AirSettings {
            shedding: ALL,
            bound_core: core(0.01),
            wake_core: core(0.07),
            wake_overlap: 1.0,
            clearance: 0.1,
            ..with_leading_edges(leading, DVec3::ZERO)
        };
        let lattice = Lattice::new(vec![Surface::grid("wing", 2, 3)], settings).unwrap();
        let motion = |t: f64| {
            let [start, rate, _] = smoothstep7(t, 0.0, 0.5);
            let w = std::f64::consts::TAU;
            let angle = start * (w * t).sin();
            let turn = rate * (w * t).sin() + start * w * (w * t).cos();
            let wing = rectangle(2, 3, DVec3::X, 2.0 * DVec3::Y).into_iter();
            let position: Vec<DVec3> = wing
                .map(|x| r3(angle) * (r2(0.8) * (x - 0.25 * DVec3::X) + 0.2 * DVec3::Y))
                .collect();
            let velocity = position.iter().map(|x| turn * DVec3::Z.cross(*x) + drift);
            NodeMotion {
                velocity: velocity.collect(),
                position,
            }
        };
        let mut forces = Vec::new();
        fly(&lattice, motion, 0.025, 12, |_, _, loads, _| {
            forces.push(total_force(loads));
        })
        .unwrap();
        forces
    };
    for leading in [suction, LeadingEdge::Always, LeadingEdge::Never] {
        let rest = of(leading, DVec3::ZERO);
        let most = rest.iter().fold(0.0_f64, |most, f| most.max(f.length()));
        for direction in [DVec3::X, -DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z] {
            let other = of(leading, 1e-17 * direction);
            let apart = rest.iter().zip(&other).map(|(a, b)| a.distance(*b));
            let largest = apart.fold(0.0, f64::max) / most;
            println!("{direction}: {largest:.1e}");
            // Roundings, amplified by steps of a free wake.
            assert!(largest < 5e-12);
        }
    }
}

/// Wings that move through air at rest, and the same in a stream that carries everything along: as many rows of
/// wake are too far.
#[test]
fn invariant_rows_dropped_for_their_distance_under_the_motion_of_the_observer() {
    let rows = |stream: DVec3, u: DVec3| {
        let settings = AirSettings {
            max_distance: Some(0.5),
            ..lattice(stream + u).settings().clone()
        };
        let lattice = Lattice::new(lattice(stream).surfaces().to_vec(), settings).unwrap();
        let run = run(&lattice, |t| turned(pair(t), DMat3::IDENTITY, t * u, u));
        (run.state.sheets[0].rows(), total_force(&run.loads))
    };
    let (kept, force) = rows(STREAM, DVec3::ZERO);
    assert!(kept < STEPS);
    for u in [-STREAM, 5.0 * STREAM] {
        let (moving, other) = rows(STREAM, u);
        assert_eq!(moving, kept);
        assert!((force - other).length() < 1e-9 * force.length()); // as above
    }
}

/// Two wings beside a sphere, with mirror pairs; the left wing's panels run the other way round.
pub(crate) fn halves(motion: &NodeMotion, whole: bool) -> Lattice {
    let right = Surface::grid("right", 3, 4);
    let mut left = Surface::grid("left", 3, 4);
    left.panels.iter_mut().for_each(|c| c.swap(1, 3));
    let (nodes, quads) = sphere(2);
    let body = Surface::closed("body", nodes.len(), quads.clone());
    let settings = AirSettings {
        shedding: ALL,
        convection: Convection::AdamsBashforth,
        max_rows: Some(5),
        ..AirSettings::benchmark(1.2, STREAM)
    };
    let lattice = Lattice::new(vec![right, left, body], settings).unwrap();
    if whole {
        return lattice;
    }
    let flip = |x: DVec3| DVec3::new(x.x, -x.y, x.z);
    let twin = |x: &DVec3| {
        let is_image = |y: &DVec3| y.distance(flip(*x)) < 1e-9;
        motion.position.iter().position(is_image).unwrap()
    };
    let node: Vec<usize> = motion.position.iter().map(twin).collect();
    let corners = |p: usize| {
        let mut c = lattice.topology().panels[p];
        c.sort_unstable();
        c
    };
    let panel = |p: usize| {
        let mut image = corners(p).map(|n| node[n]);
        image.sort_unstable();
        (0..lattice.panel_count()).find(|&q| corners(q) == image)
    };
    let panel = (0..lattice.panel_count())
        .map(|p| panel(p).unwrap())
        .collect();
    let plane = Plane {
        point: DVec3::ZERO,
        normal: DVec3::Y,
    };
    lattice
        .with_mirror_symmetry(MirrorPairs { plane, node, panel })
        .unwrap()
}

pub(crate) fn with_body(t: f64) -> NodeMotion {
    let mut motion = pair(t);
    // Clear of the wings, and with nodes in the plane of symmetry.
    let body = sphere(2).0.into_iter().map(|x| 0.3 * x - 1.2 * DVec3::Z);
    motion.position.extend(body);
    motion.velocity.resize(motion.position.len(), DVec3::ZERO);
    motion
}

#[test]
fn agrees_with_both_halves_when_only_one_is_computed() {
    let start = with_body(0.0);
    let [whole, half] = [true, false].map(|whole| run(&halves(&start, whole), with_body));
    let scale = total_force(&whole.loads).length();
    for (a, b) in whole.loads.force.iter().zip(&half.loads.force) {
        assert!((*a - *b).length() < 1e-9 * scale); // roundings in a free wake, as above
    }
    assert!(half.loads.normal_velocity_residual < 1e-12 && half.state.sheets[0].rows() == 5);
    let residuals = [&whole, &half].map(|r| r.loads.surfaces[2].net_flux_residual);
    assert!((residuals[0] - residuals[1]).abs() < 1e-12);
    // The wakes are each other's image to the bit.
    let [right, left] = [0, 1].map(|k| &half.state.sheets[k]);
    let flipped: Vec<f64> = right.nodes.y.iter().map(|y| -y).collect();
    assert_eq!((&left.nodes.x, &left.nodes.y), (&right.nodes.x, &flipped));
    let turned: Vec<f64> = right.gamma.iter().map(|g| -g).collect();
    assert_eq!(left.gamma, turned);
}

#[test]
fn refuses_an_asymmetric_motion_where_one_half_is_computed() {
    let start = with_body(0.0);
    let motion = |t: f64| {
        let mut motion = with_body(t);
        if t > 0.25 {
            motion.position[3] += 1e-5 * DVec3::Z;
        }
        motion
    };
    let result = fly(&halves(&start, false), motion, 0.1, STEPS, |_, _, _, _| {});
    let error = result.err().expect("refused").to_string();
    assert!(
        error.contains("step 3") && error.contains("node 3"),
        "{error}"
    );
}

#[test]
fn invariant_under_reflection() {
    let run = run(&lattice(STREAM), pair);
    let [right, left] = [0, 1].map(|s| run.loads.surfaces[s]);
    let mirror = DVec3::new(1.0, -1.0, 1.0);
    // As above; the two wings are eliminated one after the other, so not bit for bit.
    assert!((left.force - mirror * right.force).length() < 1e-9 * right.force.length());
    assert!((left.moment + mirror * right.moment).length() < 1e-9 * right.moment.length());
    assert!(right.force.y.abs() > 1e-3 * right.force.length()); // something to mirror
}

/// Half the size at twice the speed: forces are the same (density speed^2 size^2).
#[test]
fn invariant_under_scale() {
    let a = run(&lattice(STREAM), pair);
    let wings = lattice(STREAM).surfaces().to_vec();
    let settings = AirSettings {
        shedding: ALL,
        ..AirSettings::benchmark(1.2, 2.0 * STREAM).with_cut_off_for(0.5)
    };
    let small = Lattice::new(wings, settings).unwrap();
    let motion = |t: f64| {
        let whole = pair(4.0 * t);
        NodeMotion {
            position: whole.position.iter().map(|x| 0.5 * *x).collect(),
            velocity: whole.velocity.iter().map(|v| 2.0 * *v).collect(),
        }
    };
    let b = fly(&small, motion, 0.025, STEPS, |_, _, _, _| {}).unwrap();
    let (fa, fb) = (total_force(&a.loads), total_force(&b.loads));
    assert!((fa - fb).length() < 1e-9 * fa.length()); // powers of two: roundings of sin and cos
}

#[test]
fn invariant_bits_for_any_number_of_threads() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| run(&lattice(STREAM), pair))
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(one.loads, three.loads);
    assert_eq!(one.state, three.state);
}

/// A copy of the state and fresh scratch memory go on bit for bit; trial loads leave no trace.
#[test]
fn invariant_bits_after_restart_and_trials() {
    let lattice = lattice(STREAM);
    let whole = run(&lattice, pair);
    let mut state = fly(&lattice, pair, 0.1, STEPS - 1, |_, _, _, _| {})
        .unwrap()
        .state
        .clone();
    let (mut ws, mut loads) = (lattice.workspace(), AirLoads::default());
    let t = STEPS as f64 * 0.1;
    lattice.convect(&mut state, 0.1, &mut ws).unwrap();
    let mut ws = lattice.workspace();
    for trial in [t + 0.03, t] {
        lattice
            .loads(&state, t, 0.1, &pair(trial), &mut ws, &mut loads)
            .unwrap();
    }
    assert_eq!(loads, whole.loads);
    lattice.accept(&mut state, &pair(t), &loads).unwrap();
    assert_eq!(state, whole.state);
}
